"""Signatures read off minors and characteristic polynomials, against signatures by elimination."""

from __future__ import annotations

from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.ideal import signature
from qe.expert.arithmetic.parametric import Conditions, Terms, cases
from qe.expert.arithmetic.parametric_forms import ParametricForms
from qe.expert.arithmetic.signature import signatures
from qe.formula.syntax import TRUE

RING = Ring.of(("a",))
SIZES = st.integers(1, 6)
SMALL = st.sampled_from((0, 0, 0, 1, -1, 2))
"""Many zeros: then minors vanish, one after the other."""


def tick() -> None:
    """No limit."""


def forms() -> ParametricForms:
    """Any form: only its arithmetic is used."""
    one = RING.constant(1)
    (case,) = cases([{(1,): one}], 1, Conditions.of(RING, (), (), tick))
    return ParametricForms(case)


FORMS = forms()


def read(
    matrix: list[list[Poly]], hankel: bool, *, square: bool = False, by: ParametricForms = FORMS
) -> dict[int, object]:
    coefficients = by.coefficients(matrix)[1:]
    return dict(signatures(by.minors(matrix), lambda: coefficients, hankel=hankel, square=square))


def by_elimination(matrix: list[list[Poly]]) -> int:
    return signature([[fmpq(c.constant_value()) if c else fmpq(0) for c in row] for row in matrix], tick)


@settings(max_examples=60)
@given(st.data(), SIZES)
def test_symmetric_matrices(data: st.DataObject, size: int) -> None:
    numbers = data.draw(st.lists(SMALL, min_size=size * size, max_size=size * size))
    matrix = [[RING.constant(numbers[min(i, j) * size + max(i, j)]) for j in range(size)] for i in range(size)]
    assert read(matrix, hankel=False) == {by_elimination(matrix): TRUE}


@settings(max_examples=40)
@given(st.lists(SMALL, min_size=1, max_size=5), st.lists(SMALL, min_size=1, max_size=3))
def test_trace_forms_in_the_powers_of_one_variable(low: list[int], factor: list[int]) -> None:
    """Of h over x^n + ..., which are Hankel matrices; for squares no signature is negative."""
    f: Terms = {(k,): RING.constant(c) for k, c in enumerate(low) if c} | {(len(low),): RING.constant(1)}
    (case,) = cases([f], 1, Conditions.of(RING, (), (), tick))
    own = ParametricForms(case)
    for h in (factor, [1]):
        terms: Terms = {(k,): RING.constant(c) for k, c in enumerate(h) if c}
        if terms:
            matrix = own.matrix(terms)
            assert read(matrix, hankel=True, square=h == [1], by=own) == {by_elimination(matrix): TRUE}
