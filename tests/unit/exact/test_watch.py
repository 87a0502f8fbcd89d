"""Arithmetic at points asks a clock between its calls, and ends when that says so."""

import pickle
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.decomposition.decompose import decompose
from qe.decomposition.lifting import Lifter
from qe.errors import BudgetExceeded
from qe.exact import watch
from qe.exact.algebraic import real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.remainder import common_coefficients
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.watch import Watch, watched_product
from qe.io.text import read
from qe.options import Budget
from tests.strategies import polynomials

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.gen(i) for i in range(3))
EQUAL_ROOTS = ((Y - X) * (Y**3 - 2), (Y - X) * (Y**3 + Y - 5))


def _stops_at(looks: int) -> tuple[Callable[[], None], list[int]]:
    """Something to ask that raises when it is asked for the ``looks``-th time, and the times it was asked."""
    asked: list[int] = []

    def ask() -> None:
        asked.append(len(asked))
        if len(asked) >= looks:
            raise BudgetExceeded("time limit reached", limit="time")

    return ask, asked


def _root_of_a_quintic(ask: Callable[[], object]) -> Point:
    (root, *_) = real_roots((X**5 - X - 1).to_univariate(0))
    return Point(RING, watch=Watch(ask)).extend(root)


@given(polynomials(RING, max_degree=4), polynomials(RING, max_degree=4), st.integers(1, 30))
def test_a_product_in_pieces_is_the_product(a: Poly, b: Poly, piece: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(watch, "PIECE", piece)
        assert watched_product(a, b, Watch()) == a * b


def test_a_long_product_is_left_between_two_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(watch, "PIECE", 10)
    ask, asked = _stops_at(4)
    with pytest.raises(BudgetExceeded):
        watched_product((X + Y + Z + 1) ** 4, (X - Y) ** 4, Watch(ask))
    assert len(asked) == 4


def test_a_remainder_sequence_is_left_between_two_products() -> None:
    f, g = (p.coefficients(1) for p in EQUAL_ROOTS)
    point = _root_of_a_quintic(lambda: None)
    ask, counted = _stops_at(10**9)
    common_coefficients(f, g, point.vanishes, Watch(ask))
    assert len(counted) > 20
    for looks in (1, len(counted) // 2, len(counted)):
        ask, asked = _stops_at(looks)
        with pytest.raises(BudgetExceeded):
            common_coefficients(f, g, point.vanishes, Watch(ask))
        assert len(asked) == looks


def test_a_stack_is_left_inside() -> None:
    """The roots that coincide are found by a remainder sequence, which asks the watch of the point's root."""
    ask, asked = _stops_at(3)
    with pytest.raises(BudgetExceeded):
        isolate_over(_root_of_a_quintic(ask), EQUAL_ROOTS)
    assert len(asked) == 3


def test_points_share_the_watch_of_their_root_and_copies_have_an_idle_one() -> None:
    ask, asked = _stops_at(1)
    point = _root_of_a_quintic(ask).extend(_root_of_a_quintic(ask).coordinate(0))
    copy = pickle.loads(pickle.dumps(point))
    assert copy.watch is copy.ancestor(0).watch
    copy.watch()
    assert not asked
    with pytest.raises(BudgetExceeded):
        point.watch()
    assert Point(RING).watch is not Point(RING).watch


def test_decomposition_watches_its_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    """The points that are lifted over ask the budget of the decomposition."""
    budget, seen = Budget(), list[Point]()
    run = Lifter.run
    monkeypatch.setattr(Lifter, "run", lambda lifter, point, node: (seen.append(point), run(lifter, point, node))[1])
    decompose(read("y^2 - x = 0"), ("x", "y"), ("E", "E"), budget=budget)
    seen[0].watch()
    budget.cancel()
    with pytest.raises(BudgetExceeded, match="cancel"):
        seen[0].watch()
