"""What an arm reaches as a formula in x, y and z, by quantifier elimination: position only, joints that turn without
limits, joints that slide within theirs.

With p' = A0^-1 p and q = A1 M2 A2 ... An 0 a point is reached iff p' = M1 q for some joints. A first joint that turns
takes q to every point with the same height and distance from its axis, so it is left out at once:

    q_z = p'_z,  q_x² + q_y² = p'_x² + p'_y²;    one that slides:  q_x = p'_x, q_y = p'_y, p'_z - q_z within its limits.

Every other joint is a quantified pair (c, s) with c² + s² = 1, or a quantified length within its limits; so is the
generator of the field of constants. What is left is a question of real algebra, with a certificate like any other.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import lcm
from typing import Any

import qe
from bezier.arm.model import Arm, Joint, Motion, apply, inverse, motion, product
from bezier.arm.ratio import Ratio, constant, variable
from qe.errors import Unable
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Formula, Relation
from qe.proof.answer import Answer

PLACE = ("x", "y", "z")
SECONDS = 30.0
"""How long the elimination may take by default."""


def reachable_formula(arm: Arm, *, timeout: float | None = SECONDS, check: bool = True) -> Answer:
    """The points (mm) that the arm reaches, as a formula in x, y, z: an answer of ``qe.eliminate``, with ``check`` with
    its certificate. Limits of joints that turn are left aside.

    Raises ``Unable`` in one line where the elimination does not end in ``timeout`` seconds, or is beyond its methods.
    """
    found = qe.eliminate(question(arm), timeout=timeout, check=check)
    if found.formula is None:
        reason = found.reason or found.status.value
        raise Unable(f"the reachable set of {arm.name} is not found by elimination: {reason}")
    return found


def question(arm: Arm) -> Formula:
    """That the arm reaches (x, y, z): the formula with quantifiers."""
    chain, joints = arm.chain, arm.chain.joints
    bound = ["w"] * (arm.field.degree > 1)
    names = [name for k in range(1, len(joints)) for name in _names(k, joints[k])]
    ring = Ring.of(("w", *PLACE, *names))
    conditions = [*_generator(arm, ring)]
    q = chain.constants[1]
    for k, (joint, after) in enumerate(zip(joints[1:], chain.constants[2:], strict=True), start=1):
        own = [variable(ring, name, arm.field) for name in _names(k, joint)]
        conditions += _within(joint, own)
        q = product(product(q, motion(joint, tuple(own) if len(own) == 2 else own[0])), after)
    zero = constant(ring, 0, arm.field)
    tip = [zero + v for v in apply(q, (Fraction(0),) * 3)]
    p = [zero + v for v in apply(inverse(chain.constants[0]), [variable(ring, name, arm.field) for name in PLACE])]
    if joints[0].motion is Motion.REVOLUTE:
        squares = [v[0] * v[0] + v[1] * v[1] for v in (tip, p)]
        pairs = [(tip[2], p[2]), (squares[0], squares[1])]
    else:
        pairs = [(tip[0], p[0]), (tip[1], p[1])]
        conditions += _within(joints[0], [p[2] - tip[2]])
    conditions += [atom((a - b).top, Relation.EQ) for a, b in pairs]
    return exists([*bound, *names], conj(conditions))


def _names(k: int, joint: Joint) -> tuple[str, ...]:
    return (f"c{k + 1}", f"s{k + 1}") if joint.motion is Motion.REVOLUTE else (f"d{k + 1}",)


def _within(joint: Joint, own: list[Ratio]) -> Iterator[Formula]:
    """What the values of a joint satisfy; a ``Ratio`` has a positive denominator."""
    if joint.motion is Motion.REVOLUTE:
        c, s = own
        yield atom((c * c + s * s - 1).top, Relation.EQ)
    elif joint.limits is not None:
        yield atom((own[0] - joint.limits[0]).top, Relation.GE)
        yield atom((own[0] - joint.limits[1]).top, Relation.LE)


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
