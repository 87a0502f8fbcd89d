"""Triangular points and fibres over them, on cases with known answers."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

import pytest
from flint import acb, arb
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import InternalError
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.arithmetic.fibre import AlgebraicFibre, SimplePart, fibre, lazard_evaluation, values
from qe.kernel.arithmetic.sturm import count_real_roots, real_among
from qe.kernel.arithmetic.triangular import ORIGIN, Coordinate, Point, pseudo_remainder
from tests.tables import each

RING = Ring.of(("x", "y", "z"))


def poly(text: str) -> Poly:
    found = convert(read(f"{text} = 0"), RING)
    return found.poly  # type: ignore[attr-defined,no-any-return]


def point(*systems: tuple[str, int, int]) -> Point:
    """Each coordinate: polynomial and the ends of its interval; the polynomial rises there."""
    built = ORIGIN
    for i, (text, low, high) in enumerate(systems):
        built = built.extended(Coordinate(i, poly(text), Fraction(low), Fraction(high), 1))
    return built


SQRT2 = point(("x^2 - 2", 1, 2))
FOURTH = point(("x^2 - 2", 1, 2), ("y^2 - x", 1, 2))  # y = 2^(1/4)
SPLIT = point(("x^2 - 2", 1, 2), ("y^2 - 2", 1, 2))  # the second polynomial is reducible over the first


@each(
    (SQRT2, "x^2 - 2", 0),
    (SQRT2, "x^4 - 4", 0),
    (SQRT2, "1414213562373095048801688724209698078569*x - 2000000000000000000000000000000000000000", -1),
    (SQRT2, "x + 1", 1),
    (FOURTH, "y^4 - 2", 0),
    (FOURTH, "y^3 - x*y", 0),
    (FOURTH, "y - x", -1),
    (SPLIT, "x - y", 0),
    (SPLIT, "x + y", 1),
    (SPLIT, "x*y - 2", 0),
)
def test_signs(at: Point, text: str, sign: int) -> None:
    assert at.sign(poly(text)) == sign
    assert at.sign(poly(f"-({text})")) * -1 == sign or poly(f"-({text})") == poly(text)
    assert at.vanishes(poly(text)) is (sign == 0)


def test_a_variable_without_a_value_is_refused() -> None:
    with pytest.raises(InternalError):
        SQRT2.sign(poly("y - 1"))


@each(
    ("z^2 - x", 2, 2),
    ("z^2 + y", 2, 0),
    ("(z - y)^2*(z^2 - x)*(z - 3)", 5, 3),  # z = y is a root of the second factor too
    ("(z - y)^2*(z - x)^2", 4, 2),
    ("(z - y)^2*(z^2 + x)", 4, 1),
    ("(z - y)^3*(z + 1)", 4, 2),
    ("(y^2 - x)*z^3 + z - y", 1, 1),
    ("z^4 - 3*x*z^2 + z", 4, 4),
)
def test_counts_over_a_tower(text: str, degree: int, count: int) -> None:
    f = fibre(FOURTH, poly(text), 2)
    assert isinstance(f, AlgebraicFibre)
    assert (f.degree, f.count(), f.count_by_remainders(), f.squarefree().count()) == (degree, count, count, count)


def test_double_roots_are_split_off_without_division() -> None:
    f = fibre(FOURTH, poly("(z - y)^2*(z^2 - 3)"), 2)
    assert isinstance(f, AlgebraicFibre)
    simple = f.squarefree()
    assert isinstance(simple, SimplePart)
    assert simple.degree == 3
    at = values(tuple(Fraction(v) for v in (-2, 0, Fraction(3, 2), 2)))
    assert f.signs(at) == [1, -1, -1, 1]
    changes = simple.signs(at)
    assert [a != b for a, b in pairwise(changes)] == [True, True, True]
    for low, high, value in [(0, Fraction(3, 2), "z - y"), (Fraction(3, 2), 2, "z^2 - 3"), (-2, 0, "z^2 - 3")]:
        number = simple.coordinate(Fraction(low), Fraction(high))
        assert isinstance(number, Coordinate)
        assert FOURTH.extended(number).sign(poly(value)) == 0


def test_common_roots_are_found_and_told_from_near_ones() -> None:
    f, g = (fibre(FOURTH, poly(t), 2) for t in ("z^3 - x*z + y - 1", "z^2 - x"))
    h = fibre(FOURTH, poly("z^4 - 2"), 2)
    assert isinstance(g, AlgebraicFibre)
    assert g.gcd(AlgebraicFibre(FOURTH, 2, poly("z^4 - x^2"))).degree == 2
    assert g.gcd(AlgebraicFibre(FOURTH, 2, poly("(z - y)*(z - 5)"))).degree == 1
    assert f.gcd(g).degree == 0
    assert h.count() == 2
    near = AlgebraicFibre(FOURTH, 2, poly("z^2 - x*z + y*z - x*y"))  # roots x and -y
    common = g.gcd(near)
    low, middle, high = common.signs(values((Fraction(-2), Fraction(0), Fraction(2))))
    assert common.degree == 1 and low == -middle and middle == high


def test_lazard_evaluation_keeps_the_hidden_root() -> None:
    """(x - a)*(z - 1) + (x - a)^2*z over x = a leaves z - 1."""
    f = poly("(x^2 - 2)*(z - 1) + (x^2 - 2)^2*z")
    evaluated = fibre(SQRT2, lazard_evaluation(f, SQRT2, {1: Fraction(0)}, 2), 2)
    assert evaluated.degree == 1
    assert evaluated.signs(values((Fraction(1, 2), Fraction(1), Fraction(3, 2)))) == [-1, 0, 1]
    rational = lazard_evaluation(poly("x^2*z - x*y^2*z - x^3"), ORIGIN, {0: Fraction(0), 1: Fraction(0)}, 2)
    assert rational.normal()[1] == poly("z")


def test_a_small_number_is_no_zero() -> None:
    """(x - 1)^200 for the cube root x of 2 is less than 2^-389, its coefficients have 195 bits."""
    p, x = RING.constant(1), RING.gen(0)
    for _ in range(200):
        p = p * (x - 1)
        high = p.coefficients(0)[3:]
        p = p - (high[0] * (x**3 - 2) if high else 0)
    cube = point(("x^3 - 2", 1, 2))
    assert cube.sign(p) == 1 and cube.sign(-p) == -1 and not cube.vanishes(p)
    assert cube.sign(p * (x**3 - 2)) == 0


def test_two_factors_with_roots_between_two_numbers_are_no_coordinate() -> None:
    assert fibre(ORIGIN, poly("(x^2 - 2)*(x^2 - 3)"), 0).coordinate(Fraction(1), Fraction(2)) is None
    assert fibre(ORIGIN, poly("(x^2 - 2)*(x^2 - 3)"), 0).coordinate(Fraction(1), Fraction(3, 2)) is not None


def test_enclosures_that_meet_their_mirror_images_do_not_tell_real_roots() -> None:
    near, far = (acb(arb(1, 0.1), arb(y, 0.1)) for y in ("0.05", "-0.1"))
    assert real_among([near, acb(5)]) == 2 and real_among([near, far]) is None
    assert real_among([acb(0, 1), acb(0, -1), acb(2)]) == 1


@pytest.mark.parametrize("roots", range(6))
def test_real_roots_are_counted(roots: int) -> None:
    """Also where leading coefficients of remainders are negative and degrees drop by more than one."""
    for extra in ("1", "x^2 + 1", "x^4 + x + 1", "-x^2 - x - 1", "x^6 + 3"):
        p = poly(extra) if extra != "1" else RING.constant(1)
        for k in range(roots):
            p = p * (2 * RING.gen(0) - 3 * k + 1)
        if p.degree(0) > 0:
            q = p.to_univariate(0)
            assert count_real_roots(q) == roots == count_real_roots(-q)
            assert count_real_roots(q * q) == roots


@given(
    st.sampled_from([(SQRT2, 1), (FOURTH, 2), (SPLIT, 2)]),
    st.lists(st.integers(-3, 3), min_size=4, max_size=30),
    st.sampled_from([(0, 1), (-2, 1), (-3, 0, 0, 1), (1, -1), (-2,)]),
    st.integers(-2, 2),
)
def test_a_remainder_has_the_sign_that_is_said_at_a_root_of_the_divisor(
    over: tuple[Point, int], numbers: list[int], lead: tuple[int, ...], root: int
) -> None:
    """The divisor is lead * (v - root) for the variable v of the fibre."""
    at, i = over
    v, zero = RING.gen(i), RING.constant(0)

    def in_x(given: Sequence[int]) -> Poly:
        return sum((c * RING.gen(0) ** k for k, c in enumerate(given)), zero)

    a = sum((in_x(numbers[k : k + 3]) * v ** (k // 3) for k in range(0, len(numbers), 3)), zero)
    b = in_x(lead) * (v - root)
    r, s = pseudo_remainder(at, a, b, i)
    assert abs(s) == 1 and r.degree(i) == 0
    assert at.sign(r) == s * at.sign(a.at_rational(i, Fraction(root)))
