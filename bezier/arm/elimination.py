"""The position of an arm with three revolute joints, reduced exactly to one equation in the last joint.

After D. L. Pieper (The kinematics of manipulators under computer control, 1968; Craig, section 4.6). With frames
A0 Rz(θ1) A1 Rz(θ2) A2 Rz(θ3) A3, e the origin of A3, p' = A0^-1 p, v(θ3) = A2 Rz(θ3) e = (κ, k3), A1 = (R, o),
g = R^T o = (γ, g3), n = R^T e_z = (ν, n3) and u = Rz(θ2) κ in the plane, q = A1 (u, k3):

    p' = Rz(θ1) q  for some θ1    iff    |q|² = |p'|²  and  q_z = p'_z
                                   iff    2 γ·u = |p'|² - |o|² - |v|² - 2 g3 k3  and  ν·u = p'_z - o_z - n3 k3.

|v|² and k3 are affine in cos θ3, sin θ3. If γ and ν are independent, u is affine in them too, and |u|² = |κ|² is one
equation of degree 2 in cos θ3, sin θ3: of degree 4 in t, where θ3 = φ + 2 arctan t. Every real t that solves it gives
a solution: θ2 is the angle from κ to u, unique unless κ = 0; θ1 the one from q to p', unique unless p' lies on axis 1.
If γ and ν are dependent (axes 1 and 2 meet or are parallel), a combination of the two equations is free of u: of degree
2 in t; the other one gives a component of u, and |u|² = |κ|² the square of the other component, m.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from bezier.arm.model import Arm, Motion, apply, inverse
from bezier.arm.ratio import Ratio, constant
from bezier.curves.scalar import dot, is_zero
from qe.errors import Unable
from qe.exact.ring import Poly, Ring

Vector = tuple[Any, ...]
Affine = tuple[Vector, Vector, Vector]
"""f0 + cos θ f1 + sin θ f2."""

T, M = "t", "m"
TURNS = tuple(
    (Fraction(c), Fraction(s))
    for c, s in (("1", "0"), ("0", "1"), ("3/5", "4/5"), ("-3/5", "4/5"), ("5/13", "12/13"), ("-5/13", "12/13"))
)
"""Cosine and sine of the φ that are tried: t misses one angle, φ + π, and the equation has at most four roots."""


@dataclass(frozen=True, slots=True, eq=False)
class Quotient:
    """``scale * top / bottom``, polynomials of one ring."""

    top: Poly
    bottom: Poly
    scale: Fraction


@dataclass(frozen=True, eq=False)
class Reduction:
    """What is left of the position problem in a ring whose last two variables are t and m.

    ``equation``: the polynomial in t that has to vanish; ``degree``: its degree where no angle is missed. ``square``:
    m² as a polynomial in t, None where there is no m. ``kappa``: |κ|² (1 + t²)²; where it vanishes θ2 is free.
    ``axis``: the square of the distance of the point from axis 1; where it vanishes θ1 is free. ``shoulder``: what
    vanishes where the point lies on the circle that the origin of the second joint describes. ``pairs``: cosine and
    sine of each joint, valid where ``kappa`` and ``axis`` do not vanish.
    """

    ring: Ring
    equation: Poly
    degree: int
    square: Poly | None
    kappa: Poly
    axis: Poly
    shoulder: tuple[Poly, Poly]
    pairs: tuple[tuple[Quotient, Quotient], ...]

    @property
    def coefficients(self) -> tuple[Poly, ...]:
        """The coefficients of the equation, from degree 0 up."""
        return self.equation.coefficients(self.ring.index[T])


@dataclass(frozen=True, eq=False)
class Geometry:
    """The constants of the derivation above, for one arm."""

    arm: Arm
    turn: Any
    shift: Vector
    v: Affine
    v_squared: tuple[Any, Any, Any]
    gamma: Vector
    nu: Vector

    @staticmethod
    def of(arm: Arm) -> Geometry:
        """Raises ``Unable`` for an arm that this reduction does not fit."""
        chain = arm.chain
        if [j.motion for j in chain.joints] != [Motion.REVOLUTE] * 3:
            kinds = ", ".join(j.motion.value for j in chain.joints)
            raise Unable(f"inverse kinematics at a point needs three revolute joints; {arm.name} has: {kinds}")
        _, first, second, last = chain.constants
        e = tuple(row[3] for row in last)
        zero = Fraction(0)
        at_zero = apply(second, (zero, zero, e[2]))
        origin = apply(second, (zero, zero, zero))
        cosine = tuple(a - b for a, b in zip(apply(second, (e[0], e[1], zero)), origin, strict=True))
        sine = tuple(a - b for a, b in zip(apply(second, (-e[1], e[0], zero)), origin, strict=True))
        v = (at_zero, cosine, sine)
        # |v|² = |v0|² + |f1|² + 2 cos θ v0·f1 + 2 sin θ v0·f2: f1 and f2 are orthogonal and equally long
        squared = (dot(at_zero, at_zero) + dot(cosine, cosine), 2 * dot(at_zero, cosine), 2 * dot(at_zero, sine))
        turn = tuple(row[:3] for row in first)
        shift = tuple(row[3] for row in first)
        g = tuple(dot([turn[i][j] for i in range(3)], shift) for j in range(3))
        geometry = Geometry(arm, turn, shift, v, squared, g, turn[2])
        if all(map(is_zero, (*g[:2], *turn[2][:2]))):
            raise Unable(f"{arm.name}: the first two joints turn about one axis, so their angles are not determined")
        return geometry

    @cached_property
    def determinant(self) -> Any:
        """γ1 ν2 - γ2 ν1."""
        return self.gamma[0] * self.nu[1] - self.gamma[1] * self.nu[0]

    def based(self, point: Sequence[Ratio]) -> tuple[Ratio, Ratio, Ratio]:
        """The point in the frame of the first joint."""
        zero = point[0] * 0
        x, y, z = (zero + value for value in apply(inverse(self.arm.chain.constants[0]), point))
        return x, y, z

    def reduce(self, ring: Ring, point: Sequence[Ratio], turn: tuple[Fraction, Fraction]) -> Reduction:
        """The reduction for a point whose coordinates are polynomials of the ring, with φ of this cosine and sine."""
        field = self.arm.field
        t = Ratio(ring.var(T), 1, field)
        one = constant(ring, 1, field)
        lifted = _lift(t, one, turn)
        target = self.based(point)
        v = [lifted(*(f[i] for f in self.v)) for i in range(3)]
        norm = one + t * t
        squares = dot(target, target) - dot(self.shift, self.shift)
        b1 = (norm * squares - lifted(*self.v_squared)) * Fraction(1, 2) - v[2] * self.gamma[2]
        b2 = norm * (target[2] - self.shift[2]) - v[2] * self.nu[2]
        kappa = v[0] * v[0] + v[1] * v[1]
        equation, square, u = self._planar(b1, b2, kappa, Ratio(ring.var(M), 1, field))
        q = [dot(row, (u[0], u[1], v[2])) + norm * o for row, o in zip(self.turn, self.shift, strict=True)]
        axis = target[0] * target[0] + target[1] * target[1]
        x, y = target[0], target[1]
        pairs = (
            (_quotient(x * q[0] + y * q[1], axis * norm), _quotient(y * q[0] - x * q[1], axis * norm)),
            (_quotient(u[0] * v[0] + u[1] * v[1], kappa), _quotient(v[0] * u[1] - v[1] * u[0], kappa)),
            (_quotient(lifted(0, 1, 0), norm), _quotient(lifted(0, 0, 1), norm)),
        )
        degree, m_squared = (4, None) if square is None else (2, square.top)
        shoulder = (axis - (dot(self.shift[:2], self.shift[:2])), target[2] - self.shift[2])
        tops = (shoulder[0].top, shoulder[1].top)
        return Reduction(ring, equation.top, degree, m_squared, kappa.top, axis.top, tops, pairs)

    def _planar(self, b1: Ratio, b2: Ratio, kappa: Ratio, m: Ratio) -> tuple[Ratio, Ratio | None, tuple[Ratio, Ratio]]:
        """(equation, m² where m is needed, u): γ·u = b1, ν·u = b2, |u|² = κ², all times 1 + t²."""
        (g1, g2, _), (n1, n2, _) = self.gamma, self.nu
        if not is_zero(self.determinant):
            over = Fraction(1) / self.determinant
            u = ((b1 * n2 - b2 * g2) * over, (b2 * g1 - b1 * n1) * over)
            return u[0] * u[0] + u[1] * u[1] - kappa, None, u
        if not (is_zero(g1) and is_zero(g2)):
            length = g1 * g1 + g2 * g2
            equation, along, (d1, d2) = b2 - b1 * ((n1 * g1 + n2 * g2) / length), b1, (g1, g2)
        else:
            length = n1 * n1 + n2 * n2
            equation, along, (d1, d2) = b1, b2, (n1, n2)
        square = kappa * length - along * along
        m = m * square.scale  # the variable stands for a multiple, whose square has integer coefficients
        u = ((along * d1 - m * d2) / length, (along * d2 + m * d1) / length)
        return equation, Ratio(square.top * square.bottom, 1, square.field), u


def _lift(t: Ratio, one: Ratio, turn: tuple[Fraction, Fraction]) -> Any:
    """The map from (f0, f1, f2) to (f0 + f1 cos θ + f2 sin θ)(1 + t²) with θ = φ + 2 arctan t."""
    c, s = turn
    minus, double = one - t * t, t * 2
    cosine, sine = minus * c - double * s, minus * s + double * c

    def lifted(f0: Any, f1: Any, f2: Any) -> Ratio:
        found: Ratio = (one + t * t) * f0 + cosine * f1 + sine * f2
        return found

    return lifted


def _quotient(top: Ratio, bottom: Ratio) -> Quotient:
    return Quotient(top.top, bottom.top, Fraction(bottom.bottom, top.bottom))
