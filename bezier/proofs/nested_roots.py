"""Numbers over a root of a polynomial and over square roots of such numbers, with exact signs; vectors of them.

``Residue``: a polynomial in t at a real root of another one that is alone in an interval. ``Nested``: sums of products
of such numbers (or of ``Surd``) with square roots, each of a positive number that needs those before it only. A sign
that interval arithmetic does not tell is found by Tarski's theorem, and by the sign of a² - b² s for a + b √s.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from bezier.proofs import square_roots as sr
from bezier.proofs.square_roots import Ball, Interval, Motion, Polynomial, Surd, combined, dot
from qe.exact.balls import ball_sign, ends, precision

BITS = (64, 400)
Number = Any
"""A ``Surd`` or a ``Residue``; a ``Polynomial`` where no sign is needed."""


@dataclass(frozen=True, eq=False)
class Place:
    """The one root of ``modulus`` (monic) between two numbers that are no roots."""

    modulus: Polynomial
    between: Interval

    @staticmethod
    def of(equation: Polynomial, between: Interval) -> Place:
        """The one root of an equation in an interval, which the caller has counted."""
        return Place(equation.by(equation[-1].inverse()), between)

    def value(self, p: Polynomial) -> Residue:
        """The polynomial at the root."""
        return Residue(sr.divided(p, self.modulus)[1] if len(p) >= len(self.modulus) else p, self)

    def around(self, bits: int) -> Interval:
        """An interval around the root; a narrower one where more is known of it."""
        return self.between


@dataclass(frozen=True, eq=False)
class Residue:
    """``poly`` at a root."""

    poly: Polynomial
    place: Place

    def __add__(self, other: Residue) -> Residue:
        return Residue(self.poly + other.poly, self.place)

    def __mul__(self, other: Residue) -> Residue:
        return self.place.value(self.poly * other.poly)

    def by(self, c: Surd) -> Residue:
        """c times it."""
        return Residue(self.poly.by(c), self.place)

    def __neg__(self) -> Residue:
        return Residue(-self.poly, self.place)

    def __bool__(self) -> bool:
        return bool(self.poly)

    @property
    def one(self) -> Residue:
        """The number 1."""
        return self.place.value(self.poly.one)

    def sign(self) -> int:
        """-1, 0 or 1: the sum of the signs of the polynomial at all roots in the interval, of which there is one."""
        if len(self.poly) < 2:
            return self.poly[0].sign() if self.poly else 0
        return _apparent(self) or sr.tarski(self.place.modulus, self.poly, self.place.between)

    def ball(self, bits: int) -> Ball:
        """As narrow as what is known of t allows."""
        return sr.enclosure(self.poly, self.place.around(bits))


@dataclass(frozen=True, eq=False)
class Root:
    """The positive square root of a positive number."""

    square: Nested
    _balls: dict[int, Ball] = field(default_factory=dict)

    def __reduce__(self) -> tuple[object, ...]:
        """Without balls, which cannot be sent to another process."""
        return Root, (self.square,)

    def ball(self, bits: int) -> Ball:
        """A ball around it."""
        if bits not in self._balls:
            self._balls[bits] = self.square.ball(bits).nonnegative_part().sqrt()
        return self._balls[bits]

    @cached_property
    def level(self) -> int:
        """More than those of the roots that its square needs."""
        return 1 + max((root.level for key in self.square.terms for root in key), default=0)


NO_ROOT: frozenset[Root] = frozenset()


@dataclass(frozen=True, eq=False)
class Nested:
    """The sum of numbers times products of different roots. A root is itself and no other, whatever its square."""

    terms: dict[frozenset[Root], Number]

    def __add__(self, other: Nested) -> Nested:
        result = dict(self.terms)
        for key, number in other.terms.items():
            result[key] = result[key] + number if key in result else number
        return Nested({key: number for key, number in result.items() if number})

    def __neg__(self) -> Nested:
        return Nested({key: -number for key, number in self.terms.items()})

    def __sub__(self, other: Nested) -> Nested:
        return self + -other

    def __mul__(self, other: Nested) -> Nested:
        total = Nested({})
        for one, a in self.terms.items():
            for two, b in other.terms.items():
                number = a * b
                part = Nested({one ^ two: number} if number else {})
                for root in one & two:
                    part = part * root.square
                total = total + part
        return total

    def by(self, c: Surd) -> Nested:
        """c times it."""
        if not c:
            return Nested({})
        return Nested({k: n.by(c) for k, n in self.terms.items()})

    def sign(self) -> int:
        """-1, 0 or 1, exactly."""
        if not self.terms:
            return 0
        if known := _apparent(self):
            return known
        top = max((root for key in self.terms for root in key), key=lambda root: root.level, default=None)
        if top is None:
            side: int = self.terms[NO_ROOT].sign()
            return side
        a = Nested({key: number for key, number in self.terms.items() if top not in key})
        b = Nested({key - {top}: number for key, number in self.terms.items() if top in key})
        one, other = a.sign(), b.sign()
        if one * other >= 0:
            return one or other
        return one * (a * a - b * b * top.square).sign()

    def ball(self, bits: int) -> Ball:
        """A ball around it, at this working precision; wide where numbers nearly cancel."""
        total = Ball(0)
        for key, number in self.terms.items():
            part = number.ball() if isinstance(number, Surd) else number.ball(bits)
            for root in key:
                part = part * root.ball(bits)
            total = total + part
        return total

    def square_roots(self) -> Iterator[Nested]:
        """All real numbers with this square: none, 0, or two."""
        side = self.sign()
        if side == 0:
            yield Nested({})
        elif side > 0:
            root, one = frozenset({Root(self)}), self.unit.terms[NO_ROOT]
            yield from (Nested({root: number}) for number in (-one, one))

    @property
    def unit(self) -> Nested:
        """The number 1 of the kind that this number, which is not 0, is made of."""
        return nested(next(iter(self.terms.values())).one)


def nested(value: Number) -> Nested:
    """A number without roots."""
    return Nested({NO_ROOT: value} if value else {})


def _apparent(number: Residue | Nested) -> int:
    """The sign, if intervals tell it, else 0."""
    for bits in BITS:
        with precision(bits):
            if side := ball_sign(number.ball(bits)):
                return side
    return 0


# --- vectors and turns about the third axis ----------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class JointValue:
    """The angle with cosine and sine ``c / w`` and ``s / w``, w > 0; or the length ``c / w`` where s is None. In these
    numbers, or in others that can be added and multiplied."""

    c: Any
    s: Any
    w: Any
    is_double: bool = False
    """Whether two solutions of one equation coincide in it."""

    def intervals(self, bits: int = BITS[-1]) -> list[Interval] | None:
        """Around cosine and sine, or around the length; None where balls of so many bits do not tell that w > 0."""
        with precision(bits):
            below = self.w.ball(bits)
            return [ends(v.ball(bits) / below) for v in (self.c, self.s) if v is not None] if below > 0 else None


@dataclass(frozen=True, eq=False)
class Vector:
    """``parts / scale``: a point, or a direction, which no shift moves."""

    parts: tuple[Nested, Nested, Nested]
    scale: Nested
    is_point: bool

    def turned(self, joint: JointValue, side: int = 1) -> Vector:
        """The image under the turn about the third axis; under the turn back for ``side`` -1. A direction stays as it
        is where the joint slides."""
        (x, y, z), w = self.parts, joint.w
        if joint.s is None:
            return self
        c, s = joint.c, joint.s if side > 0 else -joint.s
        return Vector((c * x - s * y, s * x + c * y, w * z), w * self.scale, self.is_point)

    def moved(self, motion: Motion) -> Vector:
        """The image under a rigid motion."""
        rows, shift = motion
        x, y, z = (
            combined(row, self.parts) + (self.scale.by(o) if self.is_point else Nested({}))
            for row, o in zip(rows, shift, strict=True)
        )
        return Vector((x, y, z), self.scale, self.is_point)


def angle(a: Sequence[Nested], b: Sequence[Nested], over: tuple[Nested, Nested]) -> JointValue | None:
    """The turn that takes (a0, a1) / over[0] to (b0, b1) / over[1], vectors of one length; None where they vanish."""
    result = turn_between(a, b, over)
    return result if (b[0] * b[0] + b[1] * b[1]).sign() else None


def turn_between(a: Sequence[Nested], b: Sequence[Nested], over: tuple[Nested, Nested]) -> JointValue:
    """``angle`` where the vectors do not vanish."""
    size = b[0] * b[0] + b[1] * b[1]
    return JointValue(dot(a[:2], b[:2]) * over[1], (a[0] * b[1] - a[1] * b[0]) * over[1], size * over[0])


def basis(unit: Nested) -> tuple[JointValue, JointValue, JointValue]:
    """What stands for an unknown turn: whatever is linear in its c, s and w is known by what these three give."""
    zero = Nested({})
    return JointValue(unit, zero, zero), JointValue(zero, unit, zero), JointValue(zero, zero, unit)


Wave = tuple[Nested, Nested, Nested, Nested]
"""a, b, k and the scale of an equation a cos + b sin = k / scale, where a and b are not both 0."""


def square(wave: Wave) -> Nested:
    """m² = (a² + b²) scale² - k²."""
    a, b, k, scale = wave
    return (a * a + b * b) * scale * scale - k * k


def turn_by(wave: Wave, m: Nested) -> JointValue:
    """The angle of which cosine and sine are (a k - b m, b k + a m) / ((a² + b²) scale)."""
    a, b, k, scale = wave
    return JointValue(a * k - b * m, b * k + a * m, (a * a + b * b) * scale, not m.terms)


def turns(a: Nested, b: Nested, k: Nested, scale: Nested) -> Iterator[JointValue]:
    """All angles with a cos + b sin = k / scale."""
    wave = a, b, k, scale
    return (turn_by(wave, m) for m in square(wave).square_roots())
