"""What an arm like the EV3 can reach, in closed form: position only, no joint limits.

Where axis 2 is orthogonal to axis 1, axis 3 parallel to axis 2 and the end point in a plane through axis 1, let a be
the distance of joint 2 from axis 1, c its height, R1 and R2 the distances from joint 2 to joint 3 and from there to the
end point. A point with distance ρ from axis 1 and height z is reached iff

    |R1 - R2| <= sqrt((σρ - a)² + (z - c)²) <= R1 + R2   for σ = 1 or σ = -1.

With h = |R1 - R2|, in the hole (ρ - a)² + (z - c)² < h² of σ = 1 the root for σ = -1 lies between 2a - h and 2a + h.
So if h <= a and 2a + h <= R1 + R2 the other sign reaches it: the reachable set is (ρ - a)² + (z - c)² <= (R1 + R2)².

What an arm reaches as a formula in x, y and z, by quantifier elimination: position only, joints that turn without
limits, joints that slide within theirs.

With p' = A0^-1 p and q = A1 M2 A2 ... An 0 a point is reached iff p' = M1 q for some joints. A first joint that turns
takes q to every point with the same height and distance from its axis, so it is left out at once:

    q_z = p'_z,  q_x² + q_y² = p'_x² + p'_y²;    one that slides:  q_x = p'_x, q_y = p'_y, p'_z - q_z within its limits.

Every other joint is a quantified pair (c, s) with c² + s² = 1, or a quantified length within its limits; so is the
generator of the field of constants. What is left is a question of real algebra, with a certificate like any other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, lcm
from typing import Any

import qe
from bezier.arm.elimination import Geometry, Ratio, constant, variable
from bezier.arm.inverse import geometry_of
from bezier.arm.model import Arm, Joint, JointKind, in_field
from bezier.proofs.square_roots import Triple, back, carried, dot, image
from bezier.proofs.three_joints import rows_of
from qe.errors import Unable
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Formula, Relation
from qe.proof.answer import Answer


@dataclass(frozen=True, eq=False)
class Torus:
    """(sqrt(x² + y²) - a)² + (z - c)² <= R²: the points that can be reached (mm).

    ``a_squared``, ``c``: exact; ``first_squared``, ``second_squared``: the squares of R1 and R2 with R = R1 + R2.
    """

    a_squared: Any
    c: Any
    first_squared: Any
    second_squared: Any

    @property
    def numbers(self) -> tuple[float, float, float]:
        """a, c and R in floating point."""
        first, second = (float(v) ** 0.5 for v in (self.first_squared, self.second_squared))
        return float(self.a_squared) ** 0.5, float(self.c), first + second

    def contains(self, x: float, y: float, z: float) -> bool:
        """Whether a point can be reached, in floating point; near the border ask ``bezier.arm.inverse.solve``."""
        a, c, radius = self.numbers
        return hypot(hypot(x, y) - a, z - c) <= radius

    @property
    def half_ball(self) -> float:
        """The largest r (mm) such that every point with |p| <= r and z >= 0 can be reached: a + sqrt(R² - c²)."""
        a, c, radius = self.numbers
        return a + float((radius**2 - c**2) ** 0.5)

    def __str__(self) -> str:
        a, c, radius = self.numbers
        return f"(sqrt(x^2 + y^2) - {a:.6f})^2 + (z - {c:.6f})^2 <= {radius:.6f}^2"


def reachable_set(arm: Arm) -> Torus:
    """The reachable set. Raises ``Unable`` for an arm of another shape; then ``inverse`` decides single points."""
    shift = _check_shape(geometry_of(arm))
    a_squared, c = (in_field(v, arm.field) for v in (dot(shift[:2], shift[:2]), shift[2]))
    shifts = (constant[1][:2] for constant in arm.chain.constants[2:])
    first_squared, second_squared = (in_field(dot(v, v), arm.field) for v in shifts)
    a, r1, r2 = (float(v) ** 0.5 for v in (a_squared, first_squared, second_squared))
    if not (a > abs(r1 - r2) * (1 + 1e-9) and 2 * a + abs(r1 - r2) < (r1 + r2) * (1 - 1e-9)):
        raise Unable(f"the reachable set of {arm.name} has a hole, which has no closed form here")
    return Torus(a_squared, c, first_squared, second_squared)


def _check_shape(geometry: Geometry) -> Triple:
    """Whether axis 2 is orthogonal to axis 1, axis 3 parallel to axis 2, and all moves in a plane through axis 1. The
    result is where joint 2 is."""
    name, chain, f = geometry.arm.name, geometry.chain, geometry.f
    if not all(chain.turns):
        raise Unable(f"{name}: the closed form is for arms whose joints all turn")
    (g, n), shift = rows_of(chain.constants[1], True), chain.constants[1][1]
    is_plane = not any((n[2], f[1][2], f[2][2], f[0][2] + g[2]))
    if not (is_plane and (shift[0] or shift[1])):
        raise Unable(f"{name}: the closed form is for arms that move in a plane through their first axis")
    return shift


PLACE = ("x", "y", "z")
SECONDS = 30.0
"""How long the elimination may take by default."""


def reachable_formula(arm: Arm, *, timeout: float | None = SECONDS, check: bool = True) -> Answer:
    """The points (mm) that the arm reaches, as a formula in x, y, z: an answer of ``qe.eliminate``, with ``check`` with
    its certificate. Limits of joints that turn are left aside.

    Raises ``Unable`` in one line where the elimination does not end in ``timeout`` seconds, or is beyond its methods.
    """
    result = qe.eliminate(question(arm), timeout=timeout, check=check)
    if result.formula is None:
        reason = result.reason or result.status.value
        raise Unable(f"the reachable set of {arm.name} is not found by elimination: {reason}")
    return result


def question(arm: Arm) -> Formula:
    """That the arm reaches (x, y, z): the formula with quantifiers."""
    joints = arm.joints
    bound = ["w"] * (arm.field.degree > 1)
    names = [name for k in range(1, len(joints)) for name in _names(k, joints[k])]
    ring = Ring.of(("w", *PLACE, *names))
    conditions = [*_generator(arm, ring)]
    zero = constant(ring, 0, arm.field)
    base, *links = arm.chain.in_numbers(lambda c: constant(ring, in_field(c, arm.field), arm.field))
    values = [[variable(ring, name, arm.field) for name in _names(k, joints[k])] for k in range(1, len(joints))]
    for joint, value in zip(joints[1:], values, strict=True):
        conditions += _within(joint, value)
    tip = image(links[0], carried(links[1:], values, [zero] * 3))
    p = image(back(base), [variable(ring, name, arm.field) for name in PLACE])
    if joints[0].motion is JointKind.REVOLUTE:
        squares = [v[0] * v[0] + v[1] * v[1] for v in (tip, p)]
        pairs = [(tip[2], p[2]), (squares[0], squares[1])]
    else:
        pairs = [(tip[0], p[0]), (tip[1], p[1])]
        conditions += _within(joints[0], [p[2] - tip[2]])
    conditions += [atom((a - b).top, Relation.EQ) for a, b in pairs]
    return exists([*bound, *names], conj(conditions))


def _names(k: int, joint: Joint) -> tuple[str, ...]:
    return (f"c{k + 1}", f"s{k + 1}") if joint.motion is JointKind.REVOLUTE else (f"d{k + 1}",)


def _within(joint: Joint, values: list[Ratio]) -> Iterator[Formula]:
    """What the values of a joint satisfy; a ``Ratio`` has a positive denominator."""
    if joint.motion is JointKind.REVOLUTE:
        c, s = values
        yield atom((c * c + s * s - constant(c.top.ring, 1, c.field)).top, Relation.EQ)
    elif joint.limits is not None:
        low, high = (values[0] - constant(values[0].top.ring, limit, values[0].field) for limit in joint.limits)
        yield from (atom(low.top, Relation.GE), atom(high.top, Relation.LE))


def _generator(arm: Arm, ring: Ring) -> Iterator[Formula]:
    """That w is the generator of the field of constants."""
    if arm.field.degree == 1:
        return
    theta: Any = arm.field.theta
    low, high = theta.interval()
    w = ring.var("w")
    minimal = sum((w**k * c for k, c in enumerate(theta.minimal_polynomial)), ring.constant(0))
    scale = lcm(low.denominator, high.denominator)
    yield atom(minimal, Relation.EQ)
    yield atom(w * scale - int(low * scale), Relation.GE)
    yield atom(w * scale - int(high * scale), Relation.LE)
