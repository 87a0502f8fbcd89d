"""Whether two roots over one sample point are the same number, from counts and balls alone.

Two polynomials that are known to have a root in common have it where their roots meet: once the balls around all
distinct complex roots of each are disjoint, and only one ball of the one meets a ball of the other, the roots in these
two are equal. Whether there is a common root is known from the projection (``qe.exact.from_projection``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from flint import acb, arb, arb_poly, fmpz_poly

from qe.exact.ball_roots import distinct_roots
from qe.exact.balls import EXACT_FROM, precision
from qe.exact.from_projection import COUNTED_TO, have_common_root
from qe.exact.ring import Poly
from qe.exact.sample import Fibre, Point

Shape: TypeAlias = fmpz_poly | Fibre | None


@dataclass(frozen=True, slots=True)
class Side:
    """A real root of polynomials over a point, as ``ball(bits)`` around it. ``shape``: one of them over the point."""

    ball: Callable[[int], arb]
    poly: Poly
    shape: Shape


def seen_to_be_equal(point: Point, a: Side, b: Side) -> bool | None:
    """Whether the two roots are the same number; None if counts and balls do not tell."""
    if a.shape is None or b.shape is None:
        return None  # nullified: the root is one of the Lazard evaluation
    common = have_common_root(point.sign, a.poly, b.poly, point.depth)
    if not common:
        return common
    if not any(_keeps_degree(point, side) for side in (a, b)):
        return None
    bits = EXACT_FROM
    while bits <= COUNTED_TO:
        left, right = _distinct(a.shape, bits), _distinct(b.shape, bits)
        if left is not None and right is not None:
            own, other = _around(left, a.ball(bits)), _around(right, b.ball(bits))
            if own is not None and other is not None:
                if not own.overlaps(other):
                    return False
                if sum(x.overlaps(y) for x in left for y in right) == 1:
                    return True
        bits *= 2
    return None


def _keeps_degree(point: Point, side: Side) -> bool:
    """Whether the polynomial is seen to have its degree over the point."""
    degree = side.poly.degree(point.depth)
    if isinstance(side.shape, Fibre):
        source = side.shape.source
        with precision(EXACT_FROM + 16):
            return len(source) == degree + 1 and not point.enclose(source[-1], EXACT_FROM).contains(0)
    return side.shape is not None and side.shape.degree() == degree


def _distinct(shape: Shape, bits: int) -> list[acb] | None:
    """Disjoint balls around the distinct complex roots."""
    if isinstance(shape, Fibre):
        return shape.distinct_roots(bits)
    assert shape is not None
    simple = shape / shape.gcd(shape.derivative())
    with precision(bits + 16):
        return distinct_roots(list(arb_poly(simple).coeffs()), bits)


def _around(roots: list[acb], x: arb) -> acb | None:
    """The only one of the balls that meets a ball around one of the roots."""
    met = [z for z in roots if z.overlaps(acb(x))]
    return met[0] if len(met) == 1 else None
