"""Moving the origin: polynomials and numbers in coordinates counted from another rational point."""

from __future__ import annotations

from collections.abc import Sequence
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
