"""Comparisons of methods, and conditions for whole curves."""

from __future__ import annotations

import doctest
import json
import random
import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import qe
from bezier.compare import comparison, whole_curve
from bezier.compare.command import render
from bezier.compare.comparison import METHODS, Comparison, _Parts, compare, for_method
from bezier.compare.output import NOT_REACHED, bracket, notes, rows, table, to_json
from bezier.compare.pictures import outline
from bezier.compare.whole_curve import Plane
from bezier.curves.area import convex_area
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.curves.scalar import dot
from bezier.curves.workspace import Ball, HalfSpace
from bezier.methods.cubic.existence import existence, sentence, trivial_witness
from bezier.methods.quadratic import formula as quadratic
from bezier.motion.motion import Quality
from bezier.plans import Clock
from bezier.problem import PlanMethod, Problem, read_problem
from bezier.report.first import duration
from qe.errors import BudgetExceeded, InputError, Unable
from tests.bezier.made import stays
from tests.tables import each

CUBIC = """\
method = "cubic"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
ratio = "1/2"
join_speed = "1/10"
[[half_space]]
normal = [0, 0, 1]
offset = 2
points = ["Q1", "Q2"]
"""


def test_a_cubic_problem_for_the_quadratic_method() -> None:
    given = read_problem(CUBIC)
    quadratic, cubic = (for_method(given, method) for method in METHODS)
    assert cubic is given and quadratic.method is PlanMethod.QUADRATIC
    assert (quadratic.ratio, quadratic.join_speed) == (1, 0)
    assert [item.points for item in quadratic.half_spaces] == [("Q1",)]
    assert (quadratic.start, quadratic.via, quadratic.workspace) == (given.start, given.via, given.workspace)
    back = for_method(quadratic, PlanMethod.CUBIC)
    assert [item.points for item in back.half_spaces] == [("Q1", "Q2")] and isinstance(back, Problem)


def test_other_methods_are_refused() -> None:
    from bezier.compare.comparison import compare

    with pytest.raises(InputError, match="quadratic"):
        compare(replace(read_problem(CUBIC), method=PlanMethod.SINGLE))


def test_totals_of_a_path() -> None:
    one, two = Enclosure(Fraction(1), Fraction(2)), Enclosure(Fraction(3), Fraction(7, 2))
    quality = Quality({"P": one, "Q": two}, {"P": one, "Q": Enclosure(Fraction(0), None), "R": None}, None)
    assert quality.length == Enclosure(Fraction(4), Fraction(11, 2))
    assert quality.curvature == Enclosure(Fraction(1), None)
    assert Quality({}, {"P": None}, None).curvature is None


def test_ends_are_rounded_outwards() -> None:
    third = Fraction(1, 3)
    assert bracket(Enclosure(third, 2 * third), 3) == "[0.333, 0.667]"
    assert bracket(Enclosure(third, third), 3) == "[0.333, 0.334]"
    assert bracket(Enclosure(Fraction(5, 4), Fraction(5, 4))) == "1.25"
    assert bracket(Enclosure(Fraction(1), None)) == "[1, inf]"
    assert bracket(None) == ""
    assert (duration(0.0123), duration(2.5)) == ("12.3 ms", "2.50 s")


def test_existence_theorem_of_the_comparison() -> None:
    found = existence(timeout=60)
    assert found.truth is True
    assert found.witness == ", ".join(f"{name} = {value}" for name, value in trivial_witness().items())
    assert qe.check_witness(sentence(), trivial_witness()) is True
    assert qe.check_witness(sentence(), trivial_witness() | {"q1x": "0"}, timeout=60) is False


def test_the_documentation_is_true(
    root: Path, solved: tuple[Problem, Plane, qe.Region], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It asks for the region that other tests of this file look at, too."""
    given, _, known = solved
    region = whole_curve.region

    def once(problem: Problem, plane: Plane) -> qe.Region:
        same = replace(problem, source=given.source) == given
        return known if same else region(problem, plane)

    monkeypatch.setattr(whole_curve, "region", once)
    outcome = doctest.testfile(str(root / "docs" / "compare.md"), module_relative=False)
    assert outcome.attempted > 12 and outcome.failed == 0


PROBLEM = """\
method = "cubic"
workspace = "ball"
start = [-4, 1, 1]
via = [["-7/4", 2, "5/2"], ["3/2", 2, "5/2"]]
goal = [4, 1, 1]
radius = "17/4"
"""
"""Regions (8*) and (7) of this problem take long; its plans do not."""


@pytest.fixture(scope="module")
def found() -> Comparison:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(comparison, "COMPARE_SECONDS", 0.2)
        return compare(read_problem(PROBLEM), proofs=True)


def test_parts_that_finish_are_there(found):
    assert all(side.plan.path is not None for side in found.sides.values())
    assert found.planar.whole.region is None and found.planar.cubic.region is None
    assert found.planar.named["(8*)"].reason and "limit" in found.unfinished["planar region of (7)"]


def test_derivations_are_in_the_certificate_and_linked(found):
    assert {"formula (8)", "formula (7)", "the condition z ≥ 0"} <= set(found.derivations)
    labels = [member.label for member in found.certificate.payload]
    assert {"(8): optimum", "(7): optimum", "derivation of formula (7)"} <= set(labels)
    for name, page in found.derivation_pages.items():
        assert f'href="{page}"' in render(found, {}) and qe.verify(found.derivations[name].certificate).accepted


def test_every_derivation_for_the_example_is_checked(root, monkeypatch):
    """(8*) in the plane was once left unproved: its common divisors over numbers of degree 56 took 16 s."""
    monkeypatch.setattr(comparison, "COMPARE_SECONDS", 90.0)  # whatever else the machine does
    monkeypatch.setattr(comparison, "PROOF_SECONDS", 60.0)
    whole = compare(read_problem((root / "examples" / "cubic_joins.toml").read_text()), proofs=True)
    assert not whole.unproved and not whole.unfinished
    assert "the planar region of (8*)" in whole.derivations
    assert all(found.certificate is not None for found in whole.derivations.values())


def test_every_form_shows_them_and_says_why_the_rest_is_missing(found):
    text = table(found)
    assert "path found" in text and "planar region of (7): not finished, time limit" in text
    data = json.loads(json.dumps(to_json(found, [])))
    assert data["planar"]["regions"]["(7)"]["cells"] is None and "limit" in data["planar"]["regions"]["(7)"]["reason"]
    assert data["unfinished"].keys() == found.unfinished.keys() >= {"planar region of (7)", "planar region of (8*)"}
    page = render(found, {})
    assert "path found" in page and "not finished" in page
    cells = {label: cells for label, *cells in rows(found)}
    assert cells["area of Q1 in the plane, mm²"][1] == NOT_REACHED
    assert any(line.startswith("planar region of (8*): not finished") for line in notes(found))


def test_what_has_no_proof_is_said_in_every_form(found):
    without = replace(found, unproved={"the planar region of (8*)": "time limit"})
    assert "derivation of the planar region of (8*): not every step checked: time limit" in notes(without)
    assert to_json(without, [])["unproved"] == {"the planar region of (8*)": "time limit"}
    assert "not every step checked: time limit" in render(without, {})


def test_a_part_gets_its_share_and_leaves_the_others_theirs():
    seen: list[float] = []

    def work(seconds: float) -> str:
        seen.append(seconds)
        raise BudgetExceeded("time limit reached")

    parts = _Parts(Clock(limit=10.0))
    assert parts.take("first", 2, work) is None and parts.take("second", 1, work) is None
    assert 4 < seen[0] < 4.3 and 8 < seen[1] < 8.6
    assert parts.unfinished == {"first": "time limit reached", "second": "time limit reached"}
    assert parts.take("third", 1, lambda seconds: "done") == "done" and "third" in parts.clock.seconds


def test_after_the_limit_parts_are_left_out_at_once():
    parts = _Parts(Clock(limit=0.01))
    time.sleep(0.02)
    assert parts.take("late", 1, lambda seconds: pytest.fail("it was begun")) is None
    assert "limit" in parts.unfinished["late"]


def test_a_region_is_shown_without_its_area(monkeypatch):
    def no_area(*arguments: object, **keywords: object) -> None:
        raise Unable("too curved")

    monkeypatch.setattr(comparison, "convex_area", no_area)
    problem = read_problem(PROBLEM)
    plane = comparison.Plane.through(problem)
    formula = comparison.planar_statements(problem, plane)["(8)"]
    part = comparison._region(formula, plane, Clock(), 20.0)
    assert part.region is not None and part.region._pieces and part.area is None
    assert part.reason == "area not found: too curved"


def test_a_region_is_limited_by_processor_time_not_by_the_clock():
    """On a busy machine (8*) was not reached: 30 s by the clock were 10 s of work."""
    problem = read_problem(PROBLEM)
    plane = comparison.Plane.through(problem)
    formula, begin = comparison.planar_statements(problem, plane)["(8*)"], comparison.processor_time()
    with pytest.raises(Unable, match="limit of 1 s of processor time"):
        comparison._region(formula, plane, Clock(), 1.0)
    assert 0.7 < comparison.processor_time() - begin < 4


@each(
    ("x^2 + y^2 <= 1", "x, y", np.pi),
    ("x^2 + y^2 < 1 and y <= x", "y, x", np.pi / 2),
    ("x >= 0 and y >= 0 and x + 2*y <= 2", "x, y", 1.0),
    ("0 <= x and x <= 1 and 0 <= y and y <= 3", "y, x", 3.0),
    ("x^2 + y^2 <= 4 and (x - 1)^2 + y^2 <= 4 and y <= 1", "y, x", None),
)
def test_it_is_closed_and_has_no_gap(text, order, area):
    points = outline(qe.region(text, order=order))
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    x, y = points.T
    assert (points[0] == points[-1]).all() and np.isfinite(points).all()
    # a wall across the first variable is one step; elsewhere the line goes in small ones
    walls = np.abs(np.diff(x)) < 1e-6
    assert steps[~walls].max() < 0.05
    if area is not None:
        assert abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2 == pytest.approx(area, rel=1e-4)


def test_a_region_without_interior_has_none():
    assert outline(qe.region("x^2 + y^2 <= 0", order="x, y")).shape == (0, 2)


ROOM = """\
workspace = "{kind}"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
radius = "{radius}"
"""


def problem(radius: str = "auto", kind: str = "ball") -> Problem:
    return read_problem(ROOM.format(kind=kind, radius=radius))


@pytest.fixture(scope="module")
def solved() -> tuple[Problem, Plane, qe.Region]:
    """r^2 = 89/4, so r is irrational."""
    given = problem()
    plane = Plane.through(given)
    return given, plane, whole_curve.region(given, plane, timeout=100)


@pytest.mark.deep
def test_the_planar_region_of_whole_curves_keeps_its_derivation(root: Path) -> None:
    """It was lost unnoticed: a decomposition of the whole question does not end, one for each of its pieces does."""
    given = read_problem((root / "examples" / "cubic_joins.toml").read_text())
    question = str(whole_curve.statement(given, Plane.through(given)))
    answer = qe.eliminate(question, check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps
    assert len(str(answer.formula)) < 4_000


def inside(given: Problem, plane: Plane, u: Fraction, v: Fraction) -> bool:
    """Whether the whole curves stay in the workspace, by ``bezier.curves.containment``."""
    system = quadratic.system(given)
    curves = system.curves(system.points([plane.point(u, v)]))
    return all(stays(curve, given.workspace.conditions) for curve in curves.values())


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
    assert all(answer.truth for answer in whole_curve.implications(given, plane, timeout=60).values())
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
        expected = stays(curve, [condition])
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
