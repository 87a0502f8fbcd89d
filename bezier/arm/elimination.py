"""The position of an arm with three joints, reduced exactly to one equation in the last joint.

After D. L. Pieper (The kinematics of manipulators under computer control, 1968; Craig, section 4.6), with joints that
turn or slide. With frames A0 M(q1) A1 M(q2) A2 M(q3) A3, e the origin of A3, p' = A0^-1 p, v(q3) = A2 M(q3) e,
A1 = (R, o), g = R^T o and n = R^T e_z, the point is reached iff p' = M(q1) q for some q1 and q2, q = A1 M(q2) v:

    a first joint that turns: |q|² = |p'|² and q_z = p'_z;        one that slides: q_x = p'_x and q_y = p'_y.

A second joint that turns: M(q2) v = (u, v_z) with |u| = |κ|, κ = (v_x, v_y), and both equations are linear in u: for
a first joint that turns 2 (g_x, g_y)·u = |p'|² - |o|² - |v|² - 2 g_z v_z and (n_x, n_y)·u = p'_z - o_z - n_z v_z. If
they are independent, |u|² = |κ|² is one equation in q3. If not (axes 1 and 2 meet or are parallel), a combination of
the two is free of u; the other one gives a component of u, and |u|² = |κ|² the square of the other component, m.
A second joint that slides: M(q2) v = v + d e_z. Where q_z depends on d, or the first joint slides, d is found from a
linear equation, and what is left is one in q3. Where it does not, q_z = p'_z is one in q3, and |q|² = |p'|² is
(d + v_z + g_z)² = m².

v and |v|² are affine in cos θ3, sin θ3 where the last joint turns: then θ3 = φ + 2 arctan t and all is multiplied by
1 + t²; where it slides t is its length. Every real t that solves the equation gives a solution: θ2 is the angle from
κ to u, unique unless κ = 0; θ1 the one from q to p', unique unless p' lies on axis 1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from bezier.arm.model import Arm, JointKind, apply, inverse
from bezier.arm.ratio import Ratio, constant
from bezier.curves.scalar import dot, is_zero
from qe.errors import Unable
from qe.exact.point_values import Ball, Evaluation
from qe.exact.ring import Poly, Ring

Vector = tuple[Any, ...]
Lifted = Callable[[Any], Ratio]

T, M = "t", "m"
TURNS = tuple(
    (Fraction(c), Fraction(s))
    for c, s in (("1", "0"), ("0", "1"), ("3/5", "4/5"), ("-3/5", "4/5"), ("5/13", "12/13"), ("-5/13", "12/13"))
)
"""Cosine and sine of the φ that are tried: t misses one angle, φ + π, and the equation has at most four roots."""

LIFTED = 4
"""The degree in t of |κ|² (1 + t²)² and of m², where they do not vanish at the angle that t misses."""


@dataclass(frozen=True, slots=True, eq=False)
class Quotient:
    """``scale * top / bottom``, polynomials of one ring."""

    top: Poly
    bottom: Poly
    scale: Fraction

    def at(self, here: Evaluation, bits: int) -> Ball:
        """Its value at a point, in a ball at most 2^-bits wide."""
        return here.quotient(self.top, self.bottom, self.scale, bits)


@dataclass(frozen=True, eq=False)
class Reduction:
    """What is left of the position problem in a ring whose last two variables are t and m."""

    ring: Ring
    equation: Poly
    """The polynomial in t that has to vanish."""
    degree: int | None
    """Its degree where no angle is missed, None where t misses none."""
    square: Poly | None
    """m² as a polynomial in t, None where there is no m."""
    kappa: Poly | None
    """|κ|² (1 + t²)²; where it vanishes θ2 is free."""
    axis: Poly | None
    """The square of the distance of the point from axis 1; where it vanishes θ1 is free; both None where that joint
    slides."""
    shoulder: tuple[Poly, ...]
    """What vanishes where the point lies on the circle that the origin of the second joint describes."""
    values: tuple[tuple[Quotient, ...], ...]
    """Cosine and sine of a joint that turns, the length of one that slides, valid where ``kappa`` and ``axis`` do
    not vanish."""

    @cached_property
    def coefficients(self) -> tuple[Poly, ...]:
        """The coefficients of the equation, from degree 0 up."""
        return self.equation.coefficients(self.ring.index[T])


@dataclass(frozen=True, eq=False)
class Geometry:
    """The constants of the derivation above, for one arm."""

    arm: Arm
    turn: Any
    shift: Vector
    v: tuple[Vector, ...]
    """f0, f1, f2 with v = f0 + cos θ f1 + sin θ f2, or f0, f1 with v = f0 + t f1."""
    gamma: Vector
    nu: Vector

    @staticmethod
    def of(arm: Arm) -> Geometry:
        """Raises ``Unable`` for an arm that this reduction does not fit."""
        chain = arm.chain
        if len(chain.joints) != 3:
            raise Unable(f"inverse kinematics at a point needs three joints; {arm.name} has {len(chain.joints)}")
        _, first, second, last = chain.constants
        e, zero = tuple(row[3] for row in last), Fraction(0)
        origin = apply(second, (zero, zero, zero))

        def direction(vector: Vector) -> Vector:
            return tuple(a - b for a, b in zip(apply(second, vector), origin, strict=True))

        v: tuple[Vector, ...]
        if chain.joints[2].motion is JointKind.REVOLUTE:
            v = (apply(second, (zero, zero, e[2])), direction((e[0], e[1], zero)), direction((-e[1], e[0], zero)))
        else:
            v = (apply(second, e), direction((zero, zero, zero + 1)))
        turn, shift = tuple(row[:3] for row in first), tuple(row[3] for row in first)
        g = tuple(dot([turn[i][j] for i in range(3)], shift) for j in range(3))
        geometry = Geometry(arm, turn, shift, v, g, turn[2])
        if geometry.turns[0] == geometry.turns[1]:
            used = slice(2) if geometry.turns[1] else slice(2, 3)
            if all(is_zero(c) for row in geometry.rows for c in row[used]):
                verb = "turn about one axis" if geometry.turns[0] else "slide along one direction"
                raise Unable(f"{arm.name}: the first two joints {verb}, so their values are not determined")
        return geometry

    @cached_property
    def turns(self) -> tuple[bool, ...]:
        """Which joints turn."""
        return tuple(joint.motion is JointKind.REVOLUTE for joint in self.arm.joints)

    @cached_property
    def moves_last(self) -> bool:
        """Whether the last joint moves the point at all: one on its own axis stays where it is."""
        return any(not is_zero(c) for f in self.v[1:] for c in f)

    @property
    def rows(self) -> tuple[Vector, Vector]:
        """What the two equations take of M(q2) v: g and n, or two rows of R."""
        return (self.gamma, self.nu) if self.turns[0] else (self.turn[0], self.turn[1])

    def based(self, point: Sequence[Ratio]) -> tuple[Ratio, Ratio, Ratio]:
        """The point in the frame of the first joint."""
        zero = point[0] * 0
        x, y, z = (zero + value for value in apply(inverse(self.arm.chain.constants[0]), point))
        return x, y, z

    def reduce(self, ring: Ring, point: Sequence[Ratio], turn: tuple[Fraction, Fraction]) -> Reduction:
        """The reduction for a point whose coordinates are polynomials of the ring, with φ of this cosine and sine."""
        field, target = self.arm.field, self.based(point)
        t, one = Ratio(ring.var(T), 1, field), constant(ring, 1, field)
        norm, factors = weights(t, one, turn) if self.turns[2] else (one, (one, t))
        v = [sum((w * f[i] for w, f in zip(factors, self.v, strict=True)), one * 0) for i in range(3)]
        work = _Left(self, norm, v, target, Ratio(ring.var(M), 1, field))
        equation, square, image, second, kappa = work.second_turns() if self.turns[1] else work.second_slides()
        q = [dot(row, image) + norm * o for row, o in zip(self.turn, self.shift, strict=True)]
        x, y, z = target
        axis = x * x + y * y
        first: tuple[Quotient, ...] = (quotient(norm * z - q[2], norm),)
        if self.turns[0]:
            bottom = axis * norm
            first = (quotient(x * q[0] + y * q[1], bottom), quotient(y * q[0] - x * q[1], bottom))
        last = tuple(quotient(w, norm) for w in factors[1:])
        degree = (4 if square is None and work.is_quadratic else 2) if self.turns[2] else None
        shoulder = (axis - dot(self.shift[:2], self.shift[:2]), z - self.shift[2]) if all(self.turns[:2]) else ()
        return Reduction(
            ring=ring,
            equation=equation.top,
            degree=degree,
            square=None if square is None else square.top,
            kappa=None if kappa is None else kappa.top,
            axis=axis.top if self.turns[0] else None,
            shoulder=tuple(p.top for p in shoulder),
            values=(first, second, last),
        )


Parts = tuple[Ratio, Ratio | None, tuple[Ratio, Ratio, Ratio], tuple[Quotient, ...], Ratio | None]
"""(equation, m² where m is needed, M(q2) v, the value of q2, |κ|²); all but the fourth times powers of ``norm``."""


@dataclass(frozen=True, eq=False)
class _Left:
    """One reduction under way: v is multiplied by ``norm``."""

    geometry: Geometry
    norm: Ratio
    v: list[Ratio]
    target: tuple[Ratio, Ratio, Ratio]
    m: Ratio

    @cached_property
    def v_squared(self) -> Ratio:
        """norm |v|²; where θ3 turns v runs on a circle, so no square of a cosine is left."""
        f = self.geometry.v
        if not self.geometry.turns[2]:
            square: Ratio = dot(self.v, self.v) + self.norm * 0
            return square
        # |v|² = |f0|² + |f1|² + 2 cos θ f0·f1 + 2 sin θ f0·f2: f1 and f2 are orthogonal and equally long
        along: Ratio = 2 * dot(f[0], self.v) + self.norm * (dot(f[1], f[1]) - dot(f[0], f[0]))
        return along

    @property
    def is_quadratic(self) -> bool:
        """Whether the equation is one of degree 2 in cos θ3, sin θ3 (else of degree 1)."""
        turns, rows = self.geometry.turns, self.geometry.rows
        if turns[1]:
            return not is_zero(_determinant(*rows))
        return turns[0] and not is_zero(self.geometry.nu[2])

    @cached_property
    def distance(self) -> Ratio:
        """norm (|p'|² - |o|² - |v|²)."""
        shift = self.geometry.shift
        result: Ratio = self.norm * (dot(self.target, self.target) - dot(shift, shift)) - self.v_squared
        return result

    def linear(self) -> tuple[Ratio, Ratio]:
        """What the two equations ask of u (with v_z) or of d (with v): ``rows`` times M(q2) v."""
        first, second = (self.norm * (self.target[i] - self.geometry.shift[i]) for i in range(2))
        if self.geometry.turns[0]:
            first, second = (
                self.distance * Fraction(1, 2),
                self.norm * (self.target[2] - self.geometry.shift[2]),
            )
        return first, second

    def second_turns(self) -> Parts:
        """u from two linear equations, |u|² = |κ|²."""
        v, (g, n) = self.v, self.geometry.rows
        b1, b2 = (b - v[2] * row[2] for b, row in zip(self.linear(), (g, n), strict=True))
        kappa = v[0] * v[0] + v[1] * v[1]
        equation, square, u = _planar(g, n, b1, b2, kappa, self.m)
        pair = (quotient(u[0] * v[0] + u[1] * v[1], kappa), quotient(v[0] * u[1] - v[1] * u[0], kappa))
        return equation, square, (*u, v[2]), pair, kappa

    def second_slides(self) -> Parts:
        """d from one of the two equations."""
        g, v, norm = self.geometry, self.v, self.norm
        square = None
        if not g.turns[0]:
            (r1, r2), (b1, b2) = g.rows, self.linear()
            b1, b2 = b1 - dot(r1, v), b2 - dot(r2, v)
            d = (b1 * r1[2] + b2 * r2[2]) / (r1[2] * r1[2] + r2[2] * r2[2])
            equation = b1 * r2[2] - b2 * r1[2]
        else:
            height = norm * (self.target[2] - g.shift[2]) - dot(g.nu, v)
            # |q|² - |o|² - |v|² = d² + 2 d (v_z + g_z) + 2 g·v
            wanted, middle = self.distance - 2 * dot(g.gamma, v), v[2] + norm * g.gamma[2]
            if is_zero(g.nu[2]):
                square = middle * middle + norm * wanted
                d = self.m * square.scale - middle  # m stands for a multiple, whose square has integer coefficients
                square = Ratio(square.top * square.bottom, 1, square.field)
                equation = height
            else:
                d = height / g.nu[2]
                equation = d * d + 2 * (d * middle) - norm * wanted
        return equation, square, (v[0], v[1], v[2] + d), (quotient(d, norm),), None


def _determinant(g: Vector, n: Vector) -> Any:
    return g[0] * n[1] - g[1] * n[0]


def _planar(
    g: Vector, n: Vector, b1: Ratio, b2: Ratio, kappa: Ratio, m: Ratio
) -> tuple[Ratio, Ratio | None, tuple[Ratio, Ratio]]:
    """(equation, m² where m is needed, u): g·u = b1, n·u = b2 in the plane and |u|² = κ², all times ``norm``."""
    (g1, g2, _), (n1, n2, _) = g, n
    if not is_zero(_determinant(g, n)):
        over = Fraction(1) / _determinant(g, n)
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


def weights(t: Ratio, one: Ratio, turn: tuple[Fraction, Fraction]) -> tuple[Ratio, tuple[Ratio, Ratio, Ratio]]:
    """1 + t², and 1, cos θ and sin θ times it, for θ = φ + 2 arctan t."""
    c, s = turn
    norm, minus, double = one + t * t, one - t * t, t * 2
    return norm, (norm, minus * c - double * s, minus * s + double * c)


def quotient(top: Ratio, bottom: Ratio) -> Quotient:
    """One over the other."""
    return Quotient(top.top, bottom.top, Fraction(bottom.bottom, top.bottom))
