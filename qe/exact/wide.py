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
from math import gcd, lcm
from operator import mul

from flint import fmpq, fmpz, fmpz_mpoly

from qe.exact.poly import Factors, Poly, Ring, SparseTerm

WIDE = 24
"""In rings with more variables, polynomials keep track of the few that they contain."""


class WideRing(Ring, more_than=WIDE):
    """A ring of many variables."""

    is_wide = True

    def element(self, p: fmpz_mpoly, support: Iterable[int] | None = None) -> Poly:
        """The polynomial with this value in FLINT; ``support``, where known, has all variables that occur."""
        return WidePoly(self, p) if support is None else WidePoly.of(self, p, frozenset(support))

    def gen(self, i: int) -> Poly:
        return LinearPoly(self, (i,), (1,))

    def from_sparse(self, terms: Iterable[SparseTerm]) -> Poly:
        sums: dict[tuple[str, ...], int] = {}
        for powers, c in terms:
            key = tuple([self.names[i] for i, k in powers for _ in range(k)])
            sums[key] = sums.get(key, 0) + c
        return self.combination({key: c for key, c in sums.items() if c})

    def linear(self, terms: Mapping[int, int], rest: int) -> Poly:
        """The sum of multiples, not by zero, of variables, and a number."""
        variables = tuple(sorted(terms))
        numbers = tuple(map(terms.__getitem__, variables))
        return LinearPoly(self, variables, numbers, rest) if terms else self.constant(rest)

    def combination(self, coefficients: Mapping[tuple[str, ...], int]) -> Poly:
        if max(map(len, coefficients), default=0) < 2:
            terms = {self.index[names[0]]: c for names, c in coefficients.items() if names}
            return self.linear(terms, coefficients.get((), 0))
        return super().combination(coefficients)

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
        if self.total_degree == 1:
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
            slots = [(i, self.ring.slot(i)) for i in self.variables]
            return tuple((tuple((i, 1) for i, slot in slots if e[slot]), int(c)) for e, c in self.p.terms())
        i = self.variables[-1]
        terms: list[SparseTerm] = []
        for k, c in enumerate(self.coefficients(i)):
            below = c._terms if isinstance(c, WidePoly) else c.sparse_terms()
            terms += [((*powers, (i, k)) if k else powers, a) for powers, a in below]
        return tuple(terms)

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


class LinearPoly(WidePoly):
    """sum ``numbers[k]`` * (variable ``variables[k]``) + ``rest``: at least one variable, ascending, no number zero.

    Its value in FLINT, whose terms have a place for every variable of the ring, is made when it is asked for: long
    scripts have a hundred thousand such forms, and a system of 640 in as many variables would take 2 GB.
    """

    __slots__ = ()
    ring: WideRing
    numbers: tuple[int, ...]
    rest: int

    def __init__(self, ring: WideRing, variables: tuple[int, ...], numbers: tuple[int, ...], rest: int = 0) -> None:
        self.ring, self._hash = ring, None
        known = {"variables": variables, "support": frozenset(variables), "total_degree": 1}
        self.__dict__.update(known, numbers=numbers, rest=rest)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return LinearPoly, (self.ring, self.variables, self.numbers, self.rest)

    @cached_property
    def p(self) -> fmpz_mpoly:
        terms = {tuple([self.ring.names[i] for i, _ in powers]): c for powers, c in self._terms}
        return Ring.combination(self.ring, terms).p

    @property
    def _terms(self) -> tuple[SparseTerm, ...]:
        terms: list[SparseTerm] = [(((i, 1),), c) for i, c in zip(self.variables, self.numbers)]
        return (*terms, ((), self.rest)) if self.rest else tuple(terms)

    @cached_property
    def _normal(self) -> tuple[int, Poly]:
        unit = gcd(*self.numbers, self.rest) * (1 if self.numbers[-1] > 0 else -1)
        if unit == 1:
            return 1, self
        return unit, LinearPoly(self.ring, self.variables, tuple([c // unit for c in self.numbers]), self.rest // unit)

    def __neg__(self) -> Poly:
        return self * -1

    def __mul__(self, other: Poly | int) -> Poly:
        other = _number(other)
        if not isinstance(other, int) or not other:
            return super().__mul__(other)
        return LinearPoly(self.ring, self.variables, tuple([c * other for c in self.numbers]), self.rest * other)

    def __add__(self, other: Poly | int) -> Poly:
        other = _number(other)
        if isinstance(other, int):
            return LinearPoly(self.ring, self.variables, self.numbers, self.rest + other)
        if not isinstance(other, LinearPoly) or other.ring is not self.ring:
            return super().__add__(other)
        terms = dict(zip(self.variables, self.numbers))
        for i, c in zip(other.variables, other.numbers):
            terms[i] = terms.get(i, 0) + c
        return self.ring.linear({i: c for i, c in terms.items() if c}, self.rest + other.rest)

    def __sub__(self, other: Poly | int) -> Poly:
        return self + (-other) if isinstance(other, int | LinearPoly) else super().__sub__(other)

    def __pow__(self, exponent: int) -> Poly:
        return self if exponent == 1 else super().__pow__(exponent)

    __radd__, __rmul__ = __add__, __mul__

    def coefficients(self, i: int) -> tuple[Poly, ...]:
        if i not in self.support:
            return (self,)
        terms = dict(zip(self.variables, self.numbers))
        number = terms.pop(i)
        return self.ring.linear(terms, self.rest), self.ring.constant(number)

    def _factored(self) -> Factors:
        return self._normal[0], ((self._normal[1], 1),)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, LinearPoly):
            return super().__eq__(other)
        parts = [(f.ring, f.rest, f.numbers, f.variables) for f in (self, other)]
        return parts[0] == parts[1]

    def at_rationals(self, values: Mapping[int, Fraction | int]) -> Poly:
        whole = lcm(*(v.denominator for v in values.values()))
        terms, rest = dict(zip(self.variables, self.numbers)), self.rest * whole
        for i in values.keys() & terms.keys():
            rest += terms.pop(i) * values[i].numerator * (whole // values[i].denominator)
        return self.ring.linear(terms if whole == 1 else {i: c * whole for i, c in terms.items()}, rest)

    def _at(self, values: Iterable[Fraction | int]) -> fmpq | fmpz | int:
        at = tuple(values).__getitem__
        own = [v if isinstance(v, int) else fmpq(v.numerator, v.denominator) for v in map(at, self.variables)]
        return sum(map(mul, self.numbers, own), self.rest)

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash((self.variables, *self.numbers[::-1], *([self.rest] if self.rest else ())))
        return self._hash

    def __bool__(self) -> bool:
        return True

    def term_count(self) -> int:
        return len(self.numbers) + bool(self.rest)


def _number(given: Poly | int) -> Poly | int:
    """What is given, as an integer where it is a constant."""
    return given.constant_value() if isinstance(given, WidePoly) and given.is_constant else given


@cache
def _plain(count: int) -> Ring:
    return Ring(tuple(f"x{j}" for j in range(count)))  # which keeps track of none: a polynomial may contain all
