"""Short texts for real algebraic numbers whose exact text would fill more than a line or two."""

from __future__ import annotations

from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction

from qe.exact.algebraic import RealAlgebraic

_DIGITS = 10


def brief_algebraic(a: RealAlgebraic, longest: int) -> str:
    """The exact text where it has at most so many characters, otherwise the degree and an interval with the number."""
    if int(a.poly.height_bits()) * (a.degree + 1) < 10 * longest:  # about three bits make a digit
        text = str(a)
        if len(text) <= longest:
            return text
    low, high = a.interval(40)
    kind = "a fraction" if a.is_rational else f"a root of a polynomial of degree {a.degree}"
    return f"({kind} in [{_rounded(low, ROUND_FLOOR)}, {_rounded(high, ROUND_CEILING)}])"


def _rounded(value: Fraction, rounding: str) -> str:
    context = Context(prec=_DIGITS, rounding=rounding, Emax=MAX_EMAX, Emin=MIN_EMIN)
    return str(context.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(context))
