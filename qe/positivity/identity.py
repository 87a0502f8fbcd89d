"""Identities that prove a sign: sums of products that are nowhere negative."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from qe.exact.ring import Poly

Powers = tuple[tuple[Poly, int], ...]
Term = tuple[int, Powers]
"""A coefficient, and polynomials with exponents."""


@dataclass(frozen=True, slots=True)
class Identity:
    """Terms that add up to 0, multiplied out."""

    terms: tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class Positive:
    """That a polynomial is nowhere negative where the assumed variables are not; ``strict``: nor zero."""

    identities: tuple[Identity, ...]
    strict: bool

    def at(self, change: Callable[[Poly], Poly]) -> tuple[Identity, ...]:
        """The identities with other polynomials for variables."""
        return tuple(
            Identity(tuple((c, tuple((change(base), e) for base, e in powers)) for c, powers in each.terms))
            for each in self.identities
        )


def sum_of(poly: Poly, parts: Iterable[tuple[Fraction, Powers]]) -> Identity:
    """poly = sum of c * product, for rational c."""
    listed = [(Fraction(c), powers) for c, powers in parts if c]
    scale = lcm(*(c.denominator for c, _ in listed)) if listed else 1
    return Identity(((-scale, ((poly, 1),)), *((int(c * scale), powers) for c, powers in listed)))


def monomials(poly: Poly) -> Positive | None:
    """That a polynomial without negative coefficients is nowhere negative where its variables are not."""
    if any(c < 0 for _, c in poly.terms()):
        return None
    parts = [(Fraction(c), tuple((poly.ring.gen(i), e) for i, e in powers)) for powers, c in poly.sparse_terms()]
    return Positive((sum_of(poly, parts),), strict=any(not powers for _, powers in parts))
