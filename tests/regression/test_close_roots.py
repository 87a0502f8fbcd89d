"""Roots that agree to more digits than a float has must still be put in order (the lifting loop did not end)."""

from __future__ import annotations

from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Ring
from qe.exact.sample import Point


def test_roots_closer_than_floating_point_resolution_are_separated() -> None:
    ring = Ring.of(("x",))
    x = ring.gen(0)
    big = 10**12
    first = (x - big) ** 2 * big**20 - 2  # roots big ± sqrt(2)/10^120
    second = (x - big) ** 2 * big**20 - 3
    found = isolate_over(Point(ring), (first, second))
    assert [s.members for s in found.sections] == [[1], [0], [0], [1]]
    assert found.sectors == tuple(sorted(set(found.sectors)))
