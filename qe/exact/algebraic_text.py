"""Real algebraic numbers as exact text, from their minimal polynomials."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd

from flint import fmpz


def format_root(coefficients: Sequence[int], index: int) -> str:
    """Exact text of the real root with this index (from 0) of an irreducible polynomial, coefficients from degree 0 up.

    A fraction, ``(p + q*sqrt(d))/r`` for degree 2, otherwise ``root(k, polynomial)`` with k from 1.
    """
    if len(coefficients) == 2:
        return str(Fraction(-coefficients[0], coefficients[1]))
    if len(coefficients) == 3:
        return _format_quadratic(coefficients, index)
    terms = []
    for i, c in reversed(list(enumerate(coefficients))):
        if c:
            power = "" if i == 0 else "x" if i == 1 else f"x^{i}"
            body = power if abs(c) == 1 and power else f"{abs(c)}*{power}" if power else str(abs(c))
            terms.append(("- " if c < 0 else "+ ") + body)
    text = " ".join(terms)
    text = text[2:] if text.startswith("+") else "-" + text[2:]
    return f"root({index + 1}, {text})"


def _format_quadratic(coefficients: Sequence[int], index: int) -> str:
    c, b, lead = coefficients
    discriminant, outside = b * b - 4 * lead * c, 1
    for prime, power in fmpz(discriminant).factor():
        outside *= int(prime) ** (int(power) // 2)
    inside = discriminant // outside**2
    negative = index == 0
    common = Fraction(-b, 2 * lead)
    radical = Fraction(outside, 2 * lead)
    denominator = (common.denominator * radical.denominator) // gcd(common.denominator, radical.denominator)
    whole, factor = int(common * denominator), int(radical * denominator)
    root = f"sqrt({inside})" if factor == 1 else f"{factor}*sqrt({inside})"
    if whole:
        text = f"{whole} {'-' if negative else '+'} {root}"
        return text if denominator == 1 else f"({text})/{denominator}"
    text = f"-{root}" if negative else root
    return text if denominator == 1 else f"{text}/{denominator}"
