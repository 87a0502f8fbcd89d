"""Vectors that annihilate rows."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.quadratic_form import independent_rows
from qe.formula.syntax import TRUE
from qe.io.text import read
from qe.rules.nullspace import kernel_vector, occurring

ROWS = st.lists(st.lists(st.integers(-2, 2).map(Fraction), min_size=3, max_size=3), max_size=4)


@given(ROWS)
def test_the_vector_annihilates_every_row(rows):
    found = kernel_vector((4, 7, 9), rows)
    full = bool(rows) and len(independent_rows(rows)) == 3
    assert (found is None) == full
    if found is not None:
        assert set(found) == {4, 7, 9} and any(found.values())
        assert all(sum(c * found[k] for c, k in zip(row, (4, 7, 9), strict=True)) == 0 for row in rows)


def test_which_variables_occur() -> None:
    polys, indices = occurring(read("x*y > 1 and (z = 0 or y < 2)"), frozenset("xz"))
    assert [p.ring.names[i] for p in polys[:1] for i in indices] == ["x", "z"] and len(polys) == 3
    assert occurring(TRUE, frozenset("x")) == ([], [])
