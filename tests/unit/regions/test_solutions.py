"""Solutions case by case: what is printed is read back, and is the formula again."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.formula.evaluate import holds_at
from tests.strategies import formulas, points
from tests.tables import each


@each(
    ("x^2 = 2", None, ["x = -sqrt(2)", "x = sqrt(2)"]),
    ("x^2 + y^2 = 1 and x = y", "x y", ["x = -sqrt(2)/2 and y = x", "x = sqrt(2)/2 and y = x"]),
    ("a*x < b", "x", ["a < 0 and b/a < x", "a = 0 and 0 < b", "0 < a and x < b/a"]),
    ("x^2 + y^2 <= 1", ("x", "y"), ["-1 <= x <= 1 and -sqrt(-x^2 + 1) <= y <= sqrt(-x^2 + 1)"]),
    ("y^3 = x", "y", ["y = root(1, y^3 - x, y)"]),
    ("ex y. x = y^2", None, ["0 <= x"]),
    ("x^5 - x = 1", None, ["x = root(1, x^5 - x - 1)"]),
    ("x < x", "x", ["false"]),
    ("ex y. x < y", "x", ["true"]),
)
def test_cases(text: str, variables: object, lines: list[str]) -> None:
    found = qe.solve(text, variables)
    assert str(found).split(" or\n") == lines
    assert qe.equivalent(str(found), text) and qe.equivalent(found.formula, text)


def test_double_roots_are_counted_once() -> None:
    found = qe.solve("x*y^2 - y - 1 >= 0")  # at x = -1/4 both roots are y = -2
    assert qe.equivalent(str(found), "x*y^2 - y - 1 >= 0")
    assert qe.equivalent(f"x = -1/4 and y = -2 and ({found})", "x = -1/4 and y = -2")


def test_the_object() -> None:
    found = qe.reduce("x^2 + b*x + c = 0", "x")
    assert found.order == ("b", "c", "x") and len(found) == len(list(found)) == 3 and str(found[0]) in str(found)
    assert repr(found) == "Solutions(b, c, x: 3 cases)" and "<li><code>" in found._repr_html_()
    assert found.region.contains(found[0].sample) and qe.verify(found.region.certificate).accepted


def test_misuse() -> None:
    for wrong in (lambda: qe.solve("x > 0", 3), lambda: qe.solve("x >"), lambda: qe.solve("x > 0", "x", timeout=0)):
        with pytest.raises(qe.InputError):
            wrong()


@settings(max_examples=30)
@given(formulas(names=("x", "y"), max_degree=3), st.lists(points(("x", "y")), min_size=4, max_size=4))
def test_each_case_is_read_back_and_all_together_are_the_formula(formula, at) -> None:
    found = qe.solve(formula, "x y")
    read = [read_formula(str(case)) for case in found]
    for point in at:
        assert sum(holds_at(f, point) for f in read) == holds_at(formula, point)  # the cases are disjoint
    for case, f in zip(found, read, strict=True):
        if all(not isinstance(value, qe.RealAlgebraic) for value in case.sample.values()):
            assert holds_at(f, case.sample)


@settings(max_examples=12)
@given(formulas(names=("`a b`", "pi", "ex"), max_degree=2))
def test_odd_names(formula) -> None:
    found = qe.solve(formula)
    assert read_formula(str(found)).free == found.formula.free
