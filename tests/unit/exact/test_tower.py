"""Towers of fields over roots: arithmetic, and Lazard's values of polynomials."""

from fractions import Fraction

from flint import arb, fmpq_mpoly
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import RealAlgebraic
from qe.exact.lazard import lazard_derivative, lazard_evaluation
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.tower import Tower, clear_denominators, degree_in, leading_in
from tests.tables import each

# Towers of real number fields: inverses, common divisors, squarefree parts, norms, factors.

RING = Ring.of(("a", "b", "x"))
A, B, X = (RING.gen(i) for i in range(3))
# a = sqrt(2), b = sqrt(3 + a)
FIRST = Tower(RING).extended(0, fmpq_mpoly((A**2 - 2).p, RING.qctx))
SECOND = FIRST.extended(1, fmpq_mpoly((B**2 - A - 3).p, RING.qctx))


def own(variable: int, bits: int) -> arb:
    return arb(2).sqrt() if variable == 0 else (arb(3) + arb(2).sqrt()).sqrt()


def element(p: Poly) -> fmpq_mpoly:
    return SECOND.embed(p)


COEFFICIENTS = st.lists(st.integers(-3, 3), min_size=4, max_size=4)
ELEMENTS = COEFFICIENTS.map(lambda c: c[0] + c[1] * A + c[2] * B + c[3] * A * B)


def test_zeros_are_seen() -> None:
    assert SECOND.degree == 4 and FIRST.degree == 2 and Tower(RING).degree == 1
    assert SECOND.is_zero(A**2 - 2) and SECOND.is_zero((B**2 - 3) ** 2 - 2) and SECOND.is_zero(A * B**2 - 3 * A - 2)
    assert not SECOND.is_zero(A - B) and not SECOND.is_zero(RING.constant(1)) and SECOND.is_zero(RING.constant(0))


@given(ELEMENTS.filter(bool))
def test_inverses(p):
    inverse = SECOND.inverse(element(p))
    assert SECOND.reduce(inverse * element(p)) == RING.qctx.constant(1)
    assert SECOND.reduce(inverse) == inverse


@given(ELEMENTS, ELEMENTS, ELEMENTS)
def test_common_divisors(p, q, r):
    """(x - p) divides both; what else they share is shared by x - q and x - r."""
    f, g = (SECOND.reduce(element(X - p) * element(X - s)) for s in (q, r))
    common = SECOND.gcd(f, g, 2)
    assert leading_in(RING, common, 2).is_one()
    assert degree_in(RING, common, 2) == (2 if SECOND.is_zero(q - r) else 1)
    for h in (f, g):
        assert not SECOND.reduce(h % common)


@given(ELEMENTS, ELEMENTS)
def test_squarefree_parts(p, q):
    f = SECOND.reduce(element(X - p) * SECOND.reduce(element(X - q) * element(X - q)))
    part = SECOND.squarefree_part(f, 2)
    wanted = element(X - p) if SECOND.is_zero(p - q) else SECOND.reduce(element(X - p) * element(X - q))
    assert part == wanted and SECOND.squarefree_part(wanted, 2) == wanted


def test_norms() -> None:
    assert list(FIRST.norm(FIRST.embed(X - A), 2)) == [-2, 0, 1]
    norm = SECOND.norm(element(X - B), 2)
    assert norm.degree() == 4 and [int(c) for c in norm] in ([7, 0, -6, 0, 1], [-7, 0, 6, 0, -1])


@each(
    (X**2 - 2, arb(2).sqrt(), X - A),
    (X**2 - 2, -arb(2).sqrt(), X + A),
    (X**2 - 3, arb(3).sqrt(), X**2 - 3),
    (X**4 - 6 * X**2 + 7, (arb(3) + arb(2).sqrt()).sqrt(), X - B),
    (X**4 - 6 * X**2 + 7, (arb(3) - arb(2).sqrt()).sqrt(), X**2 - 3 + A),
    ((X - 1) * (X**2 - 2) * (X - B), arb(1), X - 1),
    (2 * X - 4 * B, 2 * own(1, 64), X - 2 * B),
)
def test_irreducible_factors(poly: Poly, root: arb, factor: Poly) -> None:
    found = SECOND.irreducible_factor(element(poly), 2, lambda bits: root, own)
    assert found == element(factor)


def test_denominators_are_cleared() -> None:
    third = fmpq_mpoly((2 * X + 3 * A).p, RING.qctx) / 6
    assert clear_denominators(RING, third) == 2 * X + 3 * A
    assert degree_in(RING, RING.qctx.constant(0), 2) == 0


# Lazard evaluation: the first derivative that does not vanish identically over a sample point.

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
