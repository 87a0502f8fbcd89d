"""Exact numbers as the command line prints them."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

from qe.exact.radicals import radical_text

LONGEST = 200
"""Characters of an exact number in texts for people."""
DIGITS = 10
"""Decimal digits shown next to an exact number; for reading only."""


def shown(value: object, unbounded: str = "") -> str:
    """An exact number, with a decimal next to it unless it is an integer."""
    if value is None:
        return unbounded
    text = radical_text(value)
    if len(text) > LONGEST:
        return f"about {decimal(value)} (the exact text has {len(text)} characters)"
    return text if text.lstrip("-").isdigit() else f"{text} (about {decimal(value)})"


def decimal(value: Any) -> str:
    """The first digits of a number, also of one that is too large or too small for a float."""
    try:
        near = float(value)
    except OverflowError:
        near = math.inf
    if math.isfinite(near) and (near or not value):
        return f"{near:.{DIGITS}g}"
    exact = value if isinstance(value, Fraction | int) else value.interval(256)[0]
    return f"{Decimal(exact.numerator) / Decimal(exact.denominator):.{DIGITS}g}"


def exact_and_decimal(value: object) -> dict[str, str]:
    """Both forms of a number, for machines."""
    return {"exact": str(Fraction(value) if isinstance(value, int) else value), "decimal": decimal(value)}
