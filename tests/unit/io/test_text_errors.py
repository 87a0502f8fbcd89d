"""Messages about texts: the right offset, and the known misunderstandings."""

from qe.io.text_errors import (
    Failing,
    SyntaxFailure,
    position,
    unexpected_token,
    unknown_character,
    unknown_function,
    way_out,
)
from qe.io.text_parser import TextParser
from tests.tables import each


def failure(text: str) -> SyntaxFailure:
    """What is said about a text that cannot be read."""
    try:
        TextParser(text).whole()
    except SyntaxFailure as error:
        return error
    raise AssertionError(f"{text} can be read")


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
    ("x === y", 4, "'===' is not used", ""),
    ("x ||| y", 2, "", ""),
    ("x! > 0", 1, "it is no factorial", ""),
    ("x => y", 3, "'=>' is not used", ""),
    ("x < = y", 4, "write <= without a space", ""),
    ("x > = y", 4, "write >= without a space", ""),
    ("a^b^c = 0", 3, "a^b^c is ambiguous", ""),
    ("2 x > 0", 2, "a product is written 2*x", ""),
    ("x y > 0", 2, "a product is written x*y", ""),
    ("x (y + 1) > 0", 2, "", ""),
    ("(x + 1) y > 0", 8, "a product is written (…)*y", ""),
    ("0,5*x = a", 1, "a decimal number is written with a point", ""),
    ("x = 1,000", 5, "a decimal number is written with a point", ""),
    ("x = 1_000", 4, "without _ between its digits", ""),
    ("exists unique x. x^2 = a", 7, "there is no ∃!", ""),
    ("exists positive x. x^2 = a", 7, "exists x > 0", ""),
    ("∃ integer n. n = x", 2, "all variables are real", ""),
    ("x >= 1\ny >= 2", 7, "of several lines", ""),
    ("(and (> x 0) (< y 1))", 1, "format smtlib", ""),
    ("x := 0", 2, "':=' is not used", ""),
    ("minimize x^2 subject to x > 1", 9, "qe.minimize", ""),
    ("find x such that x > 1", 5, "find is a command", ""),
    ("x between 0 and 1", 2, "x in [0, 1]", ""),
    ("x is positive", 2, "conditions are written with", ""),
    ("(x > 0) > y", 8, "two formulas are compared with <->", ""),
)
def test_what_is_said_about_a_text(text: str, at: int, said: str, expected: str) -> None:
    found = failure(text)
    assert said in found.message
    if said:
        assert found.at == at
    if expected:
        assert found.expected == expected


@each(
    ("`", "unknown character '`'; a name between backquotes"),
    (";", "unknown character ';'; several conditions are joined by and"),
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
