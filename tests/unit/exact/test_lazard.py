"""Lazard evaluation: the first derivative that does not vanish identically over a sample point."""

from fractions import Fraction

from qe.exact.algebraic import RealAlgebraic
from qe.exact.lazard import lazard_derivative, lazard_evaluation
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from tests.tables import each

RING = Ring.of(("a", "b", "x"))
A, B, X = (RING.gen(i) for i in range(3))
ROOT2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)
ZERO, ONE = Fraction(0), Fraction(1)


@each(
    (X - A, (ONE, ONE), X - A),
    (A * X + B, (ZERO, ZERO), RING.constant(1)),
    (A * X + A * B, (ZERO, ZERO), X + B),
    (A * X + B, (ZERO, ONE), A * X + B),
    (A**2 * X + B, (ZERO, ZERO), RING.constant(1)),
    (A**2 * X + A**2 * B, (ZERO, ZERO), 2 * X + 2 * B),
    (B * X - B**2, (ONE, ZERO), X - 2 * B),
    ((A**2 - 2) * X + B, (ROOT2, ZERO), RING.constant(1)),
    ((A**2 - 2) * (X - B), (ROOT2, ONE), 2 * A * X - 2 * A * B),
    ((B - A) * X, (ROOT2, ROOT2), X),
)
def test_derivatives(poly: Poly, point: tuple[Fraction | RealAlgebraic, ...], derivative: Poly) -> None:
    assert lazard_derivative(Point.of(RING, point), poly) == derivative


def test_rational_coordinates_are_put_in() -> None:
    found = lazard_evaluation(Point.of(RING, (Fraction(3), ONE)), A * X - B)
    assert found.variables == (2,) and found.normal()[1] == 3 * X - 1
    assert lazard_evaluation(Point.of(RING, (ROOT2, ONE)), A * X - B) == A * X - 1
