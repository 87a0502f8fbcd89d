"""Cell tables made by an oracle: what the shape of a set says where its boundary polynomials vanish."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.projection import factor_lists
from qe.elimination.critical.block import Tabulated
from qe.elimination.critical.method import _described as described
from qe.elimination.critical.table import Shape, TableBuilder
from qe.errors import BudgetExceeded, NotWellOriented
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE
from qe.options import Budget
from qe.proof.cells import Cell, CellTable
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)
DISC = X**2 + Y**2 - 1
LEVELS = ((X + 1, X - 1), (DISC,))


class Oracle:
    """Whether a polynomial is <= 0 (or < 0) at a sample; remembers the samples that it was asked about."""

    def __init__(self, poly: Poly, strict: bool) -> None:
        self.poly, self.strict, self.asked = poly, strict, 0

    def __call__(self, point: Point, vanishing: frozenset[Poly]) -> bool:
        self.asked += 1
        sign = point.sign(self.poly)
        return sign < 0 or (sign == 0 and not self.strict)


def built(shape: Shape, oracle: Oracle, levels: tuple[tuple[Poly, ...], ...] = LEVELS, **other: object) -> TableBuilder:
    given = {"operator": BROWN_MCCALLUM, "budget": Budget(), **other}
    return TableBuilder(levels, boundary=frozenset((DISC,)), shape=shape, truth=oracle, **given)  # type: ignore[arg-type]


def leaves(cell: Cell) -> list[bool | None]:
    return [cell.truth] if cell.stack is None else [t for c in cell.stack.cells for t in leaves(c)]


CLOSED = [False, *[False, True, False], *[False, True, True, True, False], *[False, True, False], False]
OPEN = [False, *[False] * 3, *[False, False, True, False, False], *[False] * 3, False]


@each(
    (Shape.CONVEX, False, CLOSED, 11),  # two sections lie next to a true sector
    (Shape.CLOSED, False, CLOSED, 11),
    (Shape.OPEN, True, OPEN, 9),  # four sections lie next to a false sector
)
def test_the_disc(shape: Shape, strict: bool, truths: list[bool], asked: int) -> None:
    oracle = Oracle(DISC, strict)
    builder = built(shape, oracle)
    assert leaves(builder.run(Point(RING))) == truths
    assert (builder.cells, oracle.asked, builder.unsettled) == (13, asked, set())


def test_what_no_theorem_settles_is_listed_as_false_and_kept() -> None:
    builder = built(Shape.ANY, Oracle(DISC, False))
    assert leaves(builder.run(Point(RING)))[4:9] == [False, False, True, False, False]
    assert builder.unsettled == {DISC}
    points = leaves(builder.run(Point(RING)))
    assert points[1:4] == points[9:12] == [False, True, False]  # a single point is asked about


def test_limits_and_polynomials_that_are_zero_on_a_line() -> None:
    with pytest.raises(BudgetExceeded):
        built(Shape.ANY, Oracle(DISC, False), budget=Budget(0.0)).run(Point(RING))
    levels = ((X,), (X * Y,))
    with pytest.raises(NotWellOriented):
        built(Shape.ANY, Oracle(X * Y, False), levels).run(Point(RING))
    cell = built(Shape.ANY, Oracle(X * Y - 1, False), levels, operator=LAZARD).run(Point(RING))
    assert cell.stack is not None and cell.stack.sectors == (Fraction(-1), Fraction(1))


class EveryCell(TableBuilder):
    """Asks about every cell."""

    def _truth(self, point: Point, vanishing: frozenset[Poly], *_: object) -> bool:
        return self.truth(point, vanishing)


NUMBERS = st.integers(-3, 3)
HALVES = st.tuples(NUMBERS, NUMBERS, st.integers(0, 5)).filter(lambda h: h[0] or h[1])
DISCS = st.tuples(NUMBERS, NUMBERS, st.integers(1, 20))


@given(st.lists(HALVES, max_size=3), st.lists(DISCS, max_size=2), st.integers(-4, 4))
@settings(max_examples=60, deadline=None)
def test_a_convex_set_is_the_same_cell_by_cell(
    halves: list[tuple[int, int, int]], discs: list[tuple[int, int, int]], line: int
) -> None:
    """With interior points, bounded or not, and lines across it that are no part of its boundary."""
    polys = [a * X + b * Y - c for a, b, c in halves] + [(X - a) ** 2 + (Y - b) ** 2 - r for a, b, r in discs]
    if not polys:
        return
    asked = 0

    def inside(point: Point, vanishing: frozenset[Poly]) -> bool:
        nonlocal asked
        asked += 1
        return all(point.sign(p) <= 0 for p in polys)

    levels = factor_lists([*polys, X - line, X + Y - line], 2, BROWN_MCCALLUM, Budget())
    given = (levels, BROWN_MCCALLUM, frozenset(f for level in levels for f in level))
    every = leaves(EveryCell(*given, Shape.ANY, inside, Budget()).run(Point(RING)))
    needed = asked
    root = TableBuilder(*given, Shape.CONVEX, inside, Budget()).run(Point(RING))
    assert root.stack is not None
    if any(t for cell in root.stack.cells[::2] for t in leaves(cell)[::2]):
        assert leaves(root) == every and asked < 2 * needed


def test_a_plane_tells_two_stretches_of_one_sign_apart() -> None:
    """Between the middle two of four conjugate roots the quartic has the sign that it has outside."""
    quartic, planes = X**4 - 10 * X**2 + 1, list[Poly]()

    def table(_: frozenset[int], more: frozenset[Poly]) -> CellTable:
        planes.extend(more)
        levels = factor_lists([quartic, *more], 1, BROWN_MCCALLUM, Budget())
        given = (levels, BROWN_MCCALLUM, frozenset((quartic,)), Shape.CONVEX)
        inside = TableBuilder(*given, lambda point, _: point.sign(quartic) >= 0 and point.sign(X * X - 1) < 0, Budget())
        root = inside.run(Point(RING))
        factors = tuple(tuple(f.convert(Ring.of(("x",))) for f in level) for level in levels)
        return CellTable(("x",), ("",), TRUE, BROWN_MCCALLUM.proof, factors, root)

    found = described(Tabulated(table(frozenset(), frozenset()), table, frozenset()))
    assert planes and all(
        abs(plane.evaluate((0,)) / plane.leading(0).constant_value()) > Fraction(3, 10) for plane in planes
    )
    for k in range(-16, 17):
        assert holds_at(found, {"x": Fraction(k, 4)}) is (abs(k) <= 1)
