"""Quadratic forms for the checker: reading, convexity by LDL^T, rank; rational arithmetic only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.kernel.limits import check_variables
from qe.proof.entry import Entry

Row = tuple[Fraction, ...]


@dataclass(frozen=True, slots=True)
class Form:
    """x^T H x / 2 + b.x + c."""

    hessian: tuple[Row, ...]
    gradient: Row
    constant: Fraction


def read_form(entry: Entry, size: int) -> Form:
    """A polynomial of degree at most 2 as a list of [coefficient, exponents]; no term twice, none zero."""
    check_variables(size)
    hessian = [[Fraction(0)] * size for _ in range(size)]
    gradient, constant = [Fraction(0)] * size, Fraction(0)
    seen: set[tuple[int, ...]] = set()
    for term in entry.items():
        parts = list(term.items())
        if len(parts) != 2:
            raise term.fail("expected [coefficient, exponents]")
        coefficient = parts[0].rational()
        exponents = tuple(e.integer() for e in parts[1].items())
        if len(exponents) != size or sum(exponents) > 2:
            raise parts[1].fail(f"expected {size} exponents of sum at most 2")
        if not coefficient or exponents in seen:
            raise term.fail("a zero coefficient or a repeated term")
        seen.add(exponents)
        occurring = [k for k, e in enumerate(exponents) for _ in range(e)]
        if not occurring:
            constant = coefficient
        elif len(occurring) == 1:
            gradient[occurring[0]] = coefficient
        else:
            i, j = occurring
            hessian[i][j] += coefficient
            hessian[j][i] += coefficient
    return Form(tuple(map(tuple, hessian)), tuple(gradient), constant)


def is_linear(form: Form) -> bool:
    """Whether the form has no quadratic part."""
    return not any(any(row) for row in form.hessian)


def is_convex(matrix: Sequence[Sequence[Fraction]]) -> bool:
    """Whether a symmetric matrix is positive semidefinite: symmetric elimination, one diagonal entry at a time.

    A zero diagonal entry of a positive semidefinite matrix forces a zero row; a positive one is eliminated, and the
    Schur complement is positive semidefinite iff the matrix is.
    """
    m = [list(row) for row in matrix]
    for k in range(len(m)):
        pivot = m[k][k]
        if pivot < 0 or (pivot == 0 and any(m[k][j] for j in range(k, len(m)))):
            return False
        if pivot == 0:
            continue
        for i in range(k + 1, len(m)):
            factor = m[i][k] / pivot
            if factor:
                for j in range(k, len(m)):
                    m[i][j] -= factor * m[k][j]
    return True


def rank(rows: Sequence[Sequence[Fraction]]) -> int:
    """The rank of a rational matrix."""
    work, found = [list(row) for row in rows if any(row)], 0
    while work:
        row = work.pop()
        lead = next((i for i, v in enumerate(row) if v), None)
        if lead is None:
            continue
        found += 1
        for other in work:
            if other[lead]:
                factor = other[lead] / row[lead]
                for j, v in enumerate(row):
                    other[j] -= factor * v
    return found
