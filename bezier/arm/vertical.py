"""Arms whose second and third joints move the end point in a plane parallel to the first axis, about which it turns.

So are elbow arms and cylindrical ones, with or without an offset. In the frame of the first joint let h be the unit
normal of that plane, e = h x z: the end point is r e + d h + z e_z with d constant. The point p' = (x, y, z) is reached
iff r² = W = x² + y² - d² and the plane arm reaches (r, z). That is so iff Q(r, z) >= 0, and its joints are continuous
functions of r, z and δ with δ² = Q, one position for each sign of δ:

* two joints that turn, links of lengths L1, L2 from the centre (a, c): Q = 4 L1² L2² - (D - L1² - L2²)², where
  D = (r - a)² + (z - c)²; δ is 2 L1 L2 times the sine at the elbow (where D = 0 the second joint is free);
* one that turns and one that slides along a line at the distance b from the centre: Q = D - b² (the same at D = 0);
* one that slides and one that turns on a radius L: Q = L² - w², w the distance from the line of the centres;
* two that slide: one position everywhere, no Q.

The first joint is the angle from r e + d h to (x, y): free where x = y = 0, else unique. So a solution is a pair of
signs (σ, ε), r = σ √W and δ = ε √Q(r, z), and all of them are continuous in W, z and the direction of (x, y).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from bezier.arm.choices import AtPlace, Exact
from bezier.arm.critical import AlongCurve, Number, S
from bezier.arm.elimination import Geometry, Vector
from bezier.arm.inverse import Solution, geometry_of
from bezier.arm.model import Arm
from bezier.arm.ratio import Ratio, constant, variable
from bezier.curves.scalar import dot, is_zero
from qe.errors import Unable
from qe.exact.ring import Poly

Label = tuple[int, int]
"""The signs σ of r and ε of δ; ε = 1 where there is no δ, 0 for one that is not determined."""


@dataclass(frozen=True, slots=True, eq=False)
class Split:
    """even + odd r, where r² = ``square``."""

    even: Ratio
    odd: Ratio
    square: Ratio

    def __add__(self, other: Split) -> Split:
        return Split(self.even + other.even, self.odd + other.odd, self.square)

    def __mul__(self, other: Split) -> Split:
        even = self.even * other.even + self.odd * other.odd * self.square
        return Split(even, self.even * other.odd + self.odd * other.even, self.square)

    def __sub__(self, other: Split) -> Split:
        return Split(self.even - other.even, self.odd - other.odd, self.square)

    @property
    def norm(self) -> Ratio:
        """The product with what -r makes of it: it vanishes iff one of the two does."""
        return self.even * self.even - self.odd * self.odd * self.square


@dataclass(frozen=True, eq=False)
class VerticalArm:
    """``normal`` h, ``offset`` d; ``centre``: (a, c), or a point that the end point reaches where joints slide; see
    above."""

    geometry: Geometry
    normal: Vector
    offset: Any
    centre: tuple[Any, Any]

    @property
    def along(self) -> Vector:
        """e, horizontal and in the plane."""
        return (self.normal[1], -self.normal[0])

    def in_plane(self, vector: Vector) -> tuple[Any, Any]:
        """The components along e and the first axis."""
        return dot(self.along, vector[:2]), vector[2]

    @cached_property
    def turns(self) -> tuple[bool, bool]:
        """Whether the second and the third joint turn."""
        return self.geometry.turns[1], self.geometry.turns[2]

    def square(self, target: tuple[Ratio, Ratio, Ratio]) -> Ratio:
        """W for a point in the frame of the first joint."""
        x, y, _ = target
        result: Ratio = x * x + y * y - self.offset * self.offset
        return result

    def distance(self, target: tuple[Ratio, Ratio, Ratio]) -> Split:
        """D, the square of the distance of (r, z) from the centre."""
        w, zero = self.square(target), target[0] * 0
        across = Split(zero - self.centre[0], zero + 1, w)
        up = Split(target[2] - self.centre[1], zero, w)
        return across * across + up * up

    def quality(self, target: tuple[Ratio, Ratio, Ratio]) -> Split | None:
        """Q, or None where there is one position everywhere."""
        f, w, zero = self.geometry.v, self.square(target), target[0] * 0
        if not self.turns[0] and not self.turns[1]:
            return None
        if not self.turns[0]:
            r, z = self.in_plane(_column(self.geometry.turn))
            across = Split((target[2] - self.centre[1]) * r + self.centre[0] * z, zero - z, w)
            return Split(zero + dot(f[1], f[1]), zero, w) - across * across
        if not self.turns[1]:
            b = f[0][0] * f[1][1] - f[0][1] * f[1][0]
            return self.distance(target) - Split(zero + b * b, zero, w)
        one, two = dot(f[0][:2], f[0][:2]), dot(f[1], f[1])
        rest = self.distance(target) - Split(zero + one + two, zero, w)
        return Split(zero + 4 * one * two, zero, w) - rest * rest

    @cached_property
    def may_fold(self) -> bool:
        """Whether D may vanish at a point that is reached: the second joint is free there."""
        f = self.geometry.v
        if not self.turns[0]:
            return False
        if self.turns[1]:
            return is_zero(dot(f[0][:2], f[0][:2]) - dot(f[1], f[1]))
        return is_zero(f[0][0] * f[1][1] - f[0][1] * f[1][0])

    def label(self, solution: Solution) -> Label:
        """The signs of a solution of ``bezier.arm.inverse.solve``, exactly."""
        first, _, third = solution.exact
        return self._side(first), self._elbow(third)

    def _side(self, exact: Exact | None) -> int:
        if not isinstance(exact, AtPlace):
            return 0
        first, here, field = exact.known, exact.place.point, self.geometry.arm.field
        point = [variable(here.ring, name, field) for name in "xyz"]
        x, y, _ = self.geometry.based(point)
        (ex, ey), (c, s) = self.along, (Ratio(q.top * q.scale.numerator, q.scale.denominator, field) for q in first)
        return here.sign((c * (ex * x + ey * y) + s * (ex * y - ey * x)).top) * here.sign(first[0].bottom)

    def _elbow(self, exact: Exact | None) -> int:
        if self.turns == (False, False):
            return 1
        if not isinstance(exact, AtPlace):
            return 0
        third, f, here, field = exact.known, self.geometry.v, exact.place.point, self.geometry.arm.field
        values = [Ratio(q.top * q.scale.numerator, q.scale.denominator, field) for q in third]
        if not self.turns[1]:
            total = values[0] + constant(here.ring, dot(f[0][:2], f[1][:2]), field) * Ratio(third[0].bottom, 1, field)
        else:
            across = _column(self.geometry.turn)
            parts = (
                [f[0][0] * g[1] - f[0][1] * g[0] for g in f[1:]]
                if self.turns[0]
                else [dot(across, _turned(self.geometry.turn, g)) for g in f[1:]]
            )
            total = values[0] * parts[0] + values[1] * parts[1]
        return here.sign(total.top) * here.sign(third[0].bottom)


@lru_cache(maxsize=64)
def vertical_arm(arm: Arm) -> VerticalArm | None:
    """The arm as one with a plane that turns, or None if it is none. Raises ``Unable`` if the positions at a point are
    not determined by ``bezier.arm.elimination`` at all."""
    geometry = geometry_of(arm)
    turn, f, z = geometry.turn, geometry.v, _column(geometry.turn)
    if not geometry.turns[0]:
        return None
    if geometry.turns[1]:
        normal, base = z, tuple(o + n * f[0][2] for o, n in zip(geometry.shift, z, strict=True))
        centre = geometry.shift
        is_plane = all(is_zero(g[2]) for g in f[1:])
    else:
        base = centre = tuple(o + b for o, b in zip(geometry.shift, _turned(turn, f[0]), strict=True))
        first, second = _turned(turn, f[1]), _turned(turn, f[2]) if geometry.turns[2] else z
        size = dot(f[1], f[1]) if geometry.turns[2] else 1
        if is_zero(size):
            return None
        normal = tuple(c / size for c in _cross(first, second))
        is_plane = is_zero(dot(normal, z)) and is_zero(dot(normal, normal) - 1)
    moves = [dot(f[1], f[1])] + ([dot(f[0][:2], f[0][:2])] if all(geometry.turns) else [])
    if not is_plane or not is_zero(normal[2]) or any(is_zero(size) for size in moves):
        return None
    result = VerticalArm(geometry, normal, dot(normal, base), (0, 0))
    return VerticalArm(geometry, normal, result.offset, result.in_plane(centre))


def _column(turn: Any) -> Vector:
    """The z axis of the second joint."""
    return tuple(row[2] for row in turn)


def _turned(turn: Any, vector: Vector) -> Vector:
    return tuple(dot(row, vector) for row in turn)


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


SIGNS = (1, -1)


@dataclass(frozen=True, eq=False)
class SignsAlong:
    """One curve: W and Q along it, and where they vanish."""

    plane: VerticalArm
    along: AlongCurve
    target: tuple[Ratio, Ratio, Ratio]
    square: Poly
    quality: Split | None

    @staticmethod
    def of(plane: VerticalArm, along: AlongCurve) -> SignsAlong:
        """Raises ``Unable`` where W or Q vanishes along the whole curve."""
        target = plane.geometry.based(along.point)
        square, quality = plane.square(target).top, plane.quality(target)
        if not square or (quality is not None and not quality.norm.top):
            raise Unable("the whole curve is on the axis of the first joint, or along a border of what is reached")
        return SignsAlong(plane, along, target, square, quality)

    @cached_property
    def _zeros(self) -> tuple[frozenset[Number], frozenset[Number]]:
        norm = [] if self.quality is None else self.along.zeros(self.quality.norm.top)
        return frozenset(self.along.zeros(self.square)), frozenset(norm)

    @property
    def places(self) -> list[Number]:
        """Where W or Q vanishes, in [0, 1]."""
        return sorted(self._zeros[0] | self._zeros[1])

    def has_no_square(self, s: Number) -> bool:
        """Whether W = 0."""
        return s in self._zeros[0]

    def empty_sides(self, s: Number) -> frozenset[int]:
        """The σ with Q(σ √W) = 0; raises ``Unable`` if the second joint is free there."""
        if self.quality is None or s not in self._zeros[1]:
            return frozenset()
        here = self.along.place(s)
        if self.plane.may_fold and here.sign(self.plane.distance(self.target).norm.top) == 0:
            raise Unable(f"at s = {float(s):.9g} the second joint is free: which motions go on is not decided")
        even, odd = (here.sign(part.top) for part in (self.quality.even, self.quality.odd))
        return frozenset({-even * odd} if even else SIGNS)

    def labels(self, s: Fraction) -> set[Label]:
        """The labels of the solutions at a place where neither W nor Q vanishes."""
        here = self.along.place(s)
        if here.sign(self.square) < 0:
            return set()
        if self.quality is None:
            return {(side, 1) for side in SIGNS}
        even, odd, norm = (here.sign(p.top) for p in (self.quality.even, self.quality.odd, self.quality.norm))
        # with |even| > |odd √W| the sign of the one, else that of the other
        return {(side, end) for side in SIGNS if (even if norm > 0 else side * odd) > 0 for end in SIGNS}

    def direction(self, s: Number) -> tuple[Ratio, Ratio, int]:
        """(x, y) divided by as high a power of (s' - s) as it has, as polynomials to be read at s, and that power."""
        x, y, _ = self.target
        here, k = self.along.place(s), 0
        while not (here.sign(x.top) or here.sign(y.top)):
            x, y = (Ratio(v.top.derivative(S), v.bottom, v.field) for v in (x, y))
            k += 1
        return x, y, k
