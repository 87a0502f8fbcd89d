"""A bound for the number of real roots that holds at every point."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.descartes import most_real_roots
from qe.exact.ring import Ring
from qe.io import formats

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


@pytest.mark.parametrize(
    ("text", "most"),
    [("x^3 - a", 1), ("x^4 - a", 2), ("x^4 - a*x", 2), ("x^9 + a*x^8 + x", 3), ("x^3 + a*x + 1", 2 + 0 + 1), ("a", 0)],
)
def test_small_ones(text, most):
    poly = formats.read(f"{text} + 0*x*a = 0", "text").poly.convert(RING)
    assert most_real_roots(poly, 1) == most
