"""Method 2 with three quadratic curves: formula (8) of Hatakeyama, Terui and Mikawa (SCSS 2024, 4.2.1).

The formula is built exactly as printed and handed to the engine; nothing here solves it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from bezier.curves.scalar import dot, subtract
from bezier.curves.workspace import Condition, Workspace, WorkspaceKind
from bezier.methods.control import statements as st
from bezier.methods.control.system import OnPoint, Shape, System, combination, coordinates
from bezier.problem import Problem
from qe.exact.radicals import root_text

SHAPE = Shape(
    free=("Q1",),
    follows={"P1": combination((2, "Q0"), (-1, "Q1")), "R1": combination((2, "R0"), (-1, "Q1"))},
    inner=("P1", "Q1", "R1"),
    curves={"P": ("P0", "P1", "P2"), "Q": ("Q0", "Q1", "Q2"), "R": ("R0", "R1", "R2")},
    ends={"P2": "Q0", "Q2": "R0"},
    route=("Q0", "Q1", "R0"),
)
"""P1 = 2 Q0 - Q1 and R1 = 2 R0 - Q1 make both joins C1."""
FREE = SHAPE.variables
QUANTIFIED = SHAPE.quantified


def system(problem: Problem) -> System:
    """The control points of this problem with all conditions on them."""
    extra = [OnPoint(name, item.half_space) for item in problem.point_conditions for name in item.points]
    return _with_conditions(problem, (*on_inner_points(problem.workspace), *extra))


def on_inner_points(workspace: Workspace) -> tuple[OnPoint, ...]:
    """The workspace's conditions on P1, Q1, R1, in the order in which the formula states them."""
    return tuple(OnPoint(point, condition) for condition in workspace.conditions for point in SHAPE.inner)


def printed(problem: Problem) -> System:
    """The system of formula (8) exactly as printed in the paper: the norms only, also for a hemisphere."""
    ball = replace(problem.workspace, kind=WorkspaceKind.BALL)
    return _with_conditions(problem, on_inner_points(ball))


def corrected(problem: Problem) -> System:
    """The system of this problem with z >= 0 for the three control points, whatever its workspace."""
    return system(replace(problem, workspace=replace(problem.workspace, kind=WorkspaceKind.HEMISPHERE)))


def leaving(problem: Problem) -> st.Statement:
    """The sentence: some control points allowed by the printed formula (8) lie below the table."""
    allowed = printed(problem)
    heights = st.some(*(st.below(st.name(coordinates(point)[2]), st.number(0)) for point in SHAPE.inner))
    parts = [*allowed.joins(), *(statement for _, statement in allowed.labelled()), heights]
    return st.exists((*FREE, *QUANTIFIED), st.every(*parts))


def as_conditions_on_q1(system: System) -> tuple[Condition, ...]:
    """The conditions written for Q1, for pictures and explanations: balls about O, 2 Q0 and 2 R0."""
    return system.seen_by("Q1", system.given)


def _with_conditions(problem: Problem, conditions: tuple[OnPoint, ...]) -> System:
    names = ("P0", "Q0", "R0", "R2")
    return System(SHAPE, dict(zip(names, problem.named_points.values(), strict=True)), conditions)


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
