"""Arms as chains of joints: Denavit-Hartenberg rows in the modified (Craig) and in the standard convention.

A modified row is Rx(alpha) Tx(a) Rz(theta) Tz(d), a standard one Rz(theta) Tz(d) Tx(a) Rx(alpha) (J. J. Craig,
Introduction to Robotics, section 3.5; J. Denavit, R. S. Hartenberg 1955). One of theta (revolute) and d (prismatic) of
a row may vary. Lengths are in millimetres, angles in radians. All constants are exact, in one field of real algebraic
numbers.
Exact angles are rational multiples of pi whose cosine and sine lie in Q(sqrt 2, sqrt 3), and those given by these two.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cache, cached_property
from math import atan2
from typing import Any

from bezier.input.numbers import NotANumber, describe, parse, read
from bezier.proofs.arm_rows import ArmChain, cosine_of
from bezier.proofs.square_roots import Surd, primes
from qe.exact.field import NumberField

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

    @staticmethod
    def of(twelfths: int) -> Angle:
        """So many twelfths of pi."""
        return Angle((twelfths + STEP - 1) % (2 * STEP) - STEP + 1)

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
    def exact(self) -> tuple[Surd, Surd]:
        """Cosine and sine as sums of square roots."""
        if self.twelfths is None:
            return Surd.rational(self.cosine), Surd.rational(self.sine)
        return cosine_of(self.twelfths), cosine_of(self.twelfths - 6)


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
            return Angle.of(int(steps))
        raise NotANumber(f'"{raw}"')
    if read(raw) == 0:
        return Angle()
    raise NotANumber(describe(raw))


def field_of(numbers: Iterable[Surd]) -> NumberField:
    """The least of Q, Q(sqrt 2), Q(sqrt 3), Q(sqrt 2 + sqrt 3) with all these numbers."""
    return _field(frozenset(p for number in numbers for d, _ in number.terms for p in primes(d)))


@cache
def _field(roots: frozenset[int]) -> NumberField:
    if not roots:
        return NumberField.rationals()
    if roots == {2, 3}:
        return NumberField.from_root([1, 0, -10, 0, 1], 3, 4)
    (square,) = roots
    return NumberField.from_root([-square, 0, 1], 1, 2)


def in_field(value: Surd, field: NumberField) -> Any:
    """A sum of the square roots of 1, 2, 3 and 6 in a field that has these: a rational number where it is one."""
    return sum((q * _root(d, field) for d, q in value.terms), Fraction(0))


@cache
def _root(d: int, field: NumberField) -> Any:
    """The square root of d = 1, 2, 3 or 6 in a field that has it."""
    if d in (1, 6):
        return Fraction(1) if d == 1 else _root(2, field) * _root(3, field)
    theta = field.generator()
    if field.degree == 4:
        return (theta**3 - 9 * theta) / 2 if d == 2 else (11 * theta - theta**3) / 2
    return theta


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
    """One row. Where it moves, ``theta`` or ``d`` is the offset that is added to the value of the joint. ``is_within``:
    its frame is one inside of a link, whose ends are others."""

    a: Fraction
    alpha: Angle
    d: Fraction
    theta: Angle
    joint: Joint | None = None
    is_within: bool = False


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
    def ends(self) -> tuple[int, ...]:
        """Behind how many rows the frames are that are ends of links, the base first."""
        return (0, *(k for k, row in enumerate(self.rows, start=1) if not row.is_within))

    @property
    def has_limits(self) -> bool:
        """Whether a joint has limits."""
        return any(joint.limits is not None for joint in self.joints)

    @cached_property
    def chain(self) -> ArmChain:
        """The rows with what lies between two moving joints multiplied out."""
        kinds = [None if row.joint is None else row.joint.motion is JointKind.REVOLUTE for row in self.rows]
        rows = (
            (Surd.rational(row.a), row.alpha.exact, Surd.rational(row.d), row.theta.exact, turning)
            for row, turning in zip(self.rows, kinds, strict=True)
        )
        return ArmChain.of(self.convention is Convention.MODIFIED, rows)

    @cached_property
    def field(self) -> NumberField:
        """The field of all constants."""
        return field_of(c for rows, shift in self.chain.constants for row in (*rows, shift) for c in row)
