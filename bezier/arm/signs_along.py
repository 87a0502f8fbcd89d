"""The signs of W and Q (``bezier.arm.vertical``) along one curve, and where they vanish."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from bezier.arm.critical import AlongCurve, Number, S
from bezier.arm.ratio import Ratio
from bezier.arm.vertical import Label, Split, VerticalArm
from qe.errors import Unable
from qe.exact.ring import Poly

SIGNS = (1, -1)


@dataclass(frozen=True, eq=False)
class SignsAlong:
    """One curve: W and Q along it, and where they vanish."""

    plane: VerticalArm
    along: AlongCurve
    target: tuple[Ratio, Ratio, Ratio]
    square: Poly
    quality: Split | None

    @staticmethod
    def of(plane: VerticalArm, along: AlongCurve) -> SignsAlong:
        """Raises ``Unable`` where W or Q vanishes along the whole curve."""
        target = plane.geometry.based(along.point)
        square, quality = plane.square(target).top, plane.quality(target)
        if not square or (quality is not None and not quality.norm.top):
            raise Unable("the whole curve is on the axis of the first joint, or along a border of what is reached")
        return SignsAlong(plane, along, target, square, quality)

    @cached_property
    def _zeros(self) -> tuple[frozenset[Number], frozenset[Number]]:
        norm = [] if self.quality is None else self.along.zeros(self.quality.norm.top)
        return frozenset(self.along.zeros(self.square)), frozenset(norm)

    @property
    def places(self) -> list[Number]:
        """Where W or Q vanishes, in [0, 1]."""
        return sorted(self._zeros[0] | self._zeros[1])

    def has_no_square(self, s: Number) -> bool:
        """Whether W = 0."""
        return s in self._zeros[0]

    def empty_sides(self, s: Number) -> frozenset[int]:
        """The σ with Q(σ √W) = 0; raises ``Unable`` if the second joint is free there."""
        if self.quality is None or s not in self._zeros[1]:
            return frozenset()
        here = self.along.place(s)
        if self.plane.may_fold and here.sign(self.plane.distance(self.target).norm.top) == 0:
            raise Unable(f"at s = {float(s):.9g} the second joint is free: which motions go on is not decided")
        even, odd = (here.sign(part.top) for part in (self.quality.even, self.quality.odd))
        return frozenset({-even * odd} if even else SIGNS)

    def labels(self, s: Fraction) -> set[Label]:
        """The labels of the solutions at a place where neither W nor Q vanishes."""
        here = self.along.place(s)
        if here.sign(self.square) < 0:
            return set()
        if self.quality is None:
            return {(side, 1) for side in SIGNS}
        even, odd, norm = (here.sign(p.top) for p in (self.quality.even, self.quality.odd, self.quality.norm))
        # with |even| > |odd √W| the sign of the one, else that of the other
        return {(side, end) for side in SIGNS if (even if norm > 0 else side * odd) > 0 for end in SIGNS}

    def direction(self, s: Number) -> tuple[Ratio, Ratio, int]:
        """(x, y) divided by as high a power of (s' - s) as it has, as polynomials to be read at s, and that power."""
        x, y, _ = self.target
        here, k = self.along.place(s), 0
        while not (here.sign(x.top) or here.sign(y.top)):
            x, y = (Ratio(v.top.derivative(S), v.bottom, v.field) for v in (x, y))
            k += 1
        return x, y, k
