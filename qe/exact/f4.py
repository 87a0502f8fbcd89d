"""Groebner bases modulo word-size primes by Faugère's algorithm F4 (1999), once with all its choices and then again.

F4 reduces all critical pairs of one degree at a time: their polynomials and the multiples of basis elements that reduce
them are rows of a matrix. The first run, modulo one prime, finds which rows matter: those that reduce to zero, and
the multiples that only they need, are left out of the ``Trace`` (Traverso 1988). The trace is then followed modulo
many primes at once: every entry is an array. Input is homogeneous, degree reverse lexicographic order throughout.

Primes are below 2^26: sums of up to a thousand products then fit into 64 bits, and are reduced once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from flint import nmod_mat
from numpy.typing import NDArray

from qe.errors import Unable
from qe.exact.critical_pairs import CriticalPairs
from qe.exact.packed import PackedMonomials

Numbers = NDArray[np.int64]

_SEARCH, _TERM = 5, 20
"""A look at a possible divisor, and a term of a multiple, take about as long as so many products."""

MOST_PRODUCTS = 1000
"""Products of numbers below 2^26 whose sum is sure to stay below 2^62."""


class Unlucky(Exception):
    """A trace found modulo one prime does not hold modulo the others."""


@dataclass(frozen=True)
class Step:
    """One matrix. Columns: leading monomials of ``reducers`` (element, columns of the other terms), then all others.

    ``rows``: what is reduced, an element or (~number) one of the given polynomials, and its columns; ``skip`` terms at
    the front are left out. ``supports``: columns of the new elements behind the reducers' ones, leading one first.
    """

    width: int
    reducers: tuple[tuple[int, Numbers], ...]
    rows: tuple[tuple[int, Numbers], ...]
    supports: tuple[Numbers, ...]
    skip: int = 0


@dataclass
class Trace:
    """All steps; ``heads`` and ``tails``: leading and other monomials of the reduced basis. The last step finds the
    tails, and no new elements.
    """

    steps: list[Step] = field(default_factory=list)
    heads: list[int] = field(default_factory=list)
    tails: list[list[int]] = field(default_factory=list)

    @property
    def length(self) -> int:
        """About so many products of numbers are needed for each prime."""
        return sum(len(s.rows) * (sum(len(c) for _, c in s.reducers) + 10 * s.width) for s in self.steps)

    def followed(self, given: Sequence[Sequence[int]], primes: Sequence[int]) -> tuple[list[Numbers], list[bool]]:
        """Coefficients of the tails modulo every prime, an array (terms, primes) for each element of the basis, and
        which primes are good for it.

        ``given``: coefficients of the given polynomials, from the leading one on. Raises ``Unlucky``.
        """
        modulus = np.array(primes, dtype=np.int64)
        inputs = [np.array([[c % p for p in primes] for c in g], dtype=np.int64) for g in given]
        elements: list[Numbers] = []
        good = np.ones(len(primes), dtype=bool)
        for step in self.steps[:-1]:
            rest = _reduced(step, elements, inputs, modulus)
            elements += _echelon(rest, step.supports, modulus, good)
        last = _reduced(self.steps[-1], elements, inputs, modulus)
        tails = [_only(row, columns, good) for row, columns in zip(last.swapaxes(0, 1), self.steps[-1].supports)]
        return tails, good.tolist()


def _reduced(step: Step, elements: Sequence[Numbers], inputs: Sequence[Numbers], modulus: Numbers) -> Numbers:
    """(columns behind the reducers' ones, rows, primes): the rows reduced."""
    table = np.zeros((step.width, len(step.rows), len(modulus)), dtype=np.int64)
    for k, (source, columns) in enumerate(step.rows):
        table[columns, k] = (elements[source] if source >= 0 else inputs[~source])[step.skip :]
    for k, (source, columns) in enumerate(step.reducers):
        if k % MOST_PRODUCTS == MOST_PRODUCTS - 1:
            table[k:] %= modulus
        factors = table[k] % modulus
        if factors.any():
            table[columns] -= elements[source][1:, None] * factors
    return table[len(step.reducers) :] % modulus


def _echelon(rest: Numbers, runs: Sequence[Numbers], modulus: Numbers, good: NDArray[np.bool_]) -> list[Numbers]:
    """The rows in reduced echelon form with the leading columns of the first run; primes with other ones are marked."""
    rows = rest.transpose(1, 0, 2).copy()
    for j, columns in enumerate(runs):
        head = int(columns[0])
        best = j + int(np.argmax([np.count_nonzero(row[head]) for row in rows[j:]]))
        rows[[j, best]] = rows[[best, j]]
        pivots = rows[j, head]
        good &= pivots != 0
        inverse = [pow(int(c), -1, int(p)) if c else 0 for c, p in zip(pivots, modulus, strict=True)]
        rows[j] = rows[j] * np.array(inverse, dtype=np.int64) % modulus
        factors = rows[:, head].copy()
        factors[j] = 0
        rows = (rows - factors[:, None] * rows[j]) % modulus
    return [_only(row, columns, good) for row, columns in zip(rows, runs, strict=True)]


def _only(row: Numbers, columns: Numbers, good: NDArray[np.bool_]) -> Numbers:
    """The entries in these columns. Raises ``Unlucky`` where there are others."""
    beyond: NDArray[np.bool_] = np.any(row[:, good], axis=1)
    beyond[columns] = False
    if beyond.any():
        raise Unlucky
    return row[columns]


def learned(polys: Sequence[Mapping[int, int]], monomials: PackedMonomials, prime: int, most_products: int) -> Trace:
    """The trace of F4 modulo a prime for homogeneous polynomials (packed monomial -> coefficient).

    Raises ``Unable`` where it would take more than so many products of numbers, ``Unlucky`` where a leading
    coefficient vanishes.
    """
    run = _Run(monomials, prime, most_products)
    pending = sorted(range(len(polys)), key=lambda k: max(polys[k]))
    inputs = [sorted(g.items(), reverse=True) for g in polys]
    if any(g[0][1] % prime == 0 for g in inputs):
        raise Unlucky
    while pending or run.pairs.pairs:
        degree = min(
            [monomials.degree(t) for t, _, _ in run.pairs.pairs]
            + [monomials.degree(inputs[k][0][0]) for k in pending[:1]]
        )
        chosen = []
        if run.pairs.pairs and min(monomials.degree(t) for t, _, _ in run.pairs.pairs) == degree:
            chosen = run.pairs.taken()
        new = [k for k in pending if monomials.degree(inputs[k][0][0]) == degree]
        pending = [k for k in pending if k not in new]
        run.step(chosen, [(~k, [m for m, _ in inputs[k]], [c % prime for _, c in inputs[k]]) for k in new])
    run.finish()
    return run.trace


class _Run:
    """The first run: elements found so far by their monomials and coefficients."""

    def __init__(self, monomials: PackedMonomials, prime: int, most_products: int) -> None:
        self.m, self.prime, self.most_products, self.products = monomials, prime, most_products, 0
        self.modulus = np.array([prime], dtype=np.int64)
        self.pairs, self.trace = CriticalPairs(monomials), Trace()
        self.terms: list[list[int]] = []
        self.values: list[Numbers] = []

    def step(self, chosen: Sequence[tuple[int, int, int]], new: Sequence[tuple[int, list[int], list[int]]]) -> None:
        """All S-polynomials of the pairs, and new polynomials, reduced together."""
        reducers: dict[int, tuple[int, list[int]]] = {}
        rows: list[tuple[int, list[int]]] = [(source, terms) for source, terms, _ in new]
        members: dict[int, set[int]] = {}
        for t, i, j in chosen:
            members.setdefault(t, set()).update((i, j))
        for t, numbers in members.items():
            first, *others = sorted(numbers, key=lambda i: len(self.terms[i]))
            reducers[t] = first, self._multiple(first, t)
            rows += [(i, self._multiple(i, t)) for i in others]
        inputs = {source: np.array(values, dtype=np.int64)[:, None] for source, _, values in new}
        step, places = self._matrix(rows, reducers)
        rest = self._work_out(step, inputs)
        width, height = rest.shape[:2]
        if not rest.any():
            return
        columns = nmod_mat(width, height, rest.ravel().tolist(), self.prime)
        independent = _heads(columns.rref()[0])
        reduced, rank = columns.transpose().rref()
        found = []
        for entries in reduced.tolist()[:rank]:
            row = np.array([int(c) for c in entries], dtype=np.int64)
            support = np.nonzero(row)[0]
            found.append((support, [places[k] for k in support], row[support, None]))
        found.sort(key=lambda part: part[1][0])
        self._keep([rows[k] for k in independent], reducers, [terms for _, terms, _ in found])
        for _, terms, values in found:
            self.terms.append(terms)
            self.values.append(values)
            self.pairs.add(terms[0])

    def _multiple(self, i: int, t: int) -> list[int]:
        """The monomials of an element times the monomial that makes t its leading one."""
        shift = t - self.terms[i][0]
        return [m + shift for m in self.terms[i]]

    def _matrix(
        self, rows: Sequence[tuple[int, list[int]]], reducers: dict[int, tuple[int, list[int]]], skip: int = 0
    ) -> tuple[Step, list[int]]:
        """The matrix of these rows, with further multiples of elements for every monomial that has one ("symbolic
        preprocessing"); and the monomials of the columns that have none.
        """
        candidates = [(self.pairs.fields[i], i) for i in self.pairs.alive]
        guard, fields = self.m.guard, self.m.fields
        met = set(reducers)
        todo = {m for _, terms in rows for m in terms} - met
        todo.update(m for _, terms in reducers.values() for m in terms if m not in met)
        while todo:
            monomial = todo.pop()
            met.add(monomial)
            self._spend(_SEARCH * len(candidates))
            guarded = fields(monomial) | guard
            number = next((i for own, i in candidates if (guarded - own) & guard == guard), None)
            if number is not None:
                terms = self._multiple(number, monomial)
                self._spend(_TERM * len(terms))
                reducers[monomial] = number, terms
                todo.update(m for m in terms if m not in met)
        return self._placed(rows, reducers, met, skip)

    def _placed(
        self,
        rows: Sequence[tuple[int, list[int]]],
        reducers: Mapping[int, tuple[int, list[int]]],
        met: set[int],
        skip: int,
    ) -> tuple[Step, list[int]]:
        tops = sorted(reducers, reverse=True)
        others = sorted(met - reducers.keys(), reverse=True)
        place = {m: k for k, m in enumerate((*tops, *others))}

        def columns(terms: Sequence[int]) -> Numbers:
            return np.array([place[m] for m in terms], dtype=np.int64)

        below = tuple((reducers[t][0], columns(reducers[t][1][1:])) for t in tops)
        return Step(len(place), below, tuple((i, columns(terms)) for i, terms in rows), (), skip), others

    def _work_out(self, step: Step, inputs: Mapping[int, Numbers]) -> Numbers:
        self._spend(len(step.rows) * sum(len(c) for _, c in step.reducers))
        self._spend(len(step.rows) ** 2 * (step.width - len(step.reducers)))
        given = [inputs.get(~k, np.zeros((0, 1), dtype=np.int64)) for k in range(-min(inputs, default=0))]
        return _reduced(step, self.values, given, self.modulus)[:, :, 0]

    def _spend(self, products: int) -> None:
        self.products += products
        if self.products > self.most_products:
            raise Unable("a Gröbner basis modulo a prime grows past its limits")

    def _keep(
        self,
        rows: Sequence[tuple[int, list[int]]],
        reducers: Mapping[int, tuple[int, list[int]]],
        results: Sequence[Sequence[int]],
        skip: int = 0,
    ) -> None:
        """The step into the trace, with what these rows need alone."""
        met = {m for _, terms in rows for m in terms}
        needed = {}
        for t in sorted(reducers, reverse=True):
            if t in met:
                needed[t] = reducers[t]
                met.update(reducers[t][1])
        step, others = self._placed(rows, needed, met, skip)
        place = {m: k for k, m in enumerate(others)}
        columns = tuple(np.array([place[m] for m in terms], dtype=np.int64) for terms in results)
        self.trace.steps.append(Step(step.width, step.reducers, step.rows, columns, skip))

    def finish(self) -> None:
        """The last step: the tails of the minimal basis, fully reduced."""
        kept = sorted(self.pairs.alive, key=lambda i: self.terms[i][0])
        rows = [(i, self.terms[i][1:]) for i in kept]
        reducers: dict[int, tuple[int, list[int]]] = {}
        step, places = self._matrix(rows, reducers, skip=1)
        rest = self._work_out(step, {})
        self.trace.heads = [self.terms[i][0] for i in kept]
        self.trace.tails = [[places[c] for c in np.nonzero(rest[:, k])[0]] for k in range(len(rows))]
        self._keep(rows, reducers, self.trace.tails, skip=1)


def _heads(matrix: nmod_mat) -> list[int]:
    """The leading columns of a matrix in echelon form."""
    heads = []
    for row in matrix.tolist():
        head = next((k for k, c in enumerate(row) if c), None)
        if head is None:
            break
        heads.append(head)
    return heads
