"""Arms as chains of joints: Denavit-Hartenberg rows in the modified (Craig) and in the standard convention.

A modified row is Rx(alpha) Tx(a) Rz(theta) Tz(d), a standard one Rz(theta) Tz(d) Tx(a) Rx(alpha) (J. J. Craig,
Introduction to Robotics, section 3.5; J. Denavit, R. S. Hartenberg 1955). One of theta (revolute) and d (prismatic) of
a row may vary. Lengths are in millimetres, angles in radians. All constants are exact, in one field of real algebraic
numbers.

Exact angles: rational multiples of pi whose cosine and sine lie in Q(sqrt 2, sqrt 3), and angles given by these two.

Only with such constants is the system of an arm polynomial with exact coefficients in the cosines and sines of its
joints.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cache, cached_property
from math import atan2
from typing import Any

from bezier.input.numbers import NotANumber, describe, parse, read
from qe.exact.field import NumberField

Pair = tuple[Any, Any]
"""Cosine and sine: rational numbers or elements of one field."""

STEP = 12
"""Angles are multiples of pi over this."""

_MULTIPLE = re.compile(r"([+-]?)\s*(?:([0-9]+(?:/[0-9]+)?)\s*\*?\s*)?pi(?:\s*/\s*([0-9]+))?")
EXPECTED = f'a multiple of pi/{STEP} such as "-pi/2", or {{cos = "3/5", sin = "4/5"}}'


@dataclass(frozen=True, slots=True)
class Angle:
    """``twelfths`` of pi (in (-12, 12]), or, where that is None, the angle with the rational ``cosine`` and
    ``sine``."""

    twelfths: int | None = 0
    cosine: Fraction = Fraction(1)
    sine: Fraction = Fraction(0)

    def __float__(self) -> float:
        """In radians, in (-pi, pi]."""
        if self.twelfths is not None:
            return self.twelfths * 3.141592653589793 / STEP
        return atan2(self.sine, self.cosine)

    def __str__(self) -> str:
        if self.twelfths is None:
            return f"atan2({self.sine}, {self.cosine})"
        part = Fraction(self.twelfths, STEP)
        top = {1: "pi", -1: "-pi"}.get(part.numerator, f"{part.numerator}*pi")
        return "0" if not part else top if part.denominator == 1 else f"{top}/{part.denominator}"

    @property
    def roots(self) -> frozenset[int]:
        """Which of sqrt 2 and sqrt 3 its cosine and sine need."""
        if self.twelfths is None or self.twelfths % 6 == 0:
            return frozenset()
        if self.twelfths % 2:
            return frozenset({2} if self.twelfths % 3 == 0 else {2, 3})
        return frozenset({3})

    def in_field(self, field: NumberField) -> Pair:
        """Cosine and sine in a field that ``field_of`` found for this angle among others."""
        if self.twelfths is None:
            return self.cosine, self.sine
        return _cosine(self.twelfths, field), _cosine(self.twelfths - 6, field)


def read_angle(raw: object) -> Angle:
    """The angle that a TOML value stands for. Raises ``NotANumber``."""
    if isinstance(raw, dict):
        if set(raw) != {"cos", "sin"}:
            raise NotANumber(describe(raw))
        cosine, sine = read(raw["cos"]), read(raw["sin"])
        if cosine**2 + sine**2 != 1:
            raise NotANumber(f"cos = {cosine} and sin = {sine}, whose squares do not add up to 1")
        return Angle(None, cosine, sine)
    if isinstance(raw, str) and (match := _MULTIPLE.fullmatch(raw.strip())):
        if match[3] is not None and int(match[3]) == 0:
            raise NotANumber(f'"{raw}", which divides by zero')
        factor = parse(match[2] or "1") / int(match[3] or 1)
        steps = (-factor if match[1] == "-" else factor) * STEP
        if steps.denominator == 1:
            return Angle((int(steps) + STEP - 1) % (2 * STEP) - STEP + 1)
        raise NotANumber(f'"{raw}"')
    if read(raw) == 0:
        return Angle()
    raise NotANumber(describe(raw))


def field_of(angles: Iterable[Angle]) -> NumberField:
    """The least of Q, Q(sqrt 2), Q(sqrt 3), Q(sqrt 2 + sqrt 3) with the cosines and sines of all these angles."""
    return _field(frozenset[int]().union(*(angle.roots for angle in angles)))


@cache
def _field(roots: frozenset[int]) -> NumberField:
    if not roots:
        return NumberField.rationals()
    if roots == {2, 3}:
        return NumberField.from_root([1, 0, -10, 0, 1], 3, 4)
    (square,) = roots
    return NumberField.from_root([-square, 0, 1], 1, 2)


def _cosine(twelfths: int, field: NumberField) -> Any:
    """cos(k pi / 12)."""
    k = abs(twelfths) % (2 * STEP)
    k = min(k, 2 * STEP - k)
    if k > 6:
        return -_cosine(STEP - k, field)
    two, three = _root(2, field), _root(3, field)
    half = Fraction(1, 2)
    match k:
        case 0:
            return Fraction(1)
        case 1:
            return (two * three + two) * half * half
        case 2:
            return three * half
        case 3:
            return two * half
        case 4:
            return half
        case 5:
            return (two * three - two) * half * half
    return Fraction(0)


def _root(square: int, field: NumberField) -> Any:
    """sqrt 2 or sqrt 3 in the field; zero (then unused) where the field has none."""
    theta = field.generator()
    if field.degree == 4:
        cube = theta**3
        return (cube - 9 * theta) / 2 if square == 2 else (11 * theta - cube) / 2
    return theta if field.degree == 2 and theta * theta == square else Fraction(0)


Matrix = tuple[tuple[Any, ...], ...]
"""A rigid motion: the upper three of four rows."""

ZERO, ONE = Fraction(0), Fraction(1)
IDENTITY: Matrix = ((ONE, ZERO, ZERO, ZERO), (ZERO, ONE, ZERO, ZERO), (ZERO, ZERO, ONE, ZERO))


class Convention(Enum):
    """The order of the four motions of a row."""

    MODIFIED = "modified"
    STANDARD = "standard"


class JointKind(Enum):
    """What a joint does: turn about, or slide along, the z axis of its frame."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"


@dataclass(frozen=True, slots=True)
class Joint:
    """A moving joint."""

    name: str
    motion: JointKind
    limits: tuple[Fraction, Fraction] | None = None
    """The least and the greatest value, rad for a revolute joint and mm for a prismatic one."""
    max_velocity: Fraction | None = None
    max_acceleration: Fraction | None = None


@dataclass(frozen=True, slots=True)
class Row:
    """One row. Where it moves, ``theta`` or ``d`` is the offset that is added to the value of the joint."""

    a: Fraction
    alpha: Angle
    d: Fraction
    theta: Angle
    joint: Joint | None = None


@dataclass(frozen=True, slots=True)
class Chain:
    """``constants[0] M(q_1) constants[1] ... M(q_n) constants[n]``, M the motion of a joint about or along its z
    axis."""

    constants: tuple[Matrix, ...]
    joints: tuple[Joint, ...]


@dataclass(frozen=True)
class Arm:
    """An arm: its rows from the base on, and what is said about it (``name``, ``reference``)."""

    name: str
    convention: Convention
    rows: tuple[Row, ...]
    reference: str = ""

    @cached_property
    def _hash(self) -> int:
        return hash((self.name, self.convention, self.rows, self.reference))

    def __hash__(self) -> int:
        return self._hash  # found once: an arm is the key of what was worked out for it

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The moving joints, from the base on."""
        return tuple(row.joint for row in self.rows if row.joint is not None)

    @property
    def has_limits(self) -> bool:
        """Whether a joint has limits."""
        return any(joint.limits is not None for joint in self.joints)

    @cached_property
    def field(self) -> NumberField:
        """The field of all constants."""
        return field_of(angle for row in self.rows for angle in (row.alpha, row.theta))

    @cached_property
    def chain(self) -> Chain:
        """The rows with what lies between two moving joints multiplied out."""
        constants, joints, open_part = [], [], IDENTITY
        for row in self.rows:
            before, after = self.parts(row)
            open_part = product(open_part, before)
            if row.joint is not None:
                constants.append(open_part)
                joints.append(row.joint)
                open_part = IDENTITY
            open_part = product(open_part, after)
        return Chain((*constants, open_part), tuple(joints))

    def parts(self, row: Row) -> tuple[Matrix, Matrix]:
        """The motions of a row before and after its joint."""
        across = product(turn_x(row.alpha.in_field(self.field)), translation((row.a, ZERO, ZERO)))
        along = product(turn_z(row.theta.in_field(self.field)), translation((ZERO, ZERO, row.d)))
        if self.convention is Convention.MODIFIED:
            return across, along
        return IDENTITY, product(along, across)


def motion(joint: Joint, value: Any) -> Matrix:
    """The motion of a joint: ``value`` is (cosine, sine) of a revolute one, the length of a prismatic one."""
    return turn_z(value) if joint.motion is JointKind.REVOLUTE else translation((ZERO, ZERO, value))


def turn_z(pair: Pair) -> Matrix:
    """The rotation about the z axis with this cosine and sine."""
    c, s = pair
    return ((c, -s, ZERO, ZERO), (s, c, ZERO, ZERO), IDENTITY[2])


def turn_x(pair: Pair) -> Matrix:
    """The rotation about the x axis with this cosine and sine."""
    c, s = pair
    return (IDENTITY[0], (ZERO, c, -s, ZERO), (ZERO, s, c, ZERO))


def translation(shift: Iterable[Any]) -> Matrix:
    """The translation by a vector (mm)."""
    return tuple((*row[:3], t) for row, t in zip(IDENTITY, shift, strict=True))


def product(a: Matrix, b: Matrix) -> Matrix:
    """The motion ``b`` followed by ``a``."""
    return tuple(
        tuple(
            _sum(_times(row[k], b[k][j]) for k in range(3)) if j < 3 else _sum([row[3], *_products(row, b)])
            for j in range(4)
        )
        for row in a
    )


def apply(a: Matrix, point: Sequence[Any]) -> tuple[Any, ...]:
    """The image of a point."""
    return tuple(_sum([row[3], *(_times(row[k], point[k]) for k in range(3))]) for row in a)


def inverse(a: Matrix) -> Matrix:
    """The inverse motion: the rotation part is orthogonal."""
    turned = [[a[j][i] for j in range(3)] for i in range(3)]
    return tuple((*row, -_sum(_times(row[k], a[k][3]) for k in range(3))) for row in turned)


def _products(row: Sequence[Any], b: Matrix) -> list[Any]:
    return [_times(row[k], b[k][3]) for k in range(3)]


def _times(x: Any, y: Any) -> Any:
    """x y, where constants 0 and 1 (most entries) cost nothing."""
    for one, other in ((x, y), (y, x)):
        if isinstance(one, Fraction):
            if one == 0:
                return ZERO
            if one == 1:
                return other
    return x * y


def _sum(values: Iterable[Any]) -> Any:
    total: Any = ZERO
    for value in values:
        if isinstance(value, Fraction) and value == 0:
            continue
        total = value if isinstance(total, Fraction) and total == 0 else total + value
    return total
