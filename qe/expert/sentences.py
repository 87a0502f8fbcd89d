"""What evidence of the second ring says, as a sentence: what stands before and after the step that it proves.

A checker reads the evidence, and compares the sentence that is made of it here with the formulas of the step. So what a
certificate claims is what it shows, whatever else its evidence holds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import wraps
from math import lcm

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.residue import Residue, RootField
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Formula, Relation
from qe.kernel.renaming import is_same
from qe.kernel.step import Check, Claim, Context, Limits
from qe.proof.entry import Entry

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


def is_point(names: Sequence[str], values: Sequence[Residue], field: RootField, ring: Ring) -> Formula:
    """That variables have these values in the field, whose generator is named by its polynomial and interval.

    The last variable of the ring stands for that.
    """
    if all(len(value.coefficients) <= 1 for value in values):
        return conj(_is(ring, name, value, ()) for name, value in zip(names, values, strict=True))
    root = ring.gen(ring.size - 1)
    low, high = (Fraction(end, field.unit) for end in (field.a, field.b))
    parts = [atom(_poly(field.p, root), Relation.EQ)]
    parts += [atom(low.denominator * root - low.numerator, Relation.GE)]
    parts += [atom(high.denominator * root - high.numerator, Relation.LE)]
    parts += [_is(ring, name, value, (root,)) for name, value in zip(names, values, strict=True)]
    return exists((ring.names[-1],), conj(parts))


def _is(ring: Ring, name: str, value: Residue, root: Sequence[Poly]) -> Formula:
    number = _poly(value.coefficients, *root) if root else ring.constant(sum(value.coefficients))
    return atom(value.denominator * ring.gen(ring.index[name]) - number, Relation.EQ)


def _poly(coefficients: Sequence[int], x: Poly) -> Poly:
    total = x.ring.constant(0)
    for c in reversed(coefficients):
        total = total * x + c
    return total


def read_terms(terms: Entry, names: Sequence[str], ring: Ring) -> tuple[Poly, int]:
    """(p, c) such that the terms, [rational coefficient, exponents of the names], add up to p/c with c > 0."""
    found: dict[tuple[int, ...], Fraction] = {}
    for term in terms.items():
        coefficient, exponents = term.row("coefficient", "exponents")
        powers = [0] * ring.size
        for name, exponent in zip(names, exponents.items(), strict=True):
            powers[ring.index[name]] = exponent.integer()
        found[tuple(powers)] = coefficient.rational()
    scale = lcm(*(c.denominator for c in found.values()))
    return ring.from_terms({powers: int(c * scale) for powers, c in found.items()}), scale
