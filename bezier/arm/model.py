"""Arms as chains of joints: Denavit-Hartenberg rows in the modified (Craig) and in the standard convention.

A modified row is Rx(alpha) Tx(a) Rz(theta) Tz(d), a standard one Rz(theta) Tz(d) Tx(a) Rx(alpha) (J. J. Craig,
Introduction to Robotics, section 3.5; J. Denavit, R. S. Hartenberg 1955). One of theta (revolute) and d (prismatic) of
a row may vary. Lengths are in millimetres, angles in radians. All constants are exact, in one field of real algebraic
numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cached_property
from typing import Any

from bezier.arm.angles import Angle, Pair, field_of
from qe.exact.field import NumberField

Matrix = tuple[tuple[Any, ...], ...]
"""A rigid motion: the upper three of four rows."""

ZERO, ONE = Fraction(0), Fraction(1)
IDENTITY: Matrix = ((ONE, ZERO, ZERO, ZERO), (ZERO, ONE, ZERO, ZERO), (ZERO, ZERO, ONE, ZERO))


class Convention(Enum):
    """The order of the four motions of a row."""

    MODIFIED = "modified"
    STANDARD = "standard"


class Motion(Enum):
    """What a joint does: turn about, or slide along, the z axis of its frame."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"


@dataclass(frozen=True, slots=True)
class Joint:
    """A moving joint. ``limits``: the least and the greatest value, rad for a revolute joint and mm for a prismatic
    one."""

    name: str
    motion: Motion
    limits: tuple[Fraction, Fraction] | None = None
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
    return turn_z(value) if joint.motion is Motion.REVOLUTE else translation((ZERO, ZERO, value))


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
