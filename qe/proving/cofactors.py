"""Polynomials as combinations of others: cofactors by linear algebra over the rationals, for bounded degrees, and by
Buchberger's algorithm beyond.

THEOREM. If target = sum c_i * e_i with deg(c_i * e_i) <= D for all i, then the coefficients of the c_i solve a system
of linear equations, one for each monomial of degree at most D. What is found is multiplied out by the checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement
from operator import add

from qe.exact.quadratic_form import integer_combinations
from qe.exact.ring import Poly
from qe.options import Budget
from qe.proving.elimination_chain import member

MOST_UNKNOWNS, SLACK = 300, 2
"""Coefficients to be found at most; how far the degree may lie above those of the polynomials."""

Powers = tuple[int, ...]

Column = tuple[int, Powers, dict[Powers, int]]
"""An unknown coefficient: of which cofactor, of which monomial, and what it is multiplied with."""


def cofactors(
    targets: Sequence[Poly], generators: Sequence[Poly], budget: Budget, members: bool = True
) -> list[tuple[int, list[Poly]] | None]:
    """For each target (n, c) with n > 0 and n times it the sum of the c times the generators; None where none is found.

    One system of equations serves all targets of a degree. ``members``: whether the targets are known to be in the
    ideal; where they are not, Buchberger's algorithm, which may take long to find nothing, is left out.
    """
    least = [max(t.total_degree, min(e.total_degree for e in generators)) for t in targets]
    variables = sorted({i for p in (*targets, *generators) for i in p.variables})
    solutions: list[tuple[int, list[Poly]] | None] = [None] * len(targets)
    for degree in range(min(least, default=0), max(least, default=-1) + SLACK + 1):
        wanted = [k for k, low in enumerate(least) if solutions[k] is None and low <= degree <= low + SLACK]
        budget.check("prove")
        columns = list(_columns(generators, variables, degree)) if wanted else []
        if len(columns) > MOST_UNKNOWNS:
            break
        solved = integer_combinations([terms for _, _, terms in columns], [dict(targets[k].terms()) for k in wanted])
        for k, solution in zip(wanted, solved, strict=True):
            if solution is not None:
                solutions[k] = solution[0], _cofactors(columns, solution[1], generators)
    if not members:
        return solutions
    return [known or member(t, generators, budget) for known, t in zip(solutions, targets, strict=True)]


def _columns(generators: Sequence[Poly], variables: Sequence[int], degree: int) -> Iterator[Column]:
    """The multiples of the generators by monomials up to a degree."""
    for k, generator in enumerate(generators):
        terms = generator.terms()
        for powers in _monomials(variables, degree - generator.total_degree, generator.ring.size):
            yield k, powers, {tuple(map(add, powers, e)): c for e, c in terms}


def _cofactors(columns: Sequence[Column], values: Sequence[int], generators: Sequence[Poly]) -> list[Poly]:
    ring, terms = generators[0].ring, [dict[Powers, int]() for _ in generators]
    for (k, powers, _), value in zip(columns, values, strict=True):
        if value:
            terms[k][powers] = value
    return [ring.from_terms(of) for of in terms]


def _monomials(variables: Sequence[int], degree: int, size: int) -> Iterator[Powers]:
    """All monomials in the variables up to a degree (none for a negative one)."""
    for total in range(degree + 1):
        for chosen in combinations_with_replacement(variables, total):
            yield tuple(chosen.count(i) for i in range(size))
