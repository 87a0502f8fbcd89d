"""Inverse kinematics at a pose of arms with a spherical wrist: the last three axes meet in a point.

After D. L. Pieper (1968; Craig, section 4.6). With T = A0 M1 A1 M2 A2 M3 A3 M4 A4 M5 A5 M6 A6 and C the point where
axes 4, 5 and 6 meet, the pose alone gives C, the first three joints have to bring it there (``bezier.arm.inverse``),
and with R the rotation of the pose, R3 that of the first three joints and e = e_z

    W = (R3 A3)^T R A6^T = M4 A4 M5 A5 M6,    e·W e = (A4^T e)·M5 (A5 e):    a cos θ5 + b sin θ5 = k,

θ6 is the angle between the rows e^T A4 M5 A5 and e^T W, θ4 that between the columns A4 M5 A5 e and W e. Both are unique
unless W e = ± e: then axes 4 and 6 are in line, and one of the two can be chosen. So each of the first three joints'
solutions is followed by two for the wrist, one (double) or none, by the sign of a² + b² - k²: at most eight in all.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

from bezier.arm.choices import Arc, Choice, Known, by_turns
from bezier.arm.elimination import TURNS, M, Quotient, Reduction, T, quotient, weights
from bezier.arm.inverse import Inverse, Solution, geometry_of, solve_at
from bezier.arm.model import (
    Angle,
    Arm,
    Chain,
    Convention,
    JointKind,
    Matrix,
    Row,
    apply,
    field_of,
    inverse,
    motion,
    product,
)
from bezier.arm.ratio import Ratio
from bezier.arm.roots_of_squares import Rules, Scaled, fixed, turned
from bezier.curves.scalar import dot, is_zero, rational
from qe.errors import InternalError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.point_values import Evaluation, roots_above
from qe.exact.ring import Poly
from qe.exact.sample import Point

N = "n"
ROOTS = (T, M, N)
ZERO = Fraction(0)
CLOSE = 1e-6
"""How far, relative to its size, floating point may be off."""

Joints = dict[int, Known | None]
Found = tuple[Evaluation, Joints, bool, tuple[Choice, ...]]
"""A solution: its place, what the joints (from 0 on) are there, whether two solutions meet in it, and which joints can
be chosen."""


@dataclass(frozen=True)
class Wrist:
    """``first``: the arm that moves the centre of the wrist; ``height``: of the centre on axis 6, in its frame."""

    chain: Chain
    first: Arm
    height: Any


@lru_cache(maxsize=64)
def wrist_of(arm: Arm) -> Wrist | None:
    """The wrist, or None: joints before it may slide. Raises ``Unable`` where its centre has no rational height, which
    no model here has."""
    chain = arm.chain
    if len(chain.joints) != 6 or any(j.motion is not JointKind.REVOLUTE for j in chain.joints[3:]):
        return None
    between, beyond = meeting(chain.constants[4]), meeting(chain.constants[5])
    if between is None or beyond is None or not is_zero(between[0] - beyond[1]):
        return None
    height = rational(between[1])
    if height is None:
        raise Unable(f"{arm.name}: the centre of the wrist has no rational place on axis 4")
    return Wrist(chain, _first(arm, height), beyond[0])


def meeting(m: Sequence[Sequence[Any]]) -> tuple[Any, Any] | None:
    """Where an axis meets the one before it: heights on it, and on the one before; None where they do not meet, or
    are parallel. ``m``: what lies between the two joints."""
    n, o = [row[2] for row in m], [row[3] for row in m]
    size = n[0] * n[0] + n[1] * n[1]
    if is_zero(size) or not is_zero(o[0] * n[1] - o[1] * n[0]):
        return None
    along = -(o[0] * n[0] + o[1] * n[1]) / size
    return along, o[2] + along * n[2]


def _first(arm: Arm, height: Fraction) -> Arm:
    """The first three joints, with the centre of the wrist as end point. The last turn moves nothing: it is there so
    that the field of the constants is that of the whole arm."""
    moving = [k for k, row in enumerate(arm.rows) if row.joint is not None]
    fourth = arm.rows[moving[3]]
    a, alpha = (fourth.a, fourth.alpha) if arm.convention is Convention.MODIFIED else (ZERO, Angle())
    turn = next(Angle(k) for k in (0, 2, 3, 1) if field_of((Angle(k),)) == arm.field)
    return Arm(arm.name, arm.convention, (*arm.rows[: moving[3]], Row(a, alpha, height, turn)))


def centre_at(wrist: Wrist, answer: Inverse) -> tuple[Any, ...]:
    """Where the centre of the wrist is at a pose, exactly."""
    pose: Matrix = tuple((*row, c) for row, c in zip(answer.rotation, answer.point, strict=True))
    return apply(product(pose, inverse(wrist.chain.constants[6])), (ZERO, ZERO, wrist.height))


def solve_wrist(wrist: Wrist, rules: Rules, here: Point, pose: Matrix) -> Iterator[Found]:
    """All solutions at a pose, whose entries are elements of the ring of ``rules``, which has the ``ROOTS`` here."""
    values = Evaluation(here)
    wanted = tuple(tuple(float(_number(v, rules).at(values, 53)) for v in row) for row in pose)
    based = fixed(pose, rules) @ fixed(inverse(wrist.chain.constants[6]), rules)
    centre, size = based.image((ZERO, ZERO, wrist.height))
    assert size.top.is_constant, "the scale of a pose is a number"
    target = [v * Fraction(size.bottom, size.top.constant_value()) for v in centre]

    @lru_cache(maxsize=len(TURNS))
    def reductions(k: int) -> Reduction:
        return geometry_of(wrist.first).reduce(rules.ring, target, TURNS[k])

    orthogonal = _is_orthogonal(wrist)
    for position in solve_at(wrist.first, here, (), reductions).solutions:
        over = _Turned(wrist, rules, wanted, based, position)
        choices = position.choices
        if not choices:
            yield from over.solutions()
            continue
        if not orthogonal:
            if position.quotients.count(None) > 1:
                raise Unable("joints before the wrist can be chosen: for which values it follows is not decided")
            choices = (Choice(choices[0].joint, over.reached(choices[0].joint)),)
        if choices[0].arcs != ():
            yield position.place, dict(enumerate((*position.quotients, None, None, None))), position.multiple, choices


def _number(value: Any, rules: Rules) -> Quotient:
    ratio = rules.number(value) if not isinstance(value, Ratio) else value
    return quotient(ratio, rules.number(1))


def _is_orthogonal(wrist: Wrist) -> bool:
    """Whether neighbouring axes of the wrist are orthogonal: then it reaches every rotation."""
    return all(is_zero(m[2][2]) for m in wrist.chain.constants[4:6])


@dataclass(frozen=True, eq=False)
class _Turned:
    """The wrist over one solution of the first three joints."""

    wrist: Wrist
    rules: Rules
    wanted: Matrix
    based: Scaled
    position: Solution

    def reached(self, free: int) -> tuple[Arc, ...] | None:
        """The angles of a joint before the wrist that can be chosen at which the wrist reaches the rotation."""
        place, ring = self._place(), self.rules.ring
        rules = replace(self.rules, squares={k: v for k, v in self.rules.squares.items() if k != ring.index[N]})
        t, one = Ratio(ring.var(N), 1, rules.field), rules.number(1)

        def attempt(turn: tuple[Fraction, Fraction]) -> tuple[Poly, Known]:
            norm, (_, c, s) = weights(t, one, turn)
            a, b, k, scale = self._fifth(self._rest(rules, {free: turned((c, s), norm)}))
            square = rules.tidy((a * a + b * b) * scale * scale - k * k)
            return square.top, (quotient(c, norm), quotient(s, norm))

        return by_turns(attempt, place, ring.index[N], 4)

    def _place(self) -> Evaluation:
        """Where everything but the root of the wrist is known."""
        here = self.position.place
        while here.point.depth < self.rules.ring.index[N]:  # no m was needed
            here = Evaluation(here.point.extend(RealAlgebraic.rational(ZERO)), here)
        return here

    def _rest(self, rules: Rules, turns: dict[int, Scaled]) -> Scaled:
        """What the wrist has to turn, by the turns of the joints that are not determined."""
        constants, kinds = self.wrist.chain.constants, self.wrist.chain.joints
        before = fixed(constants[0], rules).rotation
        for k, (known, constant) in enumerate(zip(self.position.quotients, constants[1:4], strict=True)):
            if kinds[k].motion is JointKind.REVOLUTE:
                before = before @ (turns[k] if known is None else self._turn(known))
            before = before @ fixed(constant, rules).rotation
        return before.inverse() @ self.based.rotation

    def _fifth(self, w: Scaled) -> tuple[Ratio, Ratio, Ratio, Ratio]:
        """a, b, k and the scale in a cos θ5 + b sin θ5 = k / scale."""
        constants, one = self.wrist.chain.constants, self.rules.number(1)
        r, n = constants[4][2], [row[2] for row in constants[5]]
        a, b = r[0] * n[0] + r[1] * n[1], r[1] * n[0] - r[0] * n[1]
        return one * a, one * b, w.rows[2][2] - w.scale * (r[2] * n[2]), w.scale

    def solutions(self) -> Iterator[Found]:
        """Two, one or none."""
        rules, constants, here = self.rules, self.wrist.chain.constants, self._place()
        w = self._rest(rules, {})
        fifth = rules.turn(*self._fifth(w), N)
        assert fifth is not None, "neighbouring axes of a wrist are not parallel"
        roots = roots_above(here.point, rules.ring.index[N], rules.ring.var(N) ** 2 - fifth.square.top) or []
        inner = fixed(constants[4], rules).rotation @ fifth.motion @ fixed(constants[5], rules).rotation
        fourth = _between([inner.rows[i][2] for i in range(2)], [w.rows[i][2] for i in range(2)], inner, w, rules)
        sixth = _between(inner.rows[2][:2], w.rows[2][:2], inner, w, rules, rows=True)
        for root in roots:
            there = here.extend(root)
            known: Joints = {**dict(enumerate(self.position.quotients)), 3: None, 4: fifth.pair, 5: None}
            choices: tuple[Choice, ...] = (Choice(3),)
            if there.point.sign(rules.tidy(dot(w.rows[2][:2], w.rows[2][:2])).top):
                known |= {3: fourth, 5: sixth}
                choices = ()
                self._confirm(there, known)
            yield there, known, self.position.multiple or len(roots) == 1, choices

    def _turn(self, known: tuple[Quotient, ...]) -> Scaled:
        return turned(self.rules.numbers(known), self.rules.number(known[0].bottom))

    def _confirm(self, there: Evaluation, known: Joints) -> None:
        """Forward kinematics in floating point: a slip of the derivation would show."""
        constants = [_floats(m) for m in self.wrist.chain.constants]
        whole = constants[0]
        for k, constant in enumerate(constants[1:]):
            values = [float(q.at(there, 53)) for q in known[k] or ()]
            moved = motion(self.wrist.chain.joints[k], values if len(values) > 1 else values[0])
            whole = product(product(whole, moved), constant)
        pairs = [pair for rows in zip(whole, self.wanted, strict=True) for pair in zip(*rows, strict=True)]
        if any(abs(result - wanted) > CLOSE * (1 + abs(wanted)) for result, wanted in pairs):
            raise InternalError("the solutions at a pose contradict the forward kinematics")


def _floats(m: Matrix) -> Matrix:
    return tuple(tuple(map(float, row)) for row in m)


def _between(
    a: Sequence[Any], b: Sequence[Any], inner: Scaled, w: Scaled, rules: Rules, *, rows: bool = False
) -> tuple[Quotient, ...]:
    """Cosine and sine of the turn that takes a (over the scale of ``inner``) to b (over that of ``w``): from the left
    for columns, from the right for rows."""
    (x, y), (u, v) = (b, a) if rows else (a, b)
    below = rules.tidy((dot(b, b)) * inner.scale)
    cosine, sine = rules.tidy((x * u + y * v) * w.scale), rules.tidy((x * v - y * u) * w.scale)
    return turned((cosine, sine), below).pair
