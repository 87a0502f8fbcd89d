"""The suite ``paper``: the paper's formulas for the instance of its timing and a seeded family of random via points."""

from __future__ import annotations

import random
import re
from collections.abc import Collection, Iterator
from dataclasses import replace
from fractions import Fraction
from math import comb

from bezier.curves.scalar import exactly
from bezier.input.task import Axis, task
from bezier.methods.control.statements import number
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from bezier.methods.single import formula as single_formula
from bezier.methods.single import program as single
from bezier.methods.single.formula import Symbol
from bezier.problem import Problem as PlanningProblem
from bezier.problem import read_problem
from experiments import formulas
from experiments.problem import Problem

SEED = 2024
FAMILY = 6

TWO_ACTIVE = """
via = [[-3, 2, 0], [2, 2, 0]]
start = [-5, 0, 0]
goal = [5, 0, 0]
radius = "sqrt(27)"
"""


Point = tuple[int, int, int]


def planning_problems() -> list[PlanningProblem]:
    """Instance 0 is Q0 = (-1, 3, 3), R0 = (1, 3, 3), r^2 = 27; the others are random, with the paper's radius rule.

    Start and goal are drawn near the via points, so that the radius is often too small for formula (8).
    """
    rng = random.Random(SEED)

    def point(low: int, high: int) -> Point:
        return rng.randint(low, high), rng.randint(1, 5), rng.randint(1, 5)

    drawn = [((-1, 3, 3), (1, 3, 3), (-5, 1, 1), (5, 1, 1))]
    drawn += [(point(-5, -1), point(1, 5), point(-6, -1), point(1, 6)) for _ in range(4 * FAMILY)]
    distinct = [points for points in drawn if len(set(points)) == 4][:FAMILY]
    return [_planning_problem(*points) for points in distinct]


def _planning_problem(q0: Point, r0: Point, start: Point, goal: Point) -> PlanningProblem:
    lines = [f"via = [{list(q0)}, {list(r0)}]", f"start = {list(start)}", f"goal = {list(goal)}"]
    return read_problem("\n".join(lines))


def problems() -> list[Problem]:
    """Every formula of the paper for every instance; families are named after the formulas."""
    found = [_symbolic(), *_identities()]
    for i, instance in enumerate(planning_problems()):
        found += _quadratic(i, instance)
        found += _cubic(i, instance)
    found += _single()
    return found


def _problem(family: str, i: int, formula: str, expected: str | None = None) -> Problem:
    return Problem(f"paper/{family}", f"{family}-{i}", formula, expected)


def _symbolic() -> Problem:
    """Formula (8) with via points and radius as parameters: three balls of radius r."""
    q1, q0, r0 = (formulas.coordinates(name) for name in ("q1", "q0", "r0"))
    points = (q1, *([f"2*{v} - {u}" for u, v in zip(q1, via, strict=True)] for via in (q0, r0)))
    balls = " and ".join(formulas.within(point, "r^2") for point in points)
    return Problem("paper/formula-8", "formula-8-symbolic", str(quadratic.SHAPE.symbolic()), f"r >= 0 and {balls}")


def _identities() -> Iterator[Problem]:
    """What holds for all curves: (2), (3), (6) from the smoothness of the joins, and the convex hull property.

    The hull is the intersection of half-spaces; the property says that a curve lies in every half-space in which its
    control points lie, and that is a statement about one coordinate.
    """
    for i, degree in enumerate((2, 3, 4)):
        yield _problem("formula-2", i, str(single_formula.linearity(degree)), "true")
    yield _problem("formula-3", 0, str(single_formula.inverse()), "true")
    names = "q0, q1, q2, r0, p1, p2, r1, r2"
    smooth = "2*q0 = p2 + q1 and 2*r0 = q2 + r1 and 2*(q1 - p2) = q2 - p1 and 2*(r1 - q2) = r2 - q1"
    six = "p1 = 4*q0 - 4*q1 + q2 and p2 = 2*q0 - q1 and r1 = 2*r0 - q2 and r2 = q1 - 4*q2 + 4*r0"
    yield _problem("formula-6", 0, f"all {names}. {smooth} <-> {six}", "true")
    for i, degree in enumerate((1, 2, 3)):
        points = [f"c{k}" for k in range(degree + 1)]
        curve = " + ".join(f"{comb(degree, k)}*t^{k}*(1 - t)^{degree - k}*c{k}" for k in range(degree + 1))
        inside = " and ".join(f"{point} >= 0" for point in points)
        hull = f"all t, {', '.join(points)}. t >= 0 and t <= 1 and {inside} -> {curve} >= 0"
        yield _problem("convex-hull", i, hull, "true")


def _quadratic(i: int, problem: PlanningProblem) -> Iterator[Problem]:
    """Formula (8), with z >= 0, its feasibility, its shadow on an axis, and the whole-curve condition."""
    conditions = str(quadratic.system(problem).in_free_points())
    above = " and ".join(f"{a} >= 0" for a in ("q1z", *(f"2*{number(p[2])} - q1z" for p in problem.via)))
    x, y, z = quadratic.FREE
    yield _problem("formula-8", i, str(quadratic.printed(problem).statement()), conditions)
    corrected = str(quadratic.corrected(problem).statement())
    yield _problem("formula-8-above", i, corrected, f"{conditions} and {above}")
    meet = str(quadratic.three_balls(problem).meet).lower()
    yield _problem("formula-8-feasible", i, f"ex {x}, {y}, {z}. {conditions}", meet)
    yield _problem("formula-8-shadow", i, f"ex {y}, {z}. {conditions}")
    q0, r0 = (tuple(map(exactly, p)) for p in problem.via)
    middle = [str(number((a + b) / 2)) for a, b in zip(q0[:2], r0[:2], strict=True)]
    height = formulas.whole_curve(q0, [*middle, "h"], r0, problem.workspace.radius_squared)
    yield _problem("whole-curve", i, height)


def _cubic(i: int, problem: PlanningProblem) -> Iterator[Problem]:
    """Formula (7): as printed, its truth (true: Q1 = Q0, Q2 = R0), in the plane, Q1 fixed, and the region of Q1."""
    system = cubic.system(problem)
    conditions = str(system.in_free_points())
    yield _problem("formula-7", i, str(system.statement()), conditions)
    block = ", ".join(system.shape.variables)
    yield _problem("formula-7-feasible", i, f"ex {block}. {conditions}", "true")
    flat = in_plane(problem)
    yield _problem("formula-7-plane", i, f"ex q1x, q1y, q2x, q2y. {flat}", "true")
    q0, r0 = problem.via
    outward = [f"q1{axis} = {number(2 * exactly(a) - exactly(b))}" for axis, a, b in zip("xy", q0, r0, strict=False)]
    yield _problem("formula-7-outward", i, f"ex q1x, q1y, q2x, q2y. {' and '.join(outward)} and {flat}")
    if i == 0:
        yield _problem("formula-7-region", i, f"ex q2x, q2y. {in_plane(read_problem(TWO_ACTIVE))}")


def in_plane(problem: PlanningProblem) -> str:
    """What (7) says of Q1 and Q2 when all points lie in the plane z = 0 (the first two coordinates are kept)."""
    q0, r0 = ((p[0], p[1], Fraction(0)) for p in problem.via)
    text = str(cubic.system(replace(problem, via=(q0, r0))).in_free_points())
    return re.sub(r"\bq[12]z\b", "0", text)


def single_curve(degree: int, symbols: Collection[Symbol] = ()) -> str:
    """(4) for a curve from (0, 0) to (1, 0) that keeps the height 1, or h, from x = 2/5 to x = 3/5."""
    zero, one = Fraction(0), Fraction(1)
    axis = Axis("y", zero, zero, one)
    given = task(degree, (zero, one), (Fraction(2, 5), Fraction(3, 5)), [axis])
    conditions = " and ".join(map(str, single_formula.constraints(given, axis, symbols)))
    return f"ex {', '.join(single.variables(given, axis))}. {conditions}"


def _single() -> Iterator[Problem]:
    """(4) with numbers and with the height of the obstacle as a parameter."""
    for i, degree in enumerate((4, 5, 6)):
        yield _problem("formula-4", i, single_curve(degree), "true")
        yield _problem("formula-4-height", i, single_curve(degree, (Symbol.HEIGHT,)), "h >= 0")
