"""The position of an arm with three joints, reduced exactly to one equation in the last joint.

The derivation is that of the rule "joint positions" (``bezier.proofs.three_joints``), in polynomials of more variables:
coordinates of the point, or the parameter of a curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import Any

from bezier.arm.model import Arm, in_field
from bezier.curves.scalar import rational
from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.held_joint import spread
from bezier.proofs.nested_roots import JointValue
from bezier.proofs.square_roots import Surd, back, combined, dot
from bezier.proofs.three_joints import Equations, circle, rows_of
from qe.errors import Unable
from qe.exact.field import NumberField
from qe.exact.ring import Poly, Ring

T, M = "t", "m"
TURNS = tuple(
    (Fraction(c), Fraction(s))
    for c, s in (("1", "0"), ("0", "1"), ("3/5", "4/5"), ("-3/5", "4/5"), ("5/13", "12/13"), ("-5/13", "12/13"))
)
"""Cosine and sine of the φ that are tried: t misses one angle, φ + π, and the equation has at most four roots."""

LIFTED = 4
"""The degree in t of |κ|² (1 + t²)² and of m², where they do not vanish at the angle that t misses."""


@dataclass(frozen=True, eq=False)
class Reduction:
    """What is left of the position problem in a ring whose last two variables are t and m."""

    ring: Ring
    equation: Poly
    """The polynomial in t that has to vanish."""
    degree: int | None
    """Its degree where no angle is missed, None where t misses none."""
    square: Poly | None
    """m² as a polynomial in t, None where there is no m."""
    kappa: Poly | None
    """|κ|² (1 + t²)²; where it vanishes θ2 is free."""
    axis: Poly | None
    """The square of the distance of the point from axis 1; where it vanishes θ1 is free; both None where that joint
    slides."""
    shoulder: tuple[Poly, ...]
    """What vanishes where the point lies on the circle that the origin of the second joint describes."""
    values: tuple[JointValue, ...]
    """The joints, in ``Ratio``, valid where ``kappa`` and ``axis`` do not vanish."""

    @cached_property
    def coefficients(self) -> tuple[Poly, ...]:
        """The coefficients of the equation, from degree 0 up."""
        return self.equation.coefficients(self.ring.index[T])


@dataclass(frozen=True, eq=False)
class Geometry:
    """One arm; ``f``: f0, f1, f2 with v = f0 + cos θ f1 + sin θ f2, or f0, f1 with v = f0 + t f1."""

    arm: Arm
    chain: ArmChain
    f: Sequence[Sequence[Surd]]

    @staticmethod
    def of(arm: Arm) -> Geometry:
        """Raises ``Unable`` for an arm that this reduction does not fit."""
        chain = arm.chain
        if len(chain.turns) != 3:
            raise Unable(f"inverse kinematics at a point needs three joints; {arm.name} has {len(chain.turns)}")
        if chain.turns[0] == chain.turns[1]:
            used = slice(2) if chain.turns[1] else slice(2, 3)
            if not any(c for row in rows_of(chain.constants[1], chain.turns[0]) for c in row[used]):
                verb = "turn about one axis" if chain.turns[0] else "slide along one direction"
                raise Unable(f"{arm.name}: the first two joints {verb}, so their values are not determined")
        return Geometry(arm, chain, spread(chain.constants[2], chain.constants[3][1], chain.turns[2]))

    @property
    def moves_last(self) -> bool:
        """Whether the last joint moves the point at all: one on its own axis stays where it is."""
        return any(c for f in self.f[1:] for c in f)

    def based(self, point: Sequence[Ratio]) -> tuple[Ratio, Ratio, Ratio]:
        """The point in the frame of the first joint."""
        one = constant(point[0].top.ring, 1, self.arm.field)
        x, y, z = (combined(row, point) + one.by(o) for row, o in zip(*back(self.chain.constants[0]), strict=True))
        return x, y, z

    def reduce(self, ring: Ring, point: Sequence[Ratio], turn: tuple[Fraction, Fraction]) -> Reduction:
        """The reduction for a point whose coordinates are polynomials of the ring, with φ of this cosine and sine."""
        field, target, turns = self.arm.field, self.based(point), self.chain.turns
        t, one, m = Ratio(ring.var(T), 1, field), constant(ring, 1, field), Ratio(ring.var(M), 1, field)
        factors = circle(t, one, turn) if turns[2] else (one, t)
        both = Equations.of(turns, self.chain.constants[1], target, self.f, factors)
        equation, degree, square, parts, slide = both.reduced()
        if square is not None:  # m stands for a multiple, whose square has integer coefficients
            m, square = Ratio(m.top, square.bottom, field), Ratio(square.top * square.bottom, 1, field)
        joints, shift = both.joints(parts, slide, m, lambda number: number), self.chain.constants[1][1]
        axis = target[0] * target[0] + target[1] * target[1]
        shoulder = (axis - one.by(dot(shift[:2], shift[:2])), target[2] - one.by(shift[2])) if all(turns[:2]) else ()
        return Reduction(
            ring=ring,
            equation=equation.top,
            degree=degree if turns[2] else None,
            square=None if square is None else square.top,
            kappa=joints[1].w.top if turns[1] else None,
            axis=axis.top if turns[0] else None,
            shoulder=tuple(p.top for p in shoulder),
            values=tuple(joints),
        )


# --- numbers ------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True, eq=False)
class Ratio:
    """``top / bottom`` with bottom > 0. The first variable of the ring stands for the generator of the field of
    constants and is kept below its degree."""

    top: Poly
    bottom: int
    field: NumberField

    def __add__(self, other: Ratio) -> Ratio:
        common = lcm(self.bottom, other.bottom)
        top = self.top * (common // self.bottom) + other.top * (common // other.bottom)
        return Ratio(top, common, self.field)

    def __neg__(self) -> Ratio:
        return Ratio(-self.top, self.bottom, self.field)

    def __sub__(self, other: Ratio) -> Ratio:
        return self + -other

    def __mul__(self, other: Ratio) -> Ratio:
        return Ratio(reduced(self.top * other.top, self.field), self.bottom * other.bottom, self.field)

    def by(self, c: Surd) -> Ratio:
        """Times a number of the field."""
        value = in_field(c, self.field)
        if isinstance(value, Fraction):
            return Ratio(self.top * value.numerator, self.bottom * value.denominator, self.field)
        return self * constant(self.top.ring, value, self.field)


def constant(ring: Ring, value: Any, field: NumberField) -> Ratio:
    """A rational number or an element of the field."""
    number = rational(value)
    coefficients = (number,) if number is not None else value.coefficients
    bottom = lcm(*(c.denominator for c in coefficients))
    top, power = ring.constant(0), ring.constant(1)
    for k, c in enumerate(coefficients):
        power = power * ring.gen(0) if k else power
        if c:
            top = top + power * int(c * bottom)
    return Ratio(top, bottom, field)


def variable(ring: Ring, name: str, field: NumberField) -> Ratio:
    """A variable of the ring."""
    return Ratio(ring.var(name), 1, field)


def reduced(p: Poly, field: NumberField) -> Poly:
    """p with the powers of the generator from its degree on replaced: its minimal polynomial is monic."""
    n = field.degree
    if p.degree(0) < n:
        return p
    minimal, w = field.minimal_polynomial, p.ring.gen(0)
    result = list(p.coefficients(0))
    while len(result) > n:
        lead = result.pop()
        for k in range(n):
            if minimal[k]:
                result[len(result) - n + k] = result[len(result) - n + k] - lead * minimal[k]
    total = p.ring.constant(0)
    for c in reversed(result):
        total = total * w + c
    return total
