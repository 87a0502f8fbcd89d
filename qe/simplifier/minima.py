"""Where and how a polynomial attains its minimum: quadratic polynomials, and sums of even monomials."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import lcm

from qe.exact.quadratic_form import quadratic
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

    Completing squares one variable at a time: a*x^2/2 + l*x + rest = a*(x + l/a)^2/2 + rest - l^2/(2a) with
    a > 0 is least over x where a*x + l = 0, and what remains is quadratic in the other variables. With a = 0
    the polynomial is bounded below only if x does not occur. With a < 0 it is not bounded below.
    """
    n = len(poly.variables)
    if n > _LARGEST:
        return None
    form = quadratic(poly, poly.variables)
    assert form is not None
    hessian, linear, constant = [list(row) for row in form.hessian], list(form.gradient), form.constant
    zeros: list[Poly] = []
    for k in range(n):
        a = hessian[k][k]
        if a < 0:
            return None
        if a == 0:
            if linear[k] or any(hessian[k][k + 1 :]):
                return None
            continue
        zeros.append(_linear_form(poly, hessian[k][k:], k, linear[k]))
        for i in range(k + 1, n):
            ratio = hessian[i][k] / a
            linear[i] -= ratio * linear[k]
            for j in range(k + 1, n):
                hessian[i][j] -= ratio * hessian[k][j]
        constant -= linear[k] ** 2 / (2 * a)
    return Minimum(constant, tuple(zeros))


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
