"""A bound for the number of real roots that holds at every point."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.descartes import most_real_roots, most_roots_between
from qe.exact.ring import Ring
from qe.io import formats
from tests.tables import each

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
