"""Trees of cases on signs: what is refuted, and what is not."""

import pytest

from qe.coq.signs import Tree
from qe.errors import Unable
from qe.formula.build import exists
from qe.formula.syntax import And, Atom, Formula
from qe.io.text import read
from tests.tables import each


def parts(text: str) -> tuple[Formula, ...]:
    whole = read(text)
    return whole.args if isinstance(whole, And) else (whole,)


def test_opposite_signs_of_one_polynomial_close_at_once() -> None:
    assert Tree(parts("x > 0 and x <= 0"), [], []).text().count("Clash") == 2


def test_an_identity_is_used() -> None:
    formulas = parts("x > 0 and y > 0 and x*y <= 0")
    x, y, xy = (a.poly for a in formulas if isinstance(a, Atom))
    identity = ((1, ((0, 1),)), (-1, ((1, 1), (2, 1))))
    assert "(By 0)" in Tree(formulas, [xy, x, y], [identity]).text()
    with pytest.raises(Unable):
        Tree(formulas, [xy, x, y], []).text()


def test_a_quantified_part_holds_or_does_not() -> None:
    (less,) = parts("x < y")
    some = exists(["y"], less)
    tree = Tree([some, *parts("x > 0 or x < 0 or x = 0"), exists(["y"], less)], [], [])
    with pytest.raises(Unable):
        tree.text()
    tree = Tree([some, read("all y. x >= y")], [], [])
    assert tree.text().startswith("(Sf ")
    assert list(tree.quantified.values()) == [some]


@each("x > 0 or y > 0", "x /= 0 and (y = 0 or z < 0)", "x >= 0 and x <= 0")
def test_what_can_be_true_has_no_tree(text: str) -> None:
    with pytest.raises(Unable, match="do not exclude"):
        Tree(parts(text), [], []).text()
