"""Identities that prove a sign: sums of products that are nowhere negative."""

from __future__ import annotations

from collections.abc import Iterable
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


def sum_of(poly: Poly, parts: Iterable[tuple[Fraction, Powers]]) -> Identity:
    """poly = sum of c * product, for rational c."""
    listed = [(Fraction(c), powers) for c, powers in parts if c]
    scale = lcm(*(c.denominator for c, _ in listed)) if listed else 1
    return Identity(((-scale, ((poly, 1),)), *((int(c * scale), powers) for c, powers in listed)))
