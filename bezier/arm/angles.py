"""Exact angles: rational multiples of pi whose cosine and sine lie in Q(sqrt 2, sqrt 3), and angles given by these two.

Only with such constants is the system of an arm polynomial with exact coefficients in the cosines and sines of its
joints.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
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


def root_in(field: NumberField, square: int) -> Any:
    """sqrt 2, sqrt 3 or sqrt 6 in a field that ``field_of`` found, None where it is not there."""
    found = _root(2, field) * _root(3, field) if square == 6 else _root(square, field)
    return None if found == 0 else found


def _root(square: int, field: NumberField) -> Any:
    """sqrt 2 or sqrt 3 in the field; zero (then unused) where the field has none."""
    theta = field.generator()
    if field.degree == 4:
        cube = theta**3
        return (cube - 9 * theta) / 2 if square == 2 else (11 * theta - cube) / 2
    return theta if field.degree == 2 and theta * theta == square else Fraction(0)
