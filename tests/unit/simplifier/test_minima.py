"""Minima of quadratic polynomials and of sums of even monomials."""

from fractions import Fraction
from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.simplifier.minima import minimum, minimum_of_quadratic, vanishing
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


@each(X, X**3, -(X**2), X * Y, X**2 + Y, X**2 - Y**2, X**2 + 4 * X * Y, X**4 - X**2, X**4 + X, X**4 * Y + X**2)
def test_no_minimum_is_claimed(poly: Poly) -> None:
    assert minimum(poly) is None and vanishing(poly) == ()
    assert minimum(RING.constant(0)) is None


COEFFICIENTS = st.integers(-3, 3)


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
    found = minimum_of_quadratic(poly)
    points = list(product((-3, -1, 0, Fraction(1, 2), 2), repeat=3))
    if found is None:  # so it is unbounded: along some direction, or linear along a flat one
        far = [
            poly.evaluate([Fraction(k) * v for v in p]) for p in product((-2, -1, 0, 1, 2), repeat=3) for k in (10**6,)
        ]
        assert min(far) < 0 or any(c[6:9])
        return
    for point in points:
        value = poly.evaluate(point)
        assert value >= found.value
        assert (value == found.value) == (not any(z.evaluate(point) for z in found.zeros))
