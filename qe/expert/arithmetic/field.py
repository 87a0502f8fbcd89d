"""Numbers of Q(theta), where theta is the only root of an integer polynomial in an interval: polynomials in theta.

Nothing is assumed about the polynomial but that: a number that is 0 modulo it is 0, signs are those at the point theta,
decided by the kernel, and a number that is 0 there in another way is refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd
from typing import Any, TypeAlias

from flint import fmpq, fmpq_poly, fmpz_poly

from qe.exact.ring import Poly, Ring
from qe.exact.univariate import from_univariate
from qe.kernel.arithmetic.fibre import RationalFibre
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.arithmetic.sturm import exact
from qe.kernel.arithmetic.triangular import Point
from qe.kernel.limits import check_field
from qe.kernel.line import Sample
from qe.options import Budget
from qe.proof.entry import Entry

Number: TypeAlias = fmpq_poly
ONE = fmpq_poly([1])
LINE = Ring.of(("theta",))


class RootField:
    """The field of ``{"minimal_polynomial": [integers], "interval": [low, high]}``: a primitive polynomial with a
    positive leading coefficient, and an interval with one root of it, or the root itself twice."""

    def __init__(self, entry: Entry, budget: Budget | None = None) -> None:
        self._entry = entry
        polynomial, interval = entry.fields("minimal_polynomial", "interval")
        listed = [c.rational() for c in polynomial.items()]
        self.coefficients, self.budget = [c.numerator for c in listed], budget or Budget()
        if any(c.denominator != 1 for c in listed) or len(listed) < 2:
            raise polynomial.fail("expected integers, and a positive degree")
        if listed[-1] <= 0 or gcd(*self.coefficients) != 1:
            raise polynomial.fail("expected a primitive polynomial with positive leading coefficient")
        self.low, self.high = (end.rational() for end in interval.row("low", "high"))
        check_field(self.coefficients)
        p = fmpz_poly(self.coefficients)
        theta: Any = self.low
        if self.low != self.high:
            line = RationalFibre(LINE, 0, p, lambda: self.budget.check("verify"))
            theta = line.only_root(self.low, self.high) if self.low < self.high else None
        elif p(exact(self.low)):
            raise interval.fail("the point is not a root of the polynomial")
        if theta is None:
            raise interval.fail("the interval does not isolate one root")
        self.degree, self._minimal = len(listed) - 1, fmpq_poly(p)
        start = Sample(FactorLists(LINE, ()), Point(budget=self.budget), {}, [], (0,))
        self._place = start.extended(theta, [], alone=True)
        self.theta = self.reduced(fmpq_poly([0, 1]))

    def number(self, entry: Entry) -> Number:
        """One element: at most as many coefficients as the field's degree, lowest power first, no trailing zeros."""
        values = [c.rational() for c in entry.items()]
        if not 1 <= len(values) <= self.degree or (len(values) > 1 and not values[-1]):
            raise entry.fail(f"expected 1 to {self.degree} coefficients without trailing zeros")
        return fmpq_poly([exact(value) for value in values])

    def reduced(self, value: Number | fmpq | int) -> Number:
        """A number of the field, modulo the polynomial."""
        self.budget.check("verify")
        return (fmpq_poly() + value) % self._minimal

    def sign(self, value: Number) -> int:
        """The sign of the value at theta; 0 only for the zero polynomial, so that a weight that is one is not positive.

        ``CertificateRejected`` for another one that is 0 (the polynomial of theta is reducible then).
        """
        found = self._place.sign(from_univariate(LINE, 0, value.numer()))
        if value and not found:
            raise self._entry.fail("a number is 0 but not the zero polynomial: the minimal polynomial is reducible")
        return found

    def value(self, p: Poly, point: Sequence[Number]) -> Number:
        """A polynomial at a point."""
        total = fmpq_poly()
        for exponents, c in p.terms():
            term = fmpq_poly([c])
            for v, k in zip(point, exponents, strict=True):
                for _ in range(k):
                    term = self.reduced(term * v)
            total += term
        return self.reduced(total)


def constant(value: Fraction) -> Number:
    """A rational number as one of any field."""
    return fmpq_poly([exact(value)])
