"""The trees that operators, functions and their names make."""

from __future__ import annotations

from fractions import Fraction

import pytest

from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.functions import FUNCTIONS, RELATIONS
from qe.io.parser import TERM
from qe.io.text_errors import SyntaxFailure
from qe.io.text_parser import TextParser
from tests.tables import each


def term(text: str) -> s.Term:
    found: s.Term = TextParser(text).whole(TERM)
    return found


def name(letter: str, at: int) -> s.Name:
    return s.Name(letter, at)


@each(
    ("a + b - c", s.Sum([name("a", 0), name("b", 4), s.Minus(name("c", 8))])),
    ("a - (b - c)", s.Sum([name("a", 0), s.Minus(s.Sum([name("b", 5), s.Minus(name("c", 9))]))])),
    ("a*b/c", s.Quotient(s.Product(name("a", 0), name("b", 2), 1), name("c", 4), 3)),
    ("-a^2", s.Minus(s.Power(name("a", 1), s.Number(2), 2))),
    ("a^-2", s.Power(name("a", 0), s.Minus(s.Number(2)), 1)),
    ("--a", name("a", 2)),
    ("---a", s.Minus(name("a", 3))),
    ("+a", name("a", 1)),
    ("1.5e1", s.Number(Fraction(15))),
    ("Max(a, b, 1)", s.Apply("max", [name("a", 4), name("b", 7), s.Number(1)], 0)),
    ("sgn(a)", s.Apply("sign", [name("a", 4)], 0)),
    ("CubeRoot(a)", s.Apply("cbrt", [name("a", 9)], 0)),
    ("root(1, a, b)", s.Root(s.Number(1), name("a", 8), "b", 0)),
    ("Root(1, a)", s.Root(s.Number(1), name("a", 8), None, 0)),
)
def test_terms(text: str, tree: s.Term) -> None:
    assert term(text) == tree


X, Y = s.Comparison([name("x", 0), s.Number(0)], [Relation.GT], 2), s.Truth(True)


@each(
    ("x > 0 and true and false", s.Every([X, Y, s.Truth(False)])),
    ("x > 0 or true or false", s.Some([X, Y, s.Truth(False)])),
    ("x > 0 -> true -> false", s.Implication(X, s.Implication(Y, s.Truth(False)))),
    ("x > 0 <-> true <-> false", s.Equivalence(s.Equivalence(X, Y), s.Truth(False))),
    ("not true", s.Negation(Y)),
    ("not not true", Y),
    ("not not not true", s.Negation(Y)),
    (
        "x > 0 <= y",
        s.Comparison([name("x", 0), s.Number(0), name("y", 9)], [Relation.GT, Relation.LE], 2),
    ),
    ("ex x, y. true", s.Quantification(False, ["x", "y"], Y)),
)
def test_formulas(text: str, tree: s.Node) -> None:
    assert TextParser(text).whole() == tree


@each(
    ("1 + abs(a, b)", 4, "abs takes 1 argument"),
    ("min(" + ", ".join(["a"] * 1001) + ")", 0, "min takes 1 argument"),
    ("1 + f(a)", 4, "unknown function f"),
    ("root(a)", 0, "root takes a number"),
    ("root(1, a, b, c)", 0, "root takes a number"),
    ("root(1, a, b + 1)", 0, "root takes a number"),
    ("a + 1e99999", 4, "exponent of the number"),
)
def test_what_is_refused(text: str, at: int, said: str) -> None:
    with pytest.raises(SyntaxFailure) as error:
        term(text)
    assert error.value.at == at and said in error.value.message


def test_all_spellings_of_relations_and_functions() -> None:
    spelled = {relation: {text for text, found in RELATIONS.items() if found is relation} for relation in Relation}
    assert {"=", "==", "Eq", "Equal"} <= spelled[Relation.EQ] and {"!=", "<>", "≠", "Ne"} <= spelled[Relation.NE]
    assert {"<", "Lt", "Less"} == spelled[Relation.LT] and {">", "Gt", "Greater"} == spelled[Relation.GT]
    assert {"<=", "=<", "≤", "⩽", "\\[LessEqual]", "Le", "LessEqual"} == spelled[Relation.LE]
    assert {"≥", "⩾", ">=", "Ge"} <= spelled[Relation.GE]
    assert set(FUNCTIONS.values()) == set(s.FUNCTIONS)
