"""Enclosures of functions over boxes: every value inside lies in the ball, with its derivative."""

from fractions import Fraction
from math import asin, sqrt

from flint import arb
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import RealAlgebraic
from qe.exact.balls import ends, precision
from qe.exact.enclosure import (
    Jet,
    box_sides,
    constant,
    evaluate,
    root_jet,
    smooth_side,
)
from qe.exact.ring import Poly, Ring
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


def variable(low: Fraction, high: Fraction, side: int = 0, count: int = 1) -> Jet:
    """The coordinate on [low, high]."""
    sides = box_sides(((low, high),) * count)
    middle = constant((low + high) / 2, sides).centre
    slope = tuple(arb(int(k == side)) for k in range(count))
    return Jet(middle + sides[side], slope, middle, sides)


def contains(ball: arb, value: float) -> bool:
    return bool(abs(ball.mid() - arb(value)) <= ball.rad() + arb(1e-12))


INTERVALS = st.tuples(st.fractions(-2, 2, max_denominator=8), st.fractions(0, 1, max_denominator=8)).map(
    lambda pair: (pair[0], pair[0] + pair[1])
)


@given(polynomials(Ring.of(("x",)), max_degree=4), INTERVALS)
def test_polynomials(poly: Poly, interval: tuple[Fraction, Fraction]) -> None:
    low, high = interval
    x = variable(low, high)
    found = evaluate(poly, {0: x}, x.sides)
    slope = evaluate(poly.derivative(0), {0: x}, x.sides)
    for k in range(5):
        at = low + (high - low) * k / 4
        exact = poly.evaluate((at,))
        assert contains(found.value - arb(0), float(exact)) or abs(exact) > 10**15
        assert found.slope is not None and (found.slope[0].overlaps(slope.value) or abs(exact) > 10**15)
    assert contains(found.centre, float(poly.evaluate(((low + high) / 2,)))) or poly.height_bits() > 40


def test_the_mean_over_a_small_box_is_second_order() -> None:
    widths = []
    for k in (4, 5, 6):
        x = variable(Fraction(1), 1 + Fraction(1, 2**k))
        widths.append(float((x * x * x).mean().rad()))
    assert widths[0] / widths[1] > 3 and widths[1] / widths[2] > 3
    x = variable(Fraction(0), Fraction(1))
    assert contains((x * x).mean(), 1 / 3)


@each(
    (lambda x: x + x, lambda v: 2 * v),
    (lambda x: x * x - x, lambda v: v * v - v),
    (lambda x: -x, lambda v: -v),
    (lambda x: x.inverse(), lambda v: 1 / v),
    (lambda x: x.root(), sqrt),
    (lambda x: x.over(3), lambda v: v / 3),
    (lambda x: x.scaled(-5), lambda v: -5 * v),
    (lambda x: x.over(4).arcsine(), lambda v: asin(v / 4)),
)
def test_functions_and_their_slopes(function, exact) -> None:  # type: ignore[no-untyped-def]
    low, high = Fraction(1), Fraction(5, 4)
    found = function(variable(low, high))
    for k in range(9):
        v = float(low + (high - low) * k / 8)
        assert contains(found.value, exact(v))
        assert contains(found.slope[0], (exact(v + 1e-7) - exact(v - 1e-7)) / 2e-7) or (
            abs(float(found.slope[0].mid()) - (exact(v + 1e-7) - exact(v - 1e-7)) / 2e-7)
            <= float(found.slope[0].rad()) + 1e-6
        )
    assert contains(found.centre, exact(1.125))


def test_where_a_derivative_is_unbounded_it_is_not_said() -> None:
    zero = variable(Fraction(0), Fraction(1))
    assert zero.inverse() is None and zero.root().slope is None and contains(zero.root().value, 1.0)
    assert (
        zero.arcsine().slope is None and contains(zero.arcsine().value, asin(1)) and contains(zero.arcsine().value, 0)
    )
    assert (zero.root() + zero).slope is None and (zero.root() * zero).slope is None


@each(
    (Y - 3 * X, 1, lambda x: 3 * x),
    (2 * Y + X**2, 1, lambda x: -x * x / 2),
    (Y**2 - X, 1, lambda x: -sqrt(x)),
    (Y**2 - X, 2, sqrt),
    (X - Y**2, 1, lambda x: -sqrt(x)),
    (X - Y**2, 2, sqrt),
    (Y**3 - X, 1, lambda x: x ** (1 / 3)),
    ((Y - X) * (Y + X) * (Y - 5), 3, lambda x: 5.0),
    ((Y - X) * (Y + X) * (Y - 5), 2, lambda x: x),
)
def test_roots(poly: Poly, k: int, exact) -> None:  # type: ignore[no-untyped-def]
    with precision(120):
        x = variable(Fraction(1), Fraction(33, 32))
        found = root_jet(poly, k, {0: x}, x.sides)
    assert found is not None
    for step in range(5):
        assert contains(found.value, exact(1 + step / 128))
    assert contains(found.centre, exact(1 + 1 / 64)) and float(found.value.rad()) < 0.2


def test_roots_that_are_not_enclosed() -> None:
    x = variable(Fraction(-1), Fraction(1))
    assert root_jet(X * Y - 1, 1, {0: x}, x.sides) is None and root_jet(X * Y**2 - 1, 1, {0: x}, x.sides) is None
    one = variable(Fraction(1), Fraction(2))
    assert root_jet(Y**3 - X, 2, {0: one}, one.sides) is None


def test_numbers_and_ends() -> None:
    sides = box_sides(((Fraction(0), Fraction(1, 2)),))
    assert float(sides[0].rad()) >= 0.25 and contains(sides[0], 0.25) and contains(sides[0], -0.25)
    assert contains(constant(RealAlgebraic.from_root([-2, 0, 1], 1, 2), sides).value, sqrt(2))
    low, high = ends(constant(Fraction(1, 3), sides).value)
    assert low <= Fraction(1, 3) <= high and high - low < Fraction(1, 10**12)
    assert ends(constant(-4, sides).value) == (-4, -4)


def test_the_substitution_that_removes_square_root_ends() -> None:
    """w(0) = 0, w(1) = 1, w' vanishes at both ends, and over [0, 1] w' has the mean 1."""
    sides = box_sides(((Fraction(0), Fraction(1)),))
    place, weight = smooth_side(Fraction(0), Fraction(1), 0, sides)
    for k in range(5):
        v = k / 4
        assert contains(place.value, 3 * v**2 - 2 * v**3) and contains(weight.value, 6 * v * (1 - v))
        assert place.slope is not None and contains(place.slope[0], 6 * v * (1 - v))
        assert weight.slope is not None and contains(weight.slope[0], 6 - 12 * v)
    assert contains(place.centre, 0.5) and contains(weight.centre, 1.5) and contains(weight.mean(), 1.0)
