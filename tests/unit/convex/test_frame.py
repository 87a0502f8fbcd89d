"""Coordinates for floats: the same flat, with the constraints near 1 in them."""

from __future__ import annotations

from fractions import Fraction

from qe.convex.frame import centred_frame, lies_far, plain_frame
from qe.exact.kkt_system import Flat
from qe.exact.quadratic_form import Quadratic
from tests.tables import each
from tests.unit.convex.quadratics import ball, diagonal, line

WHOLE = Flat.whole(2)
HUGE = Fraction(2**40)


def unit(form: Quadratic, flat: Flat = WHOLE) -> Fraction:
    """The one factor of all directions of the plain frame."""
    framed = plain_frame(flat, [form])
    (factor,) = {a / b for new, old in zip(framed.basis, flat.basis) for a, b in zip(new, old) if b}
    assert framed.origin == flat.origin
    return factor


@each(
    (ball((0, 0), 1), 0),
    (ball((0, 0), 4**8), 0),  # a length of 2^8 is near 1
    (ball((0, 0), 4**12), 12),
    (ball((0, 0), Fraction(1, 4**20)), -20),
    (ball((2**30, 0), 1), 30),
    (line(2**40, 1, constant=2**50), 0),  # half-planes have no size
    (ball((0, 0), 0), 0),
)
def test_one_unit_of_length(form: Quadratic, exponent: int) -> None:
    assert abs(unit(form) / Fraction(2) ** exponent - Fraction(3, 4)) <= Fraction(5, 4)
    assert (unit(form) == 1) is (exponent == 0)


def test_the_size_nearest_to_one_counts() -> None:
    framed = plain_frame(WHOLE, [ball((0, 0), 4**30), ball((0, 0), 4)])
    assert framed.basis == WHOLE.basis


def test_the_centre_lies_amid_the_curved_constraints() -> None:
    far = [ball((HUGE, -HUGE), 1), ball((HUGE + 1, -HUGE), 1)]
    framed = centred_frame(WHOLE, far)
    assert framed.origin == (HUGE + Fraction(1, 2), -HUGE)
    assert all(q.restrict(framed.origin, framed.basis).value((Fraction(0), Fraction(0))) < 0 for q in far)


def test_each_direction_has_its_own_unit() -> None:
    thin = diagonal(1, 2**60, constant=-1)  # x^2 + (2^30 y)^2 <= 1
    framed = centred_frame(WHOLE, [thin])
    assert framed.origin == (0, 0)
    (a, _), (_, b) = framed.basis
    assert Fraction(1, 2) <= a <= 2 and Fraction(1, 2) <= b * 2**30 <= 2


def test_linear_constraints_follow_the_sizes_of_the_others() -> None:
    """y <= 2^40 x beside x^2 <= 1: y goes as far as 2^40."""
    framed = centred_frame(WHOLE, [diagonal(1, 0, constant=-1), line(-(2**40), 1)])
    (a, _), (_, b) = framed.basis
    assert Fraction(1, 2) <= a <= 2 and Fraction(1, 4) <= b / 2**40 <= 4


def test_where_only_lines_are_the_centre_is_near_all_of_them() -> None:
    framed = centred_frame(WHOLE, [line(1, 0, constant=-HUGE), line(0, 1, constant=3)])
    assert framed.origin == (HUGE, -3) and framed.basis == WHOLE.basis
    assert centred_frame(WHOLE, []).origin == (0, 0)


@each(
    ([ball((0, 0), 1)], False),
    ([ball((1000, 0), 1)], False),
    ([ball((2**30, 0), 1)], True),
    ([ball((2**25, 0), 4**24)], False),  # about as large as it is far off
    ([ball((2**30, 0), 4**30)], True),
    ([diagonal(1, 2**60, constant=-1)], True),
    ([line(2**40, 1)], False),
)
def test_what_lies_far(forms: list[Quadratic], far: bool) -> None:
    assert lies_far(WHOLE, forms) is far


def test_points_of_the_flat_stay_points_of_it() -> None:
    flat = WHOLE.cut([line(1, 1, constant=-1)])
    assert flat is not None
    for framed in (plain_frame(flat, [ball((2**30, 0), 1)]), centred_frame(flat, [ball((2**30, 0), 1)])):
        assert len(framed.basis) == 1
        for c in (Fraction(0), Fraction(1), Fraction(-7, 3)):
            x, y = framed.lift((c,))
            assert x + y == 1
