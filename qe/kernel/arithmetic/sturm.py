"""Counting real roots of integer polynomials by Sturm sequences, and exact helpers of the certificate checker.

Nothing here is used to produce an answer: producers isolate roots by Descartes' rule, the checker counts them
by Sturm's theorem (Basu, Pollack, Roy, *Algorithms in Real Algebraic Geometry*, theorem 2.62) or by a proved
enclosure of all complex roots.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import Any

from flint import acb_poly, arb, fmpq, fmpz, fmpz_mat, fmpz_poly

from qe.exact.balls import FIRST_PRECISION, precision
from qe.exact.ring import Poly

FACTOR_DEGREE = 64  # polynomials of higher degree are not factored to find smaller ones with the same root
STURM_BITS = 4_000  # above this degree * bit length, complex enclosures are tried before a Sturm sequence


def exact(value: Fraction) -> fmpq:
    """The same rational number for FLINT."""
    return fmpq(value.numerator, value.denominator)


def sign_of(value: object) -> int:
    """-1, 0 or 1 for an exact number."""
    return (value > 0) - (value < 0)  # type: ignore[operator]


def variations(signs: Sequence[int]) -> int:
    """The number of sign changes in the sequence, zeros left out."""
    present = [s for s in signs if s]
    return sum(a != b for a, b in pairwise(present))


def sturm_sequence(p: fmpz_poly, check: Callable[[], None] = lambda: None) -> list[fmpz_poly]:
    """The signed remainder sequence of p and p', each element up to a positive factor; ``check`` at every step."""
    sequence = [p, p.derivative()]
    while sequence[-1]:
        check()
        a, b = sequence[-2], sequence[-1]
        lead, power = b.leading_coefficient(), a.degree() - b.degree() + 1
        power += power & 1  # an even power keeps the sign
        remainder = -((a * lead**power) % b)
        content = remainder.content()
        sequence.append(remainder / content if content else remainder)
    return sequence[:-1]


@lru_cache(maxsize=4096)
def _count(coefficients: tuple[int, ...]) -> int:
    p = fmpz_poly(list(coefficients))
    if p.degree() * p.height_bits() > STURM_BITS:
        found = _count_by_enclosure(p)
        if found is not None:
            return found
    sequence = sturm_sequence(p)
    high = [sign_of(q.leading_coefficient()) for q in sequence]
    low = [s if q.degree() % 2 == 0 else -s for s, q in zip(high, sequence, strict=True)]
    return variations(low) - variations(high)


def count_real_roots(p: fmpz_poly) -> int:
    """The number of distinct real roots of a nonzero polynomial (Sturm's theorem, squarefree or not)."""
    if p.degree() <= 1:
        return max(0, int(p.degree()))
    return _count(tuple(int(c) for c in p.coeffs()))


def count_roots_between(p: fmpz_poly, low: Fraction, high: Fraction, check: Callable[[], None] = lambda: None) -> int:
    """The number of distinct real roots in (low, high); neither end is a root.

    At most one where the derivative is seen to have no zero; else by Sturm's theorem.
    """
    ends = exact(low), exact(high)
    with precision(FIRST_PRECISION):
        if not p.derivative()(ball(*ends)).contains(0):
            return int(sign_of(p(ends[0])) != sign_of(p(ends[1])))
    sequence = sturm_sequence(p, check)
    signs = [[sign_of(q(x)) for q in sequence] for x in ends]
    return variations(signs[0]) - variations(signs[1])


def _count_by_enclosure(p: fmpz_poly) -> int | None:
    """Distinct real roots of a squarefree p from disjoint balls around all complex roots; None if that fails."""
    with precision(FIRST_PRECISION + p.height_bits()):  # no coefficient is rounded: no search is finer than they are
        exactly = acb_poly(p)
    roots = complex_enclosures(exactly, 20_000)
    return None if roots is None else real_among(roots)


def complex_enclosures(p: acb_poly, bits: int) -> list[Any] | None:
    """Disjoint balls, each with exactly one root of p and all roots covered, or None where FLINT finds none.

    The coefficients may be balls with a leading one away from zero (Rump-Newton bounds, FLINT's validate_roots).
    """
    try:
        roots: list[Any] = p.roots(maxprec=bits)
    except ValueError:
        return None
    return roots if len(roots) == p.degree() else None


def real_among(roots: list[Any]) -> int | None:
    """How many of the enclosed roots of a real polynomial are real; None if the balls do not tell.

    A ball that misses the real axis holds a nonreal root. A ball that meets it holds a real one if its mirror
    image meets no other ball: the conjugate root lies in the mirror image, so it is the same root.
    """
    near = [z for z in roots if z.imag.contains(0)]
    for z in near:
        mirror = z.conjugate()
        if any(w is not z and mirror.overlaps(w) for w in roots):
            return None
    return len(near)


def value_at_integers(p: Poly, point: Sequence[int]) -> int:
    """The value at an integer point (one coordinate per ring variable)."""
    return int(p.p(*[fmpz(v) for v in reversed(point)])) if p.ring.size else p.constant_value()


def divide_out(p: Poly, q: Poly) -> tuple[Poly, int]:
    """(p / q^e, e) with the largest e; p and q nonzero, q not constant."""
    rest, exponent = p.p, 0
    while True:
        quotient, remainder = divmod(rest, q.p)
        if remainder:
            return p.ring.element(rest), exponent
        rest, exponent = quotient, exponent + 1


def sylvester_determinant(f: Sequence[int], g: Sequence[int]) -> int:
    """The resultant as the determinant of the Sylvester matrix; coefficients from degree 0 up, formal degrees."""
    m, n = len(f) - 1, len(g) - 1
    rows = [[0] * k + list(reversed(f)) + [0] * (n - 1 - k) for k in range(n)]
    rows += [[0] * k + list(reversed(g)) + [0] * (m - 1 - k) for k in range(m)]
    return int(fmpz_mat(rows).det()) if rows else 1


def coefficients_at(p: Poly, i: int, point: Sequence[int]) -> list[int]:
    """The coefficients in variable i, from degree 0 up, with the other variables set to integers."""
    return [value_at_integers(c, point) for c in p.coefficients(i)]


def irreducible_factor_at(p: fmpz_poly, low: fmpq, high: fmpq) -> fmpz_poly | None:
    """The irreducible factor of p that changes sign between low and high, or None unless there is exactly one.

    For large degrees, where factoring takes long, the product of all distinct factors.
    """
    if p.degree() == 1:
        found = [p]
    elif p.degree() > FACTOR_DEGREE:
        found = [p / p.gcd(p.derivative())]
    else:
        found = [f for f, _ in p.factor()[1]]
    found = [f for f in found if sign_of(f(low)) * sign_of(f(high)) < 0]
    return found[0] if len(found) == 1 else None


def ball(low: fmpq, high: fmpq) -> arb:
    """A ball that contains the interval."""
    return arb(low).union(arb(high))
