"""Decimal digits of integers of any size."""

from __future__ import annotations

from flint import fmpz


def digits(value: int) -> str:
    """Decimal digits (``str`` refuses more than 4300 of them, and takes quadratic time for those it gives)."""
    return str(fmpz(value))
