"""Elimination with every step written down: Buchberger's algorithm, each new polynomial a combination of earlier ones.

THEOREM (Buchberger 1965). S-polynomials reduced by what is known generate the ideal's Groebner basis; for an order in
which the eliminated variables come first, its elements without them generate what the ideal says of the others.
The search ends as soon as those found have the greatest common divisor that is wanted.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from math import gcd

from qe.exact.ring import Poly, Ring
from qe.options import Budget

Powers = tuple[int, ...]
Terms = dict[Powers, int]
Row = list[tuple[int, Poly]]

MOST_PAIRS, MOST_BITS = 400, 4_000
"""S-polynomials looked at, and bits of a coefficient, at most."""


def chain(
    start: Sequence[Poly], free: int, enough: Callable[[Sequence[Poly]], bool], budget: Budget
) -> list[Row] | None:
    """Rows, each a combination of the polynomials before it (up to a constant), until ``enough`` is true of those in
    the first ``free`` variables alone; None where the limits are reached or nothing more is found."""
    return _Chain(start, free, budget).run(enough)


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

    def run(self, enough: Callable[[Sequence[Poly]], bool]) -> list[Row] | None:
        pairs = list(combinations(range(self.given), 2))
        looked = 0
        while not enough([p for p in self.polys if p.level < self.free]):
            if not pairs or looked > MOST_PAIRS:
                return None
            i, j = min(pairs, key=lambda pair: self.rank(_joined(self.leads[pair[0]], self.leads[pair[1]])))
            pairs.remove((i, j))
            if not any(map(min, self.leads[i], self.leads[j])):
                continue  # coprime leading terms: the S-polynomial reduces to 0
            looked += 1
            self.budget.check("elimination", looked)
            if self.reduced(i, j):
                pairs += [(k, len(self.polys) - 1) for k in range(len(self.polys) - 1)]
                if self.polys[-1].height_bits() > MOST_BITS:
                    return None
        return self.needed()

    def reduced(self, i: int, j: int) -> bool:
        """Add what is left of an S-polynomial; whether anything is."""
        top, a, b = _joined(self.leads[i], self.leads[j]), self.terms[i], self.terms[j]
        common = gcd(a[self.leads[i]], b[self.leads[j]])
        factors: dict[int, Terms] = {
            i: {_less(top, self.leads[i]): b[self.leads[j]] // common},
            j: {_less(top, self.leads[j]): -a[self.leads[i]] // common},
        }
        rest: Terms = {}
        for k, factor in factors.items():
            for shift, c in factor.items():
                _add(rest, self.terms[k], shift, c)
        while rest:
            lead = max(rest, key=self.rank)
            k = next((k for k, own in enumerate(self.leads) if all(map(int.__le__, own, lead))), None)
            if k is None:
                break
            own, shift = self.terms[k][self.leads[k]], _less(lead, self.leads[k])
            common = gcd(rest[lead], own)
            scale, c = own // common, -rest[lead] // common
            for terms in (rest, *factors.values()):
                for powers in terms if scale != 1 else ():
                    terms[powers] *= scale
            _add(rest, self.terms[k], shift, c)
            _add(factors.setdefault(k, {}), {(0,) * len(shift): 1}, shift, c)
        if not rest:
            return False
        self.rows.append([(k, self.ring.from_terms(factor)) for k, factor in factors.items() if factor])
        self.add(self.ring.from_terms(rest).normal()[1])
        return True

    def needed(self) -> list[Row]:
        """The rows on which those without eliminated variables rest, numbered anew."""
        wanted = {k for k, p in enumerate(self.polys) if p.level < self.free}
        for k in range(len(self.polys) - 1, self.given - 1, -1):
            if k in wanted:
                wanted |= {i for i, _ in self.rows[k - self.given]}
        kept = [k for k in range(len(self.polys)) if k < self.given or k in wanted]
        numbers = {k: number for number, k in enumerate(kept)}
        return [[(numbers[i], f) for i, f in self.rows[k - self.given]] for k in kept if k >= self.given]


def _joined(a: Powers, b: Powers) -> Powers:
    return tuple(map(max, a, b))


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
