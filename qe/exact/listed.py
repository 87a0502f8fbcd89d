"""Polynomials with few of many variables whose terms are known before their value in FLINT is asked for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cached_property
from math import gcd, prod

from flint import fmpq, fmpz, fmpz_mpoly

from qe.exact.ring import Poly, Ring, SparseTerm
from qe.exact.wide import WidePoly


class ListedPoly(WidePoly):
    """A polynomial whose terms are known, none of them zero; its value in FLINT is made when it is asked for.

    Long scripts have a hundred thousand linear forms, of which many are never asked for it.
    """

    __slots__ = ()

    def __init__(self, ring: Ring, terms: Iterable[SparseTerm]) -> None:
        self.ring, self._hash = ring, None
        # from the main variable down: the lexicographic order, highest first
        self.__dict__["_terms"] = tuple(sorted(terms, key=lambda term: term[0][::-1], reverse=True))

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return ListedPoly, (self.ring, self._terms)

    @cached_property
    def p(self) -> fmpz_mpoly:
        return self.ring.from_sparse(self._terms).p

    @cached_property
    def variables(self) -> tuple[int, ...]:
        return tuple(sorted({i for powers, _ in self._terms for i, _ in powers}))

    @cached_property
    def support(self) -> frozenset[int]:
        return frozenset(self.variables)

    @cached_property
    def total_degree(self) -> int:
        return max(sum(k for _, k in powers) for powers, _ in self._terms)

    @cached_property
    def _normal(self) -> tuple[int, Poly]:
        values = [c for _, c in self._terms]
        unit = gcd(*values) if values[0] > 0 else -gcd(*values)
        return unit, (self if unit == 1 else ListedPoly(self.ring, [(powers, c // unit) for powers, c in self._terms]))

    def __mul__(self, other: Poly | int) -> Poly:
        if not isinstance(other, int) or not other:
            return super().__mul__(other)
        return ListedPoly(self.ring, [(powers, c * other) for powers, c in self._terms])

    def __sub__(self, other: Poly | int) -> Poly:
        rest = [term for term in self._terms if term[0]]
        if not isinstance(other, int) or not rest:
            return super().__sub__(other)
        constant = (0 if self._terms[-1][0] else self._terms[-1][1]) - other
        return ListedPoly(self.ring, [*rest, ((), constant)] if constant else rest)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, ListedPoly):
            return self.ring is other.ring and self._terms == other._terms
        return super().__eq__(other)

    def _at(self, values: Iterable[Fraction | int]) -> fmpq | fmpz | int:
        point = [v if isinstance(v, int) else fmpq(v.numerator, v.denominator) for v in values]
        return sum(c * prod(point[i] ** k for i, k in powers) for powers, c in self._terms)

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash((self.variables, *(c for _, c in self._terms)))
        return self._hash

    def __bool__(self) -> bool:
        return True

    def term_count(self) -> int:
        return len(self._terms)


def combination(ring: Ring, coefficients: Mapping[tuple[str, ...], int]) -> Poly:
    """The sum of multiples, not by zero, of products of names, each of which is sorted."""
    if not ring.is_wide:
        return ring.combination(coefficients)
    index, terms = ring.index, list[SparseTerm]()
    for names, c in coefficients.items():
        if len(names) == 1:
            terms.append((((index[names[0]], 1),), c))
        else:
            counts = Counter(map(index.__getitem__, names)) if names else {}
            terms.append((tuple(sorted(counts.items())), c))
    return ListedPoly(ring, terms)
