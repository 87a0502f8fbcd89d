"""Truth at points and under partial sign information."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import InputError
from qe.exact.ring import Poly
from qe.formula.evaluate import holds_at, truth_under
from qe.formula.syntax import Formula, Relation, RootAtom
from qe.formula.traverse import polynomials
from qe.io.text import read
from tests.strategies import formulas, points, rationals
from tests.tables import each

HALF = Fraction(1, 2)


@each(
    ("x^2 + y^2 <= 1", {"x": Fraction(3, 5), "y": Fraction(4, 5)}, True),
    ("x^2 + y^2 < 1", {"x": Fraction(3, 5), "y": Fraction(4, 5)}, False),
    ("x = 1/3 and not y > 0", {"x": Fraction(1, 3), "y": 0}, True),
    ("x /= 0 or y = 7", {"x": 0, "y": 7}, True),
    ("true", {}, True),
    ("x < root(2, x^2 - y)", {"x": 1, "y": 2}, True),
    ("x < root(2, x^2 - y)", {"x": 2, "y": 2}, False),
    ("x = root(1, x^2 - y)", {"x": -2, "y": 4}, True),
    ("x = root(-1, x^2 - y)", {"x": 2, "y": 4}, True),
    ("x >= root(1, x^2 - y)", {"x": 0, "y": 0}, True),
    ("x >= root(2, x^2 - y)", {"x": 0, "y": 0}, False),
    ("x /= root(1, x^2 - y)", {"x": 0, "y": -1}, False),
    ("not x /= root(1, x^2 - y)", {"x": 0, "y": -1}, True),
    ("x /= root(1, x*y)", {"x": 3, "y": 0}, False),
    ("x > root(-2, (x-1)^2*(x-2)*(x-y))", {"x": HALF + 1, "y": 5}, False),
    ("x > root(-3, (x-1)^2*(x-2)*(x-y))", {"x": HALF + 1, "y": 5}, True),
)
def test_holds_at(text: str, point: dict[str, Fraction], expected: bool) -> None:
    assert holds_at(read(text), point) is expected


@each(("x > y", "y"), ("ex y. x > y", "quantifier-free"))
def test_what_cannot_be_evaluated_is_said(text: str, named: str) -> None:
    with pytest.raises(InputError, match=named):
        holds_at(read(text), {"x": 1})


def test_more_values_than_variables_are_welcome() -> None:
    assert holds_at(read("x > 0"), {"x": 1, "unrelated": 5})


@given(formulas(names=("x", "y")), points(("x", "y")), st.data())
def test_partial_truth_is_right_under_every_completion(
    formula: Formula, point: dict[str, Fraction], data: st.DataObject
) -> None:
    known = {p: data.draw(st.booleans()) for p in polynomials(formula)}

    def sign(poly: Poly) -> int | None:
        value = poly.evaluate([point["x"], point["y"]])
        return (value > 0) - (value < 0) if known[poly] else None

    partial = truth_under(formula, sign)
    whole = holds_at(formula, point)
    assert partial in (None, whole)
    if all(known.values()):
        assert partial is whole


@given(rationals(), rationals(), st.sampled_from(tuple(Relation)), st.sampled_from((1, 2, -1, -2)))
def test_root_atoms_follow_the_square_root(x: Fraction, y: Fraction, relation: Relation, k: int) -> None:
    poly = read("x^2 - y^2 = 0").poly  # type: ignore[attr-defined]
    roots = sorted({y, -y})
    expected = False
    if abs(k) <= len(roots):
        root = roots[k - 1] if k > 0 else roots[k]
        expected = relation.holds((x > root) - (x < root))
    assert holds_at(RootAtom("x", relation, poly, k), {"x": x, "y": y}) is expected
