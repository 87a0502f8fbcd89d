"""The checker's quadratic forms: what is read, what is convex, ranks; against the engine's and by definition."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.quadratic_form import Definiteness, definiteness, independent_rows
from qe.exact.ring import Ring
from qe.expert.arithmetic.convexity import Quadratic, is_convex, rank
from qe.expert.sentences import read_terms
from qe.proof.entry import Entry
from tests.tables import each

RING = Ring.of(("x", "y"))
SMALL = st.integers(-3, 3).map(Fraction)


def symmetric(entries: list[Fraction], size: int) -> list[list[Fraction]]:
    pick = iter(entries)
    upper = {(i, j): next(pick) for i in range(size) for j in range(i, size)}
    return [[upper[min(i, j), max(i, j)] for j in range(size)] for i in range(size)]


@given(st.integers(1, 4).flatmap(lambda n: st.tuples(st.just(n), st.lists(SMALL, min_size=10, max_size=10))))
def test_convexity_agrees_with_the_engine(given_matrix):
    matrix = symmetric(given_matrix[1], given_matrix[0])
    assert is_convex(matrix) == (definiteness(matrix) is not Definiteness.NOT_SEMIDEFINITE)


@given(st.lists(st.lists(SMALL, min_size=3, max_size=3), min_size=1, max_size=4))
def test_squares_are_convex_and_stay_so_only_in_one_direction(rows):
    gram = [[sum((r[i] * r[j] for r in rows), Fraction(0)) for j in range(3)] for i in range(3)]
    assert is_convex(gram)
    assert is_convex([[-v for v in row] for row in gram]) == (not any(map(any, gram)))


@each(
    ([[0, 0], [0, 0]], True),
    ([[0, 1], [1, 0]], False),
    ([[0, 1], [1, 5]], False),
    ([[1, 1], [1, 1]], True),
    ([[1, 2], [2, 4]], True),
    ([[1, 2], [2, 3]], False),
    ([[0, 0, 0], [0, 1, 1], [0, 1, 1]], True),
    ([[1, 1, 0], [1, 1, 1], [0, 1, 9]], False),
    ([[-1]], False),
)
def test_convexity_by_hand(matrix, convex):
    assert is_convex([[Fraction(v) for v in row] for row in matrix]) is convex


@given(st.lists(st.lists(SMALL, min_size=3, max_size=3), max_size=5))
def test_rank_agrees_with_the_engine(rows):
    assert rank(rows) == (len(independent_rows(rows)) if rows else 0)


@given(st.dictionaries(st.sampled_from([e for e in product(range(3), repeat=2) if sum(e) <= 2]), SMALL.filter(bool)))
def test_a_quadratic_polynomial_has_the_values_and_slopes_of_its_terms(terms):
    entry = Entry([[str(c), list(e)] for e, c in terms.items()], "form")
    form = Quadratic.of(*read_terms(entry, RING.names, RING), Fraction)
    for x, y in product((Fraction(-2), Fraction(1, 3), Fraction(5)), repeat=2):
        point = (x, y, 1)
        assert form.value(point) == sum(c * x ** e[0] * y ** e[1] for e, c in terms.items())
        along_x = sum(c * e[0] * x ** max(e[0] - 1, 0) * y ** e[1] for e, c in terms.items())
        assert form.gradient(point)[0] == along_x
        further = (x + 1, y, 1)
        assert form.value(further) - form.value(point) - along_x == form.hessian[0][0] / 2


@each(
    [["1", [1, 2]]],
    [["1", [3, 0]]],
    [["1", [1]]],
    [["0", [1, 0]]],
    [["1", [1, 0]], ["2", [1, 0]]],
    [["1", [1, 0], 3]],
    [["1"]],
)
def test_what_is_no_form_is_refused(terms):
    with pytest.raises(CertificateRejected):
        read_terms(Entry(terms, "form"), RING.names, RING)
