"""Method 2 with three cubic curves: formula (7) of Hatakeyama, Terui and Mikawa (SCSS 2024, 4.2).

The formula is built exactly as printed (for spans of equal duration) and handed to the engine; nothing here solves it.

Unequal durations: the middle curve takes the time 1, each outer one the time beta. Velocity and acceleration with
respect to time agree at the first join iff P'(1) = beta Q'(0) and P''(1) = beta^2 Q''(0), which gives
P2 = (1+beta) Q0 - beta Q1 and P1 = (1+beta)^2 Q0 - 2 beta (1+beta) Q1 + beta^2 Q2; the second join is its mirror
image. beta = 1 is the paper's (6).
"""

from __future__ import annotations

from fractions import Fraction

from bezier.curves.enclosure import root_above
from bezier.curves.scalar import Vector, dot, exactly, is_zero, scale, subtract
from bezier.curves.workspace import HalfSpace
from bezier.methods.control.system import OnPoint, Shape, System, combination
from bezier.problem import Problem
from qe.errors import InputError

CHORD_BITS = 10
"""An irrational distance of the via points is rounded up to a multiple of 2^-CHORD_BITS (times a unit fraction)."""


def shape(ratio: Fraction = Fraction(1)) -> Shape:
    """The control points for outer curves that take ``ratio`` times as long as the middle one."""
    b = ratio
    return Shape(
        free=("Q1", "Q2"),
        follows={
            "P1": combination(((1 + b) ** 2, "Q0"), (-2 * b * (1 + b), "Q1"), (b * b, "Q2")),
            "P2": combination((1 + b, "Q0"), (-b, "Q1")),
            "R1": combination((1 + b, "R0"), (-b, "Q2")),
            "R2": combination((b * b, "Q1"), (-2 * b * (1 + b), "Q2"), ((1 + b) ** 2, "R0")),
        },
        inner=("P1", "P2", "Q1", "Q2", "R1", "R2"),
        curves={name: tuple(f"{name}{i}" for i in range(4)) for name in "PQR"},
        ends={"P3": "Q0", "Q3": "R0"},
        route=("Q0", "Q1", "Q2", "R0"),
    )


def system(problem: Problem) -> System:
    """The control points of this problem with all conditions on them. Raises ``InputError`` as ``join_speed`` does."""
    of_method = shape(problem.ratio)
    given = dict(zip(("P0", "Q0", "R0", "R3"), problem.named_points.values(), strict=True))
    conditions = [OnPoint(point, c) for c in problem.workspace.conditions for point in of_method.inner]
    conditions += [OnPoint(point, item.half_space) for item in problem.point_conditions for point in item.points]
    conditions += join_speed(problem)
    return System(of_method, given, tuple(conditions))


def join_speed(problem: Problem) -> list[OnPoint]:
    """Conditions, linear in Q1 and Q2, which imply that the path passes both joins at the speed asked for.

    THEOREM: let d = R0 - Q0, s >= 0 and L >= |d| > 0. If d.(Q1 - Q0) >= s L/3, the velocity v = 3 (Q1 - Q0) at the
    first join has |v| >= v.d/|d| >= s L/|d| >= s (Cauchy-Schwarz); likewise v = 3 (R0 - Q2) at the second one. The
    condition asks for more than the speed: a speed of at least s in the direction from Q0 to R0. "|v| >= s" itself
    would not be convex. Raises ``InputError`` when the via points coincide, so that there is no such direction.
    """
    if not problem.join_speed:
        return []
    q0, r0 = problem.via
    d = subtract(r0, q0)
    if all(map(is_zero, d)):
        raise InputError("join_speed: expected different via points, found the same point twice")
    least = problem.join_speed * root_above(exactly(dot(d, d)), CHORD_BITS) / 3
    return [
        OnPoint("Q1", HalfSpace(d, -exactly(dot(d, q0)) - least, "speed")),
        OnPoint("Q2", HalfSpace(scale(-1, d), exactly(dot(d, r0)) - least, "speed")),
    ]


def trivial_choice(problem: Problem) -> tuple[Vector, Vector]:
    """Q1 = Q0 and Q2 = R0.

    THEOREM: then P1, P2, R1, R2 are (1 - beta^2) Q0 + beta^2 R0, Q0, R0 and (1 - beta^2) R0 + beta^2 Q0, so for
    beta <= 1 every convex set that contains Q0 and R0 contains all control points: formula (7) is satisfiable. But
    Q'(0) = 3 (Q1 - Q0) = 0 and Q'(1) = 0: the path stops at both joins and turns round there.
    """
    return problem.via
