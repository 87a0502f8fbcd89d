"""Where along a curve the number of solutions may change, and where else something is special: exact parameters.

Substituting p(s) first leaves polynomials in t whose coefficients are polynomials in s over the field of the arm.
Between neighbouring zeros of the polynomials below all real solutions t of the equation (with m where it is needed) are
simple and no two meet, none passes an angle that is not determined: so their number is constant and each is an analytic
function of s.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cached_property

from bezier.arm.elimination import LIFTED, TURNS, Geometry, Ratio, Reduction, constant, reduced
from bezier.arm.inverse import geometry_of
from bezier.arm.model import Arm
from bezier.curves.curve import Bezier
from bezier.curves.scalar import rational
from bezier.proofs.course import coefficients
from bezier.proofs.square_roots import ZERO, Polynomial, Surd
from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.point_values import roots_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point

NAMES = ("w", "s", "t", "m")
S = 1
Number = Fraction | RealAlgebraic


class Reason(Enum):
    """Why a parameter is special."""

    MERGE = "solutions meet"
    AXIS = "on the axis of the first joint"
    ESCAPE = "a joint that slides would have to be infinitely long"
    FREE = "the second joint does not move the end effector"
    SINE = "two solutions share the sine of the last joint"


@dataclass(frozen=True, eq=False)
class AlongCurve:
    """The reductions along one curve, whose control points (mm) are rational."""

    arm: Arm
    curve: Bezier

    def __post_init__(self) -> None:
        if self.curve.dimension != 3:
            raise InputError(f"a path of the arm is in space: dimension 3 expected, {self.curve.dimension} found")
        if any(rational(c) is None for p in self.curve.points for c in p):
            raise InputError("a path of the arm needs rational control points")

    @cached_property
    def point(self) -> tuple[Ratio, ...]:
        """p(s), coordinates as polynomials of the ring ``NAMES``."""
        rows = (Polynomial.of(map(Surd.rational, row)) for row in coefficients(self.curve.points))
        return tuple(map(self._ratio, rows))

    def _ratio(self, p: Polynomial) -> Ratio:
        s, one = Ratio(Ring.of(NAMES).gen(S), 1, self.arm.field), constant(Ring.of(NAMES), 1, self.arm.field)
        total = one.by(ZERO)
        for c in reversed(p.coefficients):
            total = total * s + one.by(c)
        return total

    def polynomial(self, p: Polynomial) -> Poly:
        """A positive multiple of a polynomial in s, in w and s."""
        return self._ratio(p).top

    @cached_property
    def _reductions(self) -> dict[int, Reduction]:
        return {}

    def reduction(self, turn: int) -> Reduction:
        """The reduction with angles counted from ``TURNS[turn]``."""
        known = self._reductions
        if turn not in known:
            known[turn] = self.geometry.reduce(Ring.of(NAMES), self.point, TURNS[turn])
        return known[turn]

    @property
    def geometry(self) -> Geometry:
        """The constants of the arm."""
        return geometry_of(self.arm)

    def place(self, s: Number) -> Point:
        """The point of the ring at which the reductions are to be read."""
        return Point.of(Ring.of(NAMES), [self.arm.field.theta, s])

    # --- what may vanish ---------------------------------------------------------------------
    @cached_property
    def regular(self) -> Reduction:
        """A reduction whose equation has its full degree for almost all s; a length's is not zero."""
        for k in range(len(TURNS)):
            result = self.reduction(k)
            if len(result.coefficients) > (result.degree or 0):
                return result
        raise Unable(f"along the curve every value of a joint that was tried solves the equation of {self.arm.name}")

    def polynomials(self) -> Iterator[tuple[Reason, Poly]]:
        """Polynomials in w and s whose zeros contain all places where the number of solutions may change."""
        r, field = self.regular, self.arm.field
        t = r.ring.index["t"]
        if len(r.coefficients) > 1:
            yield Reason.MERGE, reduced(r.equation.discriminant(t), field)
        if r.degree is None:  # t is a length: where the leading coefficient vanishes a root has gone to infinity
            yield Reason.ESCAPE, r.coefficients[-1]
        if r.axis is not None:
            yield Reason.AXIS, r.axis
        for reason, other in ((Reason.MERGE, r.square), (Reason.FREE, r.kappa)):
            if other is not None:
                yield reason, reduced(r.equation.resultant(other, t), field)
                # where it vanishes at the angle that t misses, so may the equation for some s
                if r.degree is not None and other.degree(t) < LIFTED:
                    yield reason, r.coefficients[-1]

    def critical(self) -> list[tuple[Number, tuple[Reason, ...]]]:
        """All such parameters in [0, 1], ascending. Raises ``Unable`` where the whole curve is special."""
        result: dict[Number, list[Reason]] = {}
        for reason, p in self.polynomials():
            if not p:
                where = f"everywhere along the curve: {reason.value}"
                raise Unable(f"{where}; the number of solutions is not followed there")
            for s in self.zeros(p):
                result.setdefault(s, []).append(reason)
        return [(s, tuple(dict.fromkeys(result[s]))) for s in sorted(result)]

    def shared_sines(self) -> list[Number]:
        """The parameters in [0, 1] where two real solutions have the sine, not the cosine of the last joint in common.

        With S, C the sine and cosine the equation is A(S) + C B(S), A of degree 2 and B of degree 1: both vanish.
        """
        r = self.reduction(0)
        if r.degree != 4:
            return []
        zero = r.ring.constant(0)
        q0, q1, q2, q3, q4 = (*r.coefficients, zero, zero, zero, zero, zero)[:5]
        b0, b1 = 2 * (q0 - q4), q1 - q3  # all times 4
        a0, a1, a2 = 2 * (q0 + q4), q1 + q3, q2 - q0 - q4
        both = reduced(a0 * b1 * b1 - a1 * b0 * b1 + a2 * b0 * b0, self.arm.field)
        inside = b1 * b1 - b0 * b0
        return [s for s in self.zeros(both) if self.place(s).sign(inside) > 0] if both else []

    def zeros(self, p: Poly) -> list[Number]:
        """The zeros in [0, 1] of a polynomial in w and s, at the true value of w."""
        field = self.arm.field
        minimal = p.ring.from_terms({(k, 0, 0, 0): c for k, c in enumerate(field.minimal_polynomial) if c})
        norm = p if field.degree == 1 else minimal.resultant(p, 0)
        return [s for s in roots_between(norm, S) if self._vanishes(p, s)]

    def _vanishes(self, p: Poly, s: Number) -> bool:
        """Whether p vanishes at a zero s of its norm, the product of the conjugates of p over the rationals: if balls
        exclude zero for all the others, p is the one that vanishes."""
        if self.place(s).apparent_sign(p):
            return False
        others = [Point.of(p.ring, [w, s]) for w in self._conjugates]
        return all(other.apparent_sign(p) for other in others) or self.place(s).sign(p) == 0

    @cached_property
    def _conjugates(self) -> list[RealAlgebraic]:
        """The other roots of the minimal polynomial of the generator: all real, as the fields of arms are."""
        theta = self.arm.field.theta
        return [w for w in irreducible_roots(theta.poly) if w != theta] if self.arm.field.degree > 1 else []
