"""Polynomials in several variables under the names of python-flint: over the integers, and values at fractions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Any

from qe.plain.numbers import fmpq
from qe.plain.polynomial import Polynomial
from qe.plain.resultants import resultant
from qe.plain.terms import MASK, WIDTH, Terms, at_fraction, content, divided, division

MOST_KNOWN = 100_000
"""Values of monomials that are remembered."""


class fmpz_mpoly_ctx:
    """Names of variables in their lexicographic order."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.variables = names
        self.places = tuple(WIDTH * k for k in reversed(range(len(names))))
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


class fmpz_mpoly(Polynomial):
    """A polynomial with integer coefficients; immutable."""

    __slots__ = ("ctx",)
    ctx: fmpz_mpoly_ctx

    def __init__(self, ctx: fmpz_mpoly_ctx, terms: Terms) -> None:
        self.ctx, self.places, self.t = ctx, ctx.places, terms

    def like(self, terms: Terms) -> fmpz_mpoly:
        """The polynomial with these terms in the same variables."""
        return fmpz_mpoly(self.ctx, terms)

    def __len__(self) -> int:
        return len(self.t)

    def __pow__(self, exponent: int) -> fmpz_mpoly:
        if len(self.t) == 1 and exponent > 0:
            ((k, c),) = self.t.items()
            return self.like({self.ctx.packed([e * exponent for e in self.ctx.unpacked(k)]): c**exponent})
        return super().__pow__(exponent)

    def __divmod__(self, other: fmpz_mpoly) -> tuple[fmpz_mpoly, fmpz_mpoly]:
        """Quotient and remainder in the lexicographic order."""
        if not other.t:
            raise ZeroDivisionError("fmpz_mpoly division by zero")
        quotient, remainder = division(self.t, other.t, len(self.places))
        return self.like(quotient), self.like(remainder)

    # --- structure -------------------------------------------------------------------------
    def context(self) -> fmpz_mpoly_ctx:
        """The names of its variables."""
        return self.ctx

    def degrees(self) -> tuple[int, ...]:
        """The degree in every variable, -1 for zero."""
        return tuple([max((k >> place & MASK for k in self.t), default=-1) for place in self.places])

    def total_degree(self) -> int:
        """The largest sum of exponents, -1 for zero."""
        return max((sum(self.ctx.unpacked(k)) for k in self.t), default=-1)

    def is_constant(self) -> bool:
        """Whether no variable occurs."""
        return not any(self.t)

    def coeffs(self) -> list[int]:
        """The coefficients in the order of the terms."""
        return [self.t[k] for k in sorted(self.t, reverse=True)]

    def terms(self) -> Iterator[tuple[tuple[int, ...], int]]:
        """Exponents and coefficients, highest first in the lexicographic order."""
        return ((self.ctx.unpacked(k), self.t[k]) for k in sorted(self.t, reverse=True))

    def primitive(self) -> tuple[int, fmpz_mpoly]:
        """The greatest common divisor of the coefficients, and the polynomial over it."""
        number = content(self.t)
        return number, self.like(divided(self.t, number)) if self.t else self

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
                for place, x in zip(self.places, values, strict=True):
                    if e := k >> place & MASK:
                        value *= x**e
                known[k] = value
            total += c * value
        return total

    def subs(self, values: Mapping[int, int]) -> fmpz_mpoly:
        """The polynomial with integers for variables."""
        terms = self.t
        for i, value in values.items():
            terms = at_fraction(terms, self.places[i], value)
        return self.like(terms)

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

    def resultant(self, other: fmpz_mpoly, i: int) -> fmpz_mpoly:
        """The resultant with respect to variable i."""
        return self.like(resultant(self.t, other.t, self.places[i], len(self.places)))

    def discriminant(self, i: int) -> fmpz_mpoly:
        """The discriminant with respect to variable i, of degree at least 1 in it."""
        degree = self.degrees()[i]
        if degree == 1:
            return self.ctx.constant(1)
        place = self.places[i]
        lead = {k - (degree << place): c for k, c in self.t.items() if k >> place & MASK == degree}
        found = self.resultant(self.derivative(i), i) / self.like(lead)
        return -found if degree * (degree - 1) // 2 % 2 else found


fmpq_mpoly_ctx = fmpz_mpoly_ctx


class fmpq_mpoly:
    """A polynomial with integer coefficients over a common denominator, to be evaluated."""

    __slots__ = ("bottom", "top")

    def __init__(self, top: fmpz_mpoly, ctx: Any = None, bottom: int = 1) -> None:
        self.top, self.bottom = top, bottom

    def subs(self, values: Mapping[int, fmpq]) -> fmpq_mpoly:
        """The polynomial with fractions for variables."""
        top, bottom = self.top, self.bottom
        for i, x in values.items():
            place, degree = top.places[i], max(top.degrees()[i], 0)
            top, bottom = top.like(at_fraction(top.t, place, x.p, x.q, degree)), bottom * x.q**degree
        return fmpq_mpoly(top, bottom=bottom)

    def __call__(self, *values: fmpq) -> fmpq:
        value = self.subs(dict(enumerate(values)))
        return fmpq(value.top.leading_coefficient(), value.bottom)

    def terms(self) -> Iterator[tuple[tuple[int, ...], fmpq]]:
        """Exponents and coefficients, highest first in the lexicographic order."""
        return ((e, fmpq(c, self.bottom)) for e, c in self.top.terms())
