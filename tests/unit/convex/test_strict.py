"""Strict constraints: attained, only approached, or no point at all."""

from __future__ import annotations

from fractions import Fraction

from qe.convex.kkt import sign
from qe.convex.minimise import solve
from qe.convex.strict import settle_strict
from qe.convex.system import ConvexSystem, read_system
from qe.errors import InputError
from qe.exact.kkt_system import Point
from qe.io.lowering import lower_term
from qe.io.text import read, read_term
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumEvidence, OptimumStatus
from tests.tables import each


def system(objective: str, conditions: str) -> ConvexSystem:
    value = lower_term(read_term(objective), lambda message, at: InputError(message))
    return read_system(read(conditions), value.poly, scale=Fraction(1, value.den))


def settled(objective: str, conditions: str) -> tuple[ConvexSystem, OptimumEvidence]:
    given = system(objective, conditions)
    return given, settle_strict(given, solve(given, budget=Budget(60)), budget=Budget(60))


def satisfies(given: ConvexSystem, point: Point) -> bool:
    """Every constraint, the strict ones strictly."""
    allowed = {FormRelation.EQ: (0,), FormRelation.LE: (-1, 0), FormRelation.LT: (-1,)}
    return all(sign(f.value(point)) in allowed[r] for f, r in zip(given.forms, given.relations))


@each(
    ("x^2", "x > -1 and x < 1", 0),
    ("x", "x >= 0 and y > 0", 0),
    ("x", "x >= 0 and y > 0 and x + y < 1", 0),
    ("x + y", "x + y >= 2 and x > 0 and y > 0", 2),
    ("x^2 + y^2", "x = 3 and y > -1", 9),
    ("0*x", "x > 0 and x < 1/1000000", 0),
)
def test_attained(objective: str, conditions: str, value: int) -> None:
    given, found = settled(objective, conditions)
    assert found.status is OptimumStatus.OPTIMAL and found.attained is True
    assert satisfies(given, found.point) and given.objective.value(found.point) == value


@each(
    ("x", "x > 0", 0),
    ("x", "x > 0 and y^2 < 1", 0),
    ("x + y", "x + y > 2 and x > 0 and y > 0", 2),
    ("x", "x^2 + y^2 < 4", -2),
    ("y", "x^2 <= y and y > 0 and x <= 0", 0),
    ("x", "x >= 0 and x > 0 and x + y = 1", 0),
)
def test_only_approached(objective: str, conditions: str, value: int) -> None:
    given, found = settled(objective, conditions)
    assert found.status is OptimumStatus.OPTIMAL and found.attained is False
    assert given.objective.value(found.point) == value and not satisfies(given, found.point)
    assert satisfies(given, found.inner_point)


@each(
    "x > 0 and x < 0",
    "x >= 0 and x < 0",
    "x^2 + y^2 <= 1 and x > 1",
    "x^2 + y^2 < 1 and (x - 2)^2 + y^2 <= 1",
    "x + y = 1 and x > 0 and y > 1",
    "x >= 0 and x <= y and y <= x and x < y",
    "x^2 <= 0 and y^2 <= 0 and x + y > 0",
)
def test_empty_though_the_closed_problem_is_not(conditions: str) -> None:
    given = system("x", conditions)
    assert solve(given, budget=Budget(60)).status is OptimumStatus.OPTIMAL
    assert settled("x", conditions)[1].status is OptimumStatus.INFEASIBLE


def test_without_bound_from_a_point_inside() -> None:
    given, found = settled("x", "y > 0 and y < 1 and x < y")
    assert found.status is OptimumStatus.UNBOUNDED and satisfies(given, found.point)
    assert given.objective.value(found.direction) < 0


def test_an_empty_problem_stays_empty() -> None:
    given = system("x", "x > 1 and x < 0")
    evidence = solve(given, budget=Budget(60))
    assert settle_strict(given, evidence, budget=Budget(60)) is evidence
