"""Formula (8*): the engine's region against exact proofs about single curves, and beside the region of (8)."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

import qe
from bezier.compare import whole_curve
from bezier.compare.planar import Plane
from bezier.curves.area import convex_area
from bezier.curves.containment import all_inside, examine_all
from bezier.curves.curve import Bezier
from bezier.curves.scalar import dot
from bezier.curves.workspace import Ball, HalfSpace
from bezier.methods.quadratic import formula as quadratic
from bezier.problem import Problem, read_problem
from qe.errors import InputError
from tests.tables import each

PROBLEM = """\
workspace = "{kind}"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
radius = "{radius}"
"""


def problem(radius: str = "auto", kind: str = "ball") -> Problem:
    return read_problem(PROBLEM.format(kind=kind, radius=radius))


@pytest.fixture(scope="module")
def solved() -> tuple[Problem, Plane, qe.Region]:
    """r^2 = 89/4, so r is irrational."""
    given = problem()
    plane = Plane.through(given)
    return given, plane, whole_curve.region(given, plane, timeout=100)


def inside(given: Problem, plane: Plane, u: Fraction, v: Fraction) -> bool:
    """Whether the whole curves stay in the workspace, by ``bezier.curves.containment``."""
    system = quadratic.system(given)
    curves = system.curves(system.points([plane.point(u, v)]))
    return all(all_inside(examine_all(curve, given.workspace.conditions)) for curve in curves.values())


def test_region_is_where_the_curves_stay_inside(solved: tuple[Problem, Plane, qe.Region]) -> None:
    given, plane, region = solved
    source, seen = random.Random(5), set()
    for _ in range(80):
        u, v = Fraction(source.randint(-50, 50), 20), Fraction(source.randint(30, 56), 20)
        v = v if plane.second == (0, 1, 1) else 2 * v
        found = region.contains({"q1u": u, "q1v": v})
        assert found == inside(given, plane, u, v), (u, v)
        seen.add(found)
    assert seen == {True, False}


def test_boundary_points_touch_the_sphere(solved: tuple[Problem, Plane, qe.Region]) -> None:
    """Beside a rational point near each end of a fibre, inside and outside differ; the ends belong to the region."""
    given, plane, region = solved
    first, second = region.order
    middle = Fraction(3) if first == "q1v" else Fraction(1, 3)
    (interval,) = region.fibre({first: middle})
    assert interval.lower_closed and interval.upper_closed
    for end, outward in ((interval.lower, -1), (interval.upper, 1)):
        assert region.contains({first: middle, second: end})
        low, high = qe.RealAlgebraic.interval(end, 40) if isinstance(end, qe.RealAlgebraic) else (end, end)
        near = {1: Fraction(high), -1: Fraction(low)}[outward] + outward * Fraction(1, 10**6)
        deep = {1: Fraction(low), -1: Fraction(high)}[outward] - outward * Fraction(1, 10**6)
        for value, expected in ((near, False), (deep, True)):
            point = {first: middle, second: value}
            assert inside(given, plane, point["q1u"], point["q1v"]) is expected


def test_control_polygons_ask_for_more(solved: tuple[Problem, Plane, qe.Region]) -> None:
    given, plane, region = solved
    assert whole_curve.polygon_implies_curve(given, plane, timeout=60) is True
    narrow = qe.region(qe.eliminate(plane.section(quadratic.system(given).in_free_points(), ["Q1"]).formula).formula)
    small, large = convex_area(narrow, Fraction(1, 100)), convex_area(region, Fraction(1, 100))
    assert small.high is not None and large.low > 4 * small.high
    assert all(region.contains(point) for point in narrow.sample_points())


def test_a_curve_may_leave_although_another_condition_holds() -> None:
    """The implication is between the same condition on polygon and curve: a wider ball implies no narrower one."""
    given = problem()
    plane = Plane.through(given)
    family = whole_curve.families(given, plane)["P"]
    wide, narrow = (Ball((Fraction(0),) * 3, Fraction(s)) for s in (40, 23))
    text = f"all t, q1u, q1v. 0 <= t and t <= 1 and {family.polygon_inside([wide])} -> "
    assert qe.decide(text + str(family.inside([wide])).split("-> ", 1)[1], order=("t", "q1u", "q1v")) is True
    assert qe.decide(text + str(family.inside([narrow])).split("-> ", 1)[1], order=("t", "q1u", "q1v")) is False


@each("ball", "hemisphere")
def test_formula_at_a_point_is_the_statement_about_its_curves(kind: str) -> None:
    given = problem("6", kind)
    plane = Plane.through(given)
    formula = str(whole_curve.statement(given, plane))
    for u, v in ((0, 3), (2, 1), (-1, 4), (0, 6), (3, 5), (0, 9)):
        put = formula.replace("q1u", f"({u})").replace("q1v", f"({v})")
        assert qe.decide(put, timeout=120) == inside(given, plane, Fraction(u), Fraction(v)), (u, v)


CURVES = {
    "inside": ([(0, 0, 0), (1, 2, 0), (2, 1, 1), (1, 0, 0)], 9),
    "touches from inside": ([(-1, 1, 0), (0, 1, 0), (0, 1, 0), (1, 1, 0)], 2),
    "leaves": ([(-1, 0, 0), (0, 3, 0), (0, 3, 0), (1, 0, 0)], 4),
    "polygon leaves, curve does not": ([(-1, 0, 0), (0, 2, 0), (0, 2, 0), (1, 0, 0)], 3),
}


@pytest.mark.parametrize("name", CURVES)
def test_cubic_curves_by_the_engine_and_by_subdivision(name: str) -> None:
    points, square = CURVES[name]
    curve = Bezier.of(points)
    for condition in (Ball((Fraction(0),) * 3, Fraction(square)), HalfSpace((0, 1, 0), Fraction(1, 4))):
        expected = all_inside(examine_all(curve, [condition]))
        assert whole_curve.curve_inside(curve, [condition], timeout=120) == expected
    assert whole_curve.curve_inside(curve, [Ball((Fraction(0),) * 3, Fraction(square))]) == (name != "leaves")


def test_irrational_control_points_are_refused() -> None:
    root = qe.minimize("x", "x^2 <= 2").point["x"]
    curve = Bezier(((root, root, root), (root, root, root)))
    with pytest.raises(InputError, match="rational"):
        whole_curve.curve_inside(curve, [])


@each(
    ("[[-1, 3, 3], [1, 3, 3]]", (1, 0, 0), (0, 1, 1)),
    ("[[-3, '6/5', '8/5'], [2, '6/5', '8/5']]", (1, 0, 0), (0, "3/5", "4/5")),
    ("[[0, 0, 2], [0, 0, 1]]", (0, 0, -1), None),
    ("[[0, 0, 0], [1, 1, 2]]", (1, 1, 2), None),
)
def test_plane_through_the_via_points(via: str, first: tuple[object, ...], second: tuple[object, ...] | None) -> None:
    text = f'start = [-4, 1, 1]\nvia = {via}\ngoal = ["9/2", 1, 1]\n'
    given = read_problem(text)
    plane = Plane.through(given)
    assert plane.first == tuple(map(Fraction, first)) and dot(plane.first, plane.second) == 0
    assert second is None or plane.second == tuple(map(Fraction, second))
    for point in given.via:
        assert plane.point(*plane.place(point)) == point
    area = plane.unit_area
    exact = dot(plane.first, plane.first) * dot(plane.second, plane.second)
    assert area.high is not None and area.low**2 <= exact <= area.high**2
