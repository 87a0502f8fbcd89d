"""Reading numbers of a field Q(theta): coefficient lists of rationals, lowest power first."""

from __future__ import annotations

from math import gcd

from qe.expert.arithmetic.residue import Residue, RootField, of_rationals
from qe.kernel.limits import check_field
from qe.options import Budget
from qe.proof.entry import Entry


def read_field(entry: Entry, budget: Budget | None = None) -> RootField:
    """``{"minimal_polynomial": [integers], "interval": [low, high]}``: a primitive polynomial with positive leading
    coefficient, and an interval that is proved to isolate theta."""
    polynomial, interval = entry.fields("minimal_polynomial", "interval")
    coefficients = [c.rational() for c in polynomial.items()]
    if any(c.denominator != 1 for c in coefficients):
        raise polynomial.fail("expected integers")
    if not coefficients or coefficients[-1] <= 0 or gcd(*(c.numerator for c in coefficients)) != 1:
        raise polynomial.fail("expected a primitive polynomial with positive leading coefficient")
    ends = [e.rational() for e in interval.items()]
    if len(ends) != 2:
        raise interval.fail("expected two ends")
    check_field([c.numerator for c in coefficients])
    return RootField([c.numerator for c in coefficients], ends[0], ends[1], entry.path, budget)


def read_number(entry: Entry, field: RootField) -> Residue:
    """One element: at most as many coefficients as the field's degree, no trailing zeros."""
    values = [c.rational() for c in entry.items()]
    if not 1 <= len(values) <= field.degree or (len(values) > 1 and not values[-1]):
        raise entry.fail(f"expected 1 to {field.degree} coefficients without trailing zeros")
    return of_rationals(values)
