"""Quadratic polynomials of optimum certificates, and their quadratic parts as weighted squares."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

Form = dict[tuple[int, ...], Fraction]
"""Exponents to coefficients, of degree at most 2, in the order of the certificate."""


def read_form(terms: Sequence[Any]) -> Form:
    """The polynomial that an (accepted) certificate writes as [coefficient, exponents]."""
    return {tuple(exponents): Fraction(c) for c, exponents in terms}


def squares(parts: Sequence[tuple[Fraction, Form]]) -> Iterator[tuple[Fraction, list[Fraction]]]:
    """Positive factors and rows with sum factor * (row . x)^2 = the quadratic part of the weighted sum.

    THEOREM (Lagrange): where the form is positive semidefinite, completing squares one variable at a time succeeds.
    """
    size = max((len(e) for _, form in parts for e in form), default=0)
    matrix = [[Fraction(0)] * size for _ in range(size)]
    for weight, form in parts:
        for exponents, c in form.items():
            if sum(exponents) == 2:
                i, j = [k for k, e in enumerate(exponents) for _ in range(e)]
                matrix[i][j] += weight * c / 2
                matrix[j][i] += weight * c / 2
    for k in range(size):
        pivot = matrix[k][k]
        if not pivot:
            continue
        row = [a / pivot for a in matrix[k]]
        yield pivot, row
        matrix = [
            [a - pivot * u * v for a, v in zip(line, row, strict=True)] for line, u in zip(matrix, row, strict=True)
        ]
