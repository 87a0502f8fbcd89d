"""The language of terms: what is read is true exactly where exact arithmetic on the text says so."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import sympy
from hypothesis import example, given, settings
from hypothesis import strategies as st

import qe
from qe.exact.algebraic import RealAlgebraic
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.io import formats
from qe.io.sympy import from_sympy
from qe.io.text import read
from tests.tables import each

NUMBERS = (
    Fraction(-2),
    Fraction(-1),
    Fraction(-1, 2),
    Fraction(0),
    Fraction(1, 2),
    Fraction(1),
    Fraction(2),
    Fraction(4),
)
POINTS = [{"x": a, "y": b} for a in NUMBERS for b in NUMBERS]
Value = Any
"""A Fraction, a RealAlgebraic, or None: no value."""


def root(value: Fraction) -> Value:
    return RealAlgebraic.from_root([-value.numerator, 0, value.denominator], 0, value + 1) if value >= 0 else None


OPERATIONS: dict[str, Callable[..., Value]] = {
    "({} + {})": lambda a, b: a + b,
    "({} - {})": lambda a, b: a - b,
    "{}*{}": lambda a, b: a * b,
    "({})/({})": lambda a, b: None if b == 0 else a / b,
    "abs({})": lambda a: max(a, -a),
    "|{}|": lambda a: max(a, -a),
    "-({})": lambda a: -a,
    "min({}, {})": min,
    "max({}, {})": max,
    "sign({})": lambda a: Fraction((a > 0) - (a < 0)),
    "({})^2": lambda a: a * a,
    "({})^-1": lambda a: None if a == 0 else 1 / a,
    "sqrt({})": root,
    "({})^(1/2)": root,
    "(if {} < {} then {} else {})": lambda a, b, c, d: c if a is not None and b is not None and a < b else d,
}
RELATIONS: dict[str, Callable[[Value, Value], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    "=": lambda a, b: a == b,
    "/=": lambda a, b: a != b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
}


class Term:
    """A term as text, and its value at a point. A root is taken of rational values only, and used once at most."""

    def __init__(self, text: str, value: Callable[[dict[str, Fraction]], Value], roots: int) -> None:
        self.text, self.value, self.roots = text, value, roots

    def __repr__(self) -> str:
        return self.text


def applied(pattern: str, parts: tuple[Term, ...]) -> Term:
    rooted = pattern.startswith("sqrt") or "1/2" in pattern
    strict = not pattern.startswith("(if")

    def value(point: dict[str, Fraction]) -> Value:
        values = [part.value(point) for part in parts]
        return None if strict and None in values else OPERATIONS[pattern](*values)

    return Term(pattern.format(*(part.text for part in parts)), value, sum(p.roots for p in parts) + rooted)


@st.composite
def terms(draw: st.DrawFn, depth: int = 3) -> Term:
    if depth == 0 or draw(st.integers(0, 3)) == 0:
        leaf = draw(st.sampled_from(("x", "y", "2", "1/3")))
        return Term(leaf, (lambda point: point[leaf]) if leaf.isalpha() else (lambda _: Fraction(leaf)), 0)
    pattern = draw(st.sampled_from(sorted(OPERATIONS)))
    parts = tuple(draw(terms(depth=depth - 1)) for _ in range(pattern.count("{}")))
    if any(p.roots for p in parts) and (
        pattern.startswith("sqrt") or "1/2" in pattern or sum(p.roots for p in parts) > 1
    ):
        return parts[0] if parts[0].roots < 2 else Term("x", lambda point: point["x"], 0)
    return applied(pattern, parts)


def true_at(formula: Formula, point: dict[str, Fraction]) -> bool:
    if formula.is_quantifier_free:
        return holds_at(formula, point)
    given = [read(f"{name} = {value}") for name, value in point.items()]
    together = qe.api.input.together(formula, *given)  # type: ignore[attr-defined]
    return qe.find_instance(conj(together)) is not None


def expected(left: Term, relation: str, right: Term, point: dict[str, Fraction]) -> bool:
    a, b = left.value(point), right.value(point)
    return a is not None and b is not None and RELATIONS[relation](a, b)


@settings(max_examples=30, deadline=None)
@given(terms(), st.sampled_from(sorted(RELATIONS)), terms())
def test_a_comparison_is_true_where_both_sides_have_values_that_compare_so(
    left: Term, relation: str, right: Term
) -> None:
    try:
        formula = read(f"{left} {relation} {right}")
    except qe.ParseError as error:
        assert "division by zero" in str(error)
        return
    again = read(str(formula))
    denied = read(f"not ({left} {relation} {right})")
    assert formats.read(formats.write(formula, "json"), "json") == formula
    if not formula.is_quantifier_free:
        return
    for point in POINTS:
        wanted = expected(left, relation, right, point)
        assert true_at(formula, point) is wanted, point
        assert true_at(denied, point) is not wanted, point
        assert true_at(again, point) is wanted, point


@settings(max_examples=8, deadline=None)
@given(st.sampled_from(("ex", "all")), terms(2), st.sampled_from(sorted(RELATIONS)), terms(2), st.sampled_from(NUMBERS))
@example(
    "all", applied("sqrt({})", (Term("x", lambda p: p["x"], 0),)), ">=", Term("2", lambda _: Fraction(2), 0), NUMBERS[0]
)
def test_a_quantifier_never_contradicts_a_point(
    quantifier: str, left: Term, relation: str, right: Term, y: Fraction
) -> None:
    try:
        found = qe.eliminate(f"{quantifier} x. {left} {relation} {right}", timeout=5).formula
    except (qe.Unable, qe.ParseError):
        return
    if found is None:
        return
    truths = [expected(left, relation, right, {"x": x, "y": y}) for x in NUMBERS]
    holds = true_at(found, {"y": y, "x": Fraction(0)})
    assert holds or quantifier == "all" or not any(truths)
    assert not holds or quantifier == "ex" or all(truths)


@each(
    ("cbrt(x) < y", "x < y^3"),
    ("x^(1/3) < y", "x >= 0 and x < y^3 and y > 0"),
    ("x^(-2/3) < 1", "x > 1"),
    ("sqrt(x) + sqrt(y) + sqrt(x + y) > 0", "x >= 0 and y >= 0 and (x > 0 or y > 0)"),
    ("y = root(2, x^3 - 3*x + 1)", "ex s. s^3 - 3*s + 1 = 0 and 0 < s < 1 and y = s"),
    ("root(1, t^3 - 2)^3 = 2 and root(1, x^3 - 2) > root(1, x^2 - x)", "true"),
    ("root(1, t^3 - 2) <= x + 1 < 2", "x < 1 and (x + 1)^3 >= 2"),
    ("y < root(1, x^2 - y, x) + 1", "ex s. s = root(1, s^2 - y) and y < s + 1"),
    ("all x. sqrt(x^2 + 1) > x", "true"),
    ("all x. x^(1/3) >= 0", "false"),
    ("all x. x >= 0 -> x^(1/3) >= 0", "true"),
    ("not (1/x > 0)", "x <= 0"),
    ("1/x /= 1", "x /= 0 and x /= 1"),
    ("not 1/x = 1", "x /= 1"),
    ("all x. 1/x > 0 -> x > 0", "true"),
    ("ex x. x/x /= 1", "false"),
    ("sqrt(x) - sqrt(x) = 0", "x >= 0"),
    ("sqrt(x^2*y^2) = -x*y", "x*y <= 0"),
    ("sqrt(1/x) > y", "x > 0 and (y < 0 or x*y^2 < 1)"),
    ("x < oo and y > -oo", "true"),
    ("1/x < oo", "x /= 0"),
    ("(if x > 0 then 1/x else sqrt(-x)) > 1", "0 < x < 1 or x < -1"),
    ("|a| + |b| + |c| + |d| + |f| <= 0", "a=0 and b=0 and c=0 and d=0 and f=0"),
)
def test_meaning(text: str, meant: str) -> None:
    assert qe.equivalent(text, meant)
    assert qe.equivalent(str(read(text)), meant)


@settings(max_examples=15, deadline=None)
@given(terms(2), st.sampled_from(("<", "<=", ">", ">=")), terms(2))
def test_sympy_means_the_same(left: Term, relation: str, right: Term) -> None:
    """SymPy may simplify what it builds, so points where the text has no value are left out."""
    if "|" in f"{left}{right}" or "(if" in f"{left}{right}":
        return
    table = {"min": sympy.Min, "max": sympy.Max, "abs": sympy.Abs, "sign": sympy.sign, "sqrt": sympy.sqrt}
    names = {name: sympy.Symbol(name, real=True) for name in ("x", "y")}
    sides = (str(side).replace("^", "**") for side in (left, right))
    try:
        a, b = (sympy.sympify(side, locals={**table, **names}) for side in sides)
        expression = sympy.core.relational.Rel(a, b, relation)
    except TypeError:  # SymPy found an undefined or complex constant
        return
    if expression.has(sympy.zoo, sympy.nan, sympy.I):
        return
    formula = from_sympy(expression)
    if not formula.is_quantifier_free:
        return
    for point in POINTS:
        if left.value(point) is not None and right.value(point) is not None:
            assert true_at(formula, point) is expected(left, relation, right, point), point
