"""Univariate polynomials over a triangular point: what a polynomial of the next level is on a cell's fibre.

``fibre`` gives a ``RationalFibre`` (integer coefficients) or an ``AlgebraicFibre`` (coefficients are polynomials
at the point); both know their true degree, signs at rational numbers, the count of distinct real roots by Sturm's
theorem, greatest common divisors and squarefree parts. Every answer is exact.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from itertools import pairwise
from typing import Any

from flint import acb_poly, arb, fmpz_poly

from qe.exact.balls import precision
from qe.exact.ring import Poly
from qe.exact.univariate import from_univariate
from qe.kernel.arithmetic.sturm import (
    complex_enclosures,
    count_real_roots,
    count_roots_between,
    exact,
    irreducible_factor_at,
    real_among,
    sign_of,
)
from qe.kernel.arithmetic.triangular import (
    FIRST_BITS,
    Coordinate,
    Point,
    fibre_balls,
    gcd,
    quotient,
    subresultants,
    trim,
)

ENCLOSURE_BITS = (64, 256, 1024)
LONG_BITS = (*ENCLOSURE_BITS, 4096, 16384)  # a quotient loses many bits by cancellation
Values = list[tuple[Fraction, Any, Any]]


def values(numbers: tuple[Fraction, ...]) -> Values:
    """Rational numbers prepared for ``signs``: with their exact FLINT form and a ball."""
    with precision(FIRST_BITS):
        return [(x, exact(x), arb(exact(x))) for x in numbers]


class RationalFibre:
    """A polynomial in one variable with integer coefficients. ``degree`` is -1 for zero.

    ``check`` is called between the steps of long computations, to end them.
    """

    __slots__ = ("check", "degree", "index", "p", "ring")

    def __init__(self, ring: Any, index: int, p: fmpz_poly, check: Callable[[], None]) -> None:
        self.ring, self.index, self.p, self.check, self.degree = ring, index, p, check, int(p.degree())

    def _with(self, p: fmpz_poly) -> RationalFibre:
        return RationalFibre(self.ring, self.index, p, self.check)

    def signs(self, at: Values) -> list[int]:
        """The exact signs at rational numbers."""
        p = self.p
        return [sign_of(p(x)) for _, x, _ in at]

    def gcd(self, other: Fibre) -> RationalFibre:
        """The greatest common divisor."""
        assert isinstance(other, RationalFibre)
        return self._with(self.p.gcd(other.p))

    def squarefree(self) -> RationalFibre:
        """The product of the distinct irreducible factors."""
        return self._with(self.p / self.p.gcd(self.p.derivative()))

    def count(self) -> int:
        """The number of distinct real roots."""
        return count_real_roots(self.p)

    def only_root(self, low: Fraction, high: Fraction) -> Fraction | Coordinate | None:
        """The root in (low, high), if it is the only one and neither end is a root."""
        if 0 in self.signs(values((low, high))) or count_roots_between(self.p, low, high, self.check) != 1:
            return None
        return self.coordinate(low, high)

    def coordinate(self, low: Fraction, high: Fraction) -> Fraction | Coordinate | None:
        """The root between low and high, if exactly one irreducible factor changes sign there and only once."""
        found = irreducible_factor_at(self.p, exact(low), exact(high))
        if found is None:
            return None
        if found.degree() == 1:
            return Fraction(-int(found[0]), int(found[1]))
        poly = from_univariate(self.ring, self.index, found)
        return Coordinate(self.index, poly, low, high, sign_of(found(exact(high))))


class AlgebraicFibre:
    """A polynomial in variable ``index`` over a point; ``poly`` is trimmed: its leading coefficient is not 0 there."""

    __slots__ = ("_balls", "degree", "index", "point", "poly")

    def __init__(self, point: Point, index: int, poly: Poly) -> None:
        self.point, self.index, self.poly = point, index, poly
        self.degree = poly.degree(index) if poly else -1
        self._balls: Any = None

    def signs(self, at: Values) -> list[int]:
        """The exact signs at rational numbers."""
        with precision(FIRST_BITS):
            if self._balls is None:
                self._balls = self.balls(FIRST_BITS)
            return [self._sign(self._balls(x), number) for number, _, x in at]

    def _sign(self, value: arb, number: Fraction) -> int:
        return 1 if value > 0 else -1 if value < 0 else self.point.sign(self.poly.at_rational(self.index, number))

    def gcd(self, other: Fibre) -> AlgebraicFibre:
        """The greatest common divisor over the point."""
        assert isinstance(other, AlgebraicFibre)
        a, b = (self, other) if self.degree >= other.degree else (other, self)
        return AlgebraicFibre(self.point, self.index, gcd(self.point, a.poly, b.poly, self.index))

    def squarefree(self) -> AlgebraicFibre | SimplePart:
        """A polynomial with the same roots, all simple: self over its common divisor with its derivative."""
        shared = self._repeated()
        if shared is None:
            return self
        if shared.degree == 1 or shared._repeated() is None:
            return SimplePart(self, shared)
        return AlgebraicFibre(self.point, self.index, quotient(self.point, self.poly, shared.poly, self.index))

    def _repeated(self) -> AlgebraicFibre | None:
        """The greatest common divisor with the derivative, or None if all roots are simple."""
        if self.degree < 2:
            return None
        shared = gcd(self.point, self.poly, self.poly.derivative(self.index), self.index)
        return None if shared.degree(self.index) == 0 else AlgebraicFibre(self.point, self.index, shared)

    def balls(self, bits: int) -> Any:
        """The coefficients as balls; the working precision must be ``bits``."""
        return fibre_balls(self.point, self.poly, self.index, bits)

    def count(self) -> int:
        """The number of distinct real roots: from enclosures of all complex roots if these separate them, else by
        signed subresultants over the point's field."""
        found = _separated(self.balls, ENCLOSURE_BITS)
        return self.count_by_remainders() if found is None else found

    def count_by_remainders(self) -> int:
        """The number of distinct real roots by signed subresultants (Basu, Pollack, Roy 2006, section 4.2)."""
        i = self.index
        chain = subresultants(self.point, self.poly, self.poly.derivative(i), i)
        signs = [(s.degree(i), _parity(self.degree - s.degree(i)) * self.point.sign(s.leading(i))) for s in chain]
        signs = [(p, s) for p, s in signs if s]
        return sum(_parity(p - q) * s * t for (p, s), (q, t) in pairwise(signs) if (p - q) % 2)

    def coordinate(self, low: Fraction, high: Fraction) -> Fraction | Coordinate | None:
        """The root between low and high of a squarefree polynomial that has exactly one there, or None."""
        ends = self.signs(values((low, high)))
        if ends[0] * ends[1] >= 0:
            return None
        return Coordinate(self.index, self.poly, low, high, ends[1])


def _separated(poly: Callable[[int], Any], precisions: tuple[int, ...]) -> int | None:
    """The number of real roots of a polynomial given by balls, if at some precision all complex roots are enclosed."""
    for bits in precisions:
        with precision(bits), suppress(ZeroDivisionError):  # of a quotient whose divisor may have a lower degree
            q = poly(bits)
            roots = None if q.coeffs()[-1].contains(0) else complex_enclosures(acb_poly(q), bits)
            if roots is not None and (found := real_among(roots)) is not None:
                return found
    return None


def _parity(k: int) -> int:
    """(-1)^(k (k - 1) / 2)."""
    return -1 if k % 4 > 1 else 1


class SimplePart:
    """f / g, never written out, for g = gcd(f, f') squarefree: the roots of f, each once (multiplicity at most 2)."""

    __slots__ = ("degree", "f", "g")

    def __init__(self, f: AlgebraicFibre, g: AlgebraicFibre) -> None:
        self.f, self.g, self.degree = f, g, f.degree - g.degree

    def signs(self, at: Values) -> list[int]:
        """The exact signs at rational numbers, up to a common factor, where f is nonzero."""
        return [a * b for a, b in zip(self.f.signs(at), self.g.signs(at), strict=True)]

    def squarefree(self) -> SimplePart:
        return self

    def count(self) -> int:
        """The number of real roots."""
        found = _separated(lambda bits: self.f.balls(bits) // self.g.balls(bits), LONG_BITS)
        return self.f.count_by_remainders() if found is None else found

    def coordinate(self, low: Fraction, high: Fraction) -> Fraction | Coordinate | None:
        """The root of f between low and high where f has exactly one: a simple root of g, or else of f."""
        return self.g.coordinate(low, high) or self.f.coordinate(low, high)


Fibre = RationalFibre | AlgebraicFibre
Simple = Fibre | SimplePart


def fibre(point: Point, poly: Poly, index: int) -> Fibre:
    """``poly`` over the point as a polynomial in variable ``index``; rational coordinates already substituted."""
    if point.indices and any(i != index for i in poly.variables):
        poly = trim(point, poly, index)
    if not point.indices or all(i == index for i in poly.variables):
        return RationalFibre(poly.ring, index, poly.to_univariate(index), point.check)
    return AlgebraicFibre(point, index, poly)


def lift_up(f: Fibre, point: Point) -> AlgebraicFibre:
    """The same polynomial as one over the point, so that both operands of a gcd are of one kind."""
    if isinstance(f, AlgebraicFibre):
        return f
    return AlgebraicFibre(point, f.index, from_univariate(f.ring, f.index, f.p))


def lazard_evaluation(f: Poly, point: Point, rationals: dict[int, Fraction], index: int) -> Poly:
    """The Lazard evaluation of f in the variables below ``index``, as a polynomial at the point in that variable.

    For each variable in turn, f is divided by the highest power of (x_i - a_i) that divides it and x_i is set to
    a_i (Lazard 1994; McCallum, Parusinski, Paunescu 2019, section 2). Up to a positive factor the result is the
    partial derivative of that order at a_i.
    """
    for i in range(index):
        while True:
            point.check()
            restricted = f.at_rational(i, rationals[i]) if i in rationals else f
            if not _identically_zero(restricted, point, i):
                f = restricted
                break
            f = f.derivative(i)
    return f


def _identically_zero(p: Poly, point: Point, i: int) -> bool:
    """Whether p vanishes at the point's coordinates up to variable i for all values of the later variables."""
    if not p:
        return True
    later = [p]
    for v in range(i + 1, p.ring.size):
        later = [c for q in later for c in q.coefficients(v) if c]
    here = point.below(i + 1)
    return all(here.sign(c) == 0 for c in later)
