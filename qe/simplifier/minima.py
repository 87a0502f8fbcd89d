"""Where and how a polynomial attains its minimum, where completing squares finds it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from qe.exact.ring import Poly

_MOST_TERMS = 60


@dataclass(frozen=True, slots=True)
class Minimum:
    """The polynomial is ``value`` and positive multiples of squares of polynomials that vanish together somewhere; one
    square alone may vanish nowhere, and ``value`` is a lower bound then.

    ``squares``: (weight, polynomial), these primitive.
    """

    value: Fraction
    squares: tuple[tuple[Fraction, Poly], ...] = ()

    @property
    def zeros(self) -> tuple[Poly, ...]:
        """The value is attained exactly where all of these vanish."""
        return tuple(_radical(root) for _, root in self.squares)

    def over(self, scale: int) -> Minimum:
        """The minimum of the polynomial divided by this positive number."""
        return Minimum(self.value / scale, tuple((weight / scale, root) for weight, root in self.squares))


@lru_cache(maxsize=20_000)
def minimum(poly: Poly) -> Minimum | None:
    """The global minimum of a polynomial where one of two simple arguments finds it, else None.

    A constant plus positive multiples of monomials with even exponents is least where all the monomials vanish.
    4a * (a*x^2 + l*x + r) = (2a*x + l)^2 + (4a*r - l^2), with a number a > 0, is least over x where 2a*x + l = 0, and
    what remains is without x. With a < 0 the polynomial is unbounded below. Every quadratic polynomial is decided.
    A number and a positive multiple of one square are found, too; the square of q may be 0 nowhere.
    """
    if poly.total_degree % 2 or not poly:
        return None
    if poly.term_count() > _MOST_TERMS:
        return _one_square(poly)
    even = _even_monomials(poly)
    if even is not None:
        return even
    for i in poly.variables:
        parts = poly.coefficients(i)
        if len(parts) != 3 or not parts[2].is_constant:
            continue
        a = parts[2].constant_value()
        rest = parts[0] * (4 * a) - parts[1] * parts[1]
        least = None if a < 0 else Minimum(Fraction(rest.constant_value())) if rest.is_constant else minimum(rest)
        if least is None:
            return None  # also where the remainder is not known to be bounded: another variable may know, but which?
        size, root = (poly.ring.gen(i) * (2 * a) + parts[1]).normal()
        return Minimum(least.value, ((Fraction(size * size), root), *least.squares)).over(4 * a)
    return _one_square(poly)


def _one_square(poly: Poly) -> Minimum | None:
    """c + a*s^2 with numbers c and a > 0, else None: on a line c is what the first half of the terms says it is."""
    if any(poly.degree(i) % 2 for i in poly.variables):
        return None
    x, *others = poly.variables
    coefficients = poly.compose({i: poly.ring.constant(i + 2) for i in others}).coefficients(x)
    if len(coefficients) != poly.degree(x) + 1 or (a := coefficients[-1].constant_value()) < 0:
        return None
    line, d = [Fraction(c.constant_value(), a) for c in coefficients], poly.degree(x) // 2
    root = [Fraction(0)] * d + [Fraction(1)]
    for k in reversed(range(d)):
        root[k] = (line[d + k] - sum(root[i] * root[d + k - i] for i in range(k + 1, d))) / 2
    if any(line[k] != sum(root[i] * root[k - i] for i in range(k + 1)) for k in range(1, d)):
        return None
    number = a * (line[0] - root[0] ** 2)
    weight, square = (poly * number.denominator - number.numerator).normal()
    factor = square.square_root()
    return None if factor is None else Minimum(number, ((Fraction(weight, number.denominator), factor),))


def _even_monomials(poly: Poly) -> Minimum | None:
    constant, squares = Fraction(0), []
    for exponents, coefficient in poly.terms():
        if not any(exponents):
            constant = Fraction(coefficient)
        elif coefficient < 0 or any(k % 2 for k in exponents):
            return None
        else:
            squares.append((Fraction(coefficient), poly.ring.from_terms({tuple(k // 2 for k in exponents): 1})))
    return Minimum(constant, tuple(reversed(squares)))


def _radical(root: Poly) -> Poly:
    """A monomial without its exponents, any other polynomial as it is."""
    (exponents, _), *more = root.terms()
    return root if more else root.ring.from_terms({tuple(min(k, 1) for k in exponents): 1})


def vanishing(poly: Poly) -> tuple[Poly, ...]:
    """Polynomials whose common zeros are those of ``poly``, if it is known to be non-negative; else ()."""
    least = minimum(poly)
    return least.zeros if least is not None and least.value == 0 else ()
