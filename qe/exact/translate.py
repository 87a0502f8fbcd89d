"""Rational points put into polynomials: as the new origin, or for some of the variables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from flint import fmpq, fmpq_mpoly

from qe.exact.ring import Poly
from qe.exact.tower import clear_denominators


def translated(p: Poly, origin: Sequence[Fraction]) -> Poly:
    """The primitive positive multiple of p(x + origin), one number for each variable of the ring."""
    ring = p.ring
    images = [
        gen + fmpq(value.numerator, value.denominator)
        for gen, value in zip(ring.qctx.gens(), reversed(origin), strict=True)
    ]
    moved = clear_denominators(ring, fmpq_mpoly(p.p, ring.qctx).compose(*images, ctx=ring.qctx))
    unit, primitive = moved.normal()
    return -primitive if unit < 0 else primitive


def put_in(p: Poly, values: Mapping[int, Fraction]) -> Poly:
    """A positive multiple of p with these variables set to rational numbers, all at once."""
    ring = p.ring
    used = {ring.slot(i): fmpq(v.numerator, v.denominator) for i, v in values.items() if p.degree(i)}
    return clear_denominators(ring, fmpq_mpoly(p.p, ring.qctx).subs(used)) if used else p
