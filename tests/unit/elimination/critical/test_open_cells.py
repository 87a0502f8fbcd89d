"""Open cells of convex sets, and polynomials that tell them apart."""

from fractions import Fraction as F

from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.projection import Levels, factor_lists
from qe.elimination.critical.open_cells import OpenCell, OpenCells
from qe.elimination.critical.separate import separated
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.options import Budget

PLANE = Ring.of(("x", "y"))
X, Y = PLANE.gen(0), PLANE.gen(1)


def disc(values: tuple[F, ...]) -> bool:
    return values[0] ** 2 + values[1] ** 2 <= 4


def explored(polys: list[Poly], holds=disc, hint=(F(0), F(0))) -> OpenCells:
    levels = factor_lists(polys, 2, BROWN_MCCALLUM, Budget())
    found = OpenCells(levels, holds, Budget(), hint)
    found.explore(Point(PLANE))
    return found


def test_only_the_boundary_is_a_wall() -> None:
    polys = [X * X + Y * Y - 4, X * X + Y * Y - 1, X - Y, Y * Y - X - 3]
    found = explored(polys)
    assert found.walls() == {X * X + Y * Y - 4}
    assert all(disc(values) for values in found.inside)
    cells = list(found.cells(Point(PLANE)))
    assert all(cell.truth == disc(cell.values) for cell in cells)
    assert found.decided < len(cells)


def test_the_hint_may_be_wrong() -> None:
    assert explored([X * X + Y * Y - 4], hint=(F(50), F(-7))).walls() == {X * X + Y * Y - 4}


def test_no_true_cell() -> None:
    found = explored([X * X + Y * Y - 4], holds=lambda values: False)
    assert not found.inside and not found.walls()
    assert not any(cell.truth for cell in found.cells(Point(PLANE)))


def separate(polys: set[Poly], holds) -> tuple[Levels, list[OpenCell]]:
    def cells(extended: frozenset[Poly]) -> tuple[Levels, list[OpenCell]]:
        found = explored(list(extended), holds)
        return found.levels, list(found.cells(Point(PLANE)))

    return separated(frozenset(polys), cells)


def distinguishable(cells: list[OpenCell]) -> bool:
    return not {c.signs for c in cells if c.truth} & {c.signs for c in cells if not c.truth}


def test_two_stretches_of_one_sign() -> None:
    # the strip between the two middle ones of four lines: outside and inside have equal signs of their product
    quartic = (Y * Y - 1) * (Y * Y - 9) + X * X
    assert not quartic.factors()[1][1:]

    def inner(values: tuple[F, ...]) -> bool:
        x, y = values
        return (y * y - 1) * (y * y - 9) + x * x >= 0 and y * y < 4 and x * x < 9

    levels, cells = separate({quartic, X * X + Y * Y - 20}, inner)
    assert distinguishable(cells)
    assert any(f.total_degree == 1 for level in levels for f in level)


def test_first_variable_is_separated_by_a_line() -> None:
    def between(values: tuple[F, ...]) -> bool:
        return -1 <= values[0] <= 1 and -1 <= values[1] <= 1

    quartic = (X * X - 1) * (X * X - 9)
    _, cells = separate({quartic, Y * Y - 1, *[f for f, _ in quartic.factors()[1]]}, between)
    assert distinguishable(cells)
