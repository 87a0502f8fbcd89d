"""Exact arithmetic: polynomials, real algebraic numbers, and those of SymPy."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import sympy as sp
from flint import fmpq, fmpz_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.decomposition.interval import number_of
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.field import NumberField
from qe.exact.isolate import simplest_between
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.kernel.arithmetic.sturm import count_real_roots
from qe.proof.cells import SIGN_OF
from tests.strategies import integers
from tests.strategies import rationals as any_rationals
from tests.tables import each

coefficients = st.lists(integers(9), min_size=2, max_size=5)
rationals = any_rationals(6, 7)


@st.composite
def numbers(draw: st.DrawFn) -> RealAlgebraic:
    """A real root of a small polynomial, or a rational number."""
    roots = real_roots(fmpz_poly(draw(coefficients)) or fmpz_poly([0, 1]))
    return draw(st.sampled_from(roots)) if roots else RealAlgebraic.rational(draw(rationals))


@settings(max_examples=30)
@given(numbers(), numbers(), numbers())
def test_field_laws(a: RealAlgebraic, b: RealAlgebraic, c: RealAlgebraic) -> None:
    assume(a.degree * b.degree * c.degree <= 12)
    assert a + b == b + a and a * b == b * a
    assert (a + b) + c == a + (b + c)
    assert a * (b + c) == a * b + a * c
    assert a - a == 0 and a + (-a) == 0
    if b != 0:
        assert (a / b) * b == a


@settings(max_examples=30)
@given(numbers(), numbers(), rationals)
def test_order(a: RealAlgebraic, b: RealAlgebraic, q: Fraction) -> None:
    assert (a < b) + (a == b) + (b < a) == 1
    assert (a < b) == ((b - a).sign() > 0)
    assert (a == q) == (a.is_rational and a.as_fraction() == q)
    low, high = a.interval(40)
    assert low <= a <= high
    if a == b:
        assert hash(a) == hash(b)


@each(-1, 1)
def test_order_beside_rational_numbers_closer_than_any_ball(side: int) -> None:
    """Convergents p/q of the square root of 2, p^2 - 2 q^2 = -side, within 2^-3000 of it."""
    root, p, q = max(real_roots(fmpz_poly([-2, 0, 1]))), 1, 1
    while q.bit_length() < 1500 or p * p - 2 * q * q != -side:
        p, q = p + 2 * q, p + q
    assert root.compare_rational(fmpq(p, q)) == side


@settings(max_examples=60)
@given(st.lists(integers(30), min_size=2, max_size=9))
def test_as_many_roots_as_sturm_counts(c: list[int]) -> None:
    p = fmpz_poly(c)
    assume(p.degree() >= 1)
    roots = real_roots(p)
    assert len(roots) == count_real_roots(p)
    assert all(x < y for x, y in pairwise(roots))
    for r in roots:  # the minimal polynomial divides p
        assert p.gcd(r.poly).degree() == r.poly.degree()


@given(rationals, rationals)
def test_simplest_rational_between(a: Fraction, b: Fraction) -> None:
    assume(a < b)
    found = simplest_between(fmpq(a.numerator, a.denominator), fmpq(b.numerator, b.denominator))
    value = Fraction(int(found.p), int(found.q))
    assert a < value < b
    p, q = value.as_integer_ratio()
    if q > 1:  # all fractions between the parents in the tree of Stern and Brocot have a denominator of q or more
        below = pow(p, -1, q)
        left = Fraction(p * below // q, below)
        right = Fraction(p - left.numerator, q - below)
        assert left <= a < b <= right


polys = st.dictionaries(
    st.tuples(st.integers(0, 2), st.integers(0, 2), st.integers(0, 2)), integers(5), min_size=1, max_size=5
)


@settings(max_examples=30)
@given(numbers(), numbers(), rationals, polys)
def test_signs_at_algebraic_points(a: RealAlgebraic, b: RealAlgebraic, q: Fraction, terms: dict) -> None:
    assume(a.degree <= 3 and b.degree <= 2)
    ring = Ring.of(("x", "y", "z"))
    f = ring.from_terms(terms)
    exact = RealAlgebraic.rational(0)
    for (i, j, k), c in terms.items():
        exact = exact + c * (a**i) * (b**j) * RealAlgebraic.rational(q**k)
    assert Point.of(ring, [a, b, q]).sign(f) == exact.sign()


@settings(max_examples=30)
@given(numbers(), polys, polys)
def test_stacks_over_algebraic_points(a: RealAlgebraic, f_terms: dict, g_terms: dict) -> None:
    """Sections are roots, sector samples lie between them, and signs change only there."""
    assume(a.degree <= 3)
    ring = Ring.of(("x", "y"))
    polys = []
    for terms in (f_terms, g_terms):
        flat: dict[tuple[int, int], int] = {}
        for (i, j, _), c in terms.items():
            flat[i, j] = flat.get((i, j), 0) + c
        polys.append(ring.from_terms(flat))
    assume(all(p.degree(1) for p in polys))
    point = Point.of(ring, [a])
    found = isolate_over(point, tuple(polys))
    samples = [RealAlgebraic.rational(q) for q in found.samples]
    for k, section in enumerate(found.sections):
        above = point.extend(section.value)
        number = above.number(1)
        value = number if isinstance(number, RealAlgebraic) else RealAlgebraic.rational(number)
        assert samples[k] < value < samples[k + 1]
        for j, p in enumerate(polys):
            assert (above.sign(p) == 0) == (j in section.members or j in found.nullified)
    for j, p in enumerate(polys):
        for k, q in enumerate(found.samples):
            assert point.extend(RealAlgebraic.rational(q)).sign(p) == SIGN_OF[found.texts[2 * k][j]]


SMALL = st.integers(-9, 9)
COEFFICIENTS = st.one_of(SMALL, st.integers(-(10**25), 10**25))


@st.composite
def sympy_numbers(
    draw: st.DrawFn, *, degree: int = 5, coefficients: st.SearchStrategy[int] = COEFFICIENTS
) -> RealAlgebraic:
    roots = real_roots(fmpz_poly([*draw(st.lists(coefficients, min_size=1, max_size=degree)), 1]))
    assume(roots)
    return draw(st.sampled_from(roots))


@settings(max_examples=40)
@given(sympy_numbers())
def test_value_polynomial_and_order(number: RealAlgebraic) -> None:
    there = sp.sympify(number)
    low, high = number.interval(80)
    width = max(high - low, abs(high) / 2**70, Fraction(1, 2**70))
    value = Fraction(str(there.evalf(40, maxn=400)))
    assert low - width <= value <= high + width
    assert not there.atoms(sp.Float) and there.is_number
    assert number_of(there, "number") == number
    if number.degree <= 2:
        (found,) = [sp.Poly(sp.minimal_polynomial(there, sp.Symbol("t")))]
        assert [abs(int(c)) for c in reversed(found.all_coeffs())] == [abs(c) for c in number.minimal_polynomial]


@settings(max_examples=15)
@given(sympy_numbers(degree=2, coefficients=SMALL), sympy_numbers(degree=2, coefficients=SMALL))
def test_arithmetic_with_sympy_is_arithmetic_here(left: RealAlgebraic, right: RealAlgebraic) -> None:
    there = sp.sympify(right)
    for mixed, here in ((left + there, left + right), (there - left, right - left), (left * there, left * right)):
        assert isinstance(mixed, sp.Expr) and not mixed.atoms(sp.Float)
        error = abs((mixed - sp.sympify(here)).evalf(30, maxn=400))
        assert number_of(sp.sympify(mixed), "number") == here
        assert error <= sp.Rational(1, 10**15) * (1 + abs(sp.sympify(here).evalf(30, maxn=400)))


@settings(max_examples=30)
@given(sympy_numbers(degree=3), st.lists(st.integers(-9, 9), min_size=1, max_size=3))
def test_elements_of_fields(theta: RealAlgebraic, coefficients: list[int]) -> None:
    field = NumberField(theta)
    element = field.element([Fraction(c) for c in coefficients[: field.degree]])
    assert sp.sympify(element) == sp.sympify(element.to_algebraic())
    assert element.to_algebraic() == element and element == element.to_algebraic()
    assert (element + theta) == (element.to_algebraic() + theta)
