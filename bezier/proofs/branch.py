"""Rule "joints along curves": an arm with three joints follows curves continuously.

The sentence (``sentence``): at every parameter of each curve, from the beginning of the first piece to the end of the
last, some joints solve the equations of the arm (``bezier.proofs.arm_sentences``). What first-order logic has no words
for is checked all the same: that they depend continuously on the parameter, are the only ones in boxes of angles,
and keep the limits.

``pieces``: on [low, high] of a curve, joint values within ``radius`` of centre + slope (s - middle), one solution for
every s by Krawczyk's test (``bezier.proofs.course``). Neighbouring pieces belong together when the image of the one
lies in the box of the other at their common parameter: then both have the same solution there. ``limits``: for each
joint null, or two values between which it stays (``bezier.proofs.joint_limits``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import Any

from bezier.proofs import course
from bezier.proofs.arm_rows import read_chain
from bezier.proofs.arm_sentences import ALONG, ArmEquations, between, ring_of, with_roots
from bezier.proofs.course import Course, Lines, around, coefficients, radius_above
from bezier.proofs.joint_limits import Ends, JointStretch, KeptLimits, read_limits
from qe.exact.balls import ends, precision
from qe.expert.sentences import Sentence, stated
from qe.formula.build import conj, exists, forall, implies
from qe.formula.syntax import TRUE, Formula
from qe.kernel.step import Limits
from qe.proof.entry import Entry

MOST_POINTS = 60
Points = list[tuple[Fraction, ...]]


@dataclass(frozen=True, slots=True)
class Tube:
    """On [low, high] of a curve: joint values within ``radius`` of centre + slope (s - middle)."""

    curve: int
    low: Fraction
    high: Fraction
    centre: tuple[Fraction, ...]
    slope: tuple[Fraction, ...]
    radius: tuple[Fraction, ...]
    entry: Entry

    def at(self, s: Fraction) -> list[Fraction]:
        step = s - (self.low + self.high) / 2
        return [c + v * step for c, v in zip(self.centre, self.slope, strict=True)]


def check_branch(evidence: Entry, limits: Limits) -> Sentence:
    """What the evidence proves; or raise ``CertificateRejected`` naming the entry that fails."""
    arm, curves_entry, kept, pieces_entry = evidence.fields("arm", "curves", "limits", "pieces")
    curves = [read_curve(entry) for entry in curves_entry.items()]
    pieces = [_piece(entry, len(curves)) for entry in pieces_entry.items()]
    if not pieces:
        raise pieces_entry.fail("expected at least one piece")
    tubes = Tubes(arm, curves, read_limits(kept, 3))
    images = []
    for piece in pieces:
        limits.tick()
        images.append(tubes.image(piece))
        joint = tubes.unlimited(piece, images[-1])
        if joint is not None:
            raise piece.entry.fail(f"joint {joint + 1} is not proved to keep its limits there")
    for (one, first), (other, second) in pairwise(zip(pieces, images, strict=True)):
        _check_link(one, first, other, second, curves)
    return sentence(evidence)


def sentence(evidence: Entry) -> Sentence:
    """That the arm reaches every point of the curves along the pieces."""
    arm, curves_entry, _, pieces_entry = evidence.fields("arm", "curves", "limits", "pieces")
    chain, curves = read_chain(arm), [read_curve(entry) for entry in curves_entry.items()]
    ranges: dict[int, tuple[Fraction, Fraction]] = {}
    for piece in (_piece(entry, len(curves)) for entry in pieces_entry.items()):
        ranges[piece.curve] = (ranges.get(piece.curve, (piece.low,))[0], piece.high)
    if not ranges:
        raise pieces_entry.fail("expected at least one piece")
    listed = [ArmEquations.on_curve(chain, coefficients(curves[k])) for k in ranges]
    ring = ring_of(listed)
    s, parts = ring.var(ALONG), list[Formula]()
    for equations, pair in zip(listed, ranges.values(), strict=True):
        reached = exists(equations.variables(), equations.hold(ring))
        parts.append(forall((ALONG,), implies(between(s, *pair), reached)))
    return with_roots(ring, listed, conj(parts)), TRUE


def read_curve(entry: Entry) -> Points:
    """The control points of a curve in space."""
    points = [tuple(c.rational() for c in point.items()) for point in entry.items()]
    if not 1 <= len(points) <= MOST_POINTS or any(len(p) != 3 for p in points):
        raise entry.fail(f"expected 1 to {MOST_POINTS} points of three coordinates")
    return points


def _piece(entry: Entry, curves: int) -> Tube:
    curve, low, high, centre, slope, radius = entry.fields("curve", "low", "high", "centre", "slope", "radius")
    middle, slopes, radii = (tuple(v.rational() for v in part.items()) for part in (centre, slope, radius))
    if not len(middle) == len(slopes) == len(radii) == 3:
        raise entry.fail("expected one value for each of three joints")
    if curve.integer() >= curves:
        raise curve.fail(f"expected one of {curves} curves")
    if not 0 <= low.rational() < high.rational() <= 1:
        raise entry.fail("expected 0 <= low < high <= 1")
    if any(r <= 0 for r in radii):
        raise radius.fail("expected radii above 0")
    return Tube(curve.integer(), low.rational(), high.rational(), middle, slopes, radii, entry)


class Tubes:
    """An arm along curves, and what is proved about pieces."""

    def __init__(self, arm: Entry, curves: Sequence[Points], limits: Sequence[Ends | None]) -> None:
        chain = read_chain(arm)
        if len(chain.turns) != 3:
            raise arm.fail("expected rows, three of them with a joint")
        along = [coefficients(points) for points in curves]
        self._limits, self._courses = KeptLimits(chain, along, limits), [Course(chain, curve) for curve in along]

    def image(self, piece: Tube) -> list[Fraction]:
        """Radii of a box around 0 that holds the image, which is proved to lie inside the piece's box."""
        with precision(course.BITS):
            image = self._image(piece, Fraction(0), (piece.high - piece.low) / 2, piece.radius)
            if image is None or not course.strictly_within(image, piece.radius):
                raise piece.entry.fail("the box is not proved to hold exactly one solution")
            return [radius_above(x) for x in image]

    def _image(self, piece: Tube, *box: Any) -> Any:
        lines = Lines.of((piece.low + piece.high) / 2, piece.centre, piece.slope)
        return self._courses[piece.curve].image(lines, *box)

    def unlimited(self, piece: Tube, radii: Sequence[Fraction]) -> int | None:
        """The first joint that is not proved to keep its limits on a piece with an image of these radii."""
        low, high = piece.at(piece.low), piece.at(piece.high)
        at_end = cache(lambda end: self._at_end(piece, radii, end))
        parts = (
            JointStretch(piece.curve, (piece.low, piece.high), j, (low[j], high[j]), radii[j], at_end) for j in range(3)
        )
        return next((part.joint for part in parts if not self._limits.keeps(part)), None)

    def _at_end(self, piece: Tube, radii: Sequence[Fraction], end: int) -> list[tuple[Fraction, Fraction]]:
        """Bounds of the joints at one end: for this σ alone, the image of what holds the solution holds it too."""
        s = (piece.low, piece.high)[end]
        middle = piece.at(s)
        with precision(course.BITS):
            box = self._image(piece, s - (piece.low + piece.high) / 2, Fraction(0), radii)
            bounds = [ends(x) for x in box or [around(r) for r in radii]]
        return [(m + low, m + high) for m, (low, high) in zip(middle, bounds, strict=True)]


def _check_link(one: Tube, first: list[Fraction], other: Tube, second: list[Fraction], curves: list[Points]) -> None:
    same = one.curve == other.curve and one.high == other.low
    if not same:
        joined = other.curve == one.curve + 1 and one.high == 1 and other.low == 0
        if not joined or curves[one.curve][-1] != curves[other.curve][0]:
            raise other.entry.fail("the piece does not begin where the one before ends")
    a, b = one.at(one.high), other.at(other.low)
    gaps = [abs(x - y) for x, y in zip(a, b, strict=True)]
    if not any(
        all(gap + r <= size for gap, r, size in zip(gaps, inner, outer, strict=True))
        for inner, outer in ((first, other.radius), (second, one.radius))
    ):
        raise other.entry.fail("its solution is not proved to be that of the piece before at their common parameter")


RULE = stated(check_branch)
