"""Numbers for the tests: a toy field Q(sqrt 2), written independently of the engine, and strategies."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from hypothesis import strategies as st


@dataclass(frozen=True)
class Root2:
    """a + b*sqrt(2)."""

    a: Fraction
    b: Fraction = Fraction(0)

    @staticmethod
    def of(x: Any) -> Root2:
        return x if isinstance(x, Root2) else Root2(Fraction(x))

    def __add__(self, o: Any) -> Root2:
        o = Root2.of(o)
        return Root2(self.a + o.a, self.b + o.b)

    __radd__ = __add__

    def __neg__(self) -> Root2:
        return Root2(-self.a, -self.b)

    def __sub__(self, o: Any) -> Root2:
        return self + -Root2.of(o)

    def __rsub__(self, o: Any) -> Root2:
        return Root2.of(o) - self

    def __mul__(self, o: Any) -> Root2:
        o = Root2.of(o)
        return Root2(self.a * o.a + 2 * self.b * o.b, self.a * o.b + self.b * o.a)

    __rmul__ = __mul__

    def __truediv__(self, o: Any) -> Root2:
        o = Root2.of(o)
        norm = o.a * o.a - 2 * o.b * o.b
        return self * Root2(o.a / norm, -o.b / norm)

    def __rtruediv__(self, o: Any) -> Root2:
        return Root2.of(o) / self

    def sign(self) -> int:
        positive = (self.a > 0) + (self.b > 0) - (self.a < 0) - (self.b < 0)
        if self.a * self.b >= 0:
            return (positive > 0) - (positive < 0)
        larger = self.a * self.a > 2 * self.b * self.b
        lead = self.a if larger else self.b
        return 1 if lead > 0 else -1

    def __float__(self) -> float:
        return float(self.a) + float(self.b) * 2**0.5


small = st.fractions(min_value=-4, max_value=4, max_denominator=6)
unit = st.fractions(min_value=0, max_value=1, max_denominator=12)
surds = st.builds(Root2, small, small)


def points(dimension: int = 3, coordinate: Any = small) -> Any:
    """Strategy: points of this dimension."""
    return st.tuples(*[coordinate] * dimension)


def control_points(low: int = 1, high: int = 5, dimension: int = 3, coordinate: Any = small) -> Any:
    """Strategy: lists of control points."""
    return st.lists(points(dimension, coordinate), min_size=low, max_size=high)
