"""Via points over the boxes between start and goal."""

from __future__ import annotations

from fractions import Fraction

import pytest

from bezier.obstacles.reader import via_over
from qe.errors import InputError
from tests.bezier.bodies import at, ball

START, GOAL = at(0, 0, 0), at(12, 0, 0)


def test_without_anything_in_the_way_thirds() -> None:
    thirds = (at(4, 0, 0), at(8, 0, 0))
    assert via_over(START, GOAL, []) == thirds
    assert via_over(START, GOAL, [ball((6, 5, 0), 1)]) == thirds  # beside the way
    assert via_over(START, at(0, 0, 9), []) == (at(0, 0, 3), at(0, 0, 6))


def test_over_one_and_over_two_boxes() -> None:
    """A tenth of the height of the highest box above it, where the boxes begin and end."""
    q0, r0 = via_over(START, GOAL, [ball((6, 0, 0), 1)])
    assert (q0, r0) == ((5, 0, Fraction(6, 5)), (7, 0, Fraction(6, 5)))
    q0, r0 = via_over(START, GOAL, [ball((9, 0, 1), 2), ball((3, 0, 0), 1)])
    assert (q0, r0) == ((2, 0, 3 + Fraction(4, 10)), (11, 0, 3 + Fraction(4, 10)))
    q0, _ = via_over(START, GOAL, [ball((6, 0, 0), 1)], Fraction(1))
    assert q0[2] == 3


@pytest.mark.parametrize("centre", [(0, 0, 5), (12, 0, 0), (1, 0, 0), (11, 0, -7)])
def test_nothing_may_stand_over_the_ends(centre: tuple[int, int, int]) -> None:
    with pytest.raises(InputError, match="give via points"):
        via_over(START, GOAL, [ball(centre, 1)])
