"""Real roots of polynomials with ball coefficients: each ball holds one root, or nothing is said."""

from __future__ import annotations

from itertools import pairwise

from flint import acb, acb_poly, arb, fmpq, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ball_roots import certified_roots, distinct_roots, quadratic_roots
from qe.exact.balls import precision
from tests.tables import each

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
        assert found is not None and len(found) == len(distinct)
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
