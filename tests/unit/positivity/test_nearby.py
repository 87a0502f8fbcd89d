"""Polynomials next to one with short coefficients: bounds missed by very little, with proofs."""

import random
from fractions import Fraction
from itertools import pairwise
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Poly, Ring
from qe.io.text import read_polynomial
from qe.positivity.nearby import positive_beyond
from qe.positivity.prove import nowhere_negative
from tests.tables import each

RING = Ring.of(("x", "y", "z"))
EVERY = frozenset(range(3))
SHAPIRO = "a/(b + c) + b/(c + d) + c/(d + a) + d/(a + b)"
AM_GM = "x^4 + y^4 + z^4 + w^4"


@each(
    (f"{SHAPIRO} > 2 - 10^-40", True),
    (f"{SHAPIRO} >= 2 - 10^-40", True),
    (f"{SHAPIRO} > 2 - 10^-6", True),
    (f"{SHAPIRO} > 2", False),
    (f"{SHAPIRO} >= 2 + 10^-40", False),
)
def test_shapiro_with_four_numbers(claim: str, truth: bool) -> None:
    """Without an answer in 60 s, where the bound itself took 0.1 s."""
    pytest.importorskip("clarabel")
    found = qe.eliminate(f"all a, b, c, d. a > 0 and b > 0 and c > 0 and d > 0 -> {claim}", check=True, timeout=60)
    assert (found.truth, found.guarantee) == (truth, qe.Guarantee.CHECKED)


@each(
    (f"{AM_GM} - 4*x*y*z*w + 10^-50 > 0", True),
    (f"{AM_GM} - 4*x*y*z*w + 10^-50*x^2 >= 0", True),
    (f"{AM_GM} - 4*x*y*z*w + 10^-50*x^2 > 0", False),
    (f"{AM_GM} >= (4 - 10^-50)*x*y*z*w", True),
    (f"{AM_GM} >= (4 + 10^-50)*x*y*z*w", False),
    (f"{AM_GM} - 4*x*y*z*w > 10^-50", False),
)
def test_means_everywhere(claim: str, truth: bool) -> None:
    assert qe.decide(f"all x, y, z, w. {claim}", timeout=60) is truth


def squares(rng: random.Random) -> Poly:
    """A sum of squares of binomials."""
    terms = [{tuple(rng.choice((0, 0, 1, 2)) for _ in range(3)): rng.choice((1, 1, 2))} for _ in range(4)]
    monomials = [RING.from_terms(t) for t in terms]
    return sum(((m - n) ** 2 for m, n in pairwise(monomials)), RING.constant(0))


@settings(deadline=None, max_examples=60, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_identities_are_exact_and_signs_hold_at_points(seed: int) -> None:
    rng = random.Random(seed)
    orthant = frozenset(i for i in range(3) if rng.random() < 0.5)
    little = RING.from_terms({tuple(rng.choice((0, 1, 2)) for _ in range(3)): rng.choice((1, 1, -1))})
    poly = squares(rng) * 10 ** rng.choice((7, 12, 30)) + little
    positive = [i for i in orthant if rng.random() < 0.5]
    proof = positive_beyond(poly, orthant, positive)
    if proof is None:
        return
    for identity in proof.identities:
        assert not sum((prod((b**e for b, e in powers), start=RING.constant(c)) for c, powers in identity.terms), 0)
    for _ in range(50):
        point = [Fraction(rng.randint(-20, 20), rng.choice((1, 3, 10**9))) for _ in range(3)]
        point = [abs(v) + (i in positive and not v) if i in orthant else v for i, v in enumerate(point)]
        assert poly.evaluate(point) > 0 if proof.strict else poly.evaluate(point) >= 0


def test_they_are_found_where_the_one_nearby_is() -> None:
    found = 0
    for seed in range(200):
        near = squares(random.Random(seed))
        if near.total_degree > 1 and nowhere_negative(near.normal()[1], EVERY) is not None:
            proof = positive_beyond(near * 10**20 + RING.from_terms({(2, 0, 2): 1}), EVERY, EVERY)
            assert proof is not None and proof.strict
            found += 1
    assert found >= 20


@each("x^2 - 2*x*y + y^2", "10^20*(x - y)^2 - x*y", "10^20*(x - y)^2 + x*y*z - 10^-3*x")
def test_what_is_not_a_little_more(text: str) -> None:
    """Short coefficients already, and polynomials that are negative at (1, 1, 0)."""
    assert positive_beyond(read_polynomial(text)[0].convert(RING), EVERY, ()) is None


@each(
    ("10^20*(x^4 + y^4 + 2*z^4) - (4*10^20 - 1)*x*y*z^2", True),
    ("10^20*(x^4 + y^4 + 2*z^4) - (4*10^20 + 1)*x*y*z^2", False),
    ("10^20*(x^4 + y^4 + z^4) + x*y", False),
)
def test_odd_powers_of_what_may_be_negative_fit_exactly(text: str, fits: bool) -> None:
    """x*y is negative next to zero, however small its coefficient is."""
    assert (positive_beyond(read_polynomial(text)[0].convert(RING), frozenset(), ()) is not None) is fits
