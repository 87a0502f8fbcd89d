"""Ideals of Q[x] with finitely many zeros, for the checker: a Gröbner basis, the quotient, signatures of trace forms.

Nothing here is shared with the producers: Buchberger's algorithm in its plain form on dictionaries of terms, and
signatures by symmetric elimination instead of characteristic polynomials.

THEOREM (Hermite 1853; Pedersen, Roy, Szpirglas 1993). Let I have finitely many complex zeros, and h be a polynomial.
The signature of the form (f, g) -> Tr(multiplication by h*f*g) on Q[x]/I is the number of real zeros of I with h > 0
minus that of those with h < 0, each counted once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from heapq import heapify, heappop, heappush
from itertools import combinations

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


def product(a: Mapping[Exponents, fmpq], b: Mapping[Exponents, fmpq]) -> Terms:
    """The product of two polynomials."""
    found: Terms = {}
    for e, c in a.items():
        for f, d in b.items():
            place = tuple(i + j for i, j in zip(e, f, strict=True))
            found[place] = found.get(place, fmpq(0)) + c * d
    return {e: c for e, c in found.items() if c}


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
        return -sum(w * k for w, k in zip(self.weights, e, strict=True)), e[::-1]

    # --- the basis ---------------------------------------------------------------------------
    def _complete(self, polys: list[Terms]) -> None:
        pairs: list[tuple[tuple[int, Exponents], int, int]] = []
        done: set[tuple[int, int]] = set()
        for p in sorted(polys, key=lambda p: max(map(sum, p))):
            self._add(self.remainder(p), pairs)
        while pairs:
            self.check()
            _, i, j = heappop(pairs)
            done.add((i, j))
            (a, f), (b, g) = self.basis[i], self.basis[j]
            top = tuple(map(max, a, b))
            if not any(x and y for x, y in zip(a, b, strict=True)) or self._is_covered(top, i, j, done):
                continue
            difference = product({over(top, a): fmpq(1)}, f)
            for e, c in product({over(top, b): fmpq(1)}, g).items():
                difference[e] = difference.get(e, fmpq(0)) - c
            self._add(self.remainder({e: c for e, c in difference.items() if c}), pairs)

    def _is_covered(self, top: Exponents, i: int, j: int, done: set[tuple[int, int]]) -> bool:
        """Buchberger's second criterion: a third leading monomial divides, and both pairs with it are done."""
        for k, (lead, _) in enumerate(self.basis):
            if k not in (i, j) and divides(lead, top):
                pairs = (min(i, k), max(i, k)), (min(j, k), max(j, k))
                if pairs[0] in done and pairs[1] in done:
                    return True
        return False

    def _add(self, p: Terms, pairs: list[tuple[tuple[int, Exponents], int, int]]) -> None:
        if not p:
            return
        lead = min(p, key=self.key)
        head, number = p[lead], len(self.basis)
        if number >= MOST_ELEMENTS:
            raise Unable("the Gröbner basis of a system grows past the limits of the checker")
        for k, (other, _) in enumerate(self.basis):
            top = tuple(map(max, lead, other))
            degree, rest = self.key(top)
            heappush(pairs, ((-degree, rest), k, number))
        self.basis.append((lead, {e: c / head for e, c in p.items()}))

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
        """Whether there are finitely many complex zeros: a power of every variable is a leading monomial, or 1."""
        pure = {k for lead, _ in self.basis for k in range(self.size) if lead[k] == sum(lead)}
        return len(pure) == self.size

    def monomials(self) -> list[Exponents]:
        """Those that no leading monomial divides. ``is_finite`` must hold."""
        leads = [lead for lead, _ in self.basis]
        start = (0,) * self.size
        if any(not any(lead) for lead in leads):
            return []
        found, pending = {start}, [start]
        while pending:
            e = pending.pop()
            for larger in _larger(e):
                if larger not in found and not any(divides(lead, larger) for lead in leads):
                    found.add(larger)
                    pending.append(larger)
            if len(found) > MOST_DIMENSIONS:
                raise Unable(f"a system has more than {MOST_DIMENSIONS} complex solutions")
        return sorted(found, key=self.key, reverse=True)


def _larger(e: Exponents) -> Iterator[Exponents]:
    for k in range(len(e)):
        yield (*e[:k], e[k] + 1, *e[k + 1 :])


class TraceForms:
    """The quotient by an ideal with finitely many zeros, by its multiplication tables."""

    def __init__(self, ideal: Ideal) -> None:
        self.ideal, self.monomials = ideal, ideal.monomials()
        self._place = {e: k for k, e in enumerate(self.monomials)}
        self._matrices = [self._step(k) for k in range(ideal.size)]
        self._products: dict[Exponents, fmpq_mat] = {}
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
            k = next((k for k, power in enumerate(e) if power), None)
            if k is None:
                size = len(self.monomials)
                self._products[e] = fmpq_mat(size, size, [fmpq(i == j) for i in range(size) for j in range(size)])
            else:
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
