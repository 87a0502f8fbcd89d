"""Where the path may go: balls and half-spaces, and the two workspaces built from them.

A ``Condition`` is a set {p : margin(p) >= 0} with a polynomial margin, so that "the whole curve lies in the
set" is a question about one univariate polynomial. Obstacles are sets of the same kind.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector, dot, sign, subtract
from qe.exact.radicals import root_text


@dataclass(frozen=True, slots=True)
class Ball:
    """{p : |p - centre|^2 <= radius_squared}: convex, so a control polygon inside proves the curve inside."""

    centre: Vector
    radius_squared: Fraction
    name: str = "ball"

    def margin(self, point: Sequence[Any]) -> Any:
        """radius^2 - |p - centre|^2."""
        arrow = subtract(point, self.centre)
        return self.radius_squared - dot(arrow, arrow)

    def margin_along(self, curve: Bezier) -> bs.Coefficients:
        """radius^2 - |P(t) - centre|^2, of degree 2n."""
        moved = Bezier(tuple(subtract(p, self.centre) for p in curve.points))
        return bs.add((self.radius_squared,), bs.negate(moved.norm_squared()))


@dataclass(frozen=True, slots=True)
class HalfSpace:
    """{p : normal . p + offset >= 0}: convex."""

    normal: Vector
    offset: Fraction
    name: str = "half-space"

    def margin(self, point: Sequence[Any]) -> Any:
        """normal . p + offset."""
        return dot(self.normal, point) + self.offset

    def margin_along(self, curve: Bezier) -> bs.Coefficients:
        """normal . P(t) + offset, of degree n."""
        return tuple(self.margin(p) for p in curve.points)


Condition = Ball | HalfSpace
"""Its margin is exactly zero on the boundary, positive inside, negative outside; ``name`` is for people."""


class WorkspaceKind(Enum):
    """The model of the reachable set. REACHABLE: what an arm truly reaches, for which the ball is only a bound."""

    BALL = "ball"
    HEMISPHERE = "hemisphere"
    REACHABLE = "reachable"


@dataclass(frozen=True, slots=True)
class Workspace:
    """The ball of this radius about the origin, or its upper half {last coordinate >= 0}."""

    kind: WorkspaceKind
    radius_squared: Fraction
    dimension: int = 3

    @property
    def ball(self) -> Ball:
        """The ball condition."""
        return Ball((Fraction(0),) * self.dimension, self.radius_squared, "ball")

    @property
    def floor(self) -> HalfSpace:
        """The condition that the last coordinate is not negative."""
        normal = (Fraction(0),) * (self.dimension - 1) + (Fraction(1),)
        return HalfSpace(normal, Fraction(0), "floor")

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The conditions whose intersection is the workspace."""
        return (self.ball, self.floor) if self.kind is WorkspaceKind.HEMISPHERE else (self.ball,)

    def contains(self, point: Sequence[Any]) -> bool:
        """Exact membership."""
        return all(sign(condition.margin(point)) >= 0 for condition in self.conditions)

    @property
    def radius_text(self) -> str:
        """The radius in exact notation."""
        return root_text(self.radius_squared)
