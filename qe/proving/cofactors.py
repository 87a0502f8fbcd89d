"""Polynomials as combinations of others: cofactors by linear algebra over the rationals, for bounded degrees, and by
Buchberger's algorithm beyond.

THEOREM. If target = sum c_i * e_i with deg(c_i * e_i) <= D for all i, then the coefficients of the c_i solve a system
of linear equations, one for each monomial of degree at most D. What is found is multiplied out by the checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from math import lcm

from qe.exact.quadratic_form import echelon
from qe.exact.ring import Poly
from qe.options import Budget
from qe.proving.elimination_chain import member

MOST_UNKNOWNS, SLACK = 300, 2
"""Coefficients to be found at most; how far the degree may lie above those of the polynomials."""

Powers = tuple[int, ...]

Column = tuple[int, Powers, dict[Powers, int]]
"""An unknown coefficient: of which cofactor or further target, of which monomial, and what it is multiplied with."""


def cofactors(
    targets: Sequence[Poly], generators: Sequence[Poly], budget: Budget
) -> tuple[list[int], list[Poly]] | None:
    """(numbers, cofactors) with targets[0]*n_0 + targets[1]*n_1 + ... = sum of cofactors times generators, n_0 /= 0.

    The number of the first target is positive; None where nothing is found.
    """
    ring = targets[0].ring
    variables = sorted({i for p in (*targets, *generators) for i in p.variables})
    least = max(targets[0].total_degree, min(e.total_degree for e in generators))
    for degree in range(least, least + SLACK + 1):
        budget.check("prove")
        columns: list[Column] = []
        for k, generator in enumerate(generators):
            for powers in _monomials(variables, degree - generator.total_degree, ring.size):
                columns.append((k, powers, {_times(powers, e): c for e, c in generator.terms()}))
        for k, target in enumerate(targets[1:], start=len(generators)):
            columns.append((k, (0,) * ring.size, {e: -c for e, c in target.terms()}))
        if len(columns) > MOST_UNKNOWNS:
            break
        found = _solved(columns, dict(targets[0].terms()))
        if found is not None:
            return _cleared(columns, found, targets, generators)
    solved = member(targets[0], generators, budget) if len(targets) == 1 else None
    return None if solved is None else ([solved[0]], solved[1])


def _solved(columns: Sequence[Column], wanted: dict[Powers, int]) -> list[Fraction] | None:
    monomials = dict.fromkeys(e for _, _, terms in columns for e in terms)
    if not monomials.keys() >= wanted.keys():
        return None
    listed = [*(terms for _, _, terms in columns), wanted]
    work, pivots = echelon([[Fraction(terms.get(e, 0)) for terms in listed] for e in monomials])
    if len(columns) in pivots:
        return None
    values = [Fraction(0)] * len(columns)
    for row, pivot in zip(work, pivots, strict=True):
        values[pivot] = Fraction(row[-1])
    return values


def _cleared(
    columns: Sequence[Column],
    values: Sequence[Fraction],
    targets: Sequence[Poly],
    generators: Sequence[Poly],
) -> tuple[list[int], list[Poly]]:
    """Integers in place of rational numbers."""
    ring = targets[0].ring
    scale = lcm(*(v.denominator for v in values))
    numbers, found = [scale] + [0] * (len(targets) - 1), [ring.constant(0) for _ in generators]
    for (k, powers, _), value in zip(columns, values, strict=True):
        if k < len(generators):
            found[k] = found[k] + ring.from_terms({powers: int(value * scale)})
        else:
            numbers[k - len(generators) + 1] = int(value * scale)
    return numbers, found


def _times(left: Powers, right: Powers) -> Powers:
    return tuple(a + b for a, b in zip(left, right, strict=True))


def _monomials(variables: Sequence[int], degree: int, size: int) -> Iterator[Powers]:
    """All monomials in the variables up to a degree (none for a negative one)."""
    for total in range(degree + 1):
        for chosen in combinations_with_replacement(variables, total):
            yield tuple(chosen.count(i) for i in range(size))
