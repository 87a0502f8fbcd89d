"""Buchberger's algorithm with every step written down: each new polynomial is a combination of earlier ones.

THEOREM (Buchberger 1965). S-polynomials reduced by what is known generate the ideal's Groebner basis; for an order in
which the eliminated variables come first, its elements without them generate what the ideal says of the others, and a
member of the ideal is reduced to 0 by it. A search ends as soon as what is wanted has been found.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from heapq import heapify, heappop, heappush
from itertools import combinations
from math import gcd, lcm

from qe.exact.ring import Poly, Ring
from qe.options import Budget

Powers = tuple[int, ...]
Terms = dict[Powers, int]
Row = list[tuple[int, Poly]]

MOST_PAIRS, MOST_BITS, MOST_TERMS = 400, 4_000, 5_000
"""S-polynomials looked at, bits of a coefficient, and terms of cofactors, at most."""


def chain(
    start: Sequence[Poly], free: int, enough: Callable[[Sequence[Poly]], bool], budget: Budget
) -> list[Row] | None:
    """Rows, each a combination of the polynomials before it (up to a constant), until ``enough`` is true of those in
    the first ``free`` variables alone; None where the limits are reached, nothing more is found, or one is 0."""
    if not all(start):
        return None
    search = _Chain(start, free, budget)
    complete = search.run(lambda: enough([p for p in search.polys if p.level < free]))
    return search.needed() if complete else None


def member(target: Poly, generators: Sequence[Poly], budget: Budget) -> tuple[int, list[Poly]] | None:
    """(n, c) with n > 0 and n times the target the sum of the c times the generators; None where none is found."""
    if not any(generators):
        return None
    if not all(generators):
        rest = member(target, [g for g in generators if g], budget)
        factors_of = iter(rest[1] if rest else ())
        return rest and (rest[0], [next(factors_of) if g else g for g in generators])
    search = _Chain(generators, 0, budget)
    seen, factors, scale = -1, dict[int, Terms](), 1

    def reduced() -> bool:
        nonlocal seen, factors, scale
        if seen == len(search.polys):
            return False
        seen, rest, factors = len(search.polys), dict(target.terms()), {}
        scale = search.reduce(rest, factors)
        return not rest

    if not search.run(reduced):
        return None
    row = [(k, target.ring.from_terms(factor)) for k, factor in factors.items() if factor]
    number, combination = search.combined(row, search.cofactors())
    if sum(c.term_count() for c in combination) > MOST_TERMS:
        return None
    number *= -scale  # the target is what was taken away from it
    return (number, combination) if number > 0 else (-number, [-c for c in combination])


class _Chain:
    def __init__(self, start: Sequence[Poly], free: int, budget: Budget) -> None:
        self.ring: Ring = start[0].ring
        self.free, self.budget, self.given = free, budget, len(start)
        self.polys: list[Poly] = []
        self.terms: list[Terms] = []
        self.leads: list[Powers] = []
        self.rows: list[Row] = []
        for p in start:
            self.add(p)

    def add(self, poly: Poly) -> None:
        self.polys.append(poly)
        self.terms.append(dict(poly.terms()))
        self.leads.append(max(self.terms[-1], key=self.rank))

    def rank(self, powers: Powers) -> tuple[int, ...]:
        """Degree reverse lexicographic in the eliminated variables first, then in the others."""
        bound, free = powers[self.free :], powers[: self.free]
        return (sum(bound), *(-e for e in reversed(bound)), sum(free), *(-e for e in reversed(free)))

    def run(self, enough: Callable[[], bool]) -> bool:
        """Add polynomials until there are enough; False where the limits are reached or nothing more is found."""
        pairs = [self.ranked(i, j) for i, j in combinations(range(self.given), 2)]
        heapify(pairs)
        looked = 0
        while not enough():
            if not pairs or looked > MOST_PAIRS:
                return False
            _, j, i = heappop(pairs)
            if not any(map(min, self.leads[i], self.leads[j])):
                continue  # coprime leading terms: the S-polynomial reduces to 0
            looked += 1
            self.budget.check("elimination", looked)
            if self.add_pair(i, j):
                for k in range(len(self.polys) - 1):
                    heappush(pairs, self.ranked(k, len(self.polys) - 1))
                if self.polys[-1].height_bits() > MOST_BITS:
                    return False
        return True

    def ranked(self, i: int, j: int) -> tuple[tuple[int, ...], int, int]:
        """The least common multiple of two leading terms, by its rank, and the two, the last of them first."""
        return self.rank(tuple(map(max, self.leads[i], self.leads[j]))), j, i

    def add_pair(self, i: int, j: int) -> bool:
        """Add what is left of an S-polynomial; whether anything is."""
        top, a, b = tuple(map(max, self.leads[i], self.leads[j])), self.terms[i], self.terms[j]
        common = gcd(a[self.leads[i]], b[self.leads[j]])
        factors: dict[int, Terms] = {
            i: {_less(top, self.leads[i]): b[self.leads[j]] // common},
            j: {_less(top, self.leads[j]): -a[self.leads[i]] // common},
        }
        rest: Terms = {}
        for k, factor in factors.items():
            for shift, c in factor.items():
                _add(rest, self.terms[k], shift, c)
        self.reduce(rest, factors)
        if not rest:
            return False
        self.rows.append([(k, self.ring.from_terms(factor)) for k, factor in factors.items() if factor])
        self.add(self.ring.from_terms(rest).normal()[1])
        return True

    def reduce(self, rest: Terms, factors: dict[int, Terms]) -> int:
        """Subtract multiples of the polynomials until the leading term is a multiple of none of theirs.

        Afterwards ``rest`` is the scale that is returned times what it was, plus the changes of ``factors`` times the
        polynomials, where ``factors`` was multiplied by that scale too.
        """
        whole = 1
        while rest:
            lead = max(rest, key=self.rank)
            k = next((k for k, own in enumerate(self.leads) if all(map(int.__le__, own, lead))), None)
            if k is None:
                break
            own, shift = self.terms[k][self.leads[k]], _less(lead, self.leads[k])
            common = gcd(rest[lead], own)
            scale, c = own // common, -rest[lead] // common
            for terms in (rest, *factors.values()) if scale != 1 else ():
                for powers in terms:
                    terms[powers] *= scale
            whole *= scale
            _add(rest, self.terms[k], shift, c)
            _add(factors.setdefault(k, {}), {(0,) * len(shift): 1}, shift, c)
        return whole

    def cofactors(self) -> list[tuple[int, list[Poly]]]:
        """For each polynomial (n, c) such that n times it is the sum of the c times those at the start."""
        zero, one = self.ring.constant(0), self.ring.constant(1)
        rows = [(1, [one if k == i else zero for k in range(self.given)]) for i in range(self.given)]
        for row in self.rows:
            content = sum((f * self.polys[k] for k, f in row), zero).normal()[0]
            scale, total = self.combined(row, rows)
            rows.append((content * scale, total))
        return rows

    def combined(self, row: Row, rows: Sequence[tuple[int, list[Poly]]]) -> tuple[int, list[Poly]]:
        """(n, c) such that n times the sum of a row is the sum of the c times the polynomials at the start."""
        scale = lcm(*(rows[k][0] for k, _ in row))
        total = [self.ring.constant(0)] * self.given
        for k, f in row:
            number, own = rows[k]
            total = [t + f * c * (scale // number) for t, c in zip(total, own, strict=True)]
        return scale, total

    def needed(self) -> list[Row]:
        """The rows on which those without eliminated variables rest, numbered anew."""
        wanted = {k for k, p in enumerate(self.polys) if p.level < self.free}
        for k in range(len(self.polys) - 1, self.given - 1, -1):
            if k in wanted:
                wanted |= {i for i, _ in self.rows[k - self.given]}
        kept = [k for k in range(len(self.polys)) if k < self.given or k in wanted]
        numbers = {k: number for number, k in enumerate(kept)}
        return [[(numbers[i], f) for i, f in self.rows[k - self.given]] for k in kept if k >= self.given]


def _less(a: Powers, b: Powers) -> Powers:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _add(total: Terms, terms: Terms, shift: Powers, c: int) -> None:
    for powers, coefficient in terms.items():
        place = tuple(x + y for x, y in zip(powers, shift, strict=True))
        value = total.get(place, 0) + c * coefficient
        if value:
            total[place] = value
        else:
            del total[place]
