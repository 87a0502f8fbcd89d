"""Chains of motions against plain trigonometry: end points, derivatives, and pieces that hold exactly one solution."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin

import pytest

from bezier.arm.motion_chain import MotionChain
from tests.tables import each

F = Fraction
STILL = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))
ALONG = ((1, 0, 0, 2), (0, 1, 0, 0), (0, 0, 1, 0))
"""A link of length 2."""

SCARA = MotionChain((STILL, ALONG, ALONG, STILL), (True, True, False))
"""Two links that turn in the plane, and a slide across it."""


def end(a: float, b: float, c: float) -> tuple[float, float, float]:
    return 2 * cos(a) + 2 * cos(a + b), 2 * sin(a) + 2 * sin(a + b), c


POWERS = ((F(3), F(1, 10)), (F(1, 2), F(0), F(1, 10)), (F(1), F(-1)))
"""(3 + s/10, 1/2 + s^2/10, 1 - s)."""
LINE = SCARA.track(POWERS)


def target(s: float) -> tuple[float, ...]:
    return tuple(sum(float(c) * s**k for k, c in enumerate(coordinate)) for coordinate in POWERS)


def test_a_solution_is_one() -> None:
    for s in (F(0), F(1), F(-2)):
        found = SCARA.solve(LINE, s, (0.0, 1.0, 0.0))
        assert found is not None
        assert end(*found) == pytest.approx(target(float(s)), abs=1e-12)
    assert SCARA.solve(SCARA.track(((F(9),), (F(0),), (F(0),))), F(0), (0.1, 1.0, 0.0)) is None  # out of reach
    assert SCARA.solve(LINE, F(0), (0.0, 0.0, 0.0)) is None  # stretched out: singular


@each((F(-1, 20), F(1, 20)), (F(1), F(21, 20)))
def test_a_piece_encloses_the_solutions_and_their_derivatives(low: Fraction, high: Fraction) -> None:
    piece = SCARA.piece(LINE, low, high, (-0.5, 1.2, 1.0))
    assert piece is not None and (piece.low, piece.high) == (low, high)
    step = F(1, 1000)
    for k in range(1, 10):
        s = low + (high - low) * F(k, 10)
        before, here, after = (SCARA.solve(LINE, s + d * step, piece.near(s)) for d in (-1, 0, 1))
        assert before is not None and here is not None and after is not None
        assert [float(x) for x in piece.at(s)] == pytest.approx(piece.near(s))
        for j in range(3):
            assert abs(here[j] - piece.near(s)[j]) <= piece.inner[j] + 1e-15 and piece.inner[j] < piece.radius[j]
            speed, push = (after[j] - before[j]) / 0.002, (after[j] - 2 * here[j] + before[j]) / 1e-6
            assert piece.velocity[j][0] - 1e-5 <= speed <= piece.velocity[j][1] + 1e-5
            assert piece.acceleration[j][0] - 1e-3 <= push <= piece.acceleration[j][1] + 1e-3


def test_no_piece_where_solutions_may_meet_or_are_far_apart() -> None:
    assert SCARA.piece(LINE, F(-4), F(4), (-0.5, 1.2, 1.0)) is None  # too long for one box
    edge = SCARA.track(((F(4), F(1)), (F(0),), (F(0),)))
    assert SCARA.piece(edge, F(-1, 10), F(1, 10), (0.0, 0.1, 0.0)) is None  # leaves the reach at s = 0


def test_turns_are_about_z_and_in_order() -> None:
    quarter = SCARA.solve(SCARA.track(((F(0),), (F(4),), (F(5),))), F(0), (pi / 2 - 0.01, 0.02, 4.0))
    assert quarter is None or end(*quarter) == pytest.approx((0, 4, 5), abs=1e-6)
    bent = SCARA.solve(SCARA.track(((F(2),), (F(2),), (F(-3),))), F(0), (0.1, 1.5, 0.0))
    assert bent == pytest.approx([0.0, pi / 2, -3.0])
