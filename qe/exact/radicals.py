"""Text of a real algebraic number: exact, as radicals where degree 2 or powers of one number allow, or brief."""

from __future__ import annotations

from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from math import isqrt

from flint import fmpq, fmpz_poly

from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.algebraic_text import format_root


def format_number(a: RealAlgebraic) -> str:
    """A fraction, ``(p + q*sqrt(d))/r``, a nested radical, or ``root(k, polynomial)`` (k from 1, ascending).

    A quartic with minimal polynomial c4*y^4 + c2*y^2 + c0 in y = x - s (s the mean of the roots) is
    s ± sqrt(u) with u a root of c4*u^2 + c2*u + c0; u = (p + q*sqrt(d))/r is itself written out, and
    denested into sqrt(v) ± sqrt(w) when p^2 - q^2*d is a rational square.
    """
    if a.degree == 4:
        text = _biquadratic(a)
        if text is not None:
            return text
    return str(a)


def radical_text(a: object) -> str:
    """The same, and an n-th root where the polynomial has two terms, or c2*x^(2*n) + c1*x^n + c0; all else as it
    prints itself."""
    if not isinstance(a, RealAlgebraic):
        return str(a)
    c, half, n = a.minimal_polynomial, a.degree // 2, a.degree
    if n < 3 or any(c[k] for k in range(1, n) if 2 * k != n or n == 4):
        return format_number(a)
    sign, radicand = "-" if a.sign() < 0 else "", str(Fraction(abs(c[0]), c[-1]))
    if n % 2 == 0 and c[half]:  # |x|^half is a root of a polynomial of degree 2, one for each sign of x
        n, sides = half, (fmpz_poly([c[0], k * c[half], c[-1]]) for k in (1 - 2 * (half % 2), 1))
        negative, positive = ([u for u in irreducible_roots(side) if u.sign() > 0] for side in sides)
        radicand = str((negative[::-1] + positive)[a.index])
    base = radicand if radicand.isdecimal() else f"({radicand})"
    return f"{sign}cbrt({radicand})" if n == 3 else f"{sign}{base}^(1/{n})"


def _biquadratic(a: RealAlgebraic) -> str | None:
    c0, c1, c2, c3, c4 = a.minimal_polynomial
    shift = Fraction(-c3, 4 * c4)
    numerator, denominator = shift.numerator, shift.denominator
    # denominator^4 * p(y/denominator + shift): integral, with roots denominator*(x - shift)
    p = fmpz_poly([c0 * denominator**4, c1 * denominator**3, c2 * denominator**2, c3 * denominator, c4])
    moved = p(fmpz_poly([numerator, 1]))
    if moved[1] != 0 or moved[3] != 0:
        return None
    content = int(moved.content())
    k0, k2, k4 = (int(moved[i]) // content for i in (0, 2, 4))
    positive = a.compare_rational(fmpq(numerator, denominator)) > 0
    squares = irreducible_roots(fmpz_poly([k0, k2, k4] if k4 > 0 else [-k0, -k2, -k4]))
    if len(squares) != 2 or squares[1].sign() <= 0:
        return None
    largest_magnitude = a.index in (0, 2 * sum(u.sign() > 0 for u in squares) - 1)
    u = squares[1] if largest_magnitude else squares[0]
    body = _square_root_text(u, positive)
    return _combine(shift, body, denominator)


def _square_root_text(u: RealAlgebraic, positive: bool) -> str:
    """Text of ±sqrt(u) for a positive quadratic irrationality u."""
    c, b, lead = u.minimal_polynomial
    middle, inner = Fraction(-b, 2 * lead), Fraction(b * b - 4 * lead * c, 4 * lead * lead)
    norm = middle * middle - inner  # u * conjugate of u
    root = _rational_root(norm)
    if root is not None:
        # sqrt(m ± sqrt(e)) = sqrt((m + n)/2) ± sqrt((m - n)/2) with n = sqrt(m^2 - e)
        first, second = root_text((middle + root) / 2), root_text((middle - root) / 2)
        return f"{'' if positive else '-'}{first} {'+' if (u.index == 1) is positive else '-'} {second}"
    return f"{'' if positive else '-'}sqrt({u})"


def _rational_root(value: Fraction) -> Fraction | None:
    n, d = isqrt(max(value.numerator, 0)), isqrt(value.denominator)
    return Fraction(n, d) if n * n == value.numerator and d * d == value.denominator else None


def root_text(square: Fraction) -> str:
    """The exact square root of a nonnegative rational number: ``3/2``, ``3*sqrt(3)``, ``sqrt(2)/3``."""
    root = _rational_root(square)
    return format_root((-square.numerator, 0, square.denominator), 1) if root is None else str(root)


def _combine(shift: Fraction, body: str, denominator: int) -> str:
    """shift + body/denominator, the body being ± one or two square roots."""
    sign, size = ("-", body[1:]) if body.startswith("-") else ("+", body)
    joined = f"{shift.numerator} {sign} {size}" if shift else body
    return joined if denominator == 1 else f"({joined})/{denominator}"


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
    context = Context(prec=10, rounding=rounding, Emax=MAX_EMAX, Emin=MIN_EMIN)
    return str(context.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(context))
