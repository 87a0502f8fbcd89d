"""Arms whose second and third joints move the end point in a plane parallel to the first axis, about which it turns:
elbow arms and cylindrical ones, with or without an offset.

With W, Q, σ and ε of the rule "joint motions" (``bezier.proofs.joint_motions``) a solution is a pair of signs (σ, ε),
r = σ √W and δ = ε √Q(r, z); all of them are continuous in W, z and the direction of (x, y).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache, partial

from bezier.arm.choices import AtPlace, Exact
from bezier.arm.critical import AlongCurve, Number
from bezier.arm.elimination import Geometry, variable
from bezier.arm.inverse import Solution, geometry_of
from bezier.arm.model import Arm
from bezier.curves.curve import Bezier
from bezier.proofs.course import coefficients, seen_from_base
from bezier.proofs.joint_motions import Along, Between, Label, Plane
from bezier.proofs.square_roots import Polynomial, dot
from qe.errors import CertificateRejected, InputError, Unable
from qe.proof.entry import Entry


@dataclass(frozen=True, eq=False)
class VerticalArm:
    """``plane``: in the numbers of the checker."""

    geometry: Geometry
    plane: Plane

    @property
    def turns(self) -> tuple[bool, ...]:
        """Whether the second and the third joint turn."""
        return self.plane.turns[1:]

    def label(self, solution: Solution) -> Label:
        """The signs of a solution of ``bezier.arm.inverse.solve``, exactly."""
        first, _, third = solution.exact
        return self._side(first), self._elbow(third)

    def _side(self, exact: Exact | None) -> int:
        if not isinstance(exact, AtPlace):
            return 0
        ring, field = exact.place.point.ring, self.geometry.arm.field
        x, y, _ = self.geometry.based([variable(ring, name, field) for name in "xyz"])
        ex, ey = self.plane.outwards
        return exact.sign(exact.joint.c * (x.by(ex) + y.by(ey)) + exact.joint.s * (y.by(ex) - x.by(ey)))

    def _elbow(self, exact: Exact | None) -> int:
        if self.turns == (False, False):
            return 1
        if not isinstance(exact, AtPlace):
            return 0
        third, f = exact.joint, self.geometry.f
        if not self.turns[1]:
            return exact.sign(third.c + third.w.by(dot(f[0][:2], f[1][:2])))
        across = [f[0][0] * g[1] - f[0][1] * g[0] if self.turns[0] else g[2] for g in f[1:]]
        return exact.sign(third.c.by(across[0]) + third.s.by(across[1]))


@lru_cache(maxsize=64)
def vertical_arm(arm: Arm) -> VerticalArm | None:
    """The arm as one with a plane that turns, or None if it is none. Raises ``Unable`` if the positions at a point are
    not determined by ``bezier.arm.elimination`` at all."""
    geometry = geometry_of(arm)
    try:
        return VerticalArm(geometry, Plane.of(geometry.chain, Entry(None, arm.name)))
    except CertificateRejected:
        return None


@dataclass(frozen=True, eq=False)
class SignsAlong:
    """One curve: W and Q along it, and where they vanish."""

    arm: VerticalArm
    curve: Bezier
    signs: Along
    along: AlongCurve

    @staticmethod
    def of(arm: VerticalArm, curve: Bezier) -> SignsAlong:
        """Raises ``Unable`` where W or Q vanishes along the whole curve."""
        if curve.dimension != 3:
            raise InputError(f"a path of the arm is in space: dimension 3 expected, {curve.dimension} found")
        points = coefficients(curve.points)
        try:
            along = Along.of(arm.plane, seen_from_base(arm.geometry.chain, points), Entry(None, "curve"))
        except Unable:
            where = "on the axis of the first joint, or along a border of what is reached"
            raise Unable(f"the whole curve is {where}") from None
        return SignsAlong(arm, curve, along, AlongCurve(arm.geometry.arm, curve))

    @cached_property
    def _zeros(self) -> tuple[frozenset[Number], frozenset[Number]]:
        """Of W and of N, in [0, 1]."""
        listed = self.signs.w, self.signs.norm or Polynomial()
        w, norm = (frozenset(self.along.zeros(self.along.polynomial(p)) if p else ()) for p in listed)
        return w, norm

    @property
    def places(self) -> list[Number]:
        """Where W or Q vanishes, in [0, 1]."""
        return sorted(self._zeros[0] | self._zeros[1])

    def sign(self, s: Number, p: Polynomial) -> int:
        """Of a polynomial at a parameter."""
        return self.along.place(s).sign(self.along.polynomial(p))

    def vanishes(self, s: Number) -> tuple[bool, bool]:
        """Whether W and N do."""
        return s in self._zeros[0], s in self._zeros[1]

    def between(self, s: Number) -> Between:
        """What holds there. Raises ``Unable`` if the second joint is free."""
        has_no_square, sign, order, w = self.vanishes(s)[0], partial(self.sign, s), 0, self.signs.w
        while has_no_square and not sign(w):
            order, w = order + 1, w.derivative
        empty = self.signs.empty(sign)
        if empty is None:
            raise Unable(f"at s = {float(s):.9g} the second joint is free: which motions go on is not decided")
        return Between(has_no_square, empty, (-1) ** (order // 2))
