"""Exact Bézier curves in any dimension, over any ordered field, and how two of them join.

A curve of degree n with control points P_0, ..., P_n is P(t) = sum_k C(n,k) t^k (1-t)^(n-k) P_k, 0 <= t <= 1
(Farin, "Curves and Surfaces for CAGD", chapters 4-5). Lengths are in the unit of the input (millimetres for
the arm of the paper), t has no unit.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum
from fractions import Fraction
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.scalar import Vector, dot, is_zero, same, scale, sign, subtract, vector
from qe.errors import InputError


@dataclass(frozen=True, slots=True)
class Bezier:
    """A Bézier curve. Invariant: at least one control point, all of the same dimension >= 1."""

    points: tuple[Vector, ...]

    def __post_init__(self) -> None:
        if not self.points or not self.points[0] or len({len(p) for p in self.points}) != 1:
            raise InputError("a curve needs at least one control point, all of one dimension")

    @staticmethod
    def of(points: Iterable[Iterable[Any]]) -> Bezier:
        """The curve with these control points; integers are read as fractions."""
        return Bezier(tuple(vector(p) for p in points))

    @property
    def degree(self) -> int:
        """The formal degree n (the number of control points less one)."""
        return len(self.points) - 1

    @property
    def dimension(self) -> int:
        """The number of coordinates."""
        return len(self.points[0])

    def coordinate(self, i: int) -> bs.Coefficients:
        """Coordinate ``i`` as a polynomial in Bernstein form."""
        return tuple(p[i] for p in self.points)

    def point(self, t: Any) -> Vector:
        """P(t), exactly, by de Casteljau's algorithm."""
        return tuple(bs.value(self.coordinate(i), t) for i in range(self.dimension))

    def hodograph(self) -> Bezier:
        """The derivative P'(t) as a Bézier curve of degree n-1."""
        if self.degree == 0:
            return Bezier((scale(Fraction(0), self.points[0]),))
        steps = zip(self.points, self.points[1:], strict=False)
        return Bezier(tuple(scale(self.degree, subtract(q, p)) for p, q in steps))

    def derivative(self, order: int, t: Any) -> Vector:
        """The derivative of this order at t."""
        curve = self
        for _ in range(order):
            curve = curve.hodograph()
        return curve.point(t)

    def split(self, t: Any = bs.HALF) -> tuple[Bezier, Bezier]:
        """The parts over [0, t] and [t, 1], each with its own parameter in [0, 1]."""
        sides = [bs.split(self.coordinate(i), t) for i in range(self.dimension)]
        left, right = (tuple(zip(*(side[k] for side in sides), strict=True)) for k in (0, 1))
        return Bezier(left), Bezier(right)

    def segment(self, low: Fraction, high: Fraction) -> Bezier:
        """The part over [low, high], 0 <= low < high <= 1, with its own parameter in [0, 1]."""
        parts = [bs.restrict(self.coordinate(i), low, high) for i in range(self.dimension)]
        return Bezier(tuple(zip(*parts, strict=True)))

    def elevate(self, degree: int) -> Bezier:
        """The same curve written with this degree, not below its own."""
        if degree < self.degree:
            raise InputError(f"degree elevation from {self.degree} to {degree}: the degree cannot go down")
        parts = [bs.elevate(self.coordinate(i), degree) for i in range(self.dimension)]
        return Bezier(tuple(zip(*parts, strict=True)))

    def norm_squared(self) -> bs.Coefficients:
        """|P(t)|^2 in Bernstein form of degree 2n."""
        total: bs.Coefficients = (Fraction(0),)
        for i in range(self.dimension):
            total = bs.add(total, bs.multiply(self.coordinate(i), self.coordinate(i)))
        return total


def curvature_squared(curve: Bezier) -> tuple[bs.Coefficients, bs.Coefficients]:
    """kappa^2 = (|P'|^2 |P''|^2 - (P'.P'')^2) / |P'|^6, the squared curvature in any dimension (per length^2): both
    sides in Bernstein form on [0, 1].

    Lagrange's identity makes the numerator |P' x P''|^2 in space. Undefined where P' = 0.
    """
    first = curve.hodograph()
    second = first.hodograph()
    speed = first.norm_squared()
    mixed: bs.Coefficients = (Fraction(0),)
    for i in range(curve.dimension):
        mixed = bs.add(mixed, bs.multiply(first.coordinate(i), second.coordinate(i)))
    product = bs.multiply(speed, second.norm_squared())
    numerator = bs.add(product, bs.negate(bs.multiply(mixed, mixed)))
    return numerator, bs.multiply(speed, bs.multiply(speed, speed))


class Smoothness(IntEnum):
    """How many derivatives agree where two curves meet; ``GAP`` when they do not even meet."""

    GAP = -1
    C0 = 0
    C1 = 1
    C2 = 2


@dataclass(frozen=True, slots=True)
class Join:
    """Where one curve ends and the next begins."""

    smoothness: Smoothness
    """The highest of C0, C1, C2 that holds exactly, for the durations of the spans."""
    jumps: tuple[Vector, ...]
    """The difference of value, first and second derivative with respect to time."""
    same_direction: bool
    """Whether both velocities are non-zero and point the same way (G1)."""


def join(first: Bezier, second: Bezier, durations: tuple[Fraction, Fraction] = (Fraction(1), Fraction(1))) -> Join:
    """Compare value and derivatives with respect to time of ``first`` at 1 and of ``second`` at 0, exactly.

    ``durations``: how long each curve takes, its parameter being proportional to time.
    """
    one, two = durations
    ends = [
        (scale(one**-k, first.derivative(k, Fraction(1))), scale(two**-k, second.derivative(k, Fraction(0))))
        for k in range(3)
    ]
    smoothness = Smoothness.GAP
    for level, (left, right) in enumerate(ends):
        if not same(left, right):
            break
        smoothness = Smoothness(level)
    u, v = ends[1]
    inner = dot(u, v)
    same_direction = sign(inner) > 0 and is_zero(inner * inner - dot(u, u) * dot(v, v))
    return Join(smoothness, tuple(subtract(right, left) for left, right in ends), same_direction)
