"""The quotient of a polynomial ring by a zero-dimensional ideal: its monomials, products, traces and signatures.

Q[x]/I has the monomials that no leading monomial of a Groebner basis divides as a basis of vectors (Macaulay 1927). A
polynomial acts on it by multiplication; the traces of these maps are sums over the common zeros of I, each counted
with its multiplicity, so the trace form (f, g) -> Tr(h*f*g) is Hermite's: its rank is the number of distinct zeros with
h /= 0, its signature the number of real zeros with h > 0 minus that of those with h < 0 (Hermite 1853; Pedersen, Roy,
Szpirglas 1993).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import combinations
from operator import le

from flint import fmpq, fmpq_mat

from qe.errors import InternalError, Unable
from qe.exact.groebner import Basis
from qe.exact.ring import Poly
from qe.exact.univariate import sign_changes
from qe.exact.zeros import Zero, zeros_of

Exponents = tuple[int, ...]
Sparse = dict[int, fmpq]

MOST_DIMENSIONS = 600
"""Vectors of a quotient basis: beyond, matrices over Q take minutes."""


class PositiveDimensional(Unable):
    """A system has infinitely many complex solutions; ``free``: as many variables as can be that no equation binds."""

    def __init__(self, free: Sequence[str]) -> None:
        self.free = tuple(free)
        named = ", ".join(self.free)
        super().__init__(f"the system has infinitely many complex solutions ({named} can vary)")

    def __reduce__(self) -> tuple[object, tuple[tuple[str, ...]]]:
        return PositiveDimensional, (self.free,)


def independent_sets(leads: Sequence[Exponents], size: int) -> Iterator[tuple[int, ...]]:
    """The largest sets of positions such that no leading monomial is in these variables alone, one after the other.

    Their size is the dimension of the ideal (Kredel and Weispfenning 1988). Nothing for the unit ideal.
    """
    supports = [frozenset(k for k, e in enumerate(lead) if e) for lead in leads]
    if frozenset() in supports:
        return
    for count in range(size, -1, -1):
        is_independent = False
        for chosen in combinations(range(size), count):
            if not any(support <= set(chosen) for support in supports):
                is_independent = True
                yield chosen
        if is_independent:
            return


def dimension(basis: Basis) -> int:
    """The dimension of the set of complex zeros in the space of the basis' variables; -1 where there are none."""
    largest = next(independent_sets(basis.leads, len(basis.variables)), None)
    return -1 if largest is None else len(largest)


class Quotient:
    """Q[variables]/I with its basis of monomials, ascending. Raises ``PositiveDimensional``; may be {0} (no zeros)."""

    def __init__(self, basis: Basis) -> None:
        self.basis, self._leads = basis, basis.leads
        self.monomials = self._standard()
        self._place = {m: k for k, m in enumerate(self.monomials)}
        self._columns = self._products()

    @property
    def size(self) -> int:
        """The number of complex zeros with their multiplicities."""
        return len(self.monomials)

    def _standard(self) -> tuple[Exponents, ...]:
        free = next(independent_sets(self._leads, len(self.basis.variables)), None)
        if free is None:
            return ()
        if free:
            names = self.basis.ring.names
            raise PositiveDimensional([names[self.basis.variables[k]] for k in free])
        standard = standard_monomials(self._leads, len(self.basis.variables), MOST_DIMENSIONS, "the system")
        return tuple(sorted(standard, key=self.basis.rank))

    def _products(self) -> list[dict[Exponents, Sparse]]:
        """Normal forms of x_k times every basis monomial, found from small to large without further divisions.

        A product that is neither in the basis of vectors nor a leading monomial is x_j times a smaller product, whose
        normal form is known (Faugère, Gianni, Lazard, Mora 1993).
        """
        size = len(self.basis.variables)
        tails = dict(zip(self._leads, self.basis.tails(), strict=True))
        known: dict[Exponents, Sparse] = {m: {k: fmpq(1)} for k, m in enumerate(self.monomials)}
        border = {shifted(m, k, 1) for m in self.monomials for k in range(size)} - self._place.keys()
        for monomial in sorted(border, key=self.basis.rank):
            if monomial in tails:
                known[monomial] = {self._place[m]: c for m, c in tails[monomial].items()}
                continue
            smaller = ((k, shifted(monomial, k, -1)) for k, e in enumerate(monomial) if e)
            k, below = next((k, m) for k, m in smaller if m in border and m in known)
            total: Sparse = {}
            for j, c in known[below].items():
                for i, d in known[shifted(self.monomials[j], k, 1)].items():
                    total[i] = total.get(i, fmpq(0)) + c * d
            known[monomial] = {i: c for i, c in total.items() if c}
        return [{m: known[shifted(m, k, 1)] for m in self.monomials} for k in range(size)]

    @cached_property
    def matrices(self) -> tuple[fmpq_mat, ...]:
        """Multiplication by each variable: column j holds the coordinates of variable*monomial_j."""
        matrices = []
        for columns in self._columns:
            matrix = fmpq_mat(self.size, self.size)
            for j, monomial in enumerate(self.monomials):
                for i, c in columns[monomial].items():
                    matrix[i, j] = c
            matrices.append(matrix)
        return tuple(matrices)

    @cached_property
    def powers(self) -> tuple[fmpq_mat, ...]:
        """Multiplication by each monomial of the basis."""
        known: dict[Exponents, fmpq_mat] = {}
        one = fmpq_mat(self.size, self.size, [fmpq(i == j) for i in range(self.size) for j in range(self.size)])
        for monomial in self.monomials:
            k = next((k for k, e in enumerate(monomial) if e), None)
            known[monomial] = one if k is None else self.matrices[k] * known[shifted(monomial, k, -1)]
        return tuple(known[m] for m in self.monomials)

    @cached_property
    def traces(self) -> fmpq_mat:
        """The row of the traces of the basis monomials."""
        size = self.size
        return fmpq_mat(1, size, [sum((p[i, i] for i in range(size)), fmpq(0)) for p in self.powers])

    def matrix(self, poly: Poly) -> fmpq_mat:
        """Multiplication by a polynomial in the basis' variables."""
        total = fmpq_mat(self.size, self.size)
        for i, c in enumerate(self.coordinates(poly)):
            if c:
                total += self.powers[i] * c
        return total

    def coordinates(self, poly: Poly) -> list[fmpq]:
        """The coordinates of a polynomial: its normal form."""
        scale, rest = self.basis.reduce(poly)
        coordinates = [fmpq(0)] * self.size
        for exponents, c in rest.terms():
            coordinates[self._place[tuple(exponents[i] for i in self.basis.variables)]] = fmpq(c, scale)
        return coordinates

    @cached_property
    def trace_form(self) -> fmpq_mat:
        """Hermite's matrix Tr(b_i*b_j); symmetric."""
        return self._form(self.traces)

    def form(self, poly: Poly) -> fmpq_mat:
        """Hermite's matrix Tr(h*b_i*b_j) for h = poly; symmetric."""
        return self._form(self.traces * self.matrix(poly))

    def _form(self, row: fmpq_mat) -> fmpq_mat:
        size = self.size
        return fmpq_mat(size, size, [c for p in self.powers for c in (row * p).entries()])

    def signature(self, poly: Poly | None = None) -> int:
        """#{real zeros with h > 0} - #{real zeros with h < 0}; the number of distinct real zeros for h = 1."""
        if not self.size:
            return 0
        return signature(self.trace_form if poly is None else self.form(poly))

    @cached_property
    def distinct(self) -> int:
        """The number of distinct complex zeros."""
        return int(self.trace_form.rank()) if self.size else 0

    def zeros(self) -> list[Zero]:
        """All real zeros, exactly; their number is checked against the signature of the trace form."""
        if not self.size:
            return []
        names = [self.basis.ring.names[i] for i in self.basis.variables]
        zeros = zeros_of(self.matrices, self.traces, self.distinct, names)
        if len(zeros) != self.signature():
            raise InternalError(f"{len(zeros)} real zeros isolated, the signature says {self.signature()}")
        return zeros


def signature(matrix: fmpq_mat) -> int:
    """The signature of a symmetric matrix, exactly.

    Its characteristic polynomial has real roots only, for which Descartes' rule counts exactly.
    """
    coefficients = matrix.charpoly().coeffs()
    return sign_changes(coefficients) - sign_changes([-c if k % 2 else c for k, c in enumerate(coefficients)])


def standard_monomials(leads: Iterable[Exponents], size: int, most: int, what: str) -> set[Exponents]:
    """The monomials in so many variables that none of the leading ones divides. Raises ``Unable`` beyond ``most``."""
    standard, listed = {(0,) * size}, list(leads)
    pending = list(standard)
    while pending:
        monomial = pending.pop()
        larger = {shifted(monomial, k, 1) for k in range(size)} - standard
        new = [m for m in larger if not any(all(map(le, lead, m)) for lead in listed)]
        standard.update(new)
        pending += new
        if len(standard) > most:
            raise Unable(f"{what} has more than {most} complex solutions")
    return standard


def shifted(monomial: Exponents, k: int, by: int) -> Exponents:
    """The monomial with another power of one variable."""
    return (*monomial[:k], monomial[k] + by, *monomial[k + 1 :])
