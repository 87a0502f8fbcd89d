"""Messages about texts: the right offset, and the known misunderstandings."""

import pytest

from qe.errors import ParseError
from qe.io.text import read
from qe.io.text_errors import (
    Failing,
    position,
    unexpected_token,
    unknown_character,
    unknown_function,
    way_out,
)
from tests.tables import each


@each(
    ("", 0, "the text is empty", "a formula"),
    ("  \n ", 0, "the text is empty", "a formula"),
    ("x > 0 and ", 9, "the text ends too early", "a formula"),
    ("x >", 3, "the text ends too early", "a number, a variable or '('"),
    ("ex", 2, "the text ends too early", "the name of a variable"),
    ("x +* 2 > 0", 3, "unexpected '*'", "a number, a variable or '('"),
    ("(x > 0", 0, "this '(' is never closed", ""),
    ("((x) > 0", 0, "this '(' is never closed", ""),
    ("(x + (y > 0", 8, "unexpected '>'", "an operator or ')'"),
    ("x > 0)", 5, "this ')' has no partner", ""),
    ("(x > 0 and ∃y)", 13, "unexpected ')'", "'.' or ','"),
    ("x === y", 4, "'===' is not used", ""),
    ("x ||| y", 2, "", ""),
    ("x! > 0", 1, "it is no factorial", ""),
    ("x => y", 3, "'=>' is not used", ""),
    ("x < = y", 4, "write <= without a space", ""),
    ("x > = y", 4, "write >= without a space", ""),
    ("a^b^c = 0", 3, "a^b^c is ambiguous", ""),
    ("0,5*x = a", 1, "a decimal number is written with a point", ""),
    ("x = 1,000", 5, "a decimal number is written with a point", ""),
    ("x = 1_000", 4, "without _ between its digits", ""),
    ("exists exactly x. x^2 = a", 7, "write exactly 1 x. f", ""),
    ("print(x**2 <= a, x)", 11, "print is a command", ""),
    ("MinValue[{x, x > 0}, x]", 9, "qe.minimize", ""),
    ("x < Root[#^3 - 2 &, 1]", 4, "is written root(1, x^3 - 2)", ""),
    ("Simplify[x > 1, x > 0, Reals]", 16, "assuming=", ""),
    (
        "FunctionRange[x, x, y] > 0",
        0,
        "unknown function FunctionRange; known: abs",
        "",
    ),
    ("∃ integer n. n = x", 2, "all variables are real", ""),
    ("there are two x with x^2 = a", 10, "names of variables alone", ""),
    ("exists a real x. x^2 = a", 9, "names of variables alone", ""),
    ("for all x st x > 0, x > a", 10, "names of variables alone", ""),
    ("for all x having x > 0: x > a", 17, "x stands twice", ""),
    ("for all x, with x > 0, x > a", 11, "'with' stands only behind", ""),
    ("x >= 1\ny >= 2", 7, "of several lines", ""),
    ("(and (> x 0) (< y 1))", 1, "format smtlib", ""),
    ("x := 0", 2, "':=' is not used", ""),
    ("minimize x^2 subject to x > 1", 9, "qe.minimize", ""),
    ("find x > 1 and x < 2", 5, "find is a command", ""),
    ("x between 0 and 1", 2, "x in [0, 1]", ""),
    ("x is positive", 2, "conditions are written with", ""),
    ("(x > 0) > y", 8, "two formulas are compared with <->", ""),
    ("ex x. x^2 +", 11, "ends too early", ""),
    ("x ** ** 2 = 0", 5, "unexpected", ""),
    ("x^2 < ", 5, "ends too early", ""),
    ("ex . x = 0", 3, "the name of a variable", ""),
    ("1/2x = 1", 3, "1/(2*x)", ""),
    ("x^99999999 = 0", 1, "above the limit", ""),
    ("x = 1/0", 5, "division by zero", ""),
    ("(x = 1", 0, "never closed", ""),
    ("x = 1)", 5, "no partner", ""),
    ("x === 1", 4, "one =", ""),
    ("ex x, x = 0", 11, "'.' or ','", ""),
    ("sin(x) = 0", 0, "sin(x): sin is not algebraic; put c and s", ""),
    ("2 < ln[x + (1)] + 1", 4, "ln[x + (1)]: ln is not algebraic", ""),
    ("floor(x) = 0", 0, "needs integers", ""),
    ("f(x) = 0", 0, "unknown function f", ""),
    ("sqrt(x, y) = 0", 0, "takes 1 argument", ""),
    ("", 0, "empty", ""),
    ("x^y = 1", 1, "rational number", ""),
    ("2^x = 1", 1, "rational number", ""),
    ("x^(1/99999) = 1", 1, "root of degree", ""),
    ("x^2^3 = 1", 3, "ambiguous", ""),
    ("x => 1", 3, ">=", ""),
    ("2|x| > 0", 1, "2*|x|", ""),
    ("x > 2|y|", 7, "2*|x|", ""),
    ("x > 0 y > 1", 6, "a product is written 0*y", ""),
    ("x > 1 y > 2", 5, "an operator is missing here", ""),
    ("x = a y = 2", 5, "an operator is missing here", ""),
    ("x squared > 2 and y squared > 3", 2, "a product is written x*squared", ""),
    ("x > 1 holds", 6, "a product is written 1*holds", ""),
    ("x > 0\ny > 1", 6, "conditions of several lines", ""),
    ("1/2 x > 0", 4, "1/2 x is ambiguous", ""),
    ("1/(2) x > 0", 6, "is ambiguous", ""),
    ("f(x + 1) > 0", 0, "unknown function f", ""),
    ("k(x) > 0", 0, "unknown function k", ""),
    ("0 < a, b < 1", 5, "0 < a, b < 1 is ambiguous", ""),
    ("x > 0, y > 1 or z > 2", 5, "is ambiguous", ""),
    ("a > 0, b > 0 -> a*b > 0", 5, "is ambiguous", ""),
    ("ex y. y > x, x > 0", 11, "is ambiguous", ""),
    ("ex y. y > x or y = 1, y > 0", 20, "is ambiguous", ""),
    ("all y. y > x, y > 0", 12, "is ambiguous", ""),
    ("a > 0 <-> x^2 + a > 0 for all x", 22, "is ambiguous", ""),
    ("ex y. y > x for all x", 12, "is ambiguous", ""),
    ("x > 0 ex y. y > x", 6, "stands in front", ""),
    ("Reduce[x > 0, x, Integers]", 17, "all variables are real", ""),
    ("|my name| > 0", 4, "an operator is missing", ""),
    ("x! > 0", 1, "no factorial", ""),
    ("oo + 1 > x", 0, "infinity is no number", ""),
    ("Exists[x, x > 0, x > 1, x > 2]", 0, "perhaps a condition", ""),
    ("Eq(x)", 0, "two terms", ""),
    ("Implies(x > 0)", 0, "two formulas", ""),
    ("`x > 0", 0, "needs both", ""),
    ("x < ``", 4, "not empty", ""),
    ("x < `a\\q`", 4, "backquote or u", ""),
    ("x < `a\\u{7c}b`", 4, "a bar", ""),
    ("x + nan > 0", 4, "write `nan`", ""),
    ("(x > 0) = (y > 0)", 8, "<->", ""),
    ("x", 1, "a relation", ""),
    ("x and y > 0", 2, "a relation", ""),
    ("(x + y + z + w + 1)^1000 = 0", 19, "million", ""),
    ("1e99999999 = x", 0, "exponent of the number", ""),
    ("x < root(0, x)", 4, "no such root", ""),
    ("x < root(1, y*z)", 4, "does not contain x", ""),
    ("x + 1 < root(1, x*y)", 8, "needs its variable", ""),
    ("x < root(1)", 4, "root takes", ""),
    ("x < root(1, x, y)", 4, "in a variable of the polynomial", ""),
    ("x = 'a'", 4, "unknown character", ""),
    ("1 + abs(a, b) > 0", 4, "abs takes 1 argument", ""),
    ("min(" + ", ".join(["a"] * 1001) + ")" + " > 0", 0, "min takes 1 argument", ""),
    ("1 + f(a) > 0", 4, "unknown function f", ""),
    ("root(a) > 0", 0, "root takes a number", ""),
    ("root(1, a, b, c) > 0", 0, "root takes a number", ""),
    ("root(1, a, b + 1) > 0", 0, "root takes a number", ""),
    ("a + 1e99999 > 0", 4, "exponent of the number", ""),
    ("y > 0 and Not(x > 0, y > 0)", 10, "Not takes one formula", ""),
    ("Implies(x > 0)", 0, "Implies takes two formulas", ""),
    ("Implies(x > 0, x > 1, x > 2)", 0, "Implies takes two formulas", ""),
    ("Less(x)", 0, "Less compares two terms", ""),
    ("ForAll[x, x > 0, x > 1, x > 2]", 0, "a quantifier takes variables, perhaps a condition", ""),
)
def test_what_is_said_about_a_text(text: str, at: int, said: str, expected: str) -> None:
    with pytest.raises(ParseError) as caught:
        read(text, source="input")
    found, (line, column) = caught.value, position(text, at)
    assert said in str(found) and "\n" not in str(found)
    assert not expected or found.expected == expected
    if said:
        assert (found.line, found.column) == (line, column) and str(found).startswith(f"input:{line}:{column}: ")


@each(
    ("`", "unknown character '`'; a name between backquotes"),
    ("$", "unknown character '$'; formulas are plain text"),
    ("\\", "'and' is written and"),
    ("@", "unknown character '@'"),
    ("\x07", "unknown character U+0007"),
)
def test_unknown_characters(character: str, said: str) -> None:
    found = unknown_character(f"x {character} y", 2)
    assert found.at == 2 and said in found.message
    assert (";" in found.message.replace("';'", "")) == (character in "`;$\\")


@each(
    ("sin", "put c and s with c^2 + s^2 = 1"),
    ("COS", "put c and s"),
    ("sinh", "put a new variable"),
    ("arcsin", "put a new variable"),
    ("asin", "put a new variable"),
    ("log10", "put a new variable"),
    ("Gamma", "put a new variable"),
    ("floor", "needs integers"),
    ("MOD", "needs integers"),
    ("since", "unknown function since; known: abs"),
    ("f", "a product is written f*(…)"),
)
def test_ways_out_of_functions(name: str, said: str) -> None:
    assert said in way_out(name)


@each(
    ("1 + sin(x*(y + 1)) > 0", 4, "sin(x*(y + 1)): "),
    ("f(x, g(y)) > 0", 0, "f(x, g(y)): "),
    ("f(x", 0, ""),
    ("f(" + "x" * 70 + ")", 0, ""),
)
def test_the_application_is_shown_whole_or_not_at_all(text: str, at: int, shown: str) -> None:
    name = text[at : text.find("(", at)]
    error = unknown_function(text, name, at)
    assert (error.message, error.at) == (shown + way_out(name), at)


@each(
    ("(x # (\n + 1", 0),  # a comment hides its bracket
    ("(x + `(` + 1", 0),  # so do quotes
    ("(x) + (y", 6),
    ("(x # no end of line (", 0),
)
def test_brackets_in_comments_and_names_do_not_count(text: str, at: int) -> None:
    found = unexpected_token(text, "$END", "", len(text), {"CLOSE", "PLUS"})
    assert (found.at, found.message) == (at, "unbalanced brackets: this '(' is never closed")


@each(
    ({"QUANTIFIER", "NUMBER"}, "a formula"),
    ({"QUANTIFIER", "DOT"}, "'.' or ','"),
    ({"NUMBER", "NAME"}, "a number, a variable or '('"),
    ({"NAME"}, "the name of a variable"),
    ({"PLUS", "RELATION", "CLOSE"}, "an operator or a relation (= /= < <= > >=) or ')'"),
    ({"AND", "$END"}, "'and', 'or', '->', '<->' or the end of the text"),
    ({"COMMA", "DOT"}, "'.' or ','"),
)
def test_what_could_have_followed(kinds: set[str], shown: str) -> None:
    assert unexpected_token("x ? y", "?", "?", 2, kinds).expected == shown


@each((0, 1, 1), (2, 1, 3), (3, 1, 4), (4, 2, 1), (5, 3, 1), (8, 3, 4))
def test_lines_and_columns(at: int, line: int, column: int) -> None:
    assert position("abc\n\nxyz", at) == (line, column)


def test_an_unknown_place_is_the_beginning() -> None:
    error = Failing("x\ny", "it")("wrong", -1, "right")
    assert (error.line, error.column, error.expected) == (1, 1, "right")
