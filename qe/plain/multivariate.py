"""Polynomials in several variables under the names of python-flint: over the integers, and values at fractions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache, reduce
from operator import or_
from typing import Any

from qe.plain import factors
from qe.plain.numbers import DomainError, fmpq
from qe.plain.resultants import resultant
from qe.plain.terms import MASK, WIDTH, Terms, added, at_integer, common_divisor, content, divided, division, guard
from qe.plain.terms import times

MOST_KNOWN = 100_000
"""Values of monomials that are remembered."""


class fmpz_mpoly_ctx:
    """Names of variables in their lexicographic order."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.variables = names
        self.places = [WIDTH * k for k in reversed(range(len(names)))]
        self.guard = guard(len(names))
        self.known: dict[Sequence[int], Terms] = {}

    @staticmethod
    @cache
    def get(names: tuple[str, ...], order: str) -> fmpz_mpoly_ctx:
        """The context; equal names give the same one."""
        return fmpz_mpoly_ctx(names)

    def names(self) -> tuple[str, ...]:
        """The names of the variables."""
        return self.variables

    def gens(self) -> tuple[fmpz_mpoly, ...]:
        """The variables as polynomials."""
        return tuple(fmpz_mpoly(self, {1 << place: 1}) for place in self.places)

    def constant(self, value: int) -> fmpz_mpoly:
        """The polynomial that is a number."""
        return fmpz_mpoly(self, {0: int(value)} if value else {})

    def from_dict(self, terms: Mapping[tuple[int, ...], int]) -> fmpz_mpoly:
        """The polynomial with these coefficients, by exponents."""
        return fmpz_mpoly(self, {self.packed(e): int(c) for e, c in terms.items() if c})

    def packed(self, exponents: Sequence[int]) -> int:
        """The monomial as an integer."""
        if any(e >> (WIDTH - 1) for e in exponents):
            raise OverflowError("an exponent is too large")
        return sum(e << place for e, place in zip(exponents, self.places, strict=True))

    def unpacked(self, monomial: int) -> tuple[int, ...]:
        """The exponents of a monomial."""
        return tuple([monomial >> place & MASK for place in self.places])


class fmpz_mpoly:
    """A polynomial with integer coefficients; immutable."""

    __slots__ = ("ctx", "t")

    def __init__(self, ctx: fmpz_mpoly_ctx, terms: Terms) -> None:
        self.ctx, self.t = ctx, terms

    def _new(self, terms: Terms) -> fmpz_mpoly:
        return fmpz_mpoly(self.ctx, terms)

    def _terms(self, other: fmpz_mpoly | int) -> Terms:
        return other.t if isinstance(other, fmpz_mpoly) else {0: int(other)} if other else {}

    # --- arithmetic ------------------------------------------------------------------------
    def __eq__(self, other: object) -> bool:
        return isinstance(other, fmpz_mpoly | int) and self.t == self._terms(other)

    def __bool__(self) -> bool:
        return bool(self.t)

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"fmpz_mpoly({dict(self.terms())})"

    def __neg__(self) -> fmpz_mpoly:
        return self._new({k: -c for k, c in self.t.items()})

    def __add__(self, other: fmpz_mpoly | int) -> fmpz_mpoly:
        return self._new(added(self.t, self._terms(other)))

    __radd__ = __add__

    def __sub__(self, other: fmpz_mpoly | int) -> fmpz_mpoly:
        return self._new(added(self.t, self._terms(other), -1))

    def __rsub__(self, other: int) -> fmpz_mpoly:
        return -self + other

    def __mul__(self, other: fmpz_mpoly | int) -> fmpz_mpoly:
        if isinstance(other, int):
            return self._new({k: c * other for k, c in self.t.items()} if other else {})
        product = times(self.t, other.t)
        if reduce(or_, product, 0) & self.ctx.guard:
            raise OverflowError("an exponent is too large")
        return self._new(product)

    __rmul__ = __mul__

    def __pow__(self, exponent: int) -> fmpz_mpoly:
        if exponent < 0:
            raise DomainError("a negative power")
        if len(self.t) == 1:
            ((k, c),) = self.t.items()
            return self._new({self.ctx.packed([e * exponent for e in self.ctx.unpacked(k)]): c**exponent})
        result, square = self.ctx.constant(1), self
        while exponent:
            if exponent & 1:
                result = result * square
            exponent >>= 1
            square = square * square if exponent else square
        return result

    def __truediv__(self, other: fmpz_mpoly | int) -> fmpz_mpoly:
        divisor = self._terms(other)
        if not divisor:
            raise ZeroDivisionError("fmpz_mpoly division by zero")
        quotient, remainder = division(self.t, divisor, self.ctx.guard)
        if remainder:
            raise DomainError("fmpz_mpoly division is not exact")
        return self._new(quotient)

    def __divmod__(self, other: fmpz_mpoly) -> tuple[fmpz_mpoly, fmpz_mpoly]:
        """Quotient and remainder, which is only right where it is zero."""
        if not other.t:
            raise ZeroDivisionError("fmpz_mpoly division by zero")
        quotient, remainder = division(self.t, other.t, self.ctx.guard, exact=False)
        return self._new(quotient), self._new(remainder)

    # --- structure -------------------------------------------------------------------------
    def context(self) -> fmpz_mpoly_ctx:
        """The names of its variables."""
        return self.ctx

    def degrees(self) -> tuple[int, ...]:
        """The degree in every variable, -1 for zero."""
        return tuple([max((k >> place & MASK for k in self.t), default=-1) for place in self.ctx.places])

    def total_degree(self) -> int:
        """The largest sum of exponents, -1 for zero."""
        return max((sum(self.ctx.unpacked(k)) for k in self.t), default=-1)

    def leading_coefficient(self) -> int:
        """The coefficient of the first term."""
        return self.t[max(self.t)] if self.t else 0

    def coeffs(self) -> list[int]:
        """The coefficients in the order of the terms."""
        return [self.t[k] for k in sorted(self.t, reverse=True)]

    def terms(self) -> Iterator[tuple[tuple[int, ...], int]]:
        """Exponents and coefficients, highest first in the lexicographic order."""
        return ((self.ctx.unpacked(k), self.t[k]) for k in sorted(self.t, reverse=True))

    def primitive(self) -> tuple[int, fmpz_mpoly]:
        """The greatest common divisor of the coefficients, and the polynomial over it."""
        number = content(self.t)
        return number, self._new(divided(self.t, number)) if self.t else self

    def content(self) -> int:
        """The greatest common divisor of the coefficients."""
        return content(self.t)

    def derivative(self, i: int) -> fmpz_mpoly:
        """The derivative in variable i."""
        place = self.ctx.places[i]
        return self._new({k - (1 << place): c * (k >> place & MASK) for k, c in self.t.items() if k >> place & MASK})

    # --- values ----------------------------------------------------------------------------
    def __call__(self, *values: int) -> int:
        known = self.ctx.known.setdefault(values, {})
        if len(known) > MOST_KNOWN:
            known.clear()
        total = 0
        for k, c in self.t.items():
            value = known.get(k)
            if value is None:
                value = 1
                for place, x in zip(self.ctx.places, values, strict=True):
                    if e := k >> place & MASK:
                        value *= x**e
                known[k] = value
            total += c * value
        return total

    def subs(self, values: Mapping[int, int]) -> fmpz_mpoly:
        """The polynomial with integers for variables."""
        terms = self.t
        for i, value in values.items():
            place = self.ctx.places[i]
            terms = at_integer(terms, place, value) if value else {k: c for k, c in terms.items() if not k >> place & MASK}
        return self._new(terms)

    def compose(self, *images: fmpz_mpoly, ctx: fmpz_mpoly_ctx) -> fmpz_mpoly:
        """The polynomial with polynomials for all variables."""
        powers: list[dict[int, fmpz_mpoly]] = [{} for _ in images]
        total = ctx.constant(0)
        for exponents, c in self.terms():
            product = ctx.constant(c)
            for e, image, known in zip(exponents, images, powers, strict=True):
                if e:
                    known[e] = known.get(e) or image**e
                    product = product * known[e]
            total = total + product
        return total

    # --- algebra ---------------------------------------------------------------------------
    def gcd(self, other: fmpz_mpoly) -> fmpz_mpoly:
        """The greatest common divisor, with a positive leading coefficient."""
        return self._new(common_divisor(self.t, other.t, self.ctx.places))

    def resultant(self, other: fmpz_mpoly, i: int) -> fmpz_mpoly:
        """The resultant with respect to variable i."""
        return self._new(resultant(self.t, other.t, self.ctx.places[i], self.ctx.guard))

    def discriminant(self, i: int) -> fmpz_mpoly:
        """The discriminant with respect to variable i, of degree at least 1 in it."""
        degree = self.degrees()[i]
        if degree == 1:
            return self.ctx.constant(1)
        place = self.ctx.places[i]
        lead = {k - (degree << place): c for k, c in self.t.items() if k >> place & MASK == degree}
        found = self.resultant(self.derivative(i), i) / self._new(lead)
        return -found if degree * (degree - 1) // 2 % 2 else found

    def factor(self) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
        """The unit, and irreducible factors with their multiplicities."""
        unit, parts = factors.of_terms(self.t, self.ctx.places)
        return unit, [(self._new(f), e) for f, e in parts]


class fmpq_mpoly_ctx(fmpz_mpoly_ctx):
    """The same for polynomials with fractions for coefficients."""

    @staticmethod
    @cache
    def get(names: tuple[str, ...], order: str) -> fmpq_mpoly_ctx:
        """The context; equal names give the same one."""
        return fmpq_mpoly_ctx(names)


class fmpq_mpoly:
    """A polynomial with integer coefficients over a common denominator, to be evaluated."""

    __slots__ = ("bottom", "top")

    def __init__(self, top: fmpz_mpoly, ctx: Any = None, bottom: int = 1) -> None:
        self.top, self.bottom = top, bottom

    def subs(self, values: Mapping[int, fmpq]) -> fmpq_mpoly:
        """The polynomial with fractions for variables."""
        top, bottom = self.top, self.bottom
        for i, x in values.items():
            place, degree = top.ctx.places[i], max(top.degrees()[i], 0)
            total: Terms = {}
            powers = [x.p**e * x.q ** (degree - e) for e in range(degree + 1)]
            for k, c in top.t.items():
                e = k >> place & MASK
                k -= e << place
                total[k] = total.get(k, 0) + c * powers[e]
            top, bottom = top._new({k: c for k, c in total.items() if c}), bottom * x.q**degree
        return fmpq_mpoly(top, bottom=bottom)

    def __call__(self, *values: fmpq) -> fmpq:
        value = self.subs(dict(enumerate(values)))
        return fmpq(value.top.leading_coefficient(), value.bottom)

    def terms(self) -> Iterator[tuple[tuple[int, ...], fmpq]]:
        """Exponents and coefficients, highest first in the lexicographic order."""
        return ((e, fmpq(c, self.bottom)) for e, c in self.top.terms())
