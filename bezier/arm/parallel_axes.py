"""Inverse kinematics at a pose (a point and an orientation): arms with three neighbouring parallel axes.

Planar arms with three joints, also with a fourth one that slides along their axes, and arms with six joints whose axes
2, 3, 4 are parallel and whose axes 5 and 6 meet (or the same read from the hand back to the base), like the myCobot 280
(arXiv 2509.00823) and the UR arms. With
T = A0 M1 A1 (M2 A2 M3 A3 M4) A4 M5 A5 M6 A6, P' = A0^-1 T A6^-1, Π the part in brackets, a motion of a plane, n1 the
axis of joint 2 seen from joint 1 and C the point in which axes 5 and 6 meet, which the pose alone gives:

    the height of C above that plane:    a cos θ1 + b sin θ1 = k,
    e_z·(Π's axis seen from joint 6):    a cos θ5 + b sin θ5 = k,    and then θ6 from its other two components,
    the length of Π's translation:       a cos θ3 + b sin θ3 = k,    and then θ2 from its direction, θ4 from its turn.

Each line is equivalent to the part of the pose that it names, so nothing is lost and nothing added. a cos θ + b sin θ
= k holds iff (cos θ, sin θ) = (a k - b m, b k + a m)/(a² + b²), m² = a² + b² - k²: a tower of three square roots, in
which all signs are exact. At most eight solutions; the forward kinematics of all are compared with the pose exactly.

Where C is on axis 1, θ1 can be chosen, and the other joints follow it. Whether they can is asked of t = tan(θ1/2)
alone: m2² and m3² = p + q m2 are polynomials in t, and between the zeros of these, of p, q and p² - q² m2² nothing
changes; so one t between each two, these zeros and θ1 = π decide.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

from bezier.arm.choices import Arc, Choice, Known, RangeEnd, arcs_of, by_turns
from bezier.arm.elimination import Quotient, quotient, weights
from bezier.arm.model import Arm, Chain, JointKind, Matrix, apply, inverse, product
from bezier.arm.ratio import Ratio, reduced
from bezier.arm.roots_of_squares import Rules, Scaled, Turn, fixed, turned
from bezier.arm.wrist import Found, Joints, meeting
from bezier.curves.scalar import dot, is_zero
from qe.errors import InternalError, Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.nearby import rational_between
from qe.exact.point_values import Evaluation, roots_above
from qe.exact.ring import Poly
from qe.exact.sample import Point

ROOTS = ("m1", "m2", "m3")
ZERO = Fraction(0)


@dataclass(frozen=True)
class ParallelShape:
    """Which of the arms above: ``chain`` read in the direction of the derivation; ``first``: the place of the first of
    the three parallel axes, 0 (three joints) or 1 (six joints). ``slide``: the place and the direction, seen from the
    base, of a joint that slides along three parallel axes; it is left out of the chain."""

    chain: Chain
    is_reversed: bool
    first: int
    slide: tuple[int, tuple[Any, ...]] | None = None


def shape_of(arm: Arm) -> ParallelShape:
    """Raises ``Unable`` for an arm that the derivation does not fit."""
    chain = arm.chain
    needed = (
        "a spherical wrist, or three parallel axes, alone, with a joint that slides along them, or with two"
        " neighbouring axes that meet after one before"
    )
    refused = Unable(f"inverse kinematics at a pose needs {needed}; {arm.name} is none")
    sliding = [k for k, joint in enumerate(chain.joints) if joint.motion is JointKind.PRISMATIC]
    if len(chain.joints) == 4 and len(sliding) == 1 and (shape := _with_slide(chain, sliding[0])) is not None:
        return shape
    if sliding:
        raise refused
    if len(chain.joints) == 3 and _are_parallel(chain, 0):
        return ParallelShape(chain, False, 0)
    if len(chain.joints) == 6:
        backwards = Chain(tuple(inverse(m) for m in reversed(chain.constants)), chain.joints[::-1])
        for one, is_reversed in ((chain, False), (backwards, True)):
            if _are_parallel(one, 1) and _meet(one) is not None:
                return ParallelShape(one, is_reversed, 1)
    raise refused


def _with_slide(chain: Chain, k: int) -> ParallelShape | None:
    """Three parallel joints and one that slides along them, as in a SCARA arm: its length moves nothing else."""
    between = chain.constants[1:4]
    if any(not is_zero(m[i][2]) for m in between for i in range(2)):
        return None
    axis, merged = chain.constants[0], product(chain.constants[k], chain.constants[k + 1])
    for m in between[:k]:
        axis = product(axis, m)
    rest = Chain((*chain.constants[:k], merged, *chain.constants[k + 2 :]), (*chain.joints[:k], *chain.joints[k + 1 :]))
    return ParallelShape(rest, False, 0, (k, tuple(row[2] for row in axis))) if _are_parallel(rest, 0) else None


def _are_parallel(chain: Chain, first: int) -> bool:
    """Whether three axes are parallel, and no neighbours of them coincide."""
    pairs = (chain.constants[first + 1], chain.constants[first + 2])
    return all(is_zero(m[i][2]) for m in pairs for i in range(2)) and all(
        any(not is_zero(m[i][3]) for i in range(2)) for m in pairs
    )


def _meet(chain: Chain) -> tuple[Any, Any] | None:
    """Where axes 5 and 6 meet: heights along axis 6 and along axis 5; None where they do not, or where axis 1 is
    parallel to axis 2, or axis 4 to axis 5."""
    bent = [chain.constants[1][i][2] for i in range(2)], [chain.constants[4][2][i] for i in range(2)]
    return None if any(all(map(is_zero, pair)) for pair in bent) else meeting(chain.constants[5])


@dataclass(frozen=True, eq=False)
class _Parallel:
    """Where ``below`` vanishes the last axis is parallel to the three parallel ones, and its joint can be chosen: the
    parallel ones follow where ``elbow``, a polynomial of degree 4 in the tangent of half its angle, is not negative."""

    below: Poly
    elbow: Callable[[tuple[Fraction, Fraction]], tuple[Poly, Known]]
    var: int

    def arcs(self, place: Evaluation) -> tuple[Arc, ...] | None:
        """The angles of the last joint for which there are solutions."""
        return by_turns(self.elbow, place, self.var, 4)


Stage = tuple[str, Poly, _Parallel | None]


@dataclass(frozen=True, eq=False)
class _Tower:
    """The solutions at one pose as functions of the roots."""

    stages: tuple[Stage, ...]
    """The name of a root, its square, and what leaves the last joint free where it is known."""
    joints: Mapping[int, tuple[Quotient, ...]]
    size: Poly
    """The square of the length of Π's translation: where it vanishes, the first and the last of the parallel joints
    are free."""


@dataclass(frozen=True, eq=False)
class PoseSearch:
    """The solutions at one pose, root by root of the tower."""

    shape: ParallelShape
    rules: Rules
    pose: Scaled

    def solutions(self, place: Point) -> Iterator[Found]:
        """Every solution once."""
        if self.shape.slide is not None:
            yield from self._slid(*self.shape.slide, place)
            return
        if self.shape.first == 0:
            tower = self._planar_arm(place)
        else:
            k, first = self._first(place)
            if first is None:
                if place.sign(k.top) == 0 and (arcs := self._followed(place)) != ():
                    yield Evaluation(place), dict.fromkeys(range(6)), False, (Choice(0, arcs),)
                return
            stage: Stage = (ROOTS[0], first.square.top, None)
            tower = self._after_first(first.motion, first.scale, [stage], {0: first.pair})
        if tower is None:
            return
        for _ in range(self.rules.ring.index[tower.stages[0][0]] - place.depth):  # a planar arm has no roots before
            place = place.extend(RealAlgebraic.rational(ZERO))
        defects = self._defects(tower.joints)
        for here, multiple in self._leaves(Evaluation(place), tower.stages):
            joints: Joints = dict(tower.joints)
            first_parallel, choices = self.shape.first, tuple[Choice, ...]()
            if here.point.depth < self.rules.ring.size:  # the last joint can be chosen, and the others follow it
                joints |= dict.fromkeys((1, 2, 3, 5))
                guard = tower.stages[-2][2]
                assert guard is not None, "the last joint is free only after the first and the fifth"
                choices = (Choice(5, guard.arcs(here)),)
            elif here.point.sign(tower.size) == 0:
                joints |= {first_parallel: None, first_parallel + 2: None}
                choices = (Choice(first_parallel),)
            elif any(here.point.sign(d) for d in defects):
                raise InternalError("the solutions at a pose contradict the forward kinematics")
            yield here, joints, multiple, choices

    def _slid(self, k: int, axis: tuple[Any, ...], place: Point) -> Iterator[Found]:
        """The height along the axes is the length of the joint that slides; the rest is as without it."""
        rules, origin = self.rules, [row[3] for row in self.shape.chain.constants[0]]
        turning = self.shape.chain.constants
        height, _ = _height(turning[1:3])
        z = [row[2] for row in turning[0]]  # the axes seen from the base
        last = inverse(turning[3])
        end, _ = self.pose.image([row[3] for row in last])
        along = rules.tidy(sum(((end[i] - origin[i]) * z[i] for i in range(3)), end[0] * 0) - height)
        sign = sum((a * b for a, b in zip(axis, z, strict=True)), ZERO)
        length = along * sign
        rows = tuple((*row[:3], rules.tidy(row[3] - length * c)) for row, c in zip(self.pose.rows, axis, strict=True))
        rest = PoseSearch(replace(self.shape, slide=None), rules, Scaled(rows, self.pose.scale, rules))
        slid = (quotient(length, rules.number(1)),)
        for here, joints, multiple, choices in rest.solutions(place):
            moved: Joints = {j + (j >= k): known for j, known in joints.items()}
            yield here, {**moved, k: slid}, multiple, tuple(Choice(c.joint + (c.joint >= k), c.arcs) for c in choices)

    def _followed(self, place: Point) -> tuple[Arc, ...] | None:
        """The angles of the first joint that the other joints can follow."""
        rules, one = self.rules, self.rules.number(1)
        t = Ratio(rules.ring.var(ROOTS[0]), 1, one.field)
        around = self._after_first(turned((one - t * t, t * 2), one + t * t), one + t * t)
        (_, second, guard), (_, third, _) = around.stages
        assert guard is not None, "the last joint may be free"
        p, q = (*third.coefficients(rules.ring.index[ROOTS[1]]), third * 0, third * 0)[:2]
        norm = reduced(p * p - q * q * second, one.field)
        var, known = rules.ring.index[ROOTS[0]], (quotient(one - t * t, one + t * t), quotient(t * 2, one + t * t))

        def holds(stages: Sequence[Stage], value: RealAlgebraic) -> bool:
            return any(True for _ in self._leaves(Evaluation(place.extend(value)), stages))

        marks = _marks(place, var, (second, guard.below, norm, p, q))
        gaps = [RealAlgebraic.rational(rational_between(*pair)) for pair in pairwise([None, *marks, None])]
        behind = self._after_first(turned((-one, one * 0), one), one)
        origin = Evaluation(place.extend(RealAlgebraic.rational(ZERO)))
        ends = [RangeEnd(origin, (quotient(-one, one), quotient(one * 0, one)))]
        ends += [RangeEnd(Evaluation(place.extend(value)), known) for value in marks]
        at = [holds(behind.stages, RealAlgebraic.rational(ZERO)), *(holds(around.stages, value) for value in marks)]
        after = [holds(around.stages, value) for value in gaps]
        return arcs_of(ends, at, after)

    def _based(self) -> Scaled:
        constants = self.shape.chain.constants
        return fixed(inverse(constants[0]), self.rules) @ self.pose @ fixed(inverse(constants[-1]), self.rules)

    def _planar_arm(self, place: Point) -> _Tower | None:
        based = self._based()
        if any(place.sign(v.top) for v in _out_of_plane(based, self.shape.chain.constants[1:3])):
            return None
        joints, size, square = self._three(based)
        return _Tower(((ROOTS[2], square, None),), joints, size)

    def _first(self, place: Point) -> tuple[Ratio, Turn | None]:
        """The first joint, None where the point in which axes 5 and 6 meet is on its axis: then k has to vanish."""
        constants, rules, based = self.shape.chain.constants, self.rules, self._based()
        meeting = _meet(self.shape.chain)
        assert meeting is not None, "the shape was tested"
        n1, o1 = ([row[k] for row in constants[1]] for k in (2, 3))
        (x, y, z), size = based.image((ZERO, ZERO, meeting[0]))
        height, side = _height(constants[2:4])
        c4 = apply(constants[4], (ZERO, ZERO, meeting[1]))
        k, one = size * (side * c4[2] + height + dot(n1, o1)) - n1[2] * z, size * 0 + 1
        turn = rules.turn(n1[0] * x + n1[1] * y, n1[0] * y - n1[1] * x, k, one, ROOTS[0], by=place)
        return rules.tidy(k), turn

    def _after_first(
        self,
        turn1: Scaled,
        scale: Ratio,
        stages: Sequence[Stage] = (),
        known: Mapping[int, tuple[Quotient, ...]] | None = None,
    ) -> _Tower:
        """Joints 5 and 6, and then Π, over a first joint whose turn has this scale."""
        constants, rules, based = self.shape.chain.constants, self.rules, self._based()
        n1, (_, side) = [row[2] for row in constants[1]], _height(constants[2:4])
        one = scale * 0 + 1
        axis = turn1.image(n1)[0]  # the parallel axes seen from the base; u: seen from the end effector
        u = [rules.tidy(sum((based.rows[i][j] * axis[i] for i in range(3)), one * 0)) for j in range(3)]
        weight, r4 = scale * based.scale, constants[4][2]
        n5 = [row[2] for row in constants[5]]
        a5, b5 = r4[0] * n5[0] + r4[1] * n5[1], r4[1] * n5[0] - r4[0] * n5[1]
        fifth = rules.turn(one * a5, one * b5, u[2] * side - weight * (r4[2] * n5[2]), weight, ROOTS[1])
        assert fifth is not None, "axes 4 and 5 are not parallel"
        bend = (fifth.motion @ fixed(constants[5], rules)).rows
        w = [rules.tidy(side * sum((r4[i] * bend[i][j] for i in range(3)), one * 0)) for j in range(2)]
        below = rules.tidy(u[0] * u[0] + u[1] * u[1])
        # u = w M6; u is multiplied by weight, w by fifth.scale
        cosine = rules.tidy((u[0] * w[0] + u[1] * w[1]) * weight)
        sine = rules.tidy((w[1] * u[0] - w[0] * u[1]) * weight)
        turn6 = turned((cosine, sine), rules.tidy(below * fifth.scale))
        near = fixed(inverse(constants[1]), rules) @ turn1.inverse() @ based
        backs = fixed(inverse(constants[5]), rules), fifth.motion.inverse(), fixed(inverse(constants[4]), rules)
        far = backs[0] @ backs[1] @ backs[2]
        result = near @ turn6.inverse() @ backs[0] @ backs[1] @ backs[2]
        parallel = _Parallel(below.top, partial(self._elbow_over_last, near, far), rules.ring.index[ROOTS[2]])
        joints, size_of_plane, square = self._three(result)
        after: tuple[Stage, ...] = ((ROOTS[1], fifth.square.top, parallel), (ROOTS[2], square, None))
        pairs = {**(known or {}), 4: fifth.pair, 5: turn6.pair, **joints}
        return _Tower((*stages, *after), pairs, size_of_plane)

    def _elbow_over_last(self, near: Scaled, far: Scaled, turn: tuple[Fraction, Fraction]) -> tuple[Poly, Known]:
        """The square of the root of the elbow as a polynomial in t, θ6 = φ + 2 arctan t, and what θ6 is.

        With the last axis parallel to the three, Π's shift is x + c y + s z in their plane, c and s of θ6, and y and z
        are orthogonal and equally long.
        """
        rules, zero, one = self.rules, self.rules.number(0), self.rules.number(1)
        parts = ((zero, zero, one), (one, zero, zero), (zero, one, zero))
        shifts = [near @ turned((c, s), scale).inverse() @ far for c, s, scale in parts]
        x, y, z = ([m.rows[i][3] for i in range(2)] for m in shifts)
        norm, (_, c, s) = weights(Ratio(rules.ring.var(ROOTS[2]), 1, rules.field), one, turn)
        size = norm * rules.tidy(dot(x, x) + dot(y, y)) + (c * rules.tidy(dot(x, y)) + s * rules.tidy(dot(x, z))) * 2
        a, b, k, scale = self._elbow(size, norm * rules.tidy(shifts[0].scale * shifts[0].scale))
        square = (a * a + b * b) * scale * scale - k * k
        return square.top, (quotient(c, norm), quotient(s, norm))

    def _elbow(self, size: Ratio, squared: Ratio) -> tuple[Ratio, Ratio, Ratio, Ratio]:
        """a, b, k and the scale in a cos θ + b sin θ = k / scale for the second of the parallel joints: size / squared
        is the square of the length of Π's shift."""
        second, third = self.shape.chain.constants[self.shape.first + 1 : self.shape.first + 3]
        o2, o3 = ([row[3] for row in m[:2]] for m in (second, third))
        g = [second[0][j] * o2[0] + second[1][j] * o2[1] for j in range(2)]
        k = (size - squared * (dot(o2, o2) + dot(o3, o3))) * Fraction(1, 2)
        one = k * 0 + 1
        return one * dot(g, o3), one * (g[1] * o3[0] - g[0] * o3[1]), k, squared

    def _three(self, motion: Scaled) -> tuple[dict[int, tuple[Quotient, ...]], Poly, Poly]:
        """The three parallel joints with Π = ``found``, the square of the length of its shift, and m3²."""
        rules, first = self.rules, self.shape.first
        second, third = self.shape.chain.constants[first + 1 : first + 3]
        across = [motion.rows[i][3] for i in range(2)]
        size = rules.tidy(dot(across, across))
        elbow = rules.turn(*self._elbow(size, rules.tidy(motion.scale * motion.scale)), ROOTS[2])
        assert elbow is not None, "no two neighbours of the parallel axes coincide"
        inner = fixed(second, rules) @ elbow.motion @ fixed(third, rules)
        f = [inner.rows[i][3] for i in range(2)]  # its length is that of Π's shift, but for the scales
        cosine = rules.tidy(dot(f, across) * motion.scale)
        sine = rules.tidy((f[0] * across[1] - f[1] * across[0]) * motion.scale)
        turn2 = turned((cosine, sine), rules.tidy(size * inner.scale))
        turn4 = (turn2 @ inner.rotation).inverse() @ motion.rotation
        return {first: turn2.pair, first + 1: elbow.pair, first + 2: turn4.pair}, size.top, elbow.square.top

    def _leaves(self, here: Evaluation, stages: Sequence[Stage]) -> Iterator[tuple[Evaluation, bool]]:
        """The points of the tower, and whether two solutions meet in one. Shorter ones leave the last joint free."""
        if not stages:
            yield here, False
            return
        (name, square, guard), *rest = stages
        ring = self.rules.ring
        roots = roots_above(here.point, ring.index[name], ring.var(name) ** 2 - square) or []
        for root in roots:
            there = here.extend(root)
            if guard is not None and there.point.sign(guard.below) == 0:
                if guard.arcs(there) != ():
                    yield there, len(roots) == 1
                continue
            for leaf, multiple in self._leaves(there, rest):
                yield leaf, multiple or len(roots) == 1

    def _defects(self, joints: Mapping[int, tuple[Quotient, ...]]) -> list[Poly]:
        """What has to vanish at every solution: the forward kinematics minus the pose."""
        rules, constants = self.rules, self.shape.chain.constants
        whole = fixed(constants[0], rules)
        for k, constant in enumerate(constants[1:]):
            bottom = rules.number(joints[k][0].bottom)
            whole = whole @ turned(rules.numbers(joints[k]), bottom) @ fixed(constant, rules)
        pairs = [
            (v, w)
            for row, wanted in zip(whole.rows, self.pose.rows, strict=True)
            for v, w in zip(row, wanted, strict=True)
        ]
        return [rules.tidy(value * self.pose.scale - target * whole.scale).top for value, target in pairs]


def _height(pair: Sequence[Matrix]) -> tuple[Any, Any]:
    """(h, ±1): Π takes a height z to h ± z."""
    second, third = pair
    return second[2][3] + second[2][2] * third[2][3], second[2][2] * third[2][2]


def _out_of_plane(motion: Scaled, pair: Sequence[Matrix]) -> Iterator[Any]:
    """What has to vanish for a motion of the plane."""
    height, side = _height(pair)
    yield from (motion.rows[2][0], motion.rows[2][1])
    yield motion.rows[2][2] - motion.scale * side
    yield motion.rows[2][3] - motion.scale * height


def _marks(place: Point, var: int, polynomials: Sequence[Poly]) -> list[RealAlgebraic]:
    """All zeros of polynomials at a point, among others, ascending."""
    marks: set[RealAlgebraic] = set()
    for factor in dict.fromkeys(f for p in polynomials if p for f, _ in p.factors()[1]):
        if any(place.sign(c) for c in factor.coefficients(var)):  # one that vanishes everywhere changes nothing
            marks |= set(_zeros_of_norm(place, var, factor))
    return sorted(marks)


def _zeros_of_norm(place: Point, var: int, p: Poly) -> Iterator[RealAlgebraic]:
    """The zeros of p and of its conjugates."""
    for i in set(range(var)) & set(p.variables):
        value = place.number(i)
        if isinstance(value, Fraction):
            p = p.at_rational(i, value)
            continue
        powers = enumerate(value.minimal_polynomial)
        minimal = sum((place.ring.gen(i) ** k * c for k, c in powers), place.ring.constant(0))
        p = minimal.resultant(p, i)
    if not p:
        raise Unable("the first joint can be chosen, and whether the others follow it is not decided")
    for factor, _ in p.factors()[1]:
        yield from irreducible_roots(factor.to_univariate(var))
