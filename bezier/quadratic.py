"""Method 2 with three quadratic curves: formula (8) of Hatakeyama, Terui and Mikawa (SCSS 2024, 4.2.1).

The formula is built exactly as printed and handed to the engine; nothing here solves it. Variables: ``p1x,
p1y, p1z`` for the control point P1, and so on. A norm condition ||v|| <= r is written v.v <= r^2, which is the
same for r >= 0; with symbolic r the condition r >= 0 is written down too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from bezier.curve import Bezier
from bezier.problem import Problem
from bezier.scalar import Vector, dot, scale, sign, subtract
from bezier.workspace import Ball, Condition, HalfSpace, Workspace, WorkspaceKind, root_text

AXES = "xyz"
UNKNOWN = ("p1", "r1")
CHOSEN = "q1"
INNER = ("P1", "Q1", "R1")


def coordinates(point: str) -> tuple[str, ...]:
    """The three variables of a control point, e.g. ``q1x, q1y, q1z``."""
    return tuple(f"{point}{axis}" for axis in AXES)


FREE = coordinates(CHOSEN)
QUANTIFIED = coordinates("p1") + coordinates("r1")


def formula(problem: Problem) -> str:
    """Formula (8) for this problem, with the conditions z >= 0 on the control points for a hemisphere."""
    return _formula(
        [_number(c) for c in problem.via[0]],
        [_number(c) for c in problem.via[1]],
        _number(problem.workspace.radius_squared),
        above_table=problem.workspace.kind is WorkspaceKind.HEMISPHERE,
    )


def printed_formula(problem: Problem) -> str:
    """Formula (8) exactly as printed in the paper: the norms only, also for a hemisphere."""
    return _formula(
        [_number(c) for c in problem.via[0]],
        [_number(c) for c in problem.via[1]],
        _number(problem.workspace.radius_squared),
        above_table=False,
    )


def corrected_formula(problem: Problem) -> str:
    """Formula (8) with z >= 0 for the three control points, whatever the workspace of the problem."""
    return _formula(
        [_number(c) for c in problem.via[0]],
        [_number(c) for c in problem.via[1]],
        _number(problem.workspace.radius_squared),
        above_table=True,
    )


def symbolic_formula() -> str:
    """Formula (8) with Q0, R0 and r left as the seven parameters q0x, ..., r0z, r."""
    body = _formula(list(coordinates("q0")), list(coordinates("r0")), "r^2", above_table=False)
    return body.replace(". ", ". r >= 0 and ", 1)


def leaving_formula(problem: Problem) -> str:
    """The sentence: some control points allowed by the printed formula (8) lie below the table."""
    below = " or ".join(f"{point}z < 0" for point in ("p1", "q1", "r1"))
    body = printed_formula(problem).split(". ", 1)[1]
    block = ", ".join(FREE + QUANTIFIED)
    return f"ex {block}. {body} and ({below})"


def _formula(q0: Sequence[str], r0: Sequence[str], radius_squared: str, *, above_table: bool) -> str:
    p1, q1, r1 = (coordinates(name) for name in ("p1", "q1", "r1"))
    parts = [f"{p1[i]} = 2*{q0[i]} - {q1[i]}" for i in range(3)]
    parts += [f"{r1[i]} = 2*{r0[i]} - {q1[i]}" for i in range(3)]
    parts += [" + ".join(f"{c}^2" for c in point) + f" <= {radius_squared}" for point in (p1, q1, r1)]
    if above_table:
        parts += [f"{point[2]} >= 0" for point in (p1, q1, r1)]
    return f"ex {', '.join(QUANTIFIED)}. " + " and ".join(parts)


def _number(value: Any) -> str:
    number = Fraction(value)
    text = str(number)
    return text if number.denominator == 1 and number >= 0 else f"({text})"


def objective(problem: Problem) -> str:
    """|Q1 - Q0|^2 + |R0 - Q1|^2, which the paper asks to make as small as possible."""
    q0, r0 = problem.via
    terms = [f"({name} - {_number(c)})^2" for name, c in zip(FREE, q0, strict=True)]
    terms += [f"({_number(c)} - {name})^2" for name, c in zip(FREE, r0, strict=True)]
    return " + ".join(terms)


def objective_at(problem: Problem, q1: Sequence[Any]) -> Any:
    """The value of the objective, exactly."""
    q0, r0 = problem.via
    first, second = subtract(q1, q0), subtract(r0, q1)
    return dot(first, first) + dot(second, second)


def curves(problem: Problem, q1: Vector) -> dict[str, Bezier]:
    """The three curves P, Q, R for this Q1: P1 = 2 Q0 - Q1 and R1 = 2 R0 - Q1 make both joins C1."""
    q0, r0 = problem.via
    p1, r1 = subtract(scale(2, q0), q1), subtract(scale(2, r0), q1)
    return {
        "P": Bezier.of((problem.start, p1, q0)),
        "Q": Bezier.of((q0, q1, r0)),
        "R": Bezier.of((r0, r1, problem.goal)),
    }


def control_points(problem: Problem, q1: Vector) -> dict[str, Vector]:
    """All control points by the paper's names (P2 = Q0 and Q2 = R0)."""
    found = curves(problem, q1)
    return {f"{name}{i}": point for name, curve in found.items() for i, point in enumerate(curve.points)}


@dataclass(frozen=True, slots=True)
class OnPoint:
    """A workspace condition on one inner control point: the atom of the formula that it stands for."""

    point: str
    condition: Condition

    @property
    def label(self) -> str:
        """``P1`` for the norm condition, ``P1.z`` for the table."""
        return self.point if isinstance(self.condition, Ball) else f"{self.point}.z"


def point_conditions(workspace: Workspace) -> tuple[OnPoint, ...]:
    """The conditions of the formula on P1, Q1, R1, in the order in which they are written there."""
    return tuple(OnPoint(point, condition) for condition in workspace.conditions for point in INNER)


def conditions_text(problem: Problem) -> str:
    """The conditions of the formula with P1 and R1 put in terms of Q1, as text."""
    via = {"P1": problem.via[0], "R1": problem.via[1]}
    points = {name: [f"(2*{_number(c)} - {q})" for c, q in zip(p, FREE, strict=True)] for name, p in via.items()}
    points["Q1"] = list(FREE)
    parts = []
    for item in point_conditions(problem.workspace):
        at = points[item.point]
        if isinstance(item.condition, Ball):
            parts.append(" + ".join(f"{c}^2" for c in at) + f" <= {_number(problem.workspace.radius_squared)}")
        else:
            parts.append(f"{at[2]} >= 0")
    return " and ".join(parts)


def active(problem: Problem, q1: Vector) -> tuple[str, ...]:
    """Labels of the conditions that hold with equality at Q1, exactly: ``P1`` for |P1| = r, ``P1.z`` for z = 0."""
    points = control_points(problem, q1)
    listed = point_conditions(problem.workspace)
    return tuple(c.label for c in listed if sign(c.condition.margin(points[c.point])) == 0)


def as_conditions_on_q1(problem: Problem) -> tuple[OnPoint, ...]:
    """The same conditions written for Q1, for pictures and explanations: balls about O, 2 Q0 and 2 R0."""
    centres = {"P1": scale(2, problem.via[0]), "Q1": scale(0, problem.via[0]), "R1": scale(2, problem.via[1])}
    found = []
    for item in point_conditions(problem.workspace):
        centre = centres[item.point]
        if isinstance(item.condition, Ball):
            moved: Condition = Ball(centre, item.condition.radius_squared, item.label)
        else:
            side = 1 if item.point == "Q1" else -1
            moved = HalfSpace((Fraction(0), Fraction(0), Fraction(side)), _rational(centre[2]), item.label)
        found.append(OnPoint(item.point, moved))
    return tuple(found)


def _rational(value: Any) -> Fraction:
    return Fraction(value)


@dataclass(frozen=True, slots=True)
class ThreeBalls:
    """When the balls of radius r about O, 2 Q0 and 2 R0 meet.

    THEOREM: they have a common point iff the smallest circle enclosing O, Q0, R0 has radius rho <= r/2 (scale by
    2 and read "common point of balls" as "centre of an enclosing circle"). With squared sides of the triangle:
    right or obtuse, 4 rho^2 = longest side^2; acute, 4 rho^2 = a^2 b^2 c^2 / (4 K^2) with the area K.
    """

    sides_squared: tuple[Fraction, Fraction, Fraction]
    is_acute: bool
    needed_squared: Fraction
    radius_squared: Fraction

    @property
    def meet(self) -> bool:
        """Whether the balls meet: needed_squared <= radius_squared, the least r being its root."""
        return self.needed_squared <= self.radius_squared

    @property
    def needed_text(self) -> str:
        """The least radius for which a control point exists, exactly."""
        return root_text(self.needed_squared)


def three_balls(problem: Problem) -> ThreeBalls:
    """The three-ball condition with the numbers of this problem."""
    q0, r0 = problem.via
    difference = subtract(q0, r0)
    sides = (dot(q0, q0), dot(r0, r0), dot(difference, difference))
    a, b, c = sorted(sides)
    acute = a + b > c
    needed = c
    if acute:
        sixteen_area_squared = 2 * (a * b + b * c + c * a) - a * a - b * b - c * c
        needed = a * b * c * 4 / sixteen_area_squared
    return ThreeBalls(sides, acute, needed, problem.workspace.radius_squared)
