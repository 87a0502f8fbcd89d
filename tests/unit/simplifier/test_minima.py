"""Minima of quadratic polynomials, of sums of even monomials, and of numbers and squares."""

from fractions import Fraction
from itertools import product
from math import lcm

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.syntax import FALSE
from qe.io.text import read
from qe.simplifier.minima import minimum, vanishing
from qe.simplifier.simplify import simplify
from tests.tables import each

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.gen(i) for i in range(3))


@each(
    (X**2, 0, (X,)),
    (X**2 - 2 * X, -1, (X - 1,)),
    (X**2 + X * Y + Y**2 + 3, 3, (2 * X + Y, Y)),
    ((X - Y) ** 2 + 4, 4, (X - Y,)),
    (2 * X**4 + 3 * X**2 * Y**2 - 5, -5, (X * Y, X)),
    (2 * (X - Y + 1) ** 2 + 3 * (Z - 2) ** 2, 0, (X - Y + 1, Z - 2)),
    (2 * X**2 + 2 * X, Fraction(-1, 2), (2 * X + 1,)),
)
def test_minimum(poly: Poly, value: int, zeros: tuple[Poly, ...]) -> None:
    found = minimum(poly)
    assert found is not None and found.value == value
    assert {z.normal()[1] for z in found.zeros} == {z.normal()[1] for z in zeros}
    assert bool(vanishing(poly)) == (value == 0)


@each(X, X**3, -(X**2), X * Y, X**2 + Y, X**2 - Y**2, X**2 + 4 * X * Y, X**4 + X, X**4 * Y + X**2, X**2 - 2 * X**4)
def test_no_minimum_is_claimed(poly: Poly) -> None:
    assert minimum(poly) is None and vanishing(poly) == ()
    assert minimum(RING.constant(0)) is None


COEFFICIENTS = st.integers(-3, 3)


def is_sum(poly, least):
    scale = lcm(least.value.denominator, *(weight.denominator for weight, _ in least.squares))
    squares = sum(root * root * int(weight * scale) for weight, root in least.squares)
    return all(weight > 0 for weight, _ in least.squares) and poly * scale == squares + int(least.value * scale)


@given(*[st.lists(COEFFICIENTS, min_size=4, max_size=4)] * 2, COEFFICIENTS)
def test_squares_of_curved_polynomials_are_completed(c, d, constant):
    inner = c[0] * Y * Z + c[1] * Y**2 + c[2] * Z + c[3]
    outer = d[0] * Y**2 + d[1] * Y * Z + d[2] * Z**2 + d[3]
    poly = (X - inner) ** 2 * 3 + 2 * (Y - d[0] * Z**2) ** 2 + Z**4 + constant
    found = minimum(poly)
    assert found is not None and found.value <= constant and is_sum(poly, found)
    assert minimum((X - inner) ** 2 + outer - X**4) is None


@each(X * Y - 3, X**2 + Y**2 + Z**2 - 1, (X**2 - 3) * (Y - Z * X), 2 * X**2 - X + 1, X**3 - X * Y + Z, X**2 * Y**2 - Y)
def test_numbers_and_one_square_of_any_degree(root: Poly) -> None:
    for c in (-3, 0, 1):
        found = minimum(root * root * 3 + c)
        assert found is not None and found.value >= c and is_sum(root * root * 3 + c, found)
        assert minimum(root * root * -3 + c) is None


def test_a_polynomial_that_vanishes_on_the_line_that_is_looked_at() -> None:
    assert minimum(X**4 * (Y - 3) ** 2 + (Y - 3) ** 2 * Z**4 - (Y - 3) ** 2 * X**2 * Z**2 * 5) is None
    assert minimum((X**2 * (Y - 3) + 1) ** 2 + 1) is None  # not seen, though there is one


@each("x*y - z", "x^2 + y^2 + z^2 - 1", "(x - y)*(x + z)", "x^3 - 2*x*y")
def test_an_odd_power_with_a_positive_factor_hid_its_sign(given: str) -> None:
    before, p = read(f"{given} > 0"), f"({given})"
    assert simplify(read(f"{p}*({p}^2 + 1) > 0 and {p}*({p}^2 + 1)^3 > 0")) == simplify(before)
    assert simplify(read(f"{p}^4 + 2*{p}^2 + 2 <= 0")) == FALSE


@given(st.lists(COEFFICIENTS, min_size=10, max_size=10))
def test_minima_of_quadratics_are_least_values(c):
    poly = (
        c[0] * X**2
        + c[1] * Y**2
        + c[2] * Z**2
        + c[3] * X * Y
        + c[4] * X * Z
        + c[5] * Y * Z
        + c[6] * X
        + c[7] * Y
        + c[8] * Z
        + c[9]
    )
    if poly.total_degree != 2:
        return
    found = minimum(poly)
    points = list(product((-3, -1, 0, Fraction(1, 2), 2), repeat=3))
    if found is None:  # so it is unbounded: along some direction, or linear along a flat one
        far = [
            poly.evaluate([Fraction(k) * v for v in p]) for p in product((-2, -1, 0, 1, 2), repeat=3) for k in (10**6,)
        ]
        assert min(far) < 0 or any(c[6:9])
        return
    assert is_sum(poly, found)
    for point in points:
        value = poly.evaluate(point)
        assert value >= found.value
        assert (value == found.value) == (not any(z.evaluate(point) for z in found.zeros))
