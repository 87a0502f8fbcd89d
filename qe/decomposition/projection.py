"""One projection of a set of polynomials by an operator, and the closure of a factor set under it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain, combinations, product
from types import MappingProxyType

from qe.decomposition.operators.operator import Operator
from qe.errors import BudgetExceeded
from qe.exact.ring import Poly
from qe.options import Budget

Levels = tuple[tuple[Poly, ...], ...]

EFFORT_OF_A_CELL = 20
"""A projection of so much ``effort`` takes as long as one cell (measured: 20,000 take up to a tenth of a second)."""


class FactorSet:
    """Distinct irreducible polynomials, in the order in which they came.

    Sealed: whatever is added is factored first, and constants (zero too) have no factors.
    """

    __slots__ = ("_factors",)

    def __init__(self, polys: Iterable[Poly] = ()) -> None:
        self._factors: dict[Poly, None] = {}
        self.add(polys)

    def add(self, polys: Iterable[Poly]) -> None:
        """Take in the factors of these polynomials."""
        for p in polys:
            self._factors.update(dict.fromkeys(f for f, _ in p.factors()[1]))

    def __iter__(self) -> Iterator[Poly]:
        return iter(self._factors)

    def at(self, level: int) -> list[Poly]:
        """The factors of one level."""
        return [f for f in self._factors if f.level == level]


def project(
    polys: Iterable[Poly],
    variable: int,
    operator: Operator,
    constraint: frozenset[Poly] | None = None,
    *,
    first: bool = False,
) -> Iterator[Poly]:
    """The (unfactored) projection of a set of irreducible polynomials with main variable ``variable``.

    With the factors of an equational ``constraint``, what two other polynomials contribute is left out (McCallum
    2001), and in the ``first`` projection what each of them does, too (McCallum 1999).
    """
    listing = list(polys)
    core = listing if constraint is None else [f for f in listing if f in constraint]
    others = [] if constraint is None else [f for f in listing if f not in constraint]
    for f in core if first else listing:
        yield from operator.of_one(f, variable)
    for f, g in chain(combinations(core, 2), product(core, others)):
        yield from operator.of_two(f, g, variable)


def effort(polys: Iterable[Poly], variable: int) -> int:
    """The size of the largest resultant or discriminant of a projection: degrees times numbers of terms."""
    sizes = sorted(((f.degree(variable), f.term_count()) for f in polys), reverse=True)
    return max(((m + n) * s * t for k, (m, s) in enumerate(sizes) for n, t in sizes[k:]), default=0)


def factor_lists(
    polys: Iterable[Poly],
    size: int,
    operator: Operator,
    budget: Budget,
    thom_levels: frozenset[int] = frozenset(),
    constraints: Mapping[int, frozenset[Poly]] = MappingProxyType({}),
    heaviest: int | None = None,
    lowest: int = 0,
) -> Levels:
    """The irreducible factors of ``polys``, closed under projection down to level ``lowest``, one list per level.

    At the levels in ``thom_levels`` all derivatives of the factors with respect to the main variable join.
    ``constraints`` holds the factors of equational constraints by level (see ``equational``). Raises
    ``BudgetExceeded`` rather than start a projection of more ``effort`` than ``heaviest``.
    """
    found = FactorSet(polys)
    for k in range(size - 1, -1, -1):
        if k in thom_levels:
            for f in found.at(k):
                found.add(_derivatives(f, k))
        if k == lowest:
            break
        here = found.at(k)
        if heaviest is not None and effort(here, k) > heaviest:
            raise BudgetExceeded("a projection is too heavy", limit="effort")
        if budget.is_limited:
            budget.spend(effort(here, k) // EFFORT_OF_A_CELL)
        for p in project(here, k, operator, constraints.get(k), first=k == size - 1):
            budget.check("project", size - k, size)
            found.add((p,))
    # low degree first, then few terms, then by terms
    levels = (sorted(found.at(k), key=lambda p: (p.degrees[::-1], p.term_count(), p.terms())) for k in range(size))
    return tuple(map(tuple, levels))


def _derivatives(f: Poly, variable: int) -> Iterator[Poly]:
    """The derivatives of positive degree."""
    for _ in range(f.degree(variable) - 1):
        f = f.derivative(variable)
        yield f
