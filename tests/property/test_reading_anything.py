"""Readers answer any text with a formula or with one line that says what is wrong, never with another error."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from qe.errors import InputError
from qe.formula.syntax import Formula
from qe.io import formats
from tests.strategies import formulas

WORDS = (
    *("x", "y", "E", "A", "ex", "all", "not", "and", "or", "->", "<->", "true", "(", ")", "+", "-", "*", "/", "^", "<"),
    *("=", "/=", ">=", ".", ",", "0", "2", "1/2", "0.5", "1e3", "root", "|a b|", "#", "\n", "~", "/\\", "\\/", "==>"),
    *("[", "]", "(E x)", "_root_1", "{", "}", "impl", "<>", "**", ":=", ";", "%", "|", '"', "!", ":named", "let"),
    *("assert", "(assert", "declare-const", "Real", "exists", "(check-sat)", "(declare-const x Real)", "((", "))"),
    *("²", "ite", "`a b`", "`", "`e`", "`a\\`", "\\u{a}", "pi", "e"),
)
token_texts = st.lists(st.sampled_from(WORDS), max_size=14).map(" ".join)


def check(text: str, name: str) -> None:
    try:
        formula = formats.read(text, name)
    except InputError as error:
        assert "\n" not in str(error)
    else:
        assert isinstance(formula, Formula)


@pytest.mark.parametrize("name", formats.READABLE)
@given(token_texts | st.text(max_size=12))
@example("")
@example("\x00")
@example("٣ > x")
@example("x > |" + "a" * 100)
@example("x > `" + "a" * 100)
@example("`\\u{110000}` > 0")
@example("`\\u{d800}` > 0")
@example("[" * 5000)
@example("(" * 5000)
@example("not " * 5000 + "x > 0")
@example("- " * 5000 + "x > 0")
def test_any_text(name: str, text: str) -> None:
    check(text, name)


@pytest.mark.parametrize("name", formats.READABLE)
@given(formulas(max_quantifiers=2), st.data())
def test_damaged_text(name: str, formula: Formula, data: st.DataObject) -> None:
    text = formats.write(formula, name)
    start = data.draw(st.integers(0, len(text)))
    stop = data.draw(st.integers(start, min(len(text), start + 6)))
    check(text[:start] + data.draw(st.sampled_from(("", " ", "(", ")", "x", "0", "=", "-"))) + text[stop:], name)
