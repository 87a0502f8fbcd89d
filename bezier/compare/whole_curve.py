"""Which Q1 keep the whole curves in the workspace, not only their control polygons: formula (8*).

The paper's formula (8) bounds the control points, which is sufficient by the convex hull property but not necessary.
(8*)  for all t in [0, 1]: P(t), Q(t) and R(t) are in the workspace, with P1 = 2 Q0 - Q1 and R1 = 2 R0 - Q1,
has one quantified variable, of degree 4, and Q1 as parameters. For every t its conditions are convex in Q1, so its
region is a closed convex set, and it contains that of (8). Here Q1 lies in a ``Plane``; the engine eliminates t.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

import qe
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure, root_enclosure
from bezier.curves.scalar import Vector, dot, exactly, is_zero, rational, scale, subtract
from bezier.curves.workspace import Condition
from bezier.methods.control import statements as st
from bezier.methods.control.system import coordinates, stated
from bezier.methods.quadratic import formula as quadratic
from bezier.problem import Problem
from qe.errors import InputError, InternalError, Unable
from qe.options import Budget

POINT = "Q1"
TIME = st.name("t")
WHOLE = st.between(st.number(0), TIME, st.number(1))


@dataclass(frozen=True, slots=True)
class Family:
    """Curves whose control points have terms for coordinates."""

    points: Sequence[Sequence[st.Term]]

    def at(self) -> list[st.Term]:
        """The coordinates of the point at the parameter t."""
        return [st.bracketed(st.bernstein(column, TIME)) for column in zip(*self.points, strict=True)]

    def inside(self, conditions: Iterable[Condition]) -> st.Statement:
        """The whole curve satisfies the conditions: a formula in the parameters, or a sentence without any."""
        return _for_all_t(_all(conditions, [self.at()]))

    def polygon_inside(self, conditions: Iterable[Condition]) -> st.Statement:
        """All control points satisfy the conditions."""
        return _all(conditions, self.points)


def _for_all_t(body: st.Statement) -> st.Statement:
    return st.for_all(["t"], st.implies(WHOLE, body))


def _all(conditions: Iterable[Condition], points: Sequence[Sequence[st.Term]]) -> st.Statement:
    return st.grouped(*(stated(c, point) for c in conditions for point in points))


def families(problem: Problem, plane: Plane) -> dict[str, Family]:
    """The curves P, Q, R of formula (8) with Q1 in the plane, by name."""
    system, q1 = quadratic.system(problem), plane.terms(POINT)
    known = {name: [st.number(exactly(c)) for c in place] for name, place in system.given.items()} | {POINT: q1}

    def terms(point: str) -> list[st.Term]:
        parts = system.shape.combination(system.shape.ends.get(point, point))
        return [st.combined((c, known[other][i]) for c, other in parts) for i in range(3)]

    return {name: Family([terms(point) for point in listed]) for name, listed in system.shape.curves.items()}


def statement(problem: Problem, plane: Plane) -> st.Statement:
    """(8*) with Q1 in the plane: the variables ``q1u, q1v`` are free."""
    points = [family.at() for family in families(problem, plane).values()]
    return _for_all_t(_all(problem.workspace.conditions, points))


def region(problem: Problem, plane: Plane, *, timeout: float | None = None) -> qe.Region:
    """The set of Q1 in the plane for which the whole curves stay in the workspace."""
    return qe.region(statement(problem, plane).formula, timeout=timeout)


def implications(problem: Problem, plane: Plane, *, timeout: float | None = None) -> dict[str, Any]:
    """The engine's answers to whether the control polygons bound the curves, up to the first false one, by name: (8)
    implies (8*) for Q1 in the plane where all are true.

    ``timeout``: seconds for all of them together. Raises ``Unable`` where one is not decided, ``BudgetExceeded`` at
    the limit.
    """
    budget = Budget(timeout)
    order = ("t", *plane_coordinates(POINT))
    data: dict[str, Any] = {}
    for name, family in families(problem, plane).items():
        for c in problem.workspace.conditions:
            inside = st.implies(st.every(WHOLE, family.polygon_inside([c])), _all([c], [family.at()]))
            left = budget.time_left("whole curves")
            answer = qe.eliminate(st.for_all(order, inside).formula, timeout=left, order=order)
            if answer.truth is None:
                budget.check("whole curves")
                raise Unable(answer.reason or "it was not decided")
            data[f"the control points of {name} bound it ({c.name})"] = answer
            if not answer.truth:
                return data
    return data


def curve_inside(curve: Bezier, conditions: Sequence[Condition], *, timeout: float | None = None) -> bool:
    """Whether the whole curve satisfies the conditions, decided by the engine. Raises ``InputError`` for irrational
    control points; ``bezier.curves.containment`` decides the same without quantifier elimination, for those too."""
    if any(rational(c) is None for point in curve.points for c in point):
        raise InputError("a curve with rational coordinates expected")
    family = Family([[st.number(exactly(c)) for c in point] for point in curve.points])
    return qe.decide(family.inside(conditions).formula, timeout=timeout)


@dataclass(frozen=True, slots=True)
class Plane:
    """The points u * first + v * second: the plane through the origin and the two via points, in which regions of Q1
    can be decomposed and drawn. Invariant: the two vectors are rational, orthogonal and not zero.

    THEOREM. Orthogonal projection onto a plane that contains O, Q0 and R0 maps every control point of formulas (7) and
    (8), a combination of Q0, R0 and free points, to the same combination of the projections, and increases no norm. So
    while all conditions are balls about O, the region of Q1 in the plane is both the section and the projection of the
    one in space. With further conditions it is the region for free points that lie in the plane.
    """

    first: Vector
    second: Vector

    @staticmethod
    def through(problem: Problem) -> Plane:
        """The plane through O, Q0 and R0, its first axis along R0 - Q0; one of them if the three are on a line."""
        q0, r0 = problem.via
        first = _along(subtract(r0, q0))
        others = [q0, problem.start, problem.goal, *(tuple(Fraction(i == k) for i in range(3)) for k in (2, 1, 0))]
        for other in others:
            across = subtract(other, scale(dot(other, first) / dot(first, first), first))
            if not all(map(is_zero, across)):
                return Plane(first, _along(across))
        raise InternalError("every vector is parallel to one")

    def point(self, u: Fraction, v: Fraction) -> Vector:
        """The point with these coordinates in the plane."""
        return tuple(u * a + v * b for a, b in zip(self.first, self.second, strict=True))

    def place(self, point: Vector) -> Vector:
        """The coordinates of the orthogonal projection of a point."""
        return tuple(dot(point, axis) / exactly(dot(axis, axis)) for axis in (self.first, self.second))

    @property
    def unit_area(self) -> Enclosure:
        """The area of the rectangle of the two axes, in the square of the unit of the points."""
        square = exactly(dot(self.first, self.first) * dot(self.second, self.second))
        return root_enclosure(square, square)

    def section(self, condition: st.Statement, free: Sequence[str]) -> st.Statement:
        """A condition on free points that lie in the plane, in their coordinates there (see ``plane_coordinates``)."""
        pairs = [pair for point in free for pair in zip(coordinates(point), self.terms(point), strict=True)]
        equations = [st.equal(st.name(name), term) for name, term in pairs]
        return st.exists([name for name, _ in pairs], st.every(*equations, condition))

    def terms(self, point: str) -> list[st.Term]:
        """The three coordinates of a control point in the plane, by its ``plane_coordinates``."""
        place, axes = st.names(plane_coordinates(point)), zip(self.first, self.second, strict=True)
        rows = ([st.product(st.number(exactly(a)), c) for a, c in zip(row, place, strict=True)] for row in axes)
        return [st.total(row) for row in rows]


def plane_coordinates(point: str) -> tuple[str, str]:
    """The variables of a control point in the plane: ``q1u, q1v``."""
    return f"{point.lower()}u", f"{point.lower()}v"


def _along(arrow: Vector) -> Vector:
    """A short rational vector in this direction: of length 1 if that is rational, else with coprime integers."""
    values = [exactly(c) for c in arrow]
    common = lcm(*(c.denominator for c in values))
    whole = [int(c * common) for c in values]
    square = Fraction(sum(c * c for c in whole))
    length = root_enclosure(square, square)
    if length.high is not None and length.low == length.high:
        return scale(1 / length.low, tuple(map(Fraction, whole)))
    return scale(Fraction(1, gcd(*whole)), tuple(map(Fraction, whole)))
