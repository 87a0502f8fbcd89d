"""The grammar of the text: every rule against the plain way to write the same."""

from __future__ import annotations

from itertools import product

import pytest

from qe.errors import InputError
from qe.formula.evaluate import holds_at
from qe.formula.relation import Relation
from qe.formula.syntax import Formula
from qe.io import surface as s
from qe.io.lowering import lower
from qe.io.parser import TERM
from qe.io.text_errors import SyntaxFailure
from qe.io.text_parser import LatexParser, TextParser, parser_of
from tests.tables import each


def read(text: str) -> Formula:
    return lower(TextParser(text).whole(), lambda message, at: InputError(message))


@each(
    ("x in [0, 1)", "0 <= x and x < 1"),
    ("x in (0, 1]", "0 < x and x <= 1"),
    ("x in [-infinity, 1]", "x <= 1"),
    ("x in (0, infinity]", "0 < x"),
    ("x in {1, 2, y}", "x = 1 or x = 2 or x = y"),
    ("x in Reals", "true"),
    ("1/x in Reals", "x /= 0"),
    ("Element(x, Reals) and x > 0", "x > 0"),
    ("ex x in [0, 1]. x > y", "ex x. 0 <= x and x <= 1 and x > y"),
    ("all x in [0, 1]. x > y", "all x. 0 <= x and x <= 1 -> x > y"),
    ("ex x, z in [0, 1]. x*z > y", "ex x, z. (0 <= x and x <= 1) and (0 <= z and z <= 1) and x*z > y"),
    ("all x. ex z. x > z", "all x. (ex z. x > z)"),
    ("all x ex z. x > z", "all x. (ex z. x > z)"),
    ("ex x z. x > z", "ex x, z. x > z"),
    ("ex x (x > y)", "ex x. x > y"),
    ("ForAll[{x, z}, x > z]", "all x, z. x > z"),
    ("ForAll[x, x > 0, x > y]", "all x. x > 0 -> x > y"),
    ("Exists[x, x > 0, x > y]", "ex x. x > 0 and x > y"),
    ("Exists((x, z), x > z)", "ex x, z. x > z"),
    ("And(x > 0, y > 0, z > 0)", "x > 0 and y > 0 and z > 0"),
    ("Or(x > 0, y > 0)", "x > 0 or y > 0"),
    ("Not(x > 0)", "x <= 0"),
    ("Implies(x > 0, y > 0)", "x > 0 -> y > 0"),
    ("Equivalent(x > 0, y > 0)", "x > 0 <-> y > 0"),
    ("Less(x, y, z)", "x < y and y < z"),
    ("GreaterEqual[x, y]", "x >= y"),
    ("if x > 0 then y > 0 else z > 0", "(x > 0 -> y > 0) and (x > 0 or z > 0)"),
    ("|x - 1| > y", "abs(x - 1) > y"),
    ("√x > y", "sqrt(x) > y"),
    ("{x > 0, y > 0}", "x > 0 and y > 0"),
    ("ForAll x. x > y", "all x. x > y"),
    ("∃x. x > y", "ex x. x > y"),
    ("A x. x > y", "all x. x > y"),
    ("E x. x > y", "ex x. x > y"),
)
def test_other_ways_to_write(text: str, plain: str) -> None:
    assert read(text) == read(plain)


@each("(if x > 0 then y else z) > 1", "If[x > 0, y, z] > 1")
def test_case_distinctions_in_terms(text: str) -> None:
    formula = read(text)
    for x, y, z in product((0, 1), (1, 2), (1, 2)):
        assert holds_at(formula, {"x": x, "y": y, "z": z}) == ((y if x > 0 else z) > 1)


@each(1, 2, 3)
def test_exclusive_or(count: int) -> None:
    names = "xyz"[:count]
    formula = read(f"Xor({', '.join(f'{name} > 0' for name in names)})")
    for signs in product((0, 1), repeat=count):
        assert holds_at(formula, dict(zip(names, signs))) == bool(sum(signs) % 2)


@each(
    ("y > 0 and Not(x > 0, y > 0)", 10, "Not takes one formula"),
    ("Implies(x > 0)", 0, "Implies takes two formulas"),
    ("Implies(x > 0, x > 1, x > 2)", 0, "Implies takes two formulas"),
    ("Less(x)", 0, "Less compares two terms"),
    ("ForAll[x, x > 0, x > 1, x > 2]", 0, "a quantifier takes variables, perhaps a condition"),
)
def test_wrong_numbers_of_parts(text: str, at: int, said: str) -> None:
    with pytest.raises(SyntaxFailure) as error:
        TextParser(text).whole()
    assert error.value.at == at and said in error.value.message


def test_offsets_of_sets_and_functions() -> None:
    found = TextParser("x in (0, 1)").whole()
    x = s.Name("x", 0)
    low, high = s.Comparison([x, s.Number(0)], [Relation.GT], 2), s.Comparison([x, s.Number(1)], [Relation.LT], 2)
    assert found == s.Every([low, high])
    assert TextParser("1 + |x|").whole(TERM) == s.Sum([s.Number(1), s.Apply("abs", [s.Name("x", 5)], 4)])
    assert TextParser("∞").whole(TERM) == s.Infinity(0)


def test_one_grammar_for_text_and_latex() -> None:
    latex = r"\forall x \colon x^{2} \geq 0 \land \frac{1}{2} > y"
    fail = lambda message, at: InputError(message)  # noqa: E731
    assert parser_of(latex) is LatexParser and parser_of("x > 0 | y > 0") is TextParser
    assert lower(LatexParser(latex).whole(), fail) == read("all x. x^2 >= 0 and 1/2 > y")


@each(
    ("x > 0 | y > 0", "x > 0 or y > 0"),
    ("x > 0||y > 0", "x > 0 or y > 0"),
    ("||x| - 1| > y", "abs(abs(x) - 1) > y"),
    ("|x| > 0 || |y| > 0", "abs(x) > 0 or abs(y) > 0"),
    ("(x > 0 | y > 0) & |x|*|y| < 1", "(x > 0 or y > 0) and abs(x)*abs(y) < 1"),
    ("Element[x | y, Reals] | |x| > 1", "true or abs(x) > 1"),
)
def test_bars(text: str, plain: str) -> None:
    assert read(text) == read(plain)
