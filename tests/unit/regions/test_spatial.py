"""Regions in the plane and in space: connected components, closure and interior, fibres."""

from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction as F
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.decomposition.interval import Interval
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.formula.build import conj, disj, neg
from qe.formula.normal import nnf
from qe.formula.syntax import Formula
from qe.io.substitution import over_one_ring
from qe.options import Budget
from qe.regions.region import Region
from qe.regions.spatial import Coordinates, Space, coordinates
from qe.regions.topology import near
from tests.strategies import formulas
from tests.tables import each

ORDER = ("x", "y", "z")
TORUS = "(x^2 + y^2 + z^2 + 3)^2 <= 16*(x^2 + y^2)"

KNOWN = {
    "x^2 + y^2 + z^2 <= 1 or (x - 2)^2 + y^2 + z^2 <= 1": 1,
    "x^2 + y^2 + z^2 < 1 or (x - 2)^2 + y^2 + z^2 < 1": 2,
    "x^2 + y^2 + z^2 < 1 or (x - 2)^2 + y^2 + z^2 < 1 or x = 1 and y = 0 and z = 0": 1,
    "1 <= x^2 + y^2 + z^2 <= 4": 1,
    "2 <= x^2 + y^2 + z^2 <= 4 or x^2 + y^2 + z^2 <= 1": 2,
    "0 <= x < 1 and 0 <= y <= 1 and 0 <= z <= 1 or 1 <= x <= 2 and 1 <= y <= 2 and 1 <= z <= 2": 1,
    "0 <= x < 1 and 0 <= y < 1 and 0 <= z <= 1 or 1 <= x <= 2 and 1 < y <= 2 and 1 <= z <= 2": 2,
    "x*y*z > 0": 4,
    "x*y*z >= 0": 1,
    "x*y*z /= 0": 8,
    "x^2 + y^2 = z^2 and z /= 0": 2,
    "x^2 + y^2 = z^2": 1,
    "x^2 + y^2 = z^2 - 1": 2,
    "x^2 + y^2 = z^2 + 1": 1,
    "x^2 = y^2*z and y /= 0": 2,
    "x^2 > 1": 2,
    "x^2 + y^2 + z^2 < 0": 0,
}

ON_LINES = {  # x*z - y is zero on the whole line x = y = 0
    "x*z = y": 1,
    "x*z > y": 1,
    "x*z = y and x /= 0": 2,
    "x*z = y and (x /= 0 or y /= 0) or x = 0 and y = 0 and z > 5": 1,
    "x*z = y and x > 0 and z < 1 or x = 0 and y = 0 and z > 2": 2,
    "x*z = y and x > 0 and z < 1 or x = 0 and y = 0 and z >= 1": 1,
}


def counts(formula: Formula) -> Iterator[int | None]:
    """The number of components by each of the coordinates, None where it stays open."""
    given = nnf(formula)
    for chosen in [*coordinates(given, ORDER), Coordinates(ORDER, (1, 2))]:
        parts = Space.of(chosen.of(given), chosen.order, Budget(120)).components()
        yield None if parts is None else len(parts)


@pytest.mark.parametrize(("text", "count"), (KNOWN | ON_LINES).items())
def test_known_numbers(text: str, count: int) -> None:
    whole = qe.region(text, order=ORDER)
    parts = whole.components()
    assert len(parts) == count
    assert all(a.is_disjoint(b) for a, b in combinations(parts, 2))
    assert not parts or qe.equivalent(disj(over_one_ring(*(p.formula for p in parts))), whole.formula)


@each((TORUS, 1), (f"{TORUS} or x^2 + y^2 + z^2 <= 1/2", 2), (f"{TORUS} and x*y /= 0", 4), (f"({TORUS}) = false", 1))
def test_a_torus(text: str, count: int) -> None:
    """Alone, with a ball in its hole, without two planes, and what is around it."""
    outside = text.endswith("= false")
    formula = read_formula(text.removesuffix(" = false"))
    assert next(counts(neg(formula) if outside else formula)) == count


@pytest.mark.parametrize(("text", "count"), ON_LINES.items())
def test_lines_on_which_a_factor_vanishes_leave_it_open_or_do_not_matter(text: str, count: int) -> None:
    """The first order leaves some of them open; none gives another number."""
    assert {count} <= set(counts(read_formula(text))) <= {count, None}


def test_four_variables_are_refused() -> None:
    with pytest.raises(qe.Unable, match="up to 3 variables"):
        qe.region("x*y*z*w > 1").components()


SMALL = st.integers(-3, 3)
BALLS = st.lists(st.tuples(SMALL, SMALL, SMALL, st.integers(1, 2)), min_size=2, max_size=3, unique=True)
BOXES = st.lists(st.tuples(SMALL, SMALL, SMALL), min_size=2, max_size=4, unique=True)


@settings(max_examples=4)
@given(BALLS, st.booleans())
def test_unions_of_balls(balls: list[tuple[int, ...]], closed: bool) -> None:
    """Balls meet where their centres are no farther apart than their radii together (open ones: nearer than that)."""
    relation = "<=" if closed else "<"
    text = " or ".join(f"(x - {a})^2 + (y - {b})^2 + (z - {c})^2 {relation} {r * r}" for a, b, c, r in balls)
    near = []
    for p, q in combinations(range(len(balls)), 2):
        *centre, r = balls[p]
        *other, s = balls[q]
        gap = sum((u - v) ** 2 for u, v in zip(centre, other)) - (r + s) ** 2
        near += [(p, q)] if gap < 0 or (closed and gap == 0) else []
    assert len(qe.region(text, order=ORDER).components()) == _parts(len(balls), near)


@settings(max_examples=4)
@given(BOXES, st.booleans())
def test_unions_of_boxes(corners: list[tuple[int, ...]], closed: bool) -> None:
    """Unit boxes that hold their lower sides meet as neighbours do; closed ones also at corners."""
    relation = "<=" if closed else "<"
    text = " or ".join(
        " and ".join(f"{v} >= {k} and {v} {relation} {k + 1}" for v, k in zip(ORDER, at)) for at in corners
    )
    near = []
    for p, q in combinations(range(len(corners)), 2):
        apart = [v - u for u, v in zip(corners[p], corners[q])]
        same_way = min(apart) >= 0 or max(apart) <= 0
        near += [(p, q)] if max(map(abs, apart)) <= 1 and (closed or same_way) else []
    assert len(qe.region(text, order=ORDER).components()) == _parts(len(corners), near)


@settings(max_examples=6)
@given(formulas(names=ORDER, max_degree=2))
def test_all_coordinates_give_one_number(formula: Formula) -> None:
    with suppress(qe.BudgetExceeded):  # some have millions of cells
        assert len(set(counts(formula)) - {None}) == 1


def _parts(size: int, pairs: list[tuple[int, int]]) -> int:
    """The number of parts of a graph."""
    part = list(range(size))
    for p, q in pairs:
        part = [part[p] if k == part[q] else k for k in part]
    return len(set(part))


@settings(max_examples=6)
@given(formulas(names=("x",), max_degree=3))
def test_closure_and_interior_on_the_line(formula) -> None:
    _agrees(formula, ("x",))


@settings(max_examples=6)
@given(formulas(names=("x", "y"), max_degree=1))
def test_closure_and_interior_in_the_plane(formula) -> None:
    _agrees(formula, ("x", "y"))


@pytest.mark.deep
@each("y^2 < x^2*(x - 1)", "x*y > 1 or y = 0", "x^2 + y^2 > 1 and x*y <= 1", "x*y^2 < 1")
def test_closure_and_interior_of_curved_sets(text: str) -> None:
    _agrees(read_formula(text), ("x", "y"))


def _agrees(formula, order: tuple[str, ...]) -> None:
    region = Region.of(formula, order)
    f = nnf(region.formula)
    assert qe.equivalent(region.closure().formula, near(f, order), timeout=120)
    assert qe.equivalent(region.interior().formula, neg(near(nnf(f, negate=True), order)), timeout=120)
    border = conj(over_one_ring(region.closure().formula, neg(region.interior().formula)))
    assert qe.equivalent(region.boundary().formula, border)


SQRT2 = RealAlgebraic.from_root((-2, 0, 1), 1, 2)
ANNULUS = "x^2 + y^2 <= 4 and x^2 + y^2 > 1"


def test_three_variables_walk_to_a_point() -> None:
    region = qe.region("x^2 + y^2 + z^2 <= 3 and x*y*z >= 1")
    point: list[object] = []
    for _ in region.order:
        intervals = region.fibre(point)  # type: ignore[arg-type]
        point.append(intervals[0].simplest())
    assert region.contains(dict(zip(region.order, point, strict=True)))  # type: ignore[arg-type]


def test_prefix_must_name_the_first_variables() -> None:
    region = qe.region(ANNULUS)
    for wrong in ({"y": 1}, {"x": 0, "y": 1}, [1, 2], {"x": "one"}, [1, 2, 3]):
        with pytest.raises(InputError):
            region.fibre(wrong)  # type: ignore[arg-type]


def test_membership_in_intervals() -> None:
    interval = Interval(F(0), SQRT2, False, True)
    assert SQRT2 in interval and F(1) in interval and F(0) not in interval and F(3, 2) not in interval
    assert F(-5) in Interval(None, F(0), False, False)
