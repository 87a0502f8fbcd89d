"""Exact numbers as points hold them: rational, or real algebraic."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from qe.exact.algebraic import RealAlgebraic

Number = Fraction | RealAlgebraic
Assignment = Mapping[str, Number]
Values = dict[str, Number]


def simplest(value: Number) -> Number:
    """A rational number as a Fraction, whatever its representation."""
    if isinstance(value, RealAlgebraic) and value.is_rational:
        return value.as_fraction()
    return value
