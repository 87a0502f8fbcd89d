"""Three-valued truth from signs of factors: what is said with some signs hidden is the truth at the point."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.certify.arithmetic.products import FactorLists
from qe.certify.matrix import Situation, compiled
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula, Relation
from qe.io.text import read

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)
FACTORS = ((X, X - 1), (Y - X, Y + 1, X * Y - 1))
LISTS = FactorLists(RING, FACTORS)
PRODUCTS = (X, X - 1, -2 * (Y - X), X**2 * (Y + 1), (X * Y - 1) ** 2 * X, (Y - X) * (Y + 1) ** 3, 1 - X * Y)


@st.composite
def matrices(draw: st.DrawFn, depth: int = 2) -> Formula:
    if not depth or draw(st.booleans()):
        return atom(draw(st.sampled_from(PRODUCTS)), draw(st.sampled_from(tuple(Relation))))
    parts = [draw(matrices(depth - 1)) for _ in range(draw(st.integers(2, 3)))]
    return draw(st.sampled_from((conj, disj, lambda fs: neg(conj(fs)))))(parts)


NUMBERS = st.fractions(-2, 2, max_denominator=2)


def situation(point: dict[str, Fraction], hidden: set[tuple[int, int]]) -> Situation:
    signs: list[list[int | None]] = []
    for level, factors in enumerate(FACTORS):
        values = [f.evaluate([point["x"], point["y"]]) for f in factors]
        signs.append([None if (level, i) in hidden else (v > 0) - (v < 0) for i, v in enumerate(values)])
    return Situation(signs, [(), ()], [frozenset(), frozenset()], [frozenset(), frozenset()], [0, 0])


@given(matrices(), NUMBERS, NUMBERS, st.sets(st.tuples(st.integers(0, 1), st.integers(0, 2)), max_size=3))
def test_nothing_wrong_is_said(matrix: Formula, x: Fraction, y: Fraction, hidden: set[tuple[int, int]]) -> None:
    test, point = compiled(matrix, LISTS, "matrix"), {"x": x, "y": y}
    truth = holds_at(matrix, point)
    assert test(situation(point, set())) is truth
    assert test(situation(point, hidden)) in (truth, None)


def test_what_follows_although_a_sign_is_hidden() -> None:
    hidden, point = {(1, 2)}, {"x": Fraction(2), "y": Fraction(3)}

    def said(text: str) -> bool | None:
        return compiled(convert(read(text), RING), LISTS, "matrix")(situation(point, hidden))

    assert said("x*y = 1") is None
    assert said("(x*y - 1)^2*x >= 0") is True
    assert said("(x*y - 1)^2*x < 0") is False
    assert said("x > 0 or x*y = 1") is True
    assert said("x < 0 and x*y = 1") is False
    assert said("not x*y > 1") is None


@pytest.mark.parametrize("text", ["y > 1", "x + 3 = 0", "(y - x)*(y - 1) < 0", "ex z. z > x"])
def test_what_is_not_made_of_listed_factors(text: str) -> None:
    formula = read(text)
    with pytest.raises(CertificateRejected):
        compiled(convert(formula, Ring.of(("x", "y", "z")) if "z" in text else RING), LISTS, "matrix")


def test_roots_by_the_sections_of_their_stack() -> None:
    """x between the second and the third of three sections, of which factor 0 has the first and the third."""
    lists = FactorLists(Ring.of(("x",)), ((Ring.of(("x",)).gen(0) ** 2 - 4, Ring.of(("x",)).gen(0)),))

    def said(text: str, position: int, isolated: frozenset[int] = frozenset((0, 1))) -> bool | None:
        test = compiled(convert(read(text), Ring.of(("x",))), lists, "answer")
        sections = ((0,), (1,), (0,))
        signs: list[list[int | None]] = [[None, None]]
        return test(Situation(signs, [sections], [isolated], [frozenset()], [position]))

    assert said("x > root(1, x^2 - 4)", 4) is True
    assert said("x > root(2, x^2 - 4)", 4) is False
    assert said("x < root(2, x^2 - 4)", 4) is True
    assert said("x = root(2, x^2 - 4)", 5) is True
    assert said("x >= root(-1, x^2 - 4)", 5) is True
    assert said("x > root(-2, x^2 - 4)", 1) is False
    assert said("x > root(1, x^2 - 4)", 4, frozenset((1,))) is None  # its roots are not known there
