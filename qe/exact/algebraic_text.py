"""Real algebraic numbers as exact text."""

from __future__ import annotations

from fractions import Fraction
from math import gcd

from flint import fmpz

from qe.exact.algebraic import RealAlgebraic


def format_algebraic(a: RealAlgebraic) -> str:
    """Exact text: a fraction, ``(p + q*sqrt(d))/r`` for degree 2, otherwise ``root(k, polynomial)`` with k from 1."""
    if a.is_rational:
        return str(a.as_fraction())
    if a.degree == 2:
        return _format_quadratic(a)
    terms = []
    for i, c in reversed(list(enumerate(a.minimal_polynomial))):
        if c:
            power = "" if i == 0 else "x" if i == 1 else f"x^{i}"
            body = power if abs(c) == 1 and power else f"{abs(c)}*{power}" if power else str(abs(c))
            terms.append(("- " if c < 0 else "+ ") + body)
    text = " ".join(terms)
    text = text[2:] if text.startswith("+") else "-" + text[2:]
    return f"root({a.index + 1}, {text})"


def _format_quadratic(a: RealAlgebraic) -> str:
    c, b, lead = (int(k) for k in a.minimal_polynomial)
    discriminant, outside = b * b - 4 * lead * c, 1
    for prime, power in fmpz(discriminant).factor():
        outside *= int(prime) ** (int(power) // 2)
    inside = discriminant // outside**2
    negative = a.index == 0
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
