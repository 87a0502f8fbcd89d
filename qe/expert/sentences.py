"""What evidence of the second ring says, as a sentence: what stands before and after the step that it proves.

A checker reads the evidence, and compares the sentence that is made of it here with the formulas of the step. So what a
certificate claims is what it shows, whatever else its evidence holds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import wraps
from math import lcm
from typing import TypeVar

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.field import Number, RootField
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Formula, Relation
from qe.kernel.renaming import is_same
from qe.kernel.step import Check, Claim, Context, Limits
from qe.proof.entry import Entry

Read = TypeVar("Read")
Sentence = tuple[Formula, Formula]
"""What stands before, and what after: equivalent for all values of the variables that are free in them."""


def stated(check: Callable[[Entry, Limits], Sentence]) -> Check:
    """The checker of a rule by one that accepts its evidence and says what that proves."""

    @wraps(check)  # its module states the theorem
    def compared(claim: Claim, context: Context, limits: Limits) -> None:
        said = check(claim.evidence, limits)
        for formula, right, side in zip((claim.before, claim.after), said, ("before", "after"), strict=True):
            if not is_same(formula, right):
                raise CertificateRejected(f"{claim.path}.{side}", f"{claim.rule}: the evidence is about  {right}")

    return compared


def renamed(wanted: Sequence[str], names: Sequence[str]) -> list[str]:
    """Names like those that are wanted, different from each other and from these."""
    found: list[str] = []
    for name in wanted:
        while name in names or name in found:
            name += "_"
        found.append(name)
    return found


def is_point(names: Sequence[str], values: Sequence[Number], field: RootField, ring: Ring) -> Formula:
    """That variables have these values in the field, whose generator is named by its polynomial and interval.

    The last variable of the ring stands for that.
    """
    root = ring.gen(ring.size - 1)
    numbers = []
    for name, value in zip(names, values, strict=True):
        number = _poly([int(c) for c in value.numer().coeffs()], root)
        numbers.append(atom(int(value.denom()) * ring.var(name) - number, Relation.EQ))
    if all(value.degree() <= 0 for value in values):
        return conj(numbers)
    parts = [atom(_poly(field.coefficients, root), Relation.EQ)]
    parts += [atom(field.low.denominator * root - field.low.numerator, Relation.GE)]
    parts += [atom(field.high.denominator * root - field.high.numerator, Relation.LE)]
    return exists((ring.names[-1],), conj((*parts, *numbers)))


def _poly(coefficients: Sequence[int], x: Poly) -> Poly:
    total = x.ring.constant(0)
    for c in reversed(coefficients):
        total = total * x + c
    return total


def read_list(entry: Entry, read: Callable[[Entry], Read], count: int) -> list[Read]:
    """That many numbers, each read in this way."""
    found = [read(e) for e in entry.items()]
    if len(found) != count:
        raise entry.fail(f"expected {count} numbers, found {len(found)}")
    return found


def read_terms(terms: Entry, names: Sequence[str], ring: Ring) -> tuple[Poly, int]:
    """(p, c) such that the terms, [rational coefficient, exponents of the names], of degree at most 2, add up to p/c
    with c > 0."""
    found: dict[tuple[int, ...], Fraction] = {}
    for term in terms.items():
        first, second = term.row("coefficient", "exponents")
        coefficient, exponents, powers = first.rational(), [e.integer() for e in second.items()], [0] * ring.size
        if len(exponents) != len(names) or sum(exponents) > 2:
            raise second.fail(f"expected {len(names)} exponents of sum at most 2")
        for name, exponent in zip(names, exponents, strict=True):
            powers[ring.index[name]] = exponent
        if not coefficient or tuple(powers) in found:
            raise term.fail("a zero coefficient or a repeated term")
        found[tuple(powers)] = coefficient
    scale = lcm(*(c.denominator for c in found.values()))
    return ring.from_terms({powers: int(c * scale) for powers, c in found.items()}), scale
