"""Bounds of cells: their values without sample points, and text that stays short and quick."""

import pickle
import time

from hypothesis import example, given, settings
from hypothesis import strategies as st

import qe
from qe.decomposition.pieces import LONGEST
from qe.exact.algebraic import real_roots
from qe.exact.algebraic_text import square_part
from qe.exact.radicals import brief_algebraic
from qe.exact.ring import Ring
from qe.regions.region import Region
from tests.tables import each

X = Ring.of(("x",)).gen(0)
PRIMES = (10**59 + 19, 3 * 10**59 + 13)
"""Large enough that their product is not factored in an hour."""


def test_cells_take_no_minimal_polynomials_of_their_samples():
    """The sample of the only cell has a coordinate of degree 343 with large coefficients, that nobody asked for."""
    text = "123*x^7 - 457*x = 1009 and y^7 + x*y^2 - x^5*y = 3*x + 10007 and z^7 + y^3*x*z + x^4 = 11*y + 12345"
    region = qe.region(text, order=("x", "y", "z"), process=False)
    start = time.process_time()
    (cell,) = region.cells
    assert cell.dimension == 0 and cell.brief() and str(cell)
    assert time.process_time() - start < 3


@settings(max_examples=25, deadline=None)
@given(st.integers(-3, 3), st.integers(-3, 3), st.integers(1, 4), st.integers(0, 3))
def test_values_of_bounds_are_the_coordinates_of_samples(a, b, c, d):
    """Where a piece is a single value of a variable alone, its sample has that value."""
    text = f"(x - {a})*(x^2 - {c}) = 0 and (y^2 - {d})*(y - {b})*(y - x) <= 0 or x = {a} and y^3 = {c}"
    region = qe.region(text, order=("x", "y"))
    points = {"x": 0, "y": 0}
    for cell in region.cells:
        for bound in cell.ranges:
            if bound.is_point and bound.lower is not None and bound.lower.value is not None:
                assert bound.lower.value == cell.sample[bound.variable]
                points[bound.variable] += 1
        assert region.contains(cell.sample)
    assert points["x"]


def test_a_region_with_its_cells_can_be_pickled():
    region = qe.region("x^2 + y^2 <= 2 and y >= x", process=False)
    cells = region.cells
    again = pickle.loads(pickle.dumps(region))
    assert isinstance(again, Region) and again.cells == cells and again.contains(again.cells[0].sample)
    assert tuple(again.bounds("x")) == tuple(region.bounds("x"))


def test_long_bounds_are_described():
    power = " + ".join(f"{10**30 + k}*x^{k}*y^{9 - k}" for k in range(10))
    cells = qe.region(f"{power} = {10**70 + 1} and 0 < x and 3*x^5 < {10**60 + 7}", order=("x", "y")).cells
    texts = [cell.brief() for cell in cells]
    assert any(len(str(cell)) > 2 * LONGEST for cell in cells)
    assert all(len(text) < 4 * LONGEST + 40 for text in texts)
    assert any("a polynomial of degree 9 in y with 11 terms" in text for text in texts)


def test_a_long_number_is_an_interval_around_it():
    (root,) = real_roots((X**5 - (10**400 + 1)).to_univariate(0))
    text = brief_algebraic(root, 100)
    assert len(text) < 100 and text.startswith("(a root of a polynomial of degree 5 in [9.99999")
    assert brief_algebraic(root, 5000) == str(root)


@each(PRIMES[0] * PRIMES[1], PRIMES[0] ** 2 * PRIMES[1] ** 2, 49 * PRIMES[0] * PRIMES[1])
def test_text_of_a_square_root_never_waits_for_a_factorization(n):
    start = time.process_time()
    s = square_part(n)
    assert n % s**2 == 0 and time.process_time() - start < 5
    (_, root) = real_roots((X**2 - 2 * n).to_univariate(0))
    assert "sqrt(" in str(root)


@example(309681402271, 13963)  # FLINT lists the prime 13963 twice
@given(st.integers(1, 10**12), st.integers(1, 10**6))
def test_square_parts_of_small_numbers_are_complete(n, m):
    s = square_part(n * m * m)
    assert n * m * m % s**2 == 0 and s % m == 0 and square_part(n * m * m // s**2) == 1
