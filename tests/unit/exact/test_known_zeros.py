"""What is known to vanish at a sample point is not proved again, and nothing else is taken for known."""

from __future__ import annotations

import pytest

from qe.exact.fibre_stack import isolate_over
from qe.exact.remainder import divides
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.tower import Tower

RING = Ring.of(("x", "y", "z"))
x, y, z = (RING.gen(i) for i in range(3))


def over(point: Point, f: Poly) -> Point:
    """The highest root of f over the point."""
    isolation = isolate_over(point, (f,))
    return isolation.sample(2 * len(isolation.sections) - 1)


@pytest.fixture
def point() -> Point:
    return over(over(Point(RING), x**3 - 2 * x - 1 - x**2), y**3 - x * y + 1 - 3 * x)


def test_multiples_of_a_section_vanish_without_the_tower(point: Point, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*given: object) -> object:
        raise AssertionError("the tower was asked")

    monkeypatch.setattr(Tower, "is_zero", refuse)
    monkeypatch.setattr(Point, "tower", property(refuse))
    assert point.is_zero((y**3 - x * y + 1 - 3 * x) * (y**5 + x**7 * y + 1))
    assert point.is_zero((x**3 - 2 * x - 1 - x**2) ** 2 * (y - 1))


def test_other_polynomials_are_still_decided(point: Point) -> None:
    f = y**3 - x * y + 1 - 3 * x
    assert not point.is_zero(f + 1)
    assert not point.is_zero(y**3 - x * y + 2)
    assert point.is_zero(f * f + (x**3 - 2 * x - 1 - x**2) * y)  # in the ideal, divided by neither


def test_sectors_know_nothing() -> None:
    isolation = isolate_over(Point(RING), (x**2 - 2,))
    assert isolation.sample(0).vanishing == ()
    assert isolation.sample(1).vanishing == (x**2 - 2,)


def test_divides() -> None:
    assert divides(x - y, 3 * (x**2 - y**2)) and divides(2 * x - 2 * y, x**2 - y**2)
    assert not divides(x - y, x**2 + y**2) and not divides(x * y, x)
