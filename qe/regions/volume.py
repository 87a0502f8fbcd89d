"""Rigorous measures of regions: length, area, volume as rational enclosures.

A full-dimensional piece x_1 in (a, b), x_2 in (lower(x_1), upper(x_1)), … is the image of a unit cube; the integrand is
the product of the widths. Boxes with the largest contribution to the error are halved until the enclosure is
tight enough. The last variable is integrated exactly by its width, so the cube has one side fewer; where
``slices`` knows the area of a plane slice, two fewer.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from qe.decomposition.pieces import Piece, RootFunction
from qe.errors import BudgetExceeded, Unable
from qe.exact.balls import ends, precision
from qe.exact.enclosure import Jet, Sides, box_sides, constant, root_jet, smooth_side
from qe.exact.nearby import rational_between
from qe.exact.number import rational_ends
from qe.options import Budget
from qe.regions.described import Described as Region
from qe.regions.slices import has_closed_slices, slice_area
from qe.rules.lift import Solve
from qe.rules.normal_position import at_steps

MOST_BOXES = 60_000
FAR = 40
"""From coefficients of so many bits on, pieces are moved to the origin."""

FIRST_BITS, MOST_BITS = 80, 1 << 16
"""Working precision beyond what the size of the coefficients takes, and the most that is tried."""

_HALF = Fraction(1, 2)
Box = tuple[tuple[Fraction, Fraction], ...]


def enclose(region: Region, rel_error: Fraction, *, budget: Budget) -> tuple[Fraction, Fraction]:
    """lo <= measure <= hi, rational, with hi - lo <= rel_error * hi (0, 0 for a region without interior).

    Raises ``Unable`` for unbounded pieces and when the error is not reached within ``MOST_BOXES`` boxes,
    ``BudgetExceeded`` (with what is known of the measure by then) at a limit.
    """
    pieces = [p for p in region.cells if p.dimension == len(region.order)]
    for piece in pieces:
        for r in piece.ranges:
            if r.lower is None or r.upper is None:
                raise Unable(f"the region is unbounded in {r.variable}")
    return _Sum(region, pieces, budget).refine(rel_error)


class _Sum:
    """The boxes of all pieces, worst first."""

    def __init__(self, region: Region, pieces: Sequence[Piece], budget: Budget) -> None:
        self.budget = budget
        self.region, self.sides = region, len(region.order) - 1
        self.queue: list[tuple[Fraction, int, Piece, Box, Fraction, Fraction]] = []
        self.low = self.high = Fraction(0)
        self.count = 0
        moved = [_recentred(p) for p in pieces] if _height(pieces) > FAR else pieces
        # a discriminant cancels twice the digits of the coefficients, and its root is compared with another end
        self.bits = FIRST_BITS + 4 * _height(moved)
        for piece in moved:
            sides = self.sides - 1 if has_closed_slices(piece) else self.sides
            self._push(piece, ((Fraction(0), Fraction(1)),) * sides)

    def refine(self, rel_error: Fraction) -> tuple[Fraction, Fraction]:
        while self.queue and self.high - self.low > rel_error * self.high:
            if self.count > MOST_BOXES:
                raise Unable(self._known())
            try:
                self.budget.check("volume", self.count)
            except BudgetExceeded as error:
                raise BudgetExceeded(f"{error}: {self._known()}", limit=error.limit) from None
            _, _, piece, box, low, high = heapq.heappop(self.queue)
            self.low -= low
            self.high -= high
            if not box:  # a length: nothing but rounding makes it inexact
                self.bits *= 2
                if self.bits > MOST_BITS:
                    raise Unable(f"length known only between {float(self.low):.6g} and {float(self.high):.6g}")
            for half in _halves(box) if box else [box]:
                self._push(piece, half)
        return max(self.low, Fraction(0)), self.high

    def _known(self) -> str:
        return f"volume known only between {float(self.low):.6g} and {float(self.high):.6g}"

    def _push(self, piece: Piece, box: Box) -> None:
        self.count += 1
        low, high = self._contribution(piece, box)
        self.low += low
        self.high += high
        heapq.heappush(self.queue, (low - high, self.count, piece, box, low, high))

    def _contribution(self, piece: Piece, box: Box) -> tuple[Fraction, Fraction]:
        size = Fraction(1)
        for a, b in box:
            size *= b - a
        with precision(self.bits):
            whole = self._integrand(piece, box)
            if whole is None:
                return Fraction(0), size * self._crude(piece)
            low, high = ends(whole.mean())
        return max(low, Fraction(0)) * size, max(high, Fraction(0)) * size

    def _integrand(self, piece: Piece, box: Box) -> Jet | None:
        """The product of the widths over a box of the unit cube; None if a root could not be enclosed."""
        at: dict[int, Jet] = {}
        product: Jet | None = None
        sides = box_sides(box)
        for i, r in enumerate(piece.ranges):
            lower, upper = _end(r.lower, at, sides), _end(r.upper, at, sides)
            if lower is None or upper is None:
                return None
            if i == len(box) and i < self.sides:  # the slice over what is fixed so far has a closed form
                area = slice_area(piece, lower, upper, at, sides)
                return None if area is None or product is None else product * area
            width = upper - lower
            product = width if product is None else product * width
            if i < self.sides:
                place, weight = smooth_side(*box[i], i, sides)
                at[i] = lower + width * place
                product = product * weight
        return product

    def _crude(self, piece: Piece) -> Fraction:
        """A bound for the integrand on the whole cube: the region's extents, times the greatest weight 3/2 per side."""
        bound = Fraction(1)
        for i, r in enumerate(piece.ranges):
            extent = self.region.bounds(r.variable)
            if extent.lower is None or extent.upper is None:
                raise Unable(f"the region is unbounded in {r.variable}")
            lo, hi = rational_ends(extent.lower, 53)[0], rational_ends(extent.upper, 53)[1]
            bound *= (hi - lo) * (Fraction(3, 2) if i < self.sides else 1)
        return bound


def _height(pieces: Sequence[Piece]) -> int:
    polys = [end.poly for p in pieces for r in p.ranges for end in (r.lower, r.upper) if end is not None]
    return max((p.height_bits() for p in polys), default=0)


def _recentred(piece: Piece) -> Piece:
    """The piece moved so that its sample is near the origin: far from it, sizes are lost in the coordinates."""
    bits = FAR + _height([piece])
    sample = [piece.sample[r.variable] for r in piece.ranges]
    origin = [v if isinstance(v, Fraction) else rational_between(*rational_ends(v, bits)) for v in sample]

    def moved(root: RootFunction | None) -> RootFunction | None:
        if root is None:
            return None
        value = None if root.value is None else root.value - origin[root.poly.level]
        ring, places = root.poly.ring, zip(piece.ranges, origin, strict=True)
        tops = [(r.variable, ring.var(r.variable) * v.denominator + v.numerator, v.denominator) for r, v in places]
        steps = [Solve(variable, top, ring.constant(bottom)) for variable, top, bottom in tops]
        return RootFunction(at_steps(root.poly, steps), root.k, value)

    return replace(piece, ranges=tuple(replace(r, lower=moved(r.lower), upper=moved(r.upper)) for r in piece.ranges))


def _end(root: RootFunction | None, at: dict[int, Jet], sides: Sides) -> Jet | None:
    assert root is not None
    if root.value is not None:
        return constant(root.value, sides)
    return root_jet(root.poly, root.k, at, sides)


def _halves(box: Box) -> list[Box]:
    longest = max(range(len(box)), key=lambda i: box[i][1] - box[i][0])
    a, b = box[longest]
    middle = (a + b) * _HALF
    return [(*box[:longest], side, *box[longest + 1 :]) for side in ((a, middle), (middle, b))]
