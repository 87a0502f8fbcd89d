"""Comparisons with roots, in numbers of roots: a table has each of them as its answer, and no other."""

import qe
from qe.formula.build import conj
from qe.formula.counting import without_root_atoms
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts
from qe.io.text import read
from tests.tables import each
from tests.unit.proving.elaborated import refused

RULE = "roots counted"
PLACES = (">", ">=", "=", "<", "<=", "/=")


def counted(text: str) -> Formula:
    return without_root_atoms(read(text))


@each(1, -1, 2)
def test_each_relation_has_its_own_formula(k: int) -> None:
    atoms = [f"x {place} root({k}, x^2 - a, x)" for place in PLACES]
    for atom in atoms:
        for other in atoms if k == 1 else (atom, atoms[0]):
            assert (refused(RULE, read(atom), counted(other)) == "") is (other == atom), (atom, other)


def test_a_polynomial_that_may_vanish_has_no_roots_then() -> None:
    atom = "x > root(1, b*x - a, x)"
    right = counted(atom)
    assert refused(RULE, read(atom), right) == ""
    assert refused(RULE, read(atom), conj(conjuncts(right)[:1])) != ""


def test_everything_else_stays() -> None:
    text = "c > 0 and not x > root(1, x - a, x) and (ex y. y > root(1, y^3 - x, y))"
    right = counted(text)
    assert refused(RULE, read(text), right) == ""
    assert refused(RULE, read(text), conj(conjuncts(right)[1:])) != ""
    assert refused(RULE, "c > 0", "c > 0") == ""
    assert refused(RULE, "c > 0", "c >= 0") != ""
    assert refused(RULE, "c > 0", "c > 0", {"theory": 1}) != ""


def test_names_of_roots_that_the_formula_has_are_others() -> None:
    answer = qe.eliminate("x <= root(1, b*x - a) and t_0 > x", check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps


def test_the_kernel_alone_believes_it() -> None:
    answer = qe.eliminate("all y. x < root(2, x^2 - y) or y < 3", check=True, process=False)
    assert answer.certificate is not None and qe.verify(answer.certificate, core=True).accepted
