"""Polynomials of rings with many variables, of which each contains few.

Lists with an entry for every variable of the ring, of which python-flint makes one for the degrees and one for each
term, and factoring in the large ring take longer than everything else then. Such a polynomial remembers a small set of
variables that contains its own; degrees and terms are read off derivatives and coefficients with respect to these, and
what is not simple arithmetic is done in a ring of these alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache, cached_property, reduce
from math import lcm

from flint import fmpq, fmpz, fmpz_mpoly, fmpz_poly

from qe.errors import InternalError
from qe.exact.poly import Factors, Poly, Ring, SparseTerm

WIDE = 24
"""In rings with more variables, polynomials keep track of the few that they contain."""
_FEW = 8
"""Variables that are looked for one by one."""


class WideRing(Ring, more_than=WIDE):
    """A ring of many variables."""

    is_wide = True
    __slots__ = ()

    def element(self, p: fmpz_mpoly, support: Iterable[int] | None = None) -> Poly:
        """The polynomial with this value in FLINT; ``support``, where known, has all variables that occur."""
        return WidePoly(self, p) if support is None else WidePoly.of(self, p, frozenset(support))

    def constant(self, value: int) -> Poly:
        return self.element(self.ctx.constant(value), ())

    def from_terms(self, terms: Mapping[tuple[int, ...], int]) -> Poly:
        """The polynomial with coefficient ``terms[e]`` at the exponent vector ``e`` (in ring order)."""
        if any(k < 0 for e in terms for k in e):
            raise InternalError("negative exponent")
        return self.from_sparse([(tuple((i, k) for i, k in enumerate(e) if k), int(c)) for e, c in terms.items()])

    def from_sparse(self, terms: Iterable[SparseTerm]) -> Poly:
        sums: dict[tuple[str, ...], int] = {}
        for powers, c in terms:
            names = tuple(self.names[i] for i, k in powers for _ in range(k))
            sums[names] = sums.get(names, 0) + c
        kept = {names: c for names, c in sums.items() if c}
        return self.combination(kept) if kept else self.constant(0)

    def combination(self, coefficients: Mapping[tuple[str, ...], int]) -> Poly:
        made = super().combination(coefficients)
        if isinstance(made, WidePoly):
            made.__dict__["variables"] = tuple(sorted(made.support))  # nothing cancels
        return made

    def hash_of(self, p: Poly) -> int:
        """The hash of a polynomial of the ring: equal for equal values."""
        return hash((p.variables, *map(int, p.p.coeffs())))


class WidePoly(Poly):
    """A ``Poly`` whose variables are among ``support``; equal to, and hashed like, any other with its value."""

    __slots__ = ()

    @staticmethod
    def of(ring: Ring, p: fmpz_mpoly, support: frozenset[int]) -> WidePoly:
        """The polynomial, which has no variables but those of ``support``."""
        made = WidePoly(ring, p)
        made.__dict__["support"] = support
        return made

    @cached_property
    def support(self) -> frozenset[int]:
        """The variables that it may contain."""
        return frozenset(i for i, d in enumerate(reversed(self.p.degrees())) if d)

    def _like(self, p: fmpz_mpoly) -> WidePoly:
        return WidePoly.of(self.ring, p, self.support)

    def _scaled(self, p: fmpz_mpoly) -> WidePoly:
        made = self._like(p)
        made.__dict__["variables"] = self.variables
        return made

    def _with(self, p: fmpz_mpoly, other: Poly | int) -> WidePoly:
        if isinstance(other, int):
            return self._like(p)
        more = other.support if isinstance(other, WidePoly) else frozenset(other.variables)
        return WidePoly.of(self.ring, p, self.support | more)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return self.ring.from_sparse, (tuple(self.sparse_terms()),)

    # --- arithmetic -------------------------------------------------------------------------
    def __add__(self, other: Poly | int) -> Poly:
        return self._with(self.p + self._lift(other), other)

    __radd__ = __add__

    def __sub__(self, other: Poly | int) -> Poly:
        return self._with(self.p - self._lift(other), other)

    def __rsub__(self, other: int) -> Poly:
        return self._like(other - self.p)

    def __mul__(self, other: Poly | int) -> Poly:
        return self._with(self.p * self._lift(other), other)

    __rmul__ = __mul__

    # --- structure --------------------------------------------------------------------------
    @cached_property
    def variables(self) -> tuple[int, ...]:
        """The indices that occur, ascending."""
        count, most = len(self.support), len(self.p)
        linear = count > _FEW and most >= count and self.p.total_degree() == 1
        if linear and (most > count or any(self.p.monomial(most - 1))):
            return tuple(sorted(self.support))
        return tuple(i for i in sorted(self.support) if self.p.derivative(self.ring.slot(i)))

    @property
    def is_constant(self) -> bool:
        return not self.variables

    @cached_property
    def degrees(self) -> tuple[int, ...]:
        own = self._own_degrees
        return tuple(own.get(i, 0) for i in range(self.ring.size))

    @cached_property
    def _own_degrees(self) -> dict[int, int]:
        if self.p.total_degree() == 1:
            return dict.fromkeys(self.variables, 1)
        return {i: len(self.coefficients(i)) - 1 for i in self.variables}

    def degree(self, i: int) -> int:
        return self._own_degrees.get(i, 0)

    def sparse_terms(self) -> list[SparseTerm]:
        """The terms in no particular order: ((variable, exponent > 0), ...), ascending, with the coefficient."""
        return list(self._terms)

    @cached_property
    def _terms(self) -> tuple[SparseTerm, ...]:
        if self.is_constant:
            return (((), self.constant_value()),) if self.p else ()
        if self.total_degree == 1:
            return self._linear_terms()
        i = self.variables[-1]
        terms: list[SparseTerm] = []
        for k, c in enumerate(self.coefficients(i)):
            below = c._terms if isinstance(c, WidePoly) else c.sparse_terms()
            terms += [((*powers, (i, k)) if k else powers, a) for powers, a in below]
        return tuple(terms)

    def _linear_terms(self) -> tuple[SparseTerm, ...]:
        coefficients = [int(c) for c in self.p.coeffs()]  # that of the last variable first, the constant last
        count = len(self.variables)
        terms = tuple((((i, 1),), c) for i, c in zip(self.variables, coefficients[count - 1 :: -1]))
        return (*terms, ((), coefficients[-1])) if len(coefficients) > count else terms

    def terms(self) -> list[tuple[tuple[int, ...], int]]:
        """(exponent vector in ring order, coefficient), highest first in the lexicographic order."""
        terms = []
        for powers, c in self.sparse_terms():
            own = [0] * self.ring.size
            for i, k in powers:
                own[i] = k
            terms.append((tuple(own), c))
        return sorted(terms, key=lambda term: term[0][::-1], reverse=True)

    # --- in a ring of the variables that occur --------------------------------------------------
    def _compact(self, *others: Poly) -> tuple[tuple[int, ...], list[Poly]]:
        """The variables of all, and the polynomials in a ring of just so many variables, in the same order."""
        polys = (self, *others)
        own = tuple(sorted({i for f in polys for i in f.variables}))
        place = {i: j for j, i in enumerate(own)}
        ring = _plain(len(own))
        return own, [
            ring.from_sparse([(tuple((place[i], k) for i, k in powers), c) for powers, c in f.sparse_terms()])
            for f in polys
        ]

    def _expanded(self, own: tuple[int, ...], small: Poly) -> Poly:
        terms = [(tuple((own[j], k) for j, k in powers), c) for powers, c in small.sparse_terms()]
        return self.ring.from_sparse(terms)

    @cached_property
    def _alone(self) -> tuple[tuple[int, ...], Poly]:
        """As ``_compact`` without others: points are substituted again and again."""
        own, (f,) = self._compact()
        return own, f

    def gcd(self, other: Poly) -> Poly:
        own, (f, g) = self._compact(other)
        return self._expanded(own, f.gcd(g))

    def resultant(self, other: Poly, i: int) -> Poly:
        own, (f, g) = self._compact(other)
        return self._expanded(own, f.resultant(g, own.index(i))) if i in own else self.ring.constant(1)

    def discriminant(self, i: int) -> Poly:
        own, f = self._alone
        return self._expanded(own, f.discriminant(own.index(i)))

    def _factored(self) -> Factors:
        own, f = self._alone
        unit, parts = f.factors()
        return unit, tuple((self._expanded(own, q), e) for q, e in parts)

    # --- substitution -----------------------------------------------------------------------
    def at_rational(self, i: int, value: Fraction | int) -> Poly:
        return self.at_rationals({i: value}) if i in self.variables else self

    def at_rationals(self, values: Mapping[int, Fraction | int]) -> Poly:
        if self.total_degree == 1:  # one at a time would copy all terms as often
            whole, put = lcm(*(v.denominator for v in values.values())), {((i, 1),): v for i, v in values.items()}
            return self.ring.from_sparse(
                ((), c * int(put[p] * whole)) if p in put else (p, c * whole) for p, c in self.sparse_terms()
            )
        own, f = self._alone
        return self._expanded(own, f.at_rationals({own.index(i): value for i, value in values.items() if i in own}))

    def _at(self, values: Iterable[Fraction | int]) -> fmpq | fmpz | int:
        point = tuple(values)
        own, f = self._alone
        return f._at([point[i] for i in own])

    def compose(self, substitution: Mapping[int, Poly]) -> Poly:
        total: Poly = self.ring.constant(0)
        for powers, c in self.sparse_terms():
            images = (substitution[i] if i in substitution else self.ring.gen(i) for i, _ in powers)
            total += reduce(lambda a, b: a * b, (f**k for f, (_, k) in zip(images, powers, strict=True)), total * 0 + c)
        return total

    def to_univariate(self, i: int) -> fmpz_poly:
        if self.variables not in ((i,), ()):
            raise InternalError("a polynomial in one variable expected")
        return fmpz_poly([c.constant_value() for c in self.coefficients(i)])


@cache
def _plain(count: int) -> Ring:
    """The ring of so many variables that keeps track of none, however many they are: a polynomial may contain all."""
    return Ring(tuple(f"x{j}" for j in range(count)))
