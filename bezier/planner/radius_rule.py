"""When a via point lies on the sphere |p| = r: what formulas (7) and (8) then force, and a radius that leaves room.

The paper takes for r the largest norm of the given points, so this happens whenever a via point is the farthest one,
as in its Figure 2. THEOREM (the engine decides it for the numbers of each problem): if |V| = r, |F| <= r and
|(1 + k) V - k F| <= r with k > 0, then F = V, because V lies between F and (1 + k) V - k F and a sphere has no
straight parts. With V = Q0, F = Q1 these are conditions of (7) and (8): every path of theirs stops at Q0. Likewise at
R0, with F = Q2 in (7) and F = Q1 in (8), which therefore has no solution when both via points lie on the sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import ceil

import qe
from bezier.curves.enclosure import root_above, root_below
from bezier.curves.scalar import Vector, dot, exactly, same
from bezier.curves.workspace import Workspace
from bezier.methods.control import statements as st
from bezier.methods.control.system import coordinates
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from bezier.plans import RadiusRule
from bezier.problem import PlanMethod, Problem
from qe.errors import BudgetExceeded, InternalError, Unable

Limit = Callable[[], float | None]
"""The seconds that are left, if there is a limit."""
NEXT = {PlanMethod.QUADRATIC: ("Q1", "Q1"), PlanMethod.CUBIC: ("Q1", "Q2")}
"""The free control points next to Q0 and to R0."""
SHARES = tuple(map(Fraction, ("21/20", "5/4", "3/2", "2", "3")))
"""A larger radius is looked for between these multiples of the least one that can do."""


def on_sphere(problem: Problem) -> dict[str, str]:
    """The via points at distance r from O, with the free control point that each of them forces."""
    if problem.method not in NEXT:
        return {}
    square = problem.workspace.radius_squared
    pairs = zip(("Q0", "R0"), problem.via, NEXT[problem.method], strict=True)
    return {name: free for name, via, free in pairs if exactly(dot(via, via)) == square}


def sentence(problem: Problem, via: str, free: str) -> st.Statement:
    """The theorem with this problem's numbers: the norm conditions beside a via point force the free point."""
    at = [exactly(c) for c in dict(zip(("Q0", "R0"), problem.via, strict=True))[via]]
    square, k = st.number(problem.workspace.radius_squared), problem.ratio
    listed = coordinates(free)
    point = st.names(listed)
    other = [st.difference(st.number((1 + k) * v), st.product(st.number(k), c)) for v, c in zip(at, point, strict=True)]
    norms = (st.at_most(st.squares(row), square) for row in (point, other))
    same_place = (st.equal(c, st.number(v)) for c, v in zip(point, at, strict=True))
    return st.for_all(listed, st.implies(st.every(*norms), st.every(*same_place)))


def radius_rule(problem: Problem, solvable: bool, remaining: Limit = lambda: None) -> RadiusRule | None:
    """What the radius forces, None when no via point lies on the sphere.

    Raises ``Unable`` when the engine does not decide the sentences.
    """
    forced = on_sphere(problem)
    if not forced:
        return None
    statements, answers = questions(problem), {}
    for name, statement in statements.items():
        answers[name] = qe.eliminate(statement.formula, timeout=remaining())
        if answers[name].truth is False:
            raise InternalError("the engine refutes that a via point on the sphere forces its neighbour")
        if answers[name].truth is None:
            raise Unable("the engine did not decide what the radius forces")
    sentences = tuple(map(str, statements.values()))
    return RadiusRule(problem.method, forced, sentences, solvable, larger_radius(problem, remaining), answers)


def questions(problem: Problem) -> dict[str, st.Statement]:
    """What is asked of the engine, by name."""
    return {
        f"what the radius forces at {via}": sentence(problem, via, free) for via, free in on_sphere(problem).items()
    }


def stated_rule(problem: Problem, solvable: bool, larger: Fraction | None) -> RadiusRule | None:
    """The rule with a larger radius that a summary states; the theorem says the rest."""
    forced = on_sphere(problem)
    if not forced:
        return None
    sentences = tuple(map(str, questions(problem).values()))
    return RadiusRule(problem.method, forced, sentences, solvable, larger)


def larger_radius(problem: Problem, remaining: Limit) -> Fraction | None:
    """A simple rational radius with which the best path does not stop at a via point, proved by its optimum."""
    square = problem.workspace.radius_squared
    if problem.method is PlanMethod.QUADRATIC:
        square = max(square, quadratic.three_balls(problem).needed_squared)
    for low, high in pairwise(SHARES):
        candidate = _short_decimal(low * root_above(square), high * root_below(square))
        try:
            if helps(problem, candidate, remaining):
                return candidate
        except BudgetExceeded:
            raise
        except Unable:
            continue
    return None


def _short_decimal(low: Fraction, high: Fraction) -> Fraction:
    """The least number in [low, high], low > 0, with as few decimal places (or as many final zeros) as possible."""
    power = Fraction(10) ** len(str(int(high)))
    while True:
        result = ceil(low / power) * power
        if result <= high:
            return result
        power /= 10


def helps(problem: Problem, radius: Fraction, remaining: Limit = lambda: None) -> bool:
    """Whether the optimum with this radius exists, has an accepted certificate and differs from both via points."""
    changed = replace(problem, workspace=Workspace(problem.workspace.kind, radius * radius), radius_is_auto=False)
    system = (cubic if problem.method is PlanMethod.CUBIC else quadratic).system(changed)
    optimum = qe.minimize(
        system.objective().polynomial, system.in_free_points().formula, method="convex", timeout=remaining()
    )
    if optimum.value is None or not qe.verify(optimum.certificate).accepted:
        return False
    values = iter([optimum.point[name] for name in system.shape.variables])
    free: dict[str, Vector] = {name: (next(values), next(values), next(values)) for name in system.shape.free}
    if system.violated(system.points(list(free.values()))):
        raise InternalError("the optimum violates a condition")
    pairs = zip(NEXT[problem.method], problem.via, strict=True)
    return not any(same(free[name], via) for name, via in pairs)
