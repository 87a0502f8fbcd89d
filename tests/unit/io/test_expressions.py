"""Formulas written with Python's operators: they mean what the same text means."""

import pickle
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

import qe
from qe.errors import InputError, NoTruthValue
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.io import expressions
from qe.io.substitution import substitute
from qe.io.text import read, read_term
from tests.strategies import formulas
from tests.tables import each
from tests.universe import UNIVERSE, holds

x, y = qe.variables("x y")
ROOT2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    ((x**2 + y <= 1) & (y > x), "x^2 + y <= 1 and y > x"),
    ((x > 0) | ~(y > 0) | (x < y), "x > 0 or y <= 0 or x < y"),
    ((x > 0) >> (y >= 0.1), "x > 0 -> y >= 0.1"),
    (abs(x - 1) < Decimal("1.5"), "|x - 1| < 1.5"),
    (1 / x > -y + 3, "1/x > 3 - y"),
    (x ** Fraction(1, 2) < y / 2, "sqrt(x) < y/2"),
    ((2 * x - 3).equals(+y), "2*x - 3 = y"),
    (x.differs("y^2 + 1"), "x /= y^2 + 1"),
    (x * x > ROOT2, "x^2 > sqrt(2)"),
    (x > sympy.sqrt(sympy.Symbol("y")) - sympy.Rational(1, 2), "x > sqrt(y) - 1/2"),
    (qe.exists(x, qe.forall([y], x <= y**2)), "ex x. all y. x <= y^2"),
    (qe.exists("x", "x > y") & read("y > 0"), "(ex x. x > y) and y > 0"),
    (read("y > 0") | (x > 0), "y > 0 or x > 0"),
    (sympy.Symbol("y", real=True) > x, "y > x"),
)
def test_meaning(made: object, text: str) -> None:
    assert qe.equivalent(made, text)
    assert qe.equivalent(str(made), text)


def test_every_public_function_takes_them() -> None:
    disc = x**2 + y**2 <= 1
    assert qe.decide(qe.exists((x, y), disc))
    assert qe.minimize(x + y, [disc]).value == -ROOT2
    assert qe.region(disc, order=[y, x]).order == ("y", "x")
    assert qe.find_instance(disc & (x > y)) is not None
    assert str(qe.eliminate(qe.exists(y, disc)).formula) == "-1 <= x <= 1"
    assert pickle.loads(pickle.dumps(disc)) == disc


def test_parts() -> None:
    f = qe.exists(x, (x > y) & (x < 1)) | (y > 2)
    assert f.free == ("y",) and [str(a) for a in f.atoms] == ["x > y", "x < 1", "y > 2"]
    assert repr(x) == "x" and repr(2 * x - 1) == "(2*x - 1)"


@each(
    ("x^2 < y", {x: 2}, "4 < y"),
    ("x < y", {"x": y, "y": x}, "y < x"),
    ("x^3 < y", {x: -y / 2}, "-y^3 < 8*y"),
    ("ex x. x > y", {y: x}, "true"),
    ("ex x. x > y and x < z", {y: x, "z": x + 1}, "true"),
    ("all x. x > y or x < z", {y: "x + z"}, "x < 0"),
    ("x > y", {x: 1 / y}, "y /= 0 and 1/y > y"),
    ("x > y", {x: ROOT2}, "y < sqrt(2)"),
    ("x > y", {x: abs(y)}, "y < 0"),
    ("x > y", {"w": 5}, "x > y"),
    ("x = root(2, x^2 - y)", {x: 3}, "y = 9"),
    ("y > root(2, y^2 - x)", {x: 4}, "y > 2"),
    ("x > 0", {x: 1}, "true"),
)
def test_substitution(text: str, values: dict[object, object], expected: str) -> None:
    assert qe.equivalent(qe.Statement(read(text)).substitute(values), expected)


numbers = st.sampled_from(UNIVERSE)


@given(formulas(max_quantifiers=2), st.sampled_from(("y + 1", "2*x - z/3", "z*y", "-7/2")), numbers, numbers)
def test_substitution_is_evaluation_later(formula: Formula, text: str, a: Fraction, b: Fraction) -> None:
    if not formula.is_quantifier_free:
        return
    changed = substitute(formula, {"x": read_term(text)})
    point = {"x": b, "y": a, "z": b}
    value = {"y + 1": a + 1, "2*x - z/3": 2 * b - b / 3, "z*y": b * a, "-7/2": Fraction(-7, 2)}[text]
    assert holds_at(changed, point) is holds_at(formula, {**point, "x": value})
    assert holds(changed, point) is holds_at(changed, point)


@each(
    (lambda: x == 1, "x.equals(y)"),
    (lambda: x != y, "x.differs(y)"),
    (lambda: (x > 0) and (y > 0), "& | ~ >>"),
    (lambda: 0 < x < 1, "(x < y) & (y < z)"),
    (lambda: not (x > 0), "qe.decide"),
    (lambda: (x > 0) == True, "qe.decide"),  # noqa: E712
    (lambda: 1 if x else 2, "no truth value"),
    (lambda: x**y > 1, "rational number"),
    (lambda: x + True, "a number or an expression"),
    (lambda: x + None, "a number or an expression"),
    (lambda: x / 0 > 1, "division by zero"),
    (lambda: x + "y zz", "an operator is missing"),
    (lambda: x + float("nan"), "a number or an expression"),
    (lambda: x + sympy.pi ** sympy.sqrt(2), "not algebraic"),
    (lambda: qe.variables(""), "names of variables"),
    (lambda: qe.variables("a|b"), "cannot be the name"),
    (lambda: qe.exists([], x > 0), "at least one variable"),
    (lambda: qe.exists(x + 1, x > 0), "names of variables"),
    (lambda: qe.exists(x, x), "a formula"),
    (lambda: (x > 0).substitute({x + 1: 2}), "the name of a variable"),
    (lambda: (x > 0).substitute(3), "a mapping"),
    (lambda: (x + 1).name, "a variable expected"),
    (lambda: qe.decide(x > 0), "a sentence expected"),
)
def test_mistakes_are_told_in_one_line(wrong: Callable[[], object], part: str) -> None:
    with pytest.raises((InputError, NoTruthValue)) as caught:
        wrong()
    assert part in str(caught.value) and "\n" not in str(caught.value)


def test_values_are_put_into_answers_too() -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0").formula
    b, c = qe.variables("b c")
    assert str(answer.substitute({"b": 2, c: 1})) == "true"
    assert str(answer.substitute({b: c, "unknown": 1})) == "c*(c - 4) >= 0"
    assert str(qe.eliminate("ex x. x > 0").formula.substitute({"x": 1})) == "true"
    with pytest.raises(qe.InputError):
        answer.substitute(3)


def test_values_and_connectives_without_the_operators() -> None:
    assert str(expressions.graph_of("z", 1 / x)) == str(read("z = 1/x"))
    assert expressions.substituted(read("x > y"), {y: 2}) == read("x > 2")
    above, below = read("x > 1"), read("y < 0")
    for way, text in {"and": "x > 1 and y < 0", "or": "x > 1 or y < 0", "implies": "x > 1 -> y < 0"}.items():
        assert expressions.connected(way, above, below) == read(text)
        assert expressions.connected(way, above, qe.Statement(below)) == qe.Statement(read(text))
    assert expressions.connected("not", above) == read("x <= 1")
    with pytest.raises(InputError):
        expressions.connected("and", above, 3)


def test_terms_as_text() -> None:
    shown = {
        x + 2 * y - 3: "((x + 2*y) - 3)",
        (x - y) ** 2 / -y: "((x - y))^2/(-y)",
        abs(x) * Fraction(1, 2): "abs(x)*(1/2)",
        x + ROOT2: f"(x + ({ROOT2}))",
        +(qe.variables("x1") ** -2): "(x1)^(-2)",
    }
    for made, text in shown.items():
        assert repr(made) == text
        assert qe.equivalent(expressions.graph_of("v", made), expressions.graph_of("v", text))


def test_what_meets_other_systems() -> None:
    """``^`` was refused by Python, z3's conditions by ``&``, and terms by SymPy's functions."""
    x, y = qe.variables("x y")
    assert qe.equivalent((x > 0) ^ (y > 0), "x > 0 and y <= 0 or x <= 0 and y > 0")
    assert qe.equivalent((x > 0).formula ^ "y > 0", (x > 0) ^ (y > 0))
    sx, sy = sympy.symbols("x y")
    assert sympy.sqrt(x) == sympy.sqrt(sx)
    term = sympy.sympify(x**2 / (y - 1) + abs(x) * 0.5 - 2)
    assert sympy.simplify(term - (sx**2 / (sy - 1) + sympy.Abs(sx) / 2 - 2)) == 0
    z3 = pytest.importorskip("z3")
    assert qe.equivalent((x > 0) & (z3.Real("y") > 1), "x > 0 and y > 1")
