"""Openness by syntax: what is called open has room around every solution, and what is left out has no interior."""

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from experiments.reference import eliminate
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, exists
from qe.formula.evaluate import holds_at
from qe.formula.openness import is_closed, is_open, somewhere_nonzero
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.io.text import read
from tests.strategies import formulas, polynomials, rationals
from tests.tables import each

RING = Ring.of(("a", "x", "y"))


@each(
    ("x > 0 and y /= 0", "x y", True, False),
    ("x >= 0 or y = 0", "x y", False, True),
    ("x > 0 and a = 0", "x", True, False),
    ("x > 0 and a = 0", "a x", False, False),
    ("a > 0 or x = 0", "x", False, True),
    ("x < root(1, x^2 - a)", "y", True, True),
    ("x < root(1, x^2 - a)", "x", False, False),
    ("x < root(1, x^2 - a)", "a", False, False),
    ("not x < root(1, x^2 - a)", "a", False, False),
    ("ex y. x*y > 0", "x", False, False),
    ("ex y. y > a", "x", True, True),
)
def test_shapes(text: str, block: str, open_: bool, closed: bool) -> None:
    formula = convert(read(text), RING)
    indices = [RING.index[name] for name in block.split()]
    assert (is_open(formula, indices), is_closed(formula, indices)) == (open_, closed)


def test_constants_are_open_and_closed() -> None:
    assert all(is_open(f, (0,)) and is_closed(f, (0,)) for f in (TRUE, FALSE))


@given(formulas(names=RING.names), st.tuples(*[rationals(2, 2)] * 3), st.sampled_from([(1,), (1, 2), (0, 1, 2)]))
def test_an_open_set_has_room_around_its_points(
    formula: Formula, point: tuple[Fraction, ...], block: tuple[int, ...]
) -> None:
    """Around a rational solution a small enough box of solutions, in the block; dually for closed sets and gaps."""
    there = dict(zip(RING.names, point, strict=True))
    inside = holds_at(formula, there)
    if not (is_open(formula, block) if inside else is_closed(formula, block)):
        return
    step = Fraction(1, 10**9)
    for direction in (1, -1):
        near = {n: v + step * direction * (i in block) for i, (n, v) in enumerate(there.items())}
        assert holds_at(formula, near) == inside


@settings(max_examples=30, deadline=None)
@given(polynomials(RING, max_degree=2, max_terms=3), st.integers(-2, 2), st.integers(-2, 2))
def test_an_inequation_removes_no_interior(p: Poly, bound: int, a: int) -> None:
    """(ex x, y. F and p /= 0) iff F has a solution and some coefficient of p is not 0, for the open F: x > bound."""
    room = atom(RING.gen(1) - bound, Relation.GT)
    claimed = somewhere_nonzero(p, (1, 2))
    left = exists(("x", "y"), conj((room, atom(p, Relation.NE))))
    values = {name: Fraction(a) for name in RING.names}
    assert holds_at(eliminate(left), values) == holds_at(claimed, values)
