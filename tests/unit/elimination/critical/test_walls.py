"""The walls of convex truth sets in the plane: the same as by all open cells, by far fewer questions."""

from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.projection import factor_lists
from qe.elimination.critical.open_cells import OpenCells
from qe.elimination.critical.system import System, systems
from qe.elimination.critical.walls import Walls, box_around, walls_in_plane
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.io.text import read as parse
from qe.options import Budget

PLANE = Ring.of(("x", "y"))


def read(text: str) -> System:
    (system,) = systems(convert(parse(text), PLANE), PLANE, 2)
    return system


def walls_of(system: System, surfaces: frozenset[Poly]) -> Walls:
    box = box_around(system, Budget())
    assert box is not None
    return walls_in_plane(surfaces, box, lambda p: inside(system, p), Point(PLANE), Budget())


def inside(system: System, place: tuple[F, ...]) -> bool:
    return holds_at(system.formula, dict(zip(PLANE.names, place, strict=True)))


def by_cells(system: System, surfaces: frozenset[Poly]) -> OpenCells:
    levels = factor_lists(surfaces, 2, BROWN_MCCALLUM, Budget())
    cells = OpenCells(levels, lambda p: inside(system, p), Budget(), (F(0), F(0)))
    cells.explore(Point(PLANE))
    return cells


def surfaces_of(system: System) -> frozenset[Poly]:
    return frozenset(f for a in system.guards for f, _ in a.poly.factors()[1])


def test_a_corner_that_no_first_sample_sees_is_a_wall() -> None:
    """The middle of the disc shows the circle alone; the line cuts off a sliver far from there."""
    system = read("x^2 + y^2 <= 4 and 10*x + y <= 19")
    found = walls_of(system, surfaces_of(system))
    assert found.polys == surfaces_of(system) and found.inside


def test_far_surfaces_are_left_out() -> None:
    system = read("x^2 + y^2 <= 4 and x <= 100 and y >= -50 and (x - 9)^2 + y^2 <= 1000")
    assert walls_of(system, surfaces_of(system)).polys == surfaces_of(read("x^2 + y^2 <= 4"))


def test_no_interior_points() -> None:
    """A segment has none, over its projection or beside it."""
    for text in ("x^2 + y^2 <= 4 and x = y", "x^2 + y^2 <= 4 and x = 1"):
        assert not walls_of(read(text), surfaces_of(read(text))).inside


def test_no_box_around_what_is_unbounded_or_empty() -> None:
    assert box_around(read("y >= x^2"), Budget()) is None
    assert box_around(read("x^2 + y^2 <= 1 and x >= 2 and y <= 3"), Budget()) is None


NUMBERS = st.integers(-3, 3)
HALVES = st.tuples(NUMBERS, NUMBERS, st.integers(0, 5)).filter(lambda h: h[0] or h[1])
DISCS = st.tuples(NUMBERS, NUMBERS, st.integers(1, 20))


@given(st.lists(HALVES, max_size=4), st.lists(DISCS, min_size=1, max_size=3))
@settings(max_examples=25, deadline=None)
def test_the_walls_are_those_between_true_and_false_cells(
    halves: list[tuple[int, int, int]], discs: list[tuple[int, int, int]]
) -> None:
    parts = [f"{a}*x + {b}*y <= {c}" for a, b, c in halves] + [f"(x-{a})^2 + (y-{b})^2 <= {r}" for a, b, r in discs]
    system = read(" and ".join(parts).replace("--", "+").replace("+ -", "- "))
    surfaces = surfaces_of(system)
    cells = by_cells(system, surfaces)
    if not cells.inside:
        return
    found = walls_of(system, surfaces)
    assert {f for f in found.polys if f.level} == cells.walls()
    assert all(inside(system, place) for place in found.inside)


def test_the_shadow_found_by_walls_is_the_one_found_by_all_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "ex u, v. u^2 + v^2 <= 9 and (x - u)^2 + (y - v)^2 <= 4 and x + u <= 3"
    found = []
    for few in (0, 10**6):
        monkeypatch.setattr("qe.elimination.critical.block.FEW", few)
        found.append(qe.eliminate(text, method="critical").formula)
    assert qe.equivalent(*found)
