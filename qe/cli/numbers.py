"""Exact numbers as the command line prints them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

LONGEST = 200
"""Characters of an exact number in texts for people."""
DIGITS = 10
"""Decimal digits shown next to an exact number; for reading only."""


def shown(value: object, unbounded: str = "") -> str:
    """An exact number, with a decimal next to it unless it is an integer."""
    if value is None:
        return unbounded
    text = str(value)
    if len(text) > LONGEST:
        return f"about {decimal(value)} (the exact text has {len(text)} characters)"
    return text if text.lstrip("-").isdigit() else f"{text} (about {decimal(value)})"


def decimal(value: Any) -> str:
    """The first digits of a number."""
    return f"{float(value):.{DIGITS}g}"


def exact_and_decimal(value: object) -> dict[str, str]:
    """Both forms of a number, for machines."""
    return {"exact": str(Fraction(value) if isinstance(value, int) else value), "decimal": decimal(value)}
