"""Equational constraints: which equations count, what they save, and that answers stay the same."""

from collections.abc import Iterator
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.certify.verify import verify
from qe.decomposition.constraints import equational_constraints
from qe.decomposition.decompose import Tactics, decompose
from qe.decomposition.operators.lazard import LAZARD
from qe.exact.ring import Ring, format_poly
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import Cell
from qe.proof.certificate import Certificate
from tests.tables import each
from tests.unit.elimination.vs.line import satisfiable, specialise

ORDER = ("a", "x", "y")


def _matrix(text: str) -> Formula:
    return convert(read(text), Ring.of(ORDER))


@each(
    ("y^2 + x = 0 and y > a", {"y^2 + x"}),
    ("y^3 - x = 0 and y - a = 0", {"y - a"}),  # the cheaper one
    ("(y - x)*(y - a) = 0", {"y - x", "y - a"}),
    ("x*(y - a) = 0 and y > 0", None),  # x = 0 satisfies it between the sections of y - a
    ("x^2 - a = 0 and y > 0", None),
    ("y = a or y > 0", None),
    ("y >= a", None),
)
def test_which_equations_restrict_the_projection(text: str, factors: set[str] | None) -> None:
    found = equational_constraints(_matrix(text), 3).factors.get(2)
    if factors is None:
        assert found is None
    else:
        assert found is not None
        ring = Ring.of(ORDER)
        assert found == {p.normal()[1] for p in (next(iter(_polys(f, ring))) for f in factors)}


def _polys(text: str, ring: Ring) -> list:
    from qe.formula.traverse import polynomials

    return polynomials(convert(read(f"{text} = 0"), ring))


def test_the_projection_gets_smaller() -> None:
    matrix = _matrix("y^2 + x^2 = 1 and y^3 - a*x > 0 and y^2*x + a < 2")
    kinds = ("", "E", "E")
    small = decompose(matrix, ORDER, kinds, budget=Budget())
    large = decompose(matrix, ORDER, kinds, budget=Budget(), operator=LAZARD)
    assert small.restricted == ("y",) and not large.restricted
    assert small.factors < large.factors


terms = st.dictionaries(
    st.tuples(st.integers(0, 1), st.integers(0, 2), st.integers(0, 2)), st.integers(-2, 2), min_size=1, max_size=4
)


@settings(max_examples=18)
@given(terms, terms, terms, st.sampled_from(["<", "<=", ">", "/=", "="]))
def test_same_truth_as_the_full_lazard_projection(e: dict, f: dict, g: dict, relation: str) -> None:
    """ex y over (a, x): the truth at every free cell's sample agrees with an unrestricted decision at that point."""
    ring = Ring.of(ORDER)
    texts = [format_poly(ring.from_terms(t)) for t in (e, f, g)]
    text = f"{texts[0]} = 0 and {texts[1]} {relation} 0 and {texts[2]} > 0"
    restricted = qe.eliminate(f"ex y. {text}", method="cad").formula
    body = convert(read(text), ring)
    for a in (Fraction(-1), Fraction(0), Fraction(1, 2)):
        for x in (Fraction(-2), Fraction(0), Fraction(1), Fraction(3, 2)):
            at = {"a": a, "x": x}
            assert holds_at(restricted, at) is satisfiable(specialise(body, at), ring.index["y"])


@each(
    ("ex y. y^2 = x and y > 1", "x > 1"),  # the resultant with y - 1 is what separates x = 1
    ("ex y. y^3 = x and y^2 < 2 and y > 0", "x > 0 and x^2 < 8"),
    ("ex y. y^2 = x and y - a < 0 and y >= 0", "x >= 0 and a > 0 and a^2 > x"),
)
def test_resultants_with_the_other_polynomials_are_kept(text: str, answer: str) -> None:
    assert qe.equivalent(qe.eliminate(text, method="cad").formula, answer)


@each(
    ("x^2 + y^2 = 4 and x*y = 1", ("E", "E", "E"), ("x", "y")),  # the resultant restricts x
    ("y^2 = a and y = x^2 - 1 and x > 0", ("", "", "E"), ("x", "y")),  # a free variable as well
    ("y^2 + x = 0 and y > a", ("", "E", "E"), ("y",)),
    ("x^2 + y^2 /= 4 or x*y /= 1", ("A", "A", "A"), ("x", "y")),  # dually
    ("(y = x or y = 1 - x) and y > a", ("E", "E", "E"), ("y",)),  # one of two
    ("(y = x and y > 3 or y^2 = 2) and y > a", ("E", "E", "E"), ("y",)),
    ("y = x or y > a", ("E", "E", "E"), ()),  # nothing is implied, and two conditions would be needed to deny
    ("y^2 = x and y > a", ("", "", ""), ()),  # a region keeps all its cells
    ("y^2 = x", ("E", "E", "E"), ()),  # all factors are the constraint's
)
def test_which_levels_are_restricted(text: str, quantifiers: tuple[str, ...], restricted: tuple[str, ...]) -> None:
    found = decompose(_matrix(text), ORDER, quantifiers, budget=Budget())
    assert found.restricted == restricted
    assert verify(Certificate.cells(found.table)).accepted


def test_two_constraints_leave_fewer_factors_and_cells() -> None:
    matrix = _matrix("x^2 + y^2 = a and x^3*y = 1 and y^3 - a*x > 0 and x^2*y + y > 2")
    first = decompose(matrix, ORDER, ("E", "E", "E"), budget=Budget())
    none = decompose(matrix, ORDER, ("E", "E", "E"), budget=Budget(), tactics=Tactics(constraints=False))
    assert first.restricted == ("x", "y")
    assert first.factors < none.factors
    assert first.table.root.truth is none.table.root.truth


def test_signs_beside_a_constraint_are_open_between_its_sections() -> None:
    table = decompose(_matrix("y^2 = 2 and y > a + x"), ORDER, ("", "", "E"), budget=Budget()).table
    stack = next(c.stack for c in _cells(table.root) if c.stack is not None and len(c.stack.used) == 2)
    constraint = stack.used.index(table.constraints[2][0])
    for position, below in enumerate(stack.cells):
        assert below.signs[constraint] == ("0" if position % 2 else "+-+"[position // 2])
        assert (below.signs[1 - constraint] == "?") is (position % 2 == 0)
        assert below.truth is not None or position % 2


def _cells(cell: Cell) -> Iterator[Cell]:
    yield cell
    for below in cell.stack.cells if cell.stack else ():
        yield from _cells(below)


def test_a_constraint_that_vanishes_on_a_line_restricts_nothing_there() -> None:
    """a*y + x is zero for every y over a = x = 0."""
    found = decompose(_matrix("a*y + x = 0 and y^2 > 2"), ORDER, ("E", "E", "E"), budget=Budget())
    assert found.table.root.truth is True
    whole = decompose(_matrix("a*y + x = 0 and y^2 > 2 and x^2 + a^2 <= 0"), ORDER, ("E",) * 3, budget=Budget())
    assert whole.table.root.truth is True
    assert verify(Certificate.cells(whole.table)).accepted
