"""Kernels up to a tolerance, and the subset of slopes that still holds the sum (Caratheodory)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.convex.float_linear_algebra import caratheodory, free_columns

ROWS = st.integers(1, 4).flatmap(
    lambda n: st.lists(st.lists(st.integers(-3, 3), min_size=n, max_size=n), min_size=1, max_size=4)
)


@given(ROWS)
def test_the_free_columns_are_as_many_as_the_kernel_has_dimensions(rows: list[list[int]]) -> None:
    width = len(rows[0])
    free = free_columns(rows, width)
    matrix = np.array(rows, dtype=float)
    assert len(free) == width - np.linalg.matrix_rank(matrix)
    bound = [c for c in range(width) if c not in free]
    assert np.linalg.matrix_rank(matrix[:, bound]) == len(bound)  # the others are determined by them


def test_what_is_nearly_dependent_counts_as_dependent() -> None:
    assert free_columns([[1, 1], [1, 1 + 1e-9]], 2) != []
    assert free_columns([[1, 1], [1, 1 + 1e-3]], 2) == []
    assert free_columns([], 2) == [0, 1]


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=1, max_size=5), st.data())
def test_the_sum_stays_in_the_cone_of_independent_slopes(slopes: list[tuple[int, int]], data: st.DataObject) -> None:
    weights = data.draw(st.lists(st.integers(1, 5), min_size=len(slopes), max_size=len(slopes)))
    kept = caratheodory(range(len(slopes)), weights, slopes)
    matrix = np.array([slopes[i] for i in kept], dtype=float).reshape(len(kept), 2)
    assert np.linalg.matrix_rank(matrix) == len(kept)
    total = np.array(weights, dtype=float) @ np.array(slopes, dtype=float)
    if not kept:
        assert total == pytest.approx([0, 0])
        return
    found, *_ = np.linalg.lstsq(matrix.T, total, rcond=None)
    assert matrix.T @ found == pytest.approx(total, abs=1e-6)
    assert min(found) > -1e-6
