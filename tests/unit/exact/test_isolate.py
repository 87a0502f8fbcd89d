"""Real roots isolated: by sign changes, over balls, counted."""

from fractions import Fraction
from itertools import pairwise

from flint import acb, acb_poly, arb, fmpq, fmpq_poly, fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ball_roots import certified_roots, distinct_roots, quadratic_roots
from qe.exact.balls import precision
from qe.exact.counted_roots import counted_roots
from qe.exact.descartes import most_real_roots, most_roots_between
from qe.exact.isolate import isolate, sign_at, simplest_between
from qe.exact.ring import Ring
from qe.io import formats
from tests.strategies import HUGE
from tests.tables import each

X = fmpz_poly([0, 1])


def product(roots: list[Fraction]) -> fmpz_poly:
    """A polynomial with these real roots, and two that are not real."""
    p = X**2 + 2
    for root in roots:
        p *= root.denominator * X - root.numerator
    return p


def check(roots: list[Fraction]) -> None:
    """Disjoint intervals in order, one for each root; the ends of an open one are no roots."""
    p, found = product(roots), isolate(product(roots))
    assert len(found) == len(roots)
    for (low, high), root in zip(found, sorted(roots), strict=True):
        value = fmpq(root.numerator, root.denominator)
        if low == high:
            assert low == value
        else:
            assert low < value < high and sign_at(p, low) * sign_at(p, high) < 0
    assert all(left[1] <= right[0] for left, right in pairwise(found))


@each(
    "1 13/10 2",  # between two dyadic roots, in the half that the middle of the interval does not show
    "2 8/3 4 5",  # this one did not end
    "-3 0 11/3",  # zero as an end of two intervals
    "0",
    "-2 0 2",
)
def test_roots_beside_roots_that_are_ends(roots: str) -> None:
    check([Fraction(root) for root in roots.split()])


dyadic = st.builds(Fraction, st.integers(-16, 16), st.sampled_from((1, 2, 4)))
other = st.builds(Fraction, st.integers(-60, 60), st.sampled_from((3, 5, 7, 11)))

far_or_close = st.builds(lambda near, by: near + by, dyadic, st.sampled_from([Fraction(h) for h in HUGE])) | st.builds(
    lambda near, by: near + 1 / by, dyadic, st.sampled_from([Fraction(h) for h in HUGE])
)


@settings(max_examples=60, deadline=None)
@given(st.sets(dyadic, max_size=4), st.sets(other | far_or_close, max_size=4))
def test_every_root_has_its_interval(dyadic_roots: set[Fraction], others: set[Fraction]) -> None:
    check(sorted(dyadic_roots | others))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-9, 9), min_size=17, max_size=24), other | far_or_close)
def test_the_sign_of_a_long_polynomial_is_the_exact_one(coefficients: list[int], value: Fraction) -> None:
    """Long polynomials are tried by balls first; at a root, and just beside it, no ball decides."""
    at = fmpq(value.numerator, value.denominator)
    beside = at + fmpq(1, 2**2000)
    long = fmpz_poly([*coefficients, 1])
    with_root = long * (value.denominator * X - value.numerator)
    for p, point in ((long, at), (with_root, at), (with_root, beside)):
        exact = p(point)
        assert sign_at(p, point) == (exact > 0) - (exact < 0)


@each(
    ("0", "1", "1/2"),
    ("1/2", "1", "2/3"),
    ("0", "1/3", "1/4"),
    ("-1", "1", "0"),
    ("-1", "0", "-1/2"),
    ("2", "4", "3"),
)
def test_the_simplest_number_is_neither_end(low: str, high: str, between: str) -> None:
    found = simplest_between(*(fmpq(f.numerator, f.denominator) for f in map(Fraction, (low, high))))
    assert str(found) == between


RING = Ring.of(("a", "x"))
TERMS = st.dictionaries(st.integers(0, 9), st.integers(-20, 20).filter(bool), min_size=1, max_size=5)


@given(TERMS, st.data())
def test_no_point_has_more_roots(terms, data):
    """Coefficients that depend on a parameter may vanish there; those left have no more roots than the bound."""
    whole = RING.from_terms({(1, k): c for k, c in terms.items()})  # any coefficients, as far as exponents tell
    kept = {k: c for k, c in terms.items() if data.draw(st.booleans())}
    if kept:
        at_a_point = RING.from_terms({(0, k): c for k, c in kept.items()})
        assert len(real_roots(at_a_point.to_univariate(1))) <= most_real_roots(whole, 1)


@each(("x^3 - a", 1), ("x^4 - a", 2), ("x^4 - a*x", 2), ("x^9 + a*x^8 + x", 3), ("x^3 + a*x + 1", 2 + 0 + 1), ("a", 0))
def test_small_ones(text, most):
    poly = formats.read(f"{text} + 0*x*a = 0", "text").poly.convert(RING)
    assert most_real_roots(poly, 1) == most


@given(st.lists(st.fractions(-2, 2, max_denominator=9), min_size=1, max_size=5), st.integers(0, 1))
def test_roots_in_an_interval_are_bounded(roots, squares):
    """Each is counted once; two complex ones may be counted, so that the bound is even or odd as the number is."""
    coefficients = [Fraction(1)]
    for factor in [*([-root, Fraction(1)] for root in roots), *([Fraction(1), Fraction(1), Fraction(1)],) * squares]:
        size = len(coefficients) + len(factor) - 1
        pairs = [(i + j, a * b) for i, a in enumerate(coefficients) for j, b in enumerate(factor)]
        coefficients = [sum((c for k, c in pairs if k == n), Fraction(0)) for n in range(size)]
    low, high = Fraction(-1, 3), Fraction(1, 2)
    inside = len({root for root in roots if low < root < high})
    bound = most_roots_between(coefficients, low, high)
    assert bound >= inside and (bound - inside) % 2 == 0
    assert bound == inside or squares or inside > 1 or len(set(roots)) > 2


BITS = 128


def balls(coefficients: list[int]) -> list[arb]:
    return [arb(c) for c in coefficients]


@given(st.lists(st.integers(-9, 9), min_size=3, max_size=3).filter(lambda c: c[2]))
def test_a_quadratic_has_its_roots_in_order(coefficients: list[int]) -> None:
    c, b, a = coefficients
    with precision(BITS):
        found = quadratic_roots(balls(coefficients))
        discriminant = b * b - 4 * a * c
        if discriminant == 0:
            assert found is None  # a double root is not told from two or none
            return
        assert found is not None
        assert len(found) == (2 if discriminant > 0 else 0)
        for ball, root in zip(found, sorted(real_roots(fmpz_poly(coefficients))), strict=True):
            assert ball.overlaps(root.ball(BITS))
            assert float(ball.rad()) < 1e-30
        assert all(x < y for x, y in pairwise(found))


@given(st.sets(st.fractions(-4, 4, max_denominator=5), min_size=1, max_size=4), st.booleans())
def test_isolated_roots_are_real_ones(roots: set[object], more: bool) -> None:
    p = fmpz_poly([2, 1, 1]) if more else fmpz_poly([3])  # a factor without real roots
    for root in roots:
        p *= fmpz_poly([-root.numerator, root.denominator])  # type: ignore[attr-defined]
    with precision(BITS):
        found = certified_roots([arb(c) for c in p.coeffs()], BITS)
    assert found is not None and len(found) == len(roots)
    with precision(2 * BITS):  # else the number itself is a ball as wide
        for ball, root in zip(found, sorted(roots), strict=True):  # type: ignore[type-var]
            assert ball.contains(arb(fmpq(root.numerator, root.denominator)))  # type: ignore[attr-defined]


def test_what_balls_do_not_tell() -> None:
    with precision(BITS):
        assert quadratic_roots([arb(0, 1e-9), arb(0), arb(1)]) is None  # x^2 + about 0
        assert certified_roots(balls([1, -2, 1]), BITS) is None  # (x - 1)^2
        wide = [arb(-2, 0.5), arb(0), arb(1)]
        found = quadratic_roots(wide)
        assert found is not None
        assert all(ball.contains(root) for ball, root in zip(found, (-arb(2).sqrt(), arb(2).sqrt()), strict=True))


@each([-1, 10**30, 1], [-1, -(10**30), 1], [1, 10**30, -1], [1, -(10**30), -1])
def test_a_small_root_beside_a_huge_one_keeps_its_digits(coefficients: list[int]) -> None:
    """The textbook formula would lose it by cancellation."""
    with precision(BITS):
        found = quadratic_roots(balls(coefficients))
        assert found is not None
        small = min(found, key=lambda ball: abs(float(ball)))
        assert float(small.rad()) < abs(float(small)) * 1e-30
        root = min(real_roots(fmpz_poly(coefficients)), key=lambda r: abs(float(r)))
        assert small.overlaps(root.ball(4 * BITS))


NUMBERS = [acb(arb(2)), acb(arb(-2.25)), acb(arb(1000)), acb(0, 1), acb(1, 2)]


@given(
    st.lists(st.tuples(st.sampled_from(NUMBERS), st.integers(1, 3)), min_size=1, max_size=3, unique_by=str),
    st.booleans(),
)
def test_clusters_of_known_number_are_multiple_roots(given_roots: list[tuple[acb, int]], fine: bool) -> None:
    bits = 512 if fine else BITS
    with precision(bits + 16):
        third = arb(1) / 3  # makes the coefficients balls, not numbers
        p, distinct = acb_poly([third]), dict[str, acb]()
        for root, times in given_roots:
            both = [root] if root.imag == 0 else [root, root.conjugate()]
            for z in both:
                distinct[str(z)] = z
                p *= acb_poly([-z, 1]) ** times
        c = [x.real for x in p.coeffs()]
        found = distinct_roots(c, bits, len(distinct))
        if found is None:
            assert any(float(z.real) == 1000 for z in distinct.values())  # far from the others
            return
        assert len(found) == len(distinct)
        assert all(sum(z.overlaps(w) for w in found) == 1 for z in distinct.values())
        real = certified_roots(c, bits, len(distinct))
        assert real is not None and len(real) == sum(1 for z in distinct.values() if z.imag == 0)
        if len(distinct) + 1 < len(c) - 1:
            assert distinct_roots(c, bits, len(distinct) + 1) is None  # more are asked for than are seen


def test_close_roots_are_no_double_root() -> None:
    """Three roots, two of them 2^-100 apart, are not merged where nothing says that they are fewer."""
    with precision(512 + 16):
        near = arb(2) ** -100
        c = [x.real for x in (acb_poly([-1, 1]) * acb_poly([-1 - near, 1]) * acb_poly([-5, 1])).coeffs()]
        found = distinct_roots(c, 512)
        assert found is not None and len(found) == 3


WIDE = [fmpq(656, 10**359), fmpq(27), fmpq(162, 10**60), fmpq(243, 10**120)]
"""Roots of very different size: for FLINT's tolerance on the roots there is no precision."""


@each(64, 128, 1024)
def test_roots_of_very_different_sizes_are_found_at_each_precision(bits: int) -> None:
    with precision(bits + 16):
        found = certified_roots([arb(c) for c in WIDE], bits)
        assert found is None or len(found) in (1, 3)


@given(st.integers(20, 60), st.integers(-3, 3), st.sampled_from([-1, 1]), st.integers(-30, 30))
def test_roots_much_closer_than_they_are_large(size: int, root: int, sign: int, scale: int) -> None:
    """((x - c)^2 -+ 10^-2k)(x - r), with x as a multiple of a power of ten: three real roots or one."""
    close = fmpq_poly([fmpq(49), -14, 1]) - fmpq(sign, 10 ** (2 * size))
    p = close * fmpq_poly([-root, 1])
    unit = fmpq(10) ** scale
    coefficients = [c * unit**k for k, c in enumerate(p.coeffs())]
    expected = sorted(real_roots(fmpq_poly(coefficients).numer()))
    assert len(expected) == (3 if sign > 0 else 1)
    for bits in (128, 256, 512):
        with precision(bits + 16):
            found = certified_roots([arb(c) for c in coefficients], bits)
        assert found is None or len(found) == len(expected)
        if found is not None:
            assert all(ball.overlaps(x.ball(bits)) for ball, x in zip(found, expected, strict=True))
    assert found is not None


@each([0, 1, -2, 1], [4, -4, 1, 0, 1], [1, 0, 2, 0, 1])
def test_counting_says_nothing_about_double_roots(coefficients: list[int]) -> None:
    with precision(272):
        found = counted_roots([arb(c) for c in coefficients], 256)
    assert found is None or len(found) == len(real_roots(fmpz_poly(coefficients)))


@each(fmpq(0), fmpq(1, 10**25), fmpq(-1, 10**25))
def test_balls_that_hold_a_polynomial_with_a_double_root_say_nothing(shift: fmpq) -> None:
    """(x - 1)^2 (x - 3) with a constant term that is known to 10^-20 only, whatever its midpoint."""
    with precision(272):
        c = [arb(x) for x in (fmpz_poly([1, -2, 1]) * fmpz_poly([-3, 1])).coeffs()]
        c[0] = arb((c[0].mid().fmpq() + shift), arb(10) ** -20)
        assert counted_roots(c, 256) is None
