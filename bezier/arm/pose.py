"""Inverse kinematics at a pose (a point and an orientation), exactly.

Planar arms with three joints, also with a fourth one that slides along their axes; arms with six joints whose axes 2,
3, 4 are parallel and whose axes 5 and 6 meet (or the same read from the hand back to the base), like the myCobot 280
(arXiv 2509.00823) and the UR arms; spherical wrists behind three joints. The derivation is that of the rule "joint
positions" (``bezier.proofs.inverse_pose``), in its numbers; what it takes from here are the real roots of the equation
of the first three joints, and the forward kinematics of all solutions are compared with the pose in floating point.

Where axes 5 and 6 of six joints meet on axis 1, θ1 can be chosen, and the other joints follow it. Whether they can is
asked of t = tan(θ1/2) alone: m2² and m3² = p + q m2, the squares of the roots that θ5 and θ3 need, are polynomials in
t, and between the zeros of these, of p, q, p² - q² m2² and of what leaves θ6 free nothing changes; so one t between
each two, these zeros and θ1 = π decide.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial, reduce
from operator import mul
from typing import Any

from bezier.arm.choices import BITS, MOST_BITS, Choice, Exact, Value
from bezier.arm.elimination import TURNS
from bezier.arm.inverse import Inverse, Solution, check_kinematics, exact_number, listed, solution_of
from bezier.arm.model import Arm
from bezier.arm.roots_of_squares import roots_of, surds
from bezier.curves.scalar import rational
from bezier.proofs import inverse_pose
from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.families import Arcs, Position, arcs_of, arcs_over
from bezier.proofs.inverse_position import positions_of
from bezier.proofs.nested_roots import NO_ROOT, JointValue, Nested, Place, Root, nested, square, turn_between, turn_by
from bezier.proofs.square_roots import ONE, ZERO, Motion, Polynomial, Triple, back, is_motion
from bezier.proofs.three_joints import Positions
from qe.errors import CertificateRejected, InputError, Unable
from qe.exact.nearby import rational_between
from qe.exact.point_values import Ball, angle
from qe.options import Budget
from qe.proof.entry import Entry, Json

Rotation = tuple[tuple[Any, ...], ...]
NEEDED = (
    "a spherical wrist, or three parallel axes, alone, with a joint that slides along them, or with two neighbouring"
    " axes that meet after one before"
)


def rotation_of(quaternion: Sequence[Any]) -> Rotation:
    """The rotation of a quaternion (w, x, y, z) that is not zero; its length does not matter. Exact."""
    numbers = [rational(exact_number(v, "quaternion")) for v in listed(quaternion, "quaternion: four numbers")]
    if len(numbers) != 4:
        raise InputError(f"quaternion: four numbers (w, x, y, z) expected, {len(numbers)} found")
    w, x, y, z = numbers
    if w is None or x is None or y is None or z is None:
        raise InputError("quaternion: rational numbers expected; its length does not matter")
    size = w * w + x * x + y * y + z * z
    if size == 0:
        raise InputError("quaternion: four numbers expected that are not all 0")
    doubled = 2 / size
    return (
        (1 - doubled * (y * y + z * z), doubled * (x * y - w * z), doubled * (x * z + w * y)),
        (doubled * (x * y + w * z), 1 - doubled * (x * x + z * z), doubled * (y * z - w * x)),
        (doubled * (x * z - w * y), doubled * (y * z + w * x), 1 - doubled * (x * x + y * y)),
    )


def solve_pose(arm: Arm, point: Sequence[Any], rotation: Sequence[Sequence[Any]]) -> Inverse:
    """All solutions at a pose: ``point`` (mm) and the axes of the end effector as the columns of ``rotation``.

    Exact numbers that are sums of square roots. Raises ``Unable`` for an arm of another shape, for other numbers, and
    where the pose leaves a joint free and it is not decided whether there are solutions; ``InputError`` for what is no
    pose.
    """
    expected = "pose: three coordinates and three rows of three numbers"
    point, rotation = listed(point, expected), [listed(row, expected) for row in listed(rotation, expected)]
    if len(point) != 3 or len(rotation) != 3 or any(len(row) != 3 for row in rotation):
        raise InputError(f"{expected} expected")
    numbers = tuple(exact_number(v, "point") for v in point)
    rows = tuple(tuple(exact_number(v, "rotation") for v in row) for row in rotation)
    chain, pose = arm.chain, motion_of(numbers, rows)
    is_wrist = inverse_pose.centre(chain) is not None
    if not is_motion(pose):
        raise InputError("rotation: a matrix with orthogonal columns of length 1 and determinant 1 expected")
    try:
        placed = _by_wrist(chain, pose) if is_wrist else _by_parallel_axes(chain, pose)
        solutions = [_solution(arm, position, multiple) for position, multiple in placed]
    except inverse_pose.OtherShape:
        raise Unable(f"inverse kinematics at a pose needs {NEEDED}; {arm.name} is none") from None
    check_kinematics(arm, solutions, numbers, *zip(*rows, strict=True))
    result = tuple(sorted(solutions, key=lambda s: [v for v in s.angles if v is not None]))
    names = [joint.name for joint in arm.joints]
    free = {name for s in result for name, v in zip(names, s.values, strict=True) if v is None}
    way = -1 if not is_wrist and len(names) == 6 and not inverse_pose.has_parallel_axes(chain) else 1
    named = {_named(names[::way], s.values[::way], is_wrist) for s in result if None in s.values}
    cases = (*sorted(named), *("two solutions meet: the arm is singular here",) * any(s.multiple for s in result))
    return Inverse(arm, numbers, result, tuple(n for n in names if n in free), cases, rows)


def motion_of(point: Sequence[Any], rotation: Sequence[Sequence[Any]]) -> Motion:
    """The pose in these numbers. Raises ``Unable`` for numbers that are no sums of square roots."""
    a, b, c = (surds(row) for row in rotation)
    return (a, b, c), surds(point)


def _named(names: Sequence[str], values: Sequence[Any], is_wrist: bool) -> str:
    """What is special where joints are free; names and values in the direction of the derivation."""
    free = [k for k, value in enumerate(values) if value is None]
    if is_wrist:
        if free == [3, 5]:
            return f"the axes of {names[3]} and {names[5]} are in line"
        place = f"on the axis of {names[0]}" if free[0] == 0 else f"where {names[free[0]]} does not move it"
        return f"the centre of the wrist is {place}"
    if len(free) == 2:
        return f"the axes of {names[free[0]]} and {names[free[1]]} coincide"
    if free[0] == 0:
        return f"the axes of {names[4]} and {names[5]} meet on the axis of {names[0]}"
    return f"the axis of {names[5]} is parallel to those of {names[1]}, {names[2]} and {names[3]}"


# --- three parallel axes ---------------------------------------------------------------------------------------------
Placed = Iterator[tuple[Position, bool]]
"""Positions, and whether two solutions meet in one."""
WHERE = Entry(None, "pose")


def _by_parallel_axes(chain: ArmChain, pose: Motion) -> Placed:
    is_ahead = len(chain.turns) == 6 and inverse_pose.has_parallel_axes(chain)
    if is_ahead or (len(chain.turns) == 6 and inverse_pose.has_parallel_axes(chain.reversed)):
        constants, there = (chain.constants, pose) if is_ahead else (chain.reversed.constants, back(pose))
        based = inverse_pose.based_on(constants, there)
        if not any(inverse_pose.first_wave(constants, based)):
            whole = Position([None] * 6, {0: _followed(constants, based)})
            if whole.chosen[0] != ():
                yield whole if is_ahead else whole.backwards, False
            return
    yield from (
        (position, _is_double(position)) for position in inverse_pose.parallel_axes(chain, pose, WHERE, Budget())
    )


def _is_double(position: Position) -> bool:
    return any(joint is not None and joint.is_double for joint in position.joints)


def _followed(constants: Sequence[Motion], based: Motion) -> Arcs:
    """The angles of the first joint that the other joints can follow."""
    t, one = Polynomial((ZERO, ONE)), Polynomial((ONE,))

    def turned(at: Callable[[Polynomial], Any]) -> JointValue:
        c, s, w = (nested(at(v)) for v in (one - t * t, t + t, one + t * t))
        return JointValue(c, s, w)

    def holds(first: JointValue) -> bool:
        return any(True for _ in inverse_pose.SixJoints(constants, based, first).positions())

    six = inverse_pose.SixJoints(constants, based, turned(lambda v: v))
    u = six.axes
    second = square(six.fifth(u))
    key = frozenset({Root(second)})
    fifth = turn_by(six.fifth(u), Nested({key: one}))
    w = six.seen(fifth)
    sixth = turn_between(u.parts, w.parts, (u.scale, w.scale))
    third = square(inverse_pose.elbow_wave(constants[2:4], six.middle(inverse_pose.ORIGIN, True, fifth, sixth))).terms
    p, q, m2 = (terms.get(k, Polynomial()) for terms, k in ((third, NO_ROOT), (third, key), (second.terms, NO_ROOT)))
    below = (u.parts[0] * u.parts[0] + u.parts[1] * u.parts[1]).terms.get(NO_ROOT, Polynomial())
    marks = roots_of(reduce(mul, (f for f in (m2, below, p * p - q * q * m2, p, q) if f), one))
    below_and_above = [None, *(end for mark in marks for end in mark.between), None]
    samples = [rational_between(*pair) for pair in zip(below_and_above[::2], below_and_above[1::2], strict=True)]
    ends = [JointValue(nested(-ONE), nested(ZERO), nested(ONE)), *(turned(mark.value) for mark in marks)]
    after = [holds(turned(partial(Polynomial.at, x=sample))) for sample in samples]
    return arcs_of(ends, list(map(holds, ends)), after)


# --- spherical wrists ------------------------------------------------------------------------------------------------
def first_three(chain: ArmChain, place: Triple, pose: Motion | None) -> Iterator[tuple[Json, Positions]]:
    """The equation of three joints for one φ after the other, of which it is written down (``TURNS``): all but those
    that its angle may miss a solution of."""
    for turn in (None, *TURNS):
        written: Json = None if turn is None else [str(v) for v in turn]
        try:
            yield written, positions_of(chain, place, pose, Entry(written, "turn"))
        except CertificateRejected:
            continue


def is_family(positions: Positions, roots: Sequence[Place]) -> bool:
    """Whether the third joint can be chosen."""
    p = positions.equation
    samples = [roots[0].between[0], *(root.between[1] for root in roots)] if roots else [Fraction(0)]
    return positions.only_at_roots and (not p or any(p.at(x).sign() > 0 for x in samples))


def _by_wrist(chain: ArmChain, pose: Motion) -> Placed:
    _, positions = next(first_three(chain, pose[1], pose))
    equation, third = positions.equation, positions.both.third
    roots = roots_of(equation) if equation else []
    if is_family(positions, roots):
        if len(third) < 2:
            raise Unable("a joint that slides can be chosen: for which values the wrist follows is not decided")
        arm = positions.third_chosen(arcs_over(equation, third, positions.both.norm, roots) if equation else None)
        yield from ((whole, False) for whole in _with_wrist(chain, pose, arm))
        return
    for place in roots:
        is_multiple = positions.only_at_roots or not place.value(equation.derivative).sign()
        arms = list(positions.over(place))
        is_multiple = is_multiple or (positions.square is not None and len(arms) == 1)
        for arm in arms:
            yield from ((whole, is_multiple or _is_double(whole)) for whole in _with_wrist(chain, pose, arm))


def _with_wrist(chain: ArmChain, pose: Motion, arm: Position) -> Iterator[Position]:
    try:
        yield from inverse_pose.wrist(chain, pose, arm, WHERE)
    except CertificateRejected:
        raise Unable("joints before the wrist can be chosen: for which values it follows is not decided") from None


# --- solutions -------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class OverRoots(Exact):
    """In the numbers of the checker."""

    def value(self, bits: int = BITS) -> Value:
        working = bits + 32
        while working <= 4 * MOST_BITS:
            working *= 2
            ends = self.joint.intervals(working)
            if ends is not None and all(high - low < Fraction(1, 2 << bits) for low, high in ends):
                balls = [Ball.around(pair, bits + 64) for pair in ends]
                if self.joint.s is None:
                    return Value(balls[0])
                return Value(angle(balls[0], balls[1], bits), (balls[0], balls[1]))
        raise Unable("a joint is not known to enough digits")

    def sign(self, number: Nested) -> int:
        return number.sign()


def _solution(arm: Arm, position: Position, multiple: bool) -> Solution:
    exact = [None if joint is None else OverRoots(joint) for joint in position.joints]
    choices = []
    for k, arcs in sorted(position.chosen.items()):
        ends = {end: OverRoots(end) for arc in arcs or () for end in arc}
        choices.append(Choice(k, None if arcs is None else tuple((ends[low], ends[high]) for low, high in arcs)))
    return solution_of(arm, exact, multiple, choices)
