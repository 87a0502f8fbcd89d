"""Elimination by comprehensive Groebner systems gives what the other methods give."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.engine.strategy import Attempt, Scope
from qe.formula.evaluate import holds_at
from tests.tables import each

PROBLEMS = {
    "quadratic": "ex x. a*x^2 + b*x + c = 0",
    "a root and its sign": "ex x. x^2 + b*x + c = 0 and x > 0",
    "a weak condition": "ex x. x^2 = a and x >= b",
    "an inequation": "ex x. x^2 = a and x /= b",
    "universal": "all x. x^2 + b*x + 1 /= 0",
    "universal implication": "all x. x^2 = a ==> x < b",
    "circle and hyperbola": "ex x, y. x^2 + y^2 = r and x*y = 1",
    "disjunction": "ex x. (x^2 = a or x^3 = a) and x > 1",
    "no bound variable in some equations": "ex x. x^2 = a and a*b = 1 and b /= 2",
    "a sentence": "ex x, y, z. x*y = z and y*z = x and x*z = y and x + y + z > 2",
    "a false sentence": "ex x, y. x^2 + y^2 = 1 and x*y = 1",
    "a multiple solution": "ex x, y. (x - y)^2 = 0 and x^2 + y^2 = a and x > 0",
    "two links": "ex c, s, d, t. c^2 + s^2 = 1 and d^2 + t^2 = 1 and 2*c + d = a and 2*s + t = b",
    "matrix without powers of one variable": "ex x, y, z. x^2 + y*z = a and y^2 + x*z = 1 and z^2 + x*y = 1",
}


@pytest.mark.parametrize("name", PROBLEMS)
def test_agrees_with_the_other_methods(name: str) -> None:
    found = qe.eliminate(PROBLEMS[name], method="cgs", timeout=120)
    assert found.formula is not None, found.reason
    assert qe.equivalent(found, qe.eliminate(PROBLEMS[name]), timeout=60)


FREE = [
    "ex x, y. x^2 + y^2 = 1 and x + y >= a",
    "ex x, y. x*y = a and x + y > b",
    "ex x. a*x = b and x > 0 and x < 1",
    "ex x. x^2 + a*x + b < 0",
    "all x. x^2 + a*x + b >= 0",
    "ex x. x >= a and x <= b and x /= 0",
    "ex x. (x - a)*(x - b) <= 0 and x > 1",
]


@pytest.mark.parametrize("text", FREE)
def test_what_no_equation_binds_has_points_between_zeros(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The method alone: nothing else is even loaded."""
    loaded, load = set[str](), Attempt.load

    def seen(attempt: Attempt) -> object:
        loaded.update({attempt.method} if attempt.scope is not Scope.QUESTION else ())
        return load(attempt)

    monkeypatch.setattr(Attempt, "load", seen)
    found = qe.eliminate(text, method="cgs", process=False)
    assert found.formula is not None and loaded == {"cgs"}
    assert qe.equivalent(found, text, timeout=60)


@each(
    (FREE[0], "a^2 <= 2 or a < 0"),
    ("ex x. x^2 + x + 1 <= 0", "false"),
    ("all x. x^4 - x + 1 > 0", "true"),
    ("ex x, y. x^2 + y^2 = 1 and x + y > 2", "false"),
    ("ex x, y. x^2 = 2 and y > x", "true"),
)
def test_answers_without_equations_are_checked(text: str, expected: str) -> None:
    found = qe.eliminate(text, method="cgs", check=True, process=False)
    assert found.guarantee is qe.Guarantee.CHECKED and qe.equivalent(found.formula, expected)


@each("ex x, y. x^2 + y^2 < a and x*y > b", "ex x. x^3 + a*x > b and x < a and x > c")
def test_what_is_beyond_the_method_is_told_in_a_line(text: str) -> None:
    found = qe.eliminate(text, method="cgs", timeout=60)
    assert found.formula is None and "\n" not in found.reason
    assert "Gröbner systems alone" in found.reason or "trace forms" in found.reason


def test_the_step_is_named_and_derived() -> None:
    found = qe.eliminate("ex x, y. x^2 + y^2 = r and x*y = 1", method="cgs")
    assert "comprehensive Gröbner system" in {step.rule for step in found.derivation.steps}
    assert found.guarantee is qe.Guarantee.DERIVED


def test_a_witness_is_exact_and_checked() -> None:
    found = qe.eliminate("ex x, y. x^2 = 2 and y^3 = x and y > 1", method="cgs")
    assert found.truth and found.guarantee.value == "checked"
    assert found.witness is not None and found.witness["y"] ** 6 == 2


@each("ex x, y. y^2 = 4 and y > 0 or x > y and x < y", "ex x, y. x^2 + 1 = 0 or y^3 = 2")
def test_a_witness_has_all_variables_of_the_block(text: str) -> None:
    """Those that do not occur in the conjunction that holds were missing: an internal error."""
    found = qe.eliminate(text, method="cgs", check=True, process=False)
    assert found.truth and found.witness is not None and set(found.witness) == {"x", "y"}
    assert found.guarantee is qe.Guarantee.CHECKED


def test_systems_are_taken_by_themselves_where_that_helps() -> None:
    """The cyclic 5-roots: decomposition does not end in a time that a test could wait for."""
    equations = "a+b+c+d+e = 0 and a*b+b*c+c*d+d*e+e*a = 0 and a*b*c+b*c*d+c*d*e+d*e*a+e*a*b = 0 and a*b*c*d*e = 1"
    fourth = "a*b*c*d + b*c*d*e + c*d*e*a + d*e*a*b + e*a*b*c = 0"
    assert qe.decide(f"ex a, b, c, d, e. {equations} and {fourth} and a > b", timeout=60)
    assert not qe.decide(f"ex a, b, c, d, e. {equations} and {fourth} and a > 3", timeout=60)


@st.composite
def small_blocks(draw: st.DrawFn) -> str:
    """An equation in x with parameter k, and a condition."""
    coefficient = st.sampled_from(["1", "-1", "2", "k", "(k - 1)", "0"])
    equation = f"{draw(coefficient)}*x^2 + {draw(coefficient)}*x + {draw(coefficient)} = 0"
    relation = st.sampled_from([">", ">=", "/=", "<", "<="])
    return f"ex x. {equation} and {draw(coefficient)}*x {draw(relation)} {draw(coefficient)}"


@settings(max_examples=6)
@given(small_blocks())
def test_small_random_blocks_are_checked_and_agree_with_decomposition(text: str) -> None:
    found = qe.eliminate(text, method="cgs", check=True, process=False)
    assert found.guarantee is qe.Guarantee.CHECKED
    assert qe.equivalent(found, qe.eliminate(text, method="cad", process=False), process=False)


@st.composite
def inequalities(draw: st.DrawFn) -> str:
    """One or two conditions on x with parameter k; leading coefficients may vanish."""
    coefficient, relation = (
        st.sampled_from(["1", "-1", "2", "k", "(k - 1)", "0"]),
        st.sampled_from([">", ">=", "/=", "<"]),
    )
    first = f"{draw(coefficient)}*x^2 + {draw(coefficient)}*x + {draw(coefficient)} {draw(relation)} 0"
    second = f"{draw(coefficient)}*x {draw(relation)} {draw(coefficient)}"
    return f"ex x. {first} and {second}"


@settings(max_examples=12)
@given(inequalities())
def test_random_inequalities_agree_with_decomposition(text: str) -> None:
    found = qe.eliminate(text, method="cgs", process=False)
    assert qe.equivalent(found, qe.eliminate(text, method="cad", process=False), process=False)


@st.composite
def blocks(draw: st.DrawFn) -> str:
    """An equation or two in x, y with parameter k, and one condition."""
    coefficient = st.sampled_from(["1", "-1", "2", "k", "(k - 1)", "0"])
    first = f"x^2 + {draw(coefficient)}*x + {draw(coefficient)}*y = {draw(coefficient)}"
    second = f"{draw(coefficient)}*y^2 + y + {draw(coefficient)}*x = {draw(coefficient)}"
    condition = f"{draw(coefficient)}*x + y {draw(st.sampled_from(['>', '>=', '/=', '<']))} {draw(coefficient)}"
    return f"ex x, y. {first} and {second} and {condition}"


@pytest.mark.deep
@settings(max_examples=120)
@given(blocks())
def test_many_random_blocks(text: str) -> None:
    agree(text)


@pytest.mark.deep
@settings(max_examples=40)
@given(blocks())
def test_many_random_blocks_against_substitution(text: str) -> None:
    """Where both eliminate the block, their formulas hold at the same points."""
    found, other = (qe.eliminate(text, method=m, timeout=20) for m in ("cgs", "vs"))
    if found.formula is None or other.formula is None:
        return
    for value in map(Fraction, ("-2", "-1", "0", "1/2", "1", "3", "1000000")):
        assert holds_at(found.formula, {"k": value}) == holds_at(other.formula, {"k": value}), (text, value)


def agree(text: str) -> None:
    """At points of the parameter, also special ones, the truth is that of decomposition."""
    found = qe.eliminate(text, method="cgs", timeout=120)
    if found.formula is None:
        return
    for value in map(Fraction, ("-2", "-1", "0", "1/2", "1", "3")):
        truth = qe.decide(text.replace("k", f"({value})"), method="cad", timeout=120)
        assert holds_at(found.formula, {"k": value}) == truth, (text, value)
