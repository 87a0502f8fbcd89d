"""Zeros of polynomials with sines and cosines of rational angles among their coefficients."""

from __future__ import annotations

from fractions import Fraction
from math import cos, sin, sqrt

import pytest

from qe.exact.field import NumberField
from qe.exact.ring import Poly, Ring
from qe.exact.zeros_at_angle import zeros_at_angle
from tests.tables import each

RING = Ring.of(("w", "s", "c", "z"))
W, S, C, Z = (RING.gen(k) for k in range(4))
ROOT = NumberField.from_root([-2, 0, 1], 1, 2).theta


@each(Fraction(3), Fraction(-1, 2), Fraction(22, 7))
@each(
    (S * C - Z, lambda w, c, z: [z / c]),
    (S**2 - W * C * S + 10 * Z**2, lambda w, c, z: []),
    ((S - W) * (S * C - W * Z), lambda w, c, z: sorted((w, w * z / c))),
    (C * W + Z, lambda w, c, z: []),
    (S**2 + C, lambda w, c, z: [-sqrt(-c), sqrt(-c)] if c < 0 else []),
)
def test_zeros_are_told_apart(p: Poly, expected, angle: Fraction) -> None:
    w, c, z = sqrt(2), cos(angle), sin(angle)
    if 2 * c * c > 40 * z * z:
        return  # the second one has zeros then
    found = zeros_at_angle(p, 1, ROOT, angle, 100)
    assert found is not None
    assert [float(low) for low, _ in found] == pytest.approx(expected(w, c, z))
    assert all(low <= high < low + Fraction(1, 1 << 40) for low, high in found)


def test_double_zeros_are_not() -> None:
    assert zeros_at_angle((S - C) ** 2, 1, ROOT, Fraction(1), 64) is None
