"""Real algebraic numbers as exact text."""

from __future__ import annotations

from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from math import gcd, isqrt

from flint import fmpz

from qe.exact.algebraic import RealAlgebraic

_FACTORED_BITS, _TRIED = 110, 3000
_DIGITS = 10


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


def brief_algebraic(a: RealAlgebraic, longest: int) -> str:
    """The exact text where it has at most so many characters, otherwise the degree and an interval with the number."""
    if int(a.poly.height_bits()) * (a.degree + 1) < 10 * longest:  # about three bits make a digit
        text = format_algebraic(a)
        if len(text) <= longest:
            return text
    low, high = a.interval(40)
    kind = "a fraction" if a.is_rational else f"a root of a polynomial of degree {a.degree}"
    return f"({kind} in [{_rounded(low, ROUND_FLOOR)}, {_rounded(high, ROUND_CEILING)}])"


def _rounded(value: Fraction, rounding: str) -> str:
    context = Context(prec=_DIGITS, rounding=rounding, Emax=MAX_EMAX, Emin=MIN_EMIN)
    return str(context.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(context))


def square_part(n: int) -> int:
    """An s with s^2 dividing n > 0: the largest one, where n has at most ``_FACTORED_BITS`` bits or is easy to factor.

    Larger numbers are divided by small primes only, since factoring them may take for ever; what remains is taken out
    where it is a square as a whole.
    """
    outside, rest = 1, 1
    for prime, power in fmpz(n).factor(trial_limit=None if n.bit_length() <= _FACTORED_BITS else _TRIED):
        outside *= int(prime) ** (int(power) // 2)
        rest *= int(prime) ** (int(power) % 2)
    root = isqrt(rest)
    return outside * root if root * root == rest else outside


def _format_quadratic(a: RealAlgebraic) -> str:
    c, b, lead = (int(k) for k in a.minimal_polynomial)
    discriminant = b * b - 4 * lead * c
    outside = square_part(discriminant)
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
