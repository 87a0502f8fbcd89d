"""The exact minimum of a quadratic polynomial that is bounded below."""

from __future__ import annotations

from fractions import Fraction

from qe.exact.ring import Poly

_LARGEST = 8  # number of variables up to which the elimination is tried


def minimum_of_quadratic(poly: Poly) -> Fraction | None:
    """The minimum over R^n of a polynomial of total degree 2, or None when it is unbounded below (or too large).

    Completing squares one variable at a time: a*x^2 + l*x + rest with a > 0 has, over x, the minimum
    rest - l^2/(4a), which is again quadratic in the other variables. With a = 0 the polynomial is bounded
    below only if x does not occur. With a < 0 it is not bounded below.
    """
    if len(poly.variables) > _LARGEST:
        return None
    n = len(poly.variables)
    square = [[Fraction(0)] * n for _ in range(n)]  # symmetric matrix of the quadratic part
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
    for k in range(n):
        a = square[k][k]
        if a < 0:
            return None
        if a == 0:
            if linear[k] or any(square[k][j] for j in range(k + 1, n)):
                return None
            continue
        for i in range(k + 1, n):
            ratio = square[i][k] / a
            linear[i] -= ratio * linear[k]
            for j in range(k + 1, n):
                square[i][j] -= ratio * square[k][j]
        constant -= linear[k] ** 2 / (4 * a)
    return constant
