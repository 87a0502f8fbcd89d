"""Remainder sequences over algebraic points: the same zeros, common divisors and roots as the tower of fields."""

from fractions import Fraction

from hypothesis import assume, given
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.remainder import common_coefficients, squarefree_coefficients
from qe.exact.ring import Poly, Ring
from qe.exact.sample import FibreRoot, Point
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.gen(i) for i in range(3))


def _points() -> list[Point]:
    """Points over (x, y) with x^2 = 2 and y a root of a cubic or quartic over it, and x of degree 5."""
    found = []
    for f, g in [(X**2 - 2, Y**3 - X * Y - 1), (X**5 - X - 1, Y**2 - X), (X**2 - 3, (Y**2 - X) * (Y - 1))]:
        for root in real_roots(f.to_univariate(0)):
            below = Point(RING).extend(root)
            found += [below.extend(s.value) for s in isolate_over(below, (g,)).sections]
    return [p for p in found if isinstance(p.value, FibreRoot)]


POINTS = _points()


def test_there_are_points_to_test_with() -> None:
    assert len(POINTS) >= 5


@given(st.sampled_from(POINTS), polynomials(Ring.of(("x", "y")), max_degree=3), st.booleans())
def test_zeros_are_those_of_the_tower(point: Point, poly: Poly, times: bool) -> None:
    """Also of multiples of the polynomials that define the point, which vanish."""
    g = poly.convert(RING)
    if times:
        assert isinstance(point.value, FibreRoot)
        g = g * point.value.fibre.polynomial() + (X**2 - 2) * (X**5 - X - 1) * (X**2 - 3)
    reduced = point.reduce(g)
    assume(reduced and reduced.level == 1)
    assert isinstance(point.value, FibreRoot)
    assert point.value.annuls(reduced) is point.tower.is_zero(reduced)


@given(st.sampled_from(POINTS), polynomials(Ring.of(("x", "y", "z")), max_degree=2), st.integers(1, 3))
def test_squarefree_parts_have_the_same_roots(point: Point, poly: Poly, power: int) -> None:
    f = (poly + Z**3) ** power
    coefficients = squarefree_coefficients(f.coefficients(2), point.vanishes)
    part = sum((c * Z**k for k, c in enumerate(coefficients)), RING.constant(0))
    plain, reduced = isolate_over(point, (poly + Z**3,)), isolate_over(point, (part,))
    assert all(s.ball().overlaps(t.ball()) for s, t in zip(plain.sections, reduced.sections, strict=True))
    again = squarefree_coefficients(coefficients, point.vanishes)
    assert len(again) == len(coefficients)


@each(
    (Z**2 - X, Z**2 - X, 2),
    ((Z - X) * (Z - 1), (Z + X) * (Z - 1), 1),
    (Z**2 - 2, Z - X, 1),  # only because x^2 = 2
    (Z**3 - 2, Z - X, 0),
    ((X**2 - 2) * Z**3 + Z - X, Z - X, 1),  # the leading coefficient vanishes
    (Z - X, (X**2 - 2) * Z, 1),  # the other one is zero
)
def test_common_divisors_over_the_square_root_of_two(f: Poly, g: Poly, degree: int) -> None:
    (_, root) = real_roots((X**2 - 2).to_univariate(0))
    point = Point(RING).extend(root).extend(Point.of(RING, [Fraction(0)]).coordinate(0))
    common = common_coefficients(f.coefficients(2), g.coefficients(2), point.vanishes)
    assert len(common) == degree + 1
    assert not point.vanishes(common[-1])
