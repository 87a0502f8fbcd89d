"""Polynomials with rational coefficients over the constants of an arm: an integer polynomial over an integer.

The first variable of the ring stands for the generator of the field of constants and is kept below its degree.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

from bezier.arm.model import in_field
from bezier.curves.scalar import rational
from bezier.proofs.square_roots import Surd
from qe.exact.field import NumberField
from qe.exact.ring import Poly, Ring


@dataclass(frozen=True, slots=True, eq=False)
class Ratio:
    """``top / bottom`` with bottom > 0."""

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
