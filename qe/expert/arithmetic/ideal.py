"""Ideals of Q[x] with finitely many zeros, for the checker: a Gröbner basis, the quotient, signatures of trace forms.

Nothing here is shared with the producers: Buchberger's algorithm in its plain form on dictionaries of terms, and
signatures by symmetric elimination instead of characteristic polynomials.

THEOREM (Hermite 1853; Pedersen, Roy, Szpirglas 1993). Let I have finitely many complex zeros, and h be a polynomial.
The signature of the form (f, g) -> Tr(multiplication by h*f*g) on Q[x]/I is the number of real zeros of I with h > 0
minus that of those with h < 0, each counted once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush
from itertools import combinations
from operator import mul
from typing import Any

from flint import fmpq, fmpq_mat

from qe.errors import Unable
from qe.exact.ring import Poly

Exponents = tuple[int, ...]
Terms = dict[Exponents, fmpq]

MOST_ELEMENTS = 400
MOST_DIMENSIONS = 150


def divides(a: Exponents, b: Exponents) -> bool:
    """Whether the monomial with exponents a divides the one with exponents b."""
    return all(i <= j for i, j in zip(a, b, strict=True))


def over(a: Exponents, b: Exponents) -> Exponents:
    """The quotient of two monomials."""
    return tuple(i - j for i, j in zip(a, b, strict=True))


def terms_of(p: Poly) -> Terms:
    """A polynomial as a dictionary of its terms."""
    return {tuple(map(int, e)): fmpq(int(c)) for e, c in p.terms()}


def product(a: Mapping[Exponents, Any], b: Mapping[Exponents, Any]) -> dict[Exponents, Any]:
    """The product of two polynomials, whose coefficients are of one kind."""
    found: dict[Exponents, Any] = {}
    for e, c in a.items():
        for f, d in b.items():
            place = tuple(i + j for i, j in zip(e, f, strict=True))
            found[place] = found[place] + c * d if place in found else c * d
    return {e: c for e, c in found.items() if c}


def key(e: Exponents, weights: Sequence[int] = ()) -> tuple[int, Exponents]:
    """The smaller the higher: degree reverse lexicographic; weights of the variables are 1 where none are given."""
    return -(sum(map(mul, weights, e)) if weights else sum(e)), e[::-1]


def is_finite(leads: Sequence[Exponents], size: int) -> bool:
    """Whether there are finitely many complex zeros: a power of every variable is a leading monomial, or 1."""
    return size == len({k for lead in leads for k in range(size) if lead[k] == sum(lead)})


def monomials_below(leads: Sequence[Exponents], size: int, most: int) -> list[Exponents]:
    """Those that no leading monomial divides, where ``is_finite`` holds. Raises ``Unable`` for too many."""
    start = (0,) * size
    pending = [] if start in leads else [start]
    found = set(pending)
    while pending:
        e = pending.pop()
        for larger in ((*e[:k], e[k] + 1, *e[k + 1 :]) for k in range(size)):
            if larger not in found and not any(divides(lead, larger) for lead in leads):
                found.add(larger)
                pending.append(larger)
        if len(found) > most:
            raise Unable(f"a system has more than {most} complex solutions")
    return list(found)


@dataclass
class Pairs:
    """Members of a basis, by their numbers, whose S-polynomials are to be reduced, and those for which that is done."""

    weights: tuple[int, ...] = ()
    pending: list[tuple[tuple[int, Exponents], int, int]] = field(default_factory=list)
    done: set[tuple[int, int]] = field(default_factory=set)

    def add(self, lead: Exponents, leads: Sequence[Exponents]) -> None:
        """A further member of the basis with the others."""
        for k, other in enumerate(leads):
            degree, rest = key(tuple(map(max, lead, other)), self.weights)
            heappush(self.pending, ((-degree, rest), k, len(leads)))

    def next(self, leads: Sequence[Exponents], check: Callable[[], None]) -> tuple[int, int] | None:
        """The next pair; not needed (Buchberger) are those whose leading monomials have no common variable, or whose
        least common multiple a third one divides, both pairs with which are done."""
        while self.pending:
            check()
            _, i, j = heappop(self.pending)
            self.done.add((i, j))
            top = tuple(map(max, leads[i], leads[j]))
            others = (k for k, lead in enumerate(leads) if k not in (i, j) and divides(lead, top))
            if any(map(min, leads[i], leads[j])) and not any(
                {(min(i, k), max(i, k)), (min(j, k), max(j, k))} <= self.done for k in others
            ):
                return i, j
        return None


class Ideal:
    """The ideal of polynomials, with a basis in the degree reverse lexicographic order of weighted degrees.

    Raises ``Unable`` where the basis grows past its limits. ``check`` is called now and then.
    """

    def __init__(
        self, polys: Sequence[Mapping[Exponents, fmpq]], weights: Sequence[int], check: Callable[[], None]
    ) -> None:
        self.weights, self.size, self.check = tuple(weights), len(weights), check
        self.basis: list[tuple[Exponents, Terms]] = []
        self._complete([dict(p) for p in polys if p])

    def key(self, e: Exponents) -> tuple[int, Exponents]:
        """The smaller the higher."""
        return key(e, self.weights)

    @property
    def leads(self) -> list[Exponents]:
        """The leading monomials of the basis."""
        return [lead for lead, _ in self.basis]

    def _complete(self, polys: list[Terms]) -> None:
        pairs = Pairs(self.weights)
        for p in sorted(polys, key=lambda p: max(map(sum, p))):
            self._add(self.remainder(p), pairs)
        while (pair := pairs.next(self.leads, self.check)) is not None:
            (a, f), (b, g) = (self.basis[k] for k in pair)
            top = tuple(map(max, a, b))
            difference = product({over(top, a): fmpq(1)}, f)
            for e, c in product({over(top, b): fmpq(1)}, g).items():
                difference[e] = difference.get(e, fmpq(0)) - c
            self._add(self.remainder({e: c for e, c in difference.items() if c}), pairs)

    def _add(self, p: Terms, pairs: Pairs) -> None:
        if not p:
            return
        lead = min(p, key=self.key)
        if len(self.basis) >= MOST_ELEMENTS:
            raise Unable("the Gröbner basis of a system grows past the limits of the checker")
        pairs.add(lead, self.leads)
        self.basis.append((lead, {e: c / p[lead] for e, c in p.items()}))

    def remainder(self, p: Mapping[Exponents, fmpq]) -> Terms:
        """The normal form of a polynomial."""
        rest, done = dict(p), Terms()
        pending = [(self.key(e), e) for e in rest]
        heapify(pending)
        while pending:
            _, top = heappop(pending)
            c = rest.pop(top, fmpq(0))
            if not c:
                continue
            found = next(((lead, g) for lead, g in self.basis if divides(lead, top)), None)
            if found is None:
                done[top] = c
                continue
            self.check()
            lead, g = found
            shift = over(top, lead)
            for e, d in g.items():
                if e == lead:
                    continue
                place = tuple(i + j for i, j in zip(e, shift, strict=True))
                if place not in rest:
                    heappush(pending, (self.key(place), place))
                    rest[place] = -c * d
                else:
                    rest[place] -= c * d
        return done

    @property
    def is_finite(self) -> bool:
        """Whether there are finitely many complex zeros."""
        return is_finite(self.leads, self.size)

    def monomials(self) -> list[Exponents]:
        """Those that no leading monomial divides. ``is_finite`` must hold."""
        return sorted(monomials_below(self.leads, self.size, MOST_DIMENSIONS), key=self.key, reverse=True)


class TraceForms:
    """The quotient by an ideal with finitely many zeros, by its multiplication tables."""

    def __init__(self, ideal: Ideal) -> None:
        self.ideal, self.monomials = ideal, ideal.monomials()
        self._place = {e: k for k, e in enumerate(self.monomials)}
        self._matrices = [self._step(k) for k in range(ideal.size)]
        size = len(self.monomials)
        unit = fmpq_mat(size, size, [fmpq(i == j) for i in range(size) for j in range(size)])
        self._products = {(0,) * ideal.size: unit}
        traces = []
        for e in self.monomials:
            matrix = self._multiplication(e)
            traces.append(sum((matrix[i, i] for i in range(len(self.monomials))), fmpq(0)))
        self._traces = fmpq_mat(1, len(traces), traces)

    def _column(self, p: Mapping[Exponents, fmpq]) -> list[fmpq]:
        column = [fmpq(0)] * len(self.monomials)
        for e, c in self.ideal.remainder(p).items():
            column[self._place[e]] = c
        return column

    def _step(self, k: int) -> fmpq_mat:
        """Multiplication by a variable; columns are images."""
        columns = [self._column({(*e[:k], e[k] + 1, *e[k + 1 :]): fmpq(1)}) for e in self.monomials]
        size = len(self.monomials)
        return fmpq_mat(size, size, [columns[j][i] for i in range(size) for j in range(size)])

    def _multiplication(self, e: Exponents) -> fmpq_mat:
        if e not in self._products:
            self.ideal.check()
            k = next(k for k, power in enumerate(e) if power)
            self._products[e] = self._matrices[k] * self._multiplication((*e[:k], e[k] - 1, *e[k + 1 :]))
        return self._products[e]

    def signature(self, h: Mapping[Exponents, fmpq]) -> int:
        """#{real zeros with h > 0} - #{real zeros with h < 0}."""
        size = len(self.monomials)
        if not size:
            return 0
        weighted = fmpq_mat(size, size)
        for c, e in zip(self._column(h), self.monomials, strict=True):
            if c:
                weighted += self._multiplication(e) * c
        row = self._traces * weighted
        return signature([(row * self._multiplication(e)).entries() for e in self.monomials], self.ideal.check)


def signature(rows: list[list[fmpq]], check: Callable[[], None]) -> int:
    """The signature of a symmetric matrix by symmetric elimination.

    A diagonal entry that is not 0 gives its sign, and what is left is the complement. Where all of them are 0, one row
    and column are added to others that they cross with an entry a: that makes the diagonal entry 2a.
    """
    rows, found = [list(row) for row in rows], 0
    while rows:
        check()
        size = len(rows)
        k = next((k for k in range(size) if rows[k][k]), None)
        if k is None:
            crossing = next(((i, j) for i, j in combinations(range(size), 2) if rows[i][j]), None)
            if crossing is None:
                return found
            k, j = crossing
            rows[k] = [a + b for a, b in zip(rows[k], rows[j], strict=True)]
            for row in rows:
                row[k] += row[j]
        pivot = rows[k]
        found += 1 if pivot[k] > 0 else -1
        rest = [i for i in range(size) if i != k]
        rows = [[rows[i][j] - rows[i][k] * pivot[j] / pivot[k] for j in rest] for i in rest]
    return found
