"""Proof that a whole curve stays inside a workspace, or an exact parameter where it does not.

Three tests, each finer than the one before:

1. control polygon: all control points lie in the convex condition, so the curve does (convex hull property);
2. Bernstein: all Bernstein coefficients of margin(P(t)) are nonnegative, on [0, 1] or after bisection. For a
   ball, c_k = sum_{i+j=k} C(n,i) C(n,j) / C(2n,k) P_i . P_j <= r^2 follows from |P_i| <= r by Cauchy-Schwarz,
   so this test accepts strictly more curves;
3. roots: the square-free decomposition of margin(P(t)) (``bezier.curves.nonnegative``), which decides contact too.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from typing import Any

from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Interval, Negative, Nonnegative, decide
from bezier.curves.scalar import Vector, sign
from bezier.curves.workspace import Condition


class Argument(Enum):
    """Which argument proved that a curve is inside; ``value`` is for people."""

    POLYGON = "control polygon"
    BERNSTEIN = "Bernstein coefficients"
    ROOTS = "square-free part and roots"


@dataclass(frozen=True, slots=True)
class Inside:
    """The whole curve satisfies the condition.

    ``proof`` shows margin(P(t)) >= 0 on [0, 1]; it is None when the control polygon already proves it.
    """

    condition: Condition
    test: Argument
    proof: Nonnegative | None

    @property
    def touches(self) -> tuple[Interval, ...]:
        """Parameters where the curve is on the boundary, where the finer tests were needed to see them."""
        return self.proof.touches if self.proof else ()


@dataclass(frozen=True, slots=True)
class Leaves:
    """The curve violates the condition at the rational parameter ``t``."""

    condition: Condition
    t: Fraction
    point: Vector
    margin: Any


Outcome = Inside | Leaves


def polygon_inside(points: Iterable[Sequence[Any]], condition: Condition) -> bool:
    """Whether every control point satisfies the (convex) condition, exactly."""
    return all(sign(condition.margin(p)) >= 0 for p in points)


def examine(curve: Bezier, condition: Condition) -> Outcome:
    """Prove the whole curve inside one convex condition, or find a parameter where it leaves.

    Complete: one of the two is always returned (``Unable`` only past the subdivision limit).
    """
    if polygon_inside(curve.points, condition):
        return Inside(condition, Argument.POLYGON, None)
    return examine_closely(curve, condition)


def examine_closely(curve: Bezier, condition: Condition) -> Outcome:
    """Like ``examine``, without the control polygon test: also finds where the curve touches the boundary."""
    outcome = decide(condition.margin_along(curve))
    if isinstance(outcome, Negative):
        return Leaves(condition, outcome.t, curve.point(outcome.t), outcome.value)
    return Inside(condition, Argument.ROOTS if outcome.is_factored else Argument.BERNSTEIN, outcome)


def examine_all(curve: Bezier, conditions: Iterable[Condition]) -> tuple[Outcome, ...]:
    """``examine`` for each condition."""
    return tuple(examine(curve, condition) for condition in conditions)


def all_inside(outcomes: Iterable[Outcome]) -> bool:
    """Whether no outcome is a violation."""
    return all(isinstance(outcome, Inside) for outcome in outcomes)
