"""Joint positions at a pose: three parallel axes, alone, with a slide or in an arm of six joints; spherical wrists.

T = A0 M1 A1 ... M6 A6 is the pose. Three parallel axes (2, 3, 4, and 5 and 6 meet; or so read from the hand to the
base; D. L. Pieper 1968): with B = A0^-1 T A6^-1, Π = M2 A2 M3 A3 M4, a motion of a plane that takes heights z to h ± z,
n = A1 e_z and C = B h6 = M1 A1 Π A4 h5 the point in which axes 5 and 6 meet,

    the height of A1^-1 M1^-1 C gives θ1,    e_z·B^T M1 n = ± (A4^T e_z)·(M5 A5 e_z) gives θ5,    B^T M1 n then θ6,

and Π is known: a motion of that plane. |Π 0| = |A2 M3 A3 0| gives θ3, the direction of Π 0 θ2, Π e_x then θ4. A
spherical wrist (axes 4, 5, 6 meet): the pose gives that point, three joints bring it there, and W = M4 A4 M5 A5 M6 is
known: e_z·W e_z gives θ5, W e_z then θ4, the last row of W θ6. Every step is equivalent to the part of the pose that it
names, and gives one angle, or the solutions of a cos θ + b sin θ = k, in square roots over what is known before.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.families import Arcs, Position, bounded
from bezier.proofs.nested_roots import JointValue, Nested, Vector, Wave, angle, basis, nested, turns
from bezier.proofs.square_roots import ONE, ZERO, Motion, Surd, Triple, back, dot, image, together
from qe.errors import Unable
from qe.options import Budget
from qe.proof.entry import Entry

FREE = "a joint can be chosen here"
ORIGIN = (ZERO, ZERO, ZERO)
Axes = tuple[Sequence[Surd], Sequence[Surd]]
"""Of the joint before, seen after the constant motion behind it, and of the one after, seen before that in front."""


class OtherShape(Unable):
    """The arm is none of these."""


def parallel_axes(chain: ArmChain, pose: Motion, entry: Entry, budget: Budget) -> list[Position]:
    """All positions of an arm with three parallel axes. Raises ``OtherShape`` for another one."""
    if all(chain.turns):
        if len(chain.turns) == 3 and _are_parallel(chain.constants[1:3]):
            return list(_in_plane(chain.constants[1:3], based_on(chain.constants, pose)))
        if len(chain.turns) == 6:
            if has_parallel_axes(chain):
                return list(_six_joints(chain.constants, pose, entry, budget))
            if has_parallel_axes(chain.reversed):
                return [p.backwards for p in _six_joints(chain.reversed.constants, back(pose), entry, budget)]
    upright = not any(m[0][0][2] or m[0][1][2] for m in chain.constants[1:4])  # axes of one direction or its opposite
    if len(chain.turns) == 4 and sum(chain.turns) == 3 and upright:
        return list(_with_slide(chain, pose))
    raise OtherShape("poses are for three parallel axes, alone or with two that meet, and for spherical wrists")


def _with_slide(chain: ArmChain, pose: Motion) -> Iterator[Position]:
    """Three parallel joints and one that slides along their axes: d in A M(θ) ... Tz(d) ... moves the end by d times
    the direction of the axes and does nothing else, so the height alone tells it, and the rest is as without it."""
    k, constants = chain.turns.index(False), chain.constants
    merged = (*constants[:k], together(constants[k], constants[k + 1]), *constants[k + 2 :])
    if not _are_parallel(merged[1:3]):
        raise OtherShape("two axes are one")
    axis = constants[0]
    for m in constants[1 : k + 1]:
        axis = together(axis, m)
    based = based_on(merged, pose)
    slide = tuple(row[2] for row in axis[0])
    sign = dot(slide, [row[2] for row in merged[0][0]])
    length = sign * (based[1][2] - _height(merged[1:3])[0])
    lowered = based[0], (*based[1][:2], based[1][2] - sign * length)
    slid = JointValue(nested(length), None, nested(ONE))
    for result in _in_plane(merged[1:3], lowered):
        joints = [*result.joints[:k], slid, *result.joints[k:]]
        yield Position(joints, {j + (j >= k): arcs for j, arcs in result.chosen.items()})


def _are_parallel(pair: Sequence[Motion]) -> bool:
    """And no neighbours coincide."""
    return all(not (m[0][0][2] or m[0][1][2]) and (m[1][0] or m[1][1]) for m in pair)


def has_parallel_axes(chain: ArmChain) -> bool:
    """Whether axes 2, 3, 4 of six are parallel and 5 and 6 meet."""
    before, *pair, after, last = chain.constants[1:6]
    bent = (before[0][0][2] or before[0][1][2]) and (after[0][2][0] or after[0][2][1])
    return bool(bent) and _are_parallel(pair) and meeting(last) is not None


def meeting(m: Motion) -> tuple[Surd, Surd] | None:
    """Heights of the point that two axes share, on the second and on the first of them; None where there is none, or
    more than one. ``m``: what lies between the two joints."""
    (x, y, z), o = [row[2] for row in m[0]], m[1]
    size = x * x + y * y
    if not size or o[0] * y - o[1] * x:
        return None
    along = -(o[0] * x + o[1] * y) * size.inverse()
    return along, o[2] + along * z


def _height(pair: Sequence[Motion]) -> tuple[Surd, Surd]:
    """(h, ±1): Π takes a height z to h ± z."""
    (second, shift), (third, other) = pair
    return shift[2] + second[2][2] * other[2], second[2][2] * third[2][2]


def _vector(values: Sequence[Surd], unit: Nested, is_point: bool = False) -> Vector:
    x, y, z = (unit.by(v) for v in values)
    return Vector((x, y, z), unit, is_point)


UNITS = nested(ONE)


def _six_joints(constants: Sequence[Motion], pose: Motion, entry: Entry, budget: Budget) -> Iterator[Position]:
    based = based_on(constants, pose)
    a, b, k = first_wave(constants, based)
    if not (a or b):
        if not k:
            raise entry.fail(FREE)
        return
    for first in turns(*(nested(v) for v in (a, b, k, ONE))):
        budget.check()
        yield from SixJoints(constants, based, first).positions()


def first_wave(constants: Sequence[Motion], based: Motion) -> Triple:
    """a, b and k in the equation of the first joint; where all are 0 it can be chosen."""
    _, before, *pair, after, last, _ = constants
    heights = meeting(last)
    assert heights is not None, "the shape was tested"
    (height, side), n = _height(pair), tuple(row[2] for row in before[0])
    x, y, z = image(based, (ZERO, ZERO, heights[0]))
    k = side * image(after, (ZERO, ZERO, heights[1]))[2] + height + dot(n, before[1]) - n[2] * z
    return n[0] * x + n[1] * y, n[0] * y - n[1] * x, k


def based_on(constants: Sequence[Motion], pose: Motion) -> Motion:
    """B of the derivation above."""
    return together(together(back(constants[0]), pose), back(constants[-1]))


@dataclass(frozen=True, slots=True)
class SixJoints:
    """What follows from the first of six joints with three parallel axes."""

    constants: Sequence[Motion]
    based: Motion
    first: JointValue

    @property
    def axes(self) -> Vector:
        """The direction of the parallel axes seen from the end effector."""
        normal = _vector([row[2] for row in self.constants[1][0]], self.first.w.unit)
        return normal.turned(self.first).moved(back((self.based[0], ORIGIN)))

    def fifth(self, u: Vector) -> Wave:
        """The equation of the fifth joint, by ``axes``."""
        _, _, *pair, after, last, _ = self.constants
        height = u.parts[2].by(_height(pair)[1])
        return _turning((after[0][2], [row[2] for row in last[0]]), height, u.scale, self.first.w.unit)

    def seen(self, fifth: JointValue) -> Vector:
        """The direction of the parallel axes seen from joint 6."""
        _, _, *pair, after, last, _ = self.constants
        (_, side), unit = _height(pair), self.first.w.unit
        return _vector([side * c for c in after[0][2]], unit).turned(fifth, -1).moved(back(last))

    def middle(self, start: Sequence[Surd], is_point: bool, fifth: JointValue, sixth: JointValue) -> Vector:
        """What Π makes of a point or a direction."""
        _, before, _, _, after, last, _ = self.constants
        near = _vector(start, self.first.w.unit, is_point).moved(back(after)).turned(fifth, -1)
        near = near.moved(back(last)).turned(sixth, -1).moved(self.based)
        return near.turned(self.first, -1).moved(back(before))

    def positions(self) -> Iterator[Position]:
        """All of them."""
        u, pair = self.axes, self.constants[2:4]
        for fifth in turns(*self.fifth(u)):
            w = self.seen(fifth)
            sixth = angle(u.parts, w.parts, (u.scale, w.scale))
            if sixth is None:
                joints = basis(self.first.w.unit)
                arcs = _closed(pair, [self.middle(ORIGIN, True, fifth, joint) for joint in joints])
                if arcs != ():
                    yield Position([self.first, None, None, None, fifth, None], {5: arcs})
                continue
            e_x = self.middle((ONE, ZERO, ZERO), False, fifth, sixth)
            for three in _three(pair, self.middle(ORIGIN, True, fifth, sixth), e_x):
                chosen = {k + 1: v for k, v in three.chosen.items()}
                yield Position([self.first, *three.joints, fifth, sixth], chosen)


def _closed(pair: Sequence[Motion], shifts: Sequence[Vector]) -> Arcs:
    """The θ6 for which the parallel joints can follow, where axis 6 is parallel to theirs: Π 0 = c x + s y + z, c and s
    of θ6, x and y orthogonal and equally long, and its length between the difference and the sum of those of A2 and A3,
    (|Π 0|² - |A2 0|² - |A3 0|²)² <= 4 |A2 0|² |A3 0|²."""
    x, y, z = (v.parts[:2] for v in shifts)
    if dot(x, y).sign() or (dot(x, x) - dot(y, y)).sign():
        raise Unable("the last axis is not parallel to the three")
    (_, o), (_, p) = pair
    second, third = dot(o[:2], o[:2]), dot(p[:2], p[:2])
    squared, two, four = shifts[2].scale * shifts[2].scale, Surd.rational(2), Surd.rational(4)
    size = dot(x, x) + dot(z, z) - squared.by(second + third)
    return bounded(dot(x, z).by(two), dot(y, z).by(two), size, (squared * squared).by(four * second * third))


def _in_plane(pair: Sequence[Motion], based: Motion) -> Iterator[Position]:
    (rows, shift), (height, side) = based, _height(pair)
    if rows[2][0] or rows[2][1] or rows[2][2] - side or shift[2] - height:
        return
    yield from _three(pair, _vector(shift, UNITS, True), _vector([row[0] for row in rows], UNITS))


def _three(pair: Sequence[Motion], x: Vector, d: Vector) -> Iterator[Position]:
    """The parallel joints, by what Π does to the origin (x) and to e_x (d). Where Π leaves the origin in its place the
    first one can be chosen, and the last one follows."""
    for elbow in turns(*elbow_wave(pair, x)):
        f = _vector(pair[1][1], x.scale.unit, True).turned(elbow).moved(pair[0])
        shoulder = angle(f.parts, x.parts, (f.scale, x.scale))
        if shoulder is None:
            yield Position([None, elbow, None], {0: None})
            continue
        e = d.turned(shoulder, -1).moved(back(pair[0])).turned(elbow, -1).moved(back(pair[1]))
        yield Position([shoulder, elbow, JointValue(e.parts[0], e.parts[1], e.scale)])


def _turning(axes: Axes, height: Nested, scale: Nested, unit: Nested) -> Wave:
    """The equation of the joint between two others: how far a direction along the axis of one goes along the other."""
    r, n = axes
    a, b = unit.by(r[0] * n[0] + r[1] * n[1]), unit.by(r[1] * n[0] - r[0] * n[1])
    return a, b, height - scale.by(r[2] * n[2]), scale


def elbow_wave(pair: Sequence[Motion], x: Vector) -> Wave:
    """The equation of the second of the parallel joints: how far Π moves the origin, to x."""
    ((rows, o), (_, p)), two = pair, Surd.rational(2)
    g = [dot(column[:2], o[:2]) for column in zip(*rows, strict=True)]
    squared, unit = x.scale * x.scale, x.scale.unit
    k = dot(x.parts[:2], x.parts[:2]) - squared.by(dot(o[:2], o[:2]) + dot(p[:2], p[:2]))
    return unit.by(two * dot(g[:2], p[:2])), unit.by(two * (g[1] * p[0] - g[0] * p[1])), k, squared


# --- spherical wrists --------------------------------------------------------------------------------------------
def centre(chain: ArmChain) -> tuple[Surd, Surd] | None:
    """Heights of the centre of the wrist on axes 4 and 6."""
    if len(chain.turns) != 6 or not all(chain.turns[3:]):
        return None
    between, beyond = meeting(chain.constants[4]), meeting(chain.constants[5])
    if between is None or beyond is None or between[0] - beyond[1]:
        return None
    return between[1], beyond[0]


def wrist(chain: ArmChain, pose: Motion, arm: Position, entry: Entry) -> Iterator[Position]:
    """The last three joints, over a position of the first three, or over a family of them."""
    joints = arm.joints
    r, n = _wrist_axes(chain)
    if arm.chosen and not (r[2] or n[2]):  # neighbouring axes of the wrist are orthogonal: it reaches every rotation
        yield Position([*joints, None, None, None], arm.chosen)
        return
    if (open_ones := [k for k in range(3) if joints[k] is None])[1:]:
        raise entry.fail(FREE)
    unit = next(joint.w.unit for joint in joints if joint is not None)
    end = together(pose, back(chain.constants[6]))
    if not open_ones:
        yield from _three_of_wrist(chain, end, [joint for joint in joints if joint is not None], entry)
        return
    columns = [_sixth_axis(chain, end, [joint or other for joint in joints], unit) for other in basis(unit)]
    waves = [_turning((r, n), column.parts[2], column.scale, unit) for column in columns]
    a, b, _, scale = waves[2]
    cosine, sine, rest = (wave[2] for wave in waves)
    arcs = bounded(cosine, sine, rest, (a * a + b * b) * scale * scale)
    if arcs != ():
        yield Position([*joints, None, None, None], {open_ones[0]: arcs})


def _wrist_axes(chain: ArmChain) -> Axes:
    """Axis 4 seen after the constant motion behind it, and axis 6 seen before the one in front of it."""
    return chain.constants[4][0][2], [line[2] for line in chain.constants[5][0]]


def _sixth_axis(chain: ArmChain, end: Motion, first: Sequence[JointValue], unit: Nested) -> Vector:
    """W e_z: axis 6 seen from the third link, where W is what the wrist has to do after the first three joints."""
    column = _vector([row[2] for row in end[0]], unit)
    for joint, constant in zip(first, chain.constants, strict=False):
        column = column.moved(back(constant)).turned(joint, -1)
    return column.moved(back(chain.constants[3]))


def _three_of_wrist(chain: ArmChain, end: Motion, known: Sequence[JointValue], entry: Entry) -> Iterator[Position]:
    """The joints of the wrist over a position of the first three: θ5 by the angle of axes 4 and 6, then the others."""
    constants, unit = chain.constants, known[0].w.unit
    r, n = _wrist_axes(chain)
    column = _sixth_axis(chain, end, known, unit)
    row = _vector([line[2] for line in constants[3][0]], unit)  # W^T e_z
    for joint, constant in zip(known[::-1], constants[2::-1], strict=True):
        row = row.turned(joint).moved(constant)
    row = row.moved(back(end))
    for fifth in turns(*_turning((r, n), column.parts[2], column.scale, unit)):
        bent = _vector(n, unit).turned(fifth).moved(constants[4])
        line = _vector(r, unit).turned(fifth, -1).moved(back(constants[5]))
        fourth = angle(bent.parts, column.parts, (bent.scale, column.scale))
        sixth = angle(row.parts, line.parts, (row.scale, line.scale))
        if (fourth is None) != (sixth is None):
            raise entry.fail("axes 4 and 6 are in line, and are not")
        yield Position([*known, fourth, fifth, sixth], {} if fourth is not None else {3: None})
