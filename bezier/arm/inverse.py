"""Inverse kinematics at a point: all real joint positions that put the end effector there, with a proved count.

The equation of ``bezier.arm.elimination`` is solved at the point by exact real root isolation over the field of its
coefficients; every real root is one solution, whose forward kinematics are compared with the point in floating point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, partial
from itertools import combinations
from numbers import Integral
from typing import Any

from bezier.arm.choices import BITS, AtPlace, Choice, Exact, Value, allowed, not_negative, spans
from bezier.arm.elimination import LIFTED, TURNS, Geometry, M, Reduction, T, variable
from bezier.arm.kinematics import floats
from bezier.arm.model import Arm
from bezier.curves.scalar import rational
from bezier.proofs.square_roots import carried, image
from qe.errors import InputError, InternalError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.point_values import Evaluation, multiple_roots, roots_above
from qe.exact.ring import Poly, Ring
from qe.exact.sample import FibreRoot, Point

Reductions = Callable[[int], Reduction]

LARGEST = 10**100
"""Coordinates in mm: larger ones have no decimal that a float holds."""

CLOSE = 1e-6
"""How far, relative to the size of an arm, floating point may be off."""

MOST_BITS = 4096
"""Balls are made no narrower than 2^-4096 to tell solutions from each other."""

NAMES = ("w", "x", "y", "z", "t", "m")
FRAME = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""The place of the end effector and its axes, seen from there."""


@dataclass(frozen=True, eq=False)
class Solution:
    """One solution, or a family."""

    values: tuple[Value | None, ...]
    """One for each joint, None where it is free."""
    multiple: bool
    """Two solutions meet here."""
    allowed: bool
    """Whether it keeps the limits of the joints."""
    exact: tuple[Exact | None, ...]
    """Of each joint, None where it is free."""
    choices: tuple[Choice, ...] = ()
    """The joints of a family that can be chosen, independently of each other, and which of their values are
    possible: exactly for these there are positions. Other free joints follow them, and their limits are left
    aside."""

    @property
    def angles(self) -> tuple[float | None, ...]:
        """The angles (rad), and the lengths (mm) of joints that slide."""
        return tuple(None if value is None else float(value) for value in self.values)

    def refined(self, joint: int, bits: int) -> Value | None:
        """The value of a joint with intervals at most about 2^-bits wide."""
        exact = self.exact[joint]
        return None if exact is None else exact.value(bits)


@dataclass(frozen=True, eq=False)
class Inverse:
    """All solutions at a point (mm)."""

    arm: Arm
    point: tuple[Any, ...]
    solutions: tuple[Solution, ...]
    free: tuple[str, ...] = ()
    """The joints whose value is not determined; then there are infinitely many solutions, and each of those that
    leave one of them open stands for a family."""
    cases: tuple[str, ...] = ()
    """The names of what is special about the point."""
    rotation: tuple[tuple[Any, ...], ...] = ()
    """The rows of the orientation that was asked for, if one was."""

    @property
    def count(self) -> int | None:
        """The number of different solutions; None for infinitely many."""
        return None if self.free else len(self.solutions)

    @property
    def is_reachable(self) -> bool:
        """Whether there is a solution, limits of the joints aside."""
        return bool(self.solutions)

    @property
    def allowed_count(self) -> int:
        """The number of solutions, or families, that keep the limits of the joints."""
        return sum(s.allowed for s in self.solutions)


def separated(answer: Inverse) -> Inverse:
    """The same with balls so narrow that no two solutions share those of all joints, as far as ``MOST_BITS`` go.

    Different solutions differ in the cosine, the sine or the length of a joint. Families stay as they are.
    """

    def may_be(one: Solution, other: Solution) -> bool:
        return all(a and b and a.meets(b) for a, b in zip(one.values, other.values, strict=True))

    solutions, bits = answer.solutions, BITS
    while bits < MOST_BITS and not answer.free and any(may_be(a, b) for a, b in combinations(solutions, 2)):
        bits *= 2
        solutions = tuple(
            replace(one, values=tuple(one.refined(k, bits) for k in range(len(one.values)))) for one in solutions
        )
    return replace(answer, solutions=solutions)


def solve(arm: Arm, point: Sequence[Any]) -> Inverse:
    """All solutions at a point: coordinates (mm) are rational numbers, field elements or ``RealAlgebraic``.

    Raises ``Unable`` for an arm that the reduction does not fit, ``InputError`` for anything but three exact numbers.
    """
    numbers = tuple(exact_number(v, "point") for v in listed(point, "point: three coordinates"))
    if len(numbers) != 3:
        raise InputError(f"point: three coordinates expected, {len(numbers)} found")
    return solve_at(arm, place(general(arm, 0).ring, arm, numbers), numbers)


def solve_at(arm: Arm, here: Point, numbers: tuple[Any, ...], reductions: Reductions | None = None) -> Inverse:
    """``solve`` where the point stands in the ring of the ``reductions`` already (those for all points by default)."""
    reductions = reductions or partial(general, arm)
    first = reductions(0)
    on_axis = first.axis is not None and here.sign(first.axis) == 0
    on_shoulder = bool(first.shoulder) and all(here.sign(p) == 0 for p in first.shoulder)
    cases = (f"on the axis of {arm.joints[0].name}",) * on_axis
    cases += (f"on the circle of the shoulder, the centre of {arm.joints[1].name}",) * on_shoulder
    values, t = Evaluation(here), first.ring.index[T]
    if not geometry_of(arm).moves_last:
        place = Evaluation(here.extend(RealAlgebraic.rational(Fraction(0))))
        reached = place.point.sign(first.equation) == 0
        result = list(_at_root(arm, place, first, on_axis, False, is_still=True)) if reached else []
        return _listed(arm, numbers, result, (*cases, *(f"{arm.joints[2].name} does not move the point",) * reached))
    for k in range(len(TURNS)):
        reduction = reductions(k)
        roots = roots_above(here, t, reduction.equation)
        if roots is None:
            if _misses(here, reduction.square, None if reduction.degree is None else LIFTED, t):
                continue
            roots = _isolated(here, reduction)
            if roots is None:
                cases = (*cases, f"{arm.joints[2].name} can be chosen")
                return _listed(arm, numbers, [_family(arm, values, reduction, on_axis)], cases)
        elif _misses(here, reduction.equation, reduction.degree, t):
            continue  # the angle that t misses may be a solution: another φ tells
        result = [
            solution
            for root, multiple in zip(roots, multiple_roots(roots), strict=True)
            for solution in _at_root(arm, values.extend(root), reduction, on_axis, multiple)
        ]
        if any(s.multiple for s in result) and not on_axis:
            cases = (*cases, "two solutions meet: the arm is singular here")
        return _listed(arm, numbers, result, cases)
    raise InternalError("an equation of degree four has more than four roots")


def _listed(arm: Arm, numbers: tuple[Any, ...], solutions: list[Solution], cases: tuple[str, ...]) -> Inverse:
    if numbers:  # a point along a curve has none here
        check_kinematics(arm, solutions, numbers)
    solutions.sort(key=lambda s: [v for v in s.angles if v is not None])
    names = tuple(joint.name for joint in arm.joints)
    open_ones = {name for s in solutions for name, v in zip(names, s.values, strict=True) if v is None}
    return Inverse(arm, numbers, tuple(solutions), tuple(n for n in names if n in open_ones), cases)


def check_kinematics(arm: Arm, solutions: Iterable[Solution], *wanted: Sequence[Any]) -> None:
    """Forward kinematics in floating point: a slip of the derivation would show. Raises ``InternalError``.

    ``wanted``: where the end effector is to be, and its three axes where these are asked for. Families are left aside.
    """
    (base, *links), goals = floats(arm), [(v, tuple(map(float, goal))) for v, goal in zip(FRAME, wanted, strict=False)]
    longest = 1 + sum(abs(v) for _, shift in (base, *links) for v in shift)
    for solution in solutions:
        values = [v for v in solution.values if v is not None]
        if len(values) < len(solution.values):
            continue
        numbers = [tuple(map(float, v.pair or (v.ball,))) for v in values]
        close = CLOSE * (longest + sum(abs(float(v)) for v in values))
        for k, (start, goal) in enumerate(goals):
            end = image(base, carried(links, numbers, start, k == 0), k == 0)
            if any(abs(a - b) > close for a, b in zip(end, goal, strict=True)):
                raise InternalError("the solutions of an arm contradict its forward kinematics")


def _misses(here: Point, p: Poly | None, degree: int | None, t: int) -> bool:
    """Whether p, of this degree in t where it does not vanish at the angle that t misses, vanishes there."""
    if p is None or degree is None:
        return False
    coefficients = p.coefficients(t)
    if len(coefficients) > degree and here.sign(coefficients[-1]):
        return False
    return any(here.sign(c) for c in coefficients)  # where it vanishes at all angles another φ tells nothing


@lru_cache(maxsize=256)
def general(arm: Arm, turn: int) -> Reduction:
    """The reduction for all points, with angles counted from ``TURNS[turn]``."""
    ring = Ring.of(NAMES)
    return geometry_of(arm).reduce(ring, [variable(ring, name, arm.field) for name in "xyz"], TURNS[turn])


@lru_cache(maxsize=64)
def geometry_of(arm: Arm) -> Geometry:
    """The constants of the reduction."""
    return Geometry.of(arm)


def place(ring: Ring, arm: Arm, numbers: Sequence[Any]) -> Point:
    """The point of the ring with the generator of the arm's field and these coordinates."""
    return Point.of(ring, [arm.field.theta, *numbers])


def listed(values: Any, expected: str) -> list[Any]:
    """The values of a sequence. Raises ``InputError`` for what is none."""
    if isinstance(values, str | Mapping) or not isinstance(values, Iterable):
        raise InputError(f"{expected} expected, {type(values).__name__} found")
    return list(values)


def exact_number(value: Any, what: str) -> Fraction | RealAlgebraic:
    """The value as a rational number or a real algebraic one (integers of numpy are exact, too). Raises ``InputError``
    for anything else."""
    if isinstance(value, Integral) and not isinstance(value, bool):
        value = int(value)
    if isinstance(value, bool) or not (isinstance(value, int | Fraction | RealAlgebraic) or hasattr(value, "field")):
        raise InputError(f"{what}: exact numbers expected (int, Fraction, RealAlgebraic), {type(value).__name__} found")
    number = rational(value)
    if number is not None:
        if abs(number) > LARGEST:
            raise InputError(f"{what}: numbers of at most 1e100 expected, a larger one found")
        return number
    algebraic: RealAlgebraic = value if isinstance(value, RealAlgebraic) else value.to_algebraic()
    return algebraic


def solution_of(arm: Arm, exact: Sequence[Exact | None], multiple: bool, choices: Sequence[Choice]) -> Solution:
    """The solution whose joints have these values, within their limits or not."""
    values = tuple(None if k is None else k.value() for k in exact)
    keeps = all(k is None or allowed(joint, k) for joint, k in zip(arm.joints, exact, strict=True))
    keeps = keeps and all(spans(arm.joints[choice.joint], choice) for choice in choices)
    return Solution(values, multiple, keeps, tuple(exact), tuple(choices))


def _at_root(
    arm: Arm, here: Evaluation, reduction: Reduction, on_axis: bool, multiple: bool, *, is_still: bool = False
) -> Iterator[Solution]:
    """The solutions that belong to one root of the equation in t: one, or two, one or none where m is needed."""
    if reduction.square is None:
        yield _solution(arm, here, reduction, (on_axis, is_still), multiple)
        return
    side = here.point.sign(reduction.square)
    if side < 0:
        return
    m = reduction.ring.var(M)
    roots = roots_above(here.point, reduction.ring.index[M], m * m - reduction.square)
    for root in roots or ():
        yield _solution(arm, here.extend(root), reduction, (on_axis, is_still), multiple or side == 0)


def _solution(arm: Arm, here: Evaluation, reduction: Reduction, ends: tuple[bool, bool], multiple: bool) -> Solution:
    """``ends``: whether the first joint, and the last one, can be chosen."""
    turns = reduction.kappa is not None and here.point.sign(reduction.kappa) == 0
    free = (ends[0], turns, ends[1])
    exact = [None if f else AtPlace(k, here) for f, k in zip(free, reduction.values, strict=True)]
    return solution_of(arm, exact, multiple, [Choice(k) for k in range(3) if free[k]])


def _isolated(here: Point, reduction: Reduction) -> list[FibreRoot] | None:
    """Where the equation holds for all t: the t with m² = 0 if m² is positive nowhere, None if a family of solutions is
    left."""
    if reduction.square is None:
        return None
    t = reduction.ring.index[T]
    roots = roots_above(here, t, reduction.square)
    if roots is None:
        return None
    signs = [here.sign(c) for c in reduction.square.coefficients(t)]
    degree = max(k for k, side in enumerate(signs) if side)
    # of degree at most four: it is positive nowhere iff it is not at infinity, and no root is simple or triple
    return roots if degree % 2 == 0 and signs[degree] < 0 and all(multiple_roots(roots)) else None


def _family(arm: Arm, values: Evaluation, reduction: Reduction, on_axis: bool) -> Solution:
    """The equation holds for all t, and so do solutions where m² is not negative."""
    here, kappa, t = values.point, reduction.kappa, reduction.ring.index[T]
    last = arm.joints[2]
    turns = kappa is not None and not any(here.sign(c) for c in kappa.coefficients(t))
    square = reduction.square
    arcs = None if square is None else not_negative(values, square, t, reduction.values[2], last.motion)
    choices = [Choice(k) for k, free in enumerate((on_axis, turns)) if free]
    return solution_of(arm, (None, None, None), False, [*choices, Choice(2, arcs)])
