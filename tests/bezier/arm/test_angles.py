"""Exact angles: against floating point, and which texts are angles."""

from __future__ import annotations

from fractions import Fraction
from math import cos, isclose, pi, sin

import pytest

from bezier.arm.model import Angle, field_of, read_angle
from bezier.input.numbers import NotANumber


@pytest.mark.parametrize("twelfths", range(-24, 25))
def test_cosines_and_sines_in_the_least_field(twelfths: int) -> None:
    angle = read_angle(f"{twelfths}*pi/12")
    c, s = angle.in_field(field_of([angle]))
    assert isclose(float(c), cos(twelfths * pi / 12), abs_tol=1e-15)
    assert isclose(float(s), sin(twelfths * pi / 12), abs_tol=1e-15)
    assert c * c + s * s == 1
    assert -pi < float(angle) <= pi


@pytest.mark.parametrize("twelfths", range(-11, 13))
def test_the_same_in_the_largest_field(twelfths: int) -> None:
    c, s = Angle(twelfths).in_field(field_of([Angle(3), Angle(2)]))
    assert isclose(float(c), cos(twelfths * pi / 12), abs_tol=1e-15)
    assert isclose(float(s), sin(twelfths * pi / 12), abs_tol=1e-15)


def test_fields_are_as_small_as_they_can_be() -> None:
    assert [field_of([Angle(k)]).degree for k in (0, 6, 3, 2, 1)] == [1, 1, 2, 2, 4]
    assert field_of([Angle(9), Angle(-3)]).minimal_polynomial == (-2, 0, 1)


def test_angles_by_cosine_and_sine() -> None:
    angle = read_angle({"cos": "3/5", "sin": "-4/5"})
    assert angle.in_field(field_of([angle])) == (Fraction(3, 5), Fraction(-4, 5))
    assert str(angle) == "atan2(-4/5, 3/5)"


@pytest.mark.parametrize("text", ["0", 0, "pi", "-pi/2", "3*pi/4", "2/3*pi", "pi/12", "3 pi/4"])
def test_what_is_written_is_read_again(text: object) -> None:
    angle = read_angle(text)
    assert read_angle(str(angle)) == angle


@pytest.mark.parametrize(
    "raw", ["pi/5", "1", 1, "", "pi/0", "pipi", True, {"cos": "1/2", "sin": "1/2"}, {"cos": "1"}, [0], "sqrt(2)"]
)
def test_what_is_no_exact_angle(raw: object) -> None:
    with pytest.raises(NotANumber):
        read_angle(raw)
