"""Where and how a polynomial attains its minimum: quadratic polynomials, and sums of even monomials."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import lcm

from qe.exact.ring import Poly

_LARGEST = 8  # number of variables up to which the elimination is tried


@dataclass(frozen=True, slots=True)
class Minimum:
    """``value``, attained exactly where all polynomials of ``zeros`` vanish."""

    value: Fraction
    zeros: tuple[Poly, ...]


@lru_cache(maxsize=20_000)
def minimum(poly: Poly) -> Minimum | None:
    """The global minimum of a polynomial where one of two simple arguments finds it, else None.

    A constant plus positive multiples of monomials with even exponents is least where all the monomials vanish.
    Otherwise the polynomial must be quadratic.
    """
    if poly.total_degree % 2 or not poly:
        return None
    constant, zeros = 0, []
    for exponents, coefficient in poly.terms():
        if not any(exponents):
            constant = coefficient
        elif coefficient < 0 or any(k % 2 for k in exponents):
            return minimum_of_quadratic(poly) if poly.total_degree == 2 else None
        else:
            zeros.append(poly.ring.from_terms({tuple(min(k, 1) for k in exponents): 1}))
    return Minimum(Fraction(constant), tuple(reversed(zeros)))


def minimum_of_quadratic(poly: Poly) -> Minimum | None:
    """The minimum over R^n of a polynomial of total degree 2, or None when it is unbounded below (or too large).

    Completing squares one variable at a time: a*x^2 + l*x + rest = a*(x + l/(2a))^2 + rest - l^2/(4a) with
    a > 0 is least over x where 2*a*x + l = 0, and what remains is quadratic in the other variables. With a = 0
    the polynomial is bounded below only if x does not occur. With a < 0 it is not bounded below.
    """
    n = len(poly.variables)
    if n > _LARGEST:
        return None
    square, linear, constant = _matrix(poly)
    zeros: list[Poly] = []
    for k in range(n):
        a = square[k][k]
        if a < 0:
            return None
        if a == 0:
            if linear[k] or any(square[k][j] for j in range(k + 1, n)):
                return None
            continue
        zeros.append(_linear_form(poly, [2 * square[k][j] for j in range(k, n)], k, linear[k]))
        for i in range(k + 1, n):
            ratio = square[i][k] / a
            linear[i] -= ratio * linear[k]
            for j in range(k + 1, n):
                square[i][j] -= ratio * square[k][j]
        constant -= linear[k] ** 2 / (4 * a)
    return Minimum(constant, tuple(zeros))


def _matrix(poly: Poly) -> tuple[list[list[Fraction]], list[Fraction], Fraction]:
    """The symmetric matrix of the quadratic part, the linear part and the constant."""
    n = len(poly.variables)
    square = [[Fraction(0)] * n for _ in range(n)]
    linear = [Fraction(0)] * n
    constant = Fraction(0)
    position = {v: k for k, v in enumerate(poly.variables)}
    for exponents, coefficient in poly.terms():
        found = [position[v] for v in poly.variables for _ in range(exponents[v])]
        if len(found) == 2:
            i, j = found
            square[i][j] += Fraction(coefficient, 2)
            square[j][i] += Fraction(coefficient, 2)
        elif found:
            linear[found[0]] += coefficient
        else:
            constant += coefficient
    return square, linear, constant


def _linear_form(poly: Poly, coefficients: list[Fraction], first: int, constant: Fraction) -> Poly:
    """The primitive integer multiple of sum(coefficients[k] * variable[first + k]) + constant."""
    ring = poly.ring
    common = lcm(*(c.denominator for c in coefficients), constant.denominator)
    form = ring.constant(int(constant * common))
    for k, c in enumerate(coefficients):
        if c:
            form = form + ring.gen(poly.variables[first + k]) * int(c * common)
    return form.normal()[1]


def vanishing(poly: Poly) -> tuple[Poly, ...]:
    """Polynomials whose common zeros are those of ``poly``, if it is known to be non-negative; else ()."""
    least = minimum(poly)
    return least.zeros if least is not None and least.value == 0 else ()
