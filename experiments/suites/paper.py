"""The suite ``paper``: the paper's formulas for the instance of its timing and a seeded family of random via points."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction

from bezier import quadratic
from bezier.problem import Problem as PlanningProblem
from bezier.problem import read_problem
from experiments import formulas
from experiments.problem import Problem

SEED = 2024
FAMILY = 6

PLANE = ((-3, 2), (2, 2), 27)
"""Q0, R0 and r^2 of the plane instance of (7) with two active constraints at its optimum."""

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
    found = [_symbolic()]
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
    return Problem("paper/formula-8", "formula-8-symbolic", quadratic.SHAPE.symbolic_formula(), f"r >= 0 and {balls}")


def _quadratic(i: int, problem: PlanningProblem) -> Iterator[Problem]:
    """Formula (8), with z >= 0, its feasibility, its shadow on an axis, and the whole-curve condition."""
    conditions = quadratic.system(problem).conditions_text()
    above = " and ".join(f"{a} >= 0" for a in ("q1z", *(f"2*{p[2]} - q1z" for p in problem.via)))
    x, y, z = quadratic.FREE
    yield _problem("formula-8", i, quadratic.printed(problem).formula(), conditions)
    corrected = quadratic.corrected(problem).formula()
    yield _problem("formula-8-above", i, corrected, f"{conditions} and {above}")
    meet = str(quadratic.three_balls(problem).meet).lower()
    yield _problem("formula-8-feasible", i, f"ex {x}, {y}, {z}. {conditions}", meet)
    yield _problem("formula-8-shadow", i, f"ex {y}, {z}. {conditions}")
    middle = [str((Fraction(a) + Fraction(b)) / 2) for a, b in zip(*problem.via, strict=True)]
    radius = Fraction(problem.workspace.radius_squared)
    q0, r0 = (tuple(map(Fraction, p)) for p in problem.via)
    height = formulas.whole_curve(q0, [*middle[:2], "h"], r0, radius)
    yield _problem("whole-curve", i, height)


def _cubic(i: int, problem: PlanningProblem) -> Iterator[Problem]:
    """Formula (7): as printed, its truth (true: Q1 = Q0, Q2 = R0), in the plane, Q1 fixed, and the region of Q1."""
    q0, r0 = (tuple(map(Fraction, p)) for p in problem.via)
    radius = Fraction(problem.workspace.radius_squared)
    conditions = formulas.cubic_conditions(q0, r0, radius)
    block = ", ".join(v for name in ("q1", "q2") for v in formulas.coordinates(name))
    yield _problem("formula-7", i, formulas.formula7(q0, r0, radius), conditions)
    yield _problem("formula-7-feasible", i, f"ex {block}. {conditions}", "true")
    flat = formulas.cubic_conditions(q0[:2], r0[:2], radius)
    block = ", ".join(v for name in ("q1", "q2") for v in formulas.coordinates(name, 2))
    yield _problem("formula-7-plane", i, f"ex {block}. {flat}", "true")
    q1 = (f"q1{axis} = {formulas.number(2 * a - b)}" for axis, a, b in zip("xy", q0, r0, strict=False))
    outward = f"ex {block}. {' and '.join(q1)} and {flat}"
    yield _problem("formula-7-outward", i, outward)
    block = ", ".join(formulas.coordinates("q2", 2))
    if i == 0:
        yield _problem("formula-7-region", i, f"ex {block}. {formulas.cubic_conditions(*PLANE)}")


def _single() -> Iterator[Problem]:
    """(4) with numbers and with the height of the obstacle as a parameter."""
    a, b = Fraction(2, 5), Fraction(3, 5)
    for i, degree in enumerate((4, 5, 6)):
        yield _problem("formula-4", i, formulas.single_curve(degree, a, b), "true")
        text = formulas.single_curve(degree, a, b, "h")
        yield _problem("formula-4-height", i, text, "h >= 0")
