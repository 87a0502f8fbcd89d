"""S-expressions: a round trip, offsets, and where a text that may go on has ended."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import InputError
from qe.io.smtlib_parser import Ends, Expression, Listing, Word, parse, show
from tests.tables import each


def fail(message: str, at: int) -> InputError:
    return InputError(f"{at}: {message}")


WORDS = st.one_of(
    st.from_regex(r"[a-z+<=][a-z0-9!@.-]{0,4}", fullmatch=True).map(lambda text: Word("SYMBOL", text, 0)),
    st.sampled_from(("two words", "", "a(b", "1x", ";")).map(lambda text: Word("SYMBOL", text, 0)),
    st.sampled_from(("0", "12", "1.50")).map(lambda text: Word("NUMBER", text, 0)),
    st.sampled_from((":named", ":a-b")).map(lambda text: Word("KEYWORD", text, 0)),
    st.sampled_from(('"a ""quoted"" (word"', '""')).map(lambda text: Word("STRING", text, 0)),
    st.sampled_from(("#x1F", "#b01")).map(lambda text: Word("BITS", text, 0)),
)
EXPRESSIONS: st.SearchStrategy[Expression] = st.recursive(
    WORDS, lambda inner: st.lists(inner, max_size=3).map(lambda items: Listing(items, 0)), max_leaves=6
)


def same(left: Expression, right: Expression) -> bool:
    if isinstance(left, Listing) and isinstance(right, Listing):
        return len(left.items) == len(right.items) and all(map(same, left.items, right.items))
    return left[:2] == right[:2] and type(left) is type(right)


@given(st.lists(EXPRESSIONS, max_size=3), st.sampled_from((" ", "\n", " ; a comment (\n")))
def test_what_is_shown_is_read_back(expressions: list[Expression], between: str) -> None:
    text = between.join(map(show, expressions))
    found = parse(text, fail)
    assert len(found) == len(expressions) and all(map(same, found, expressions))
    assert max(Ends().found(text + " "), default=0) == len(text.rstrip("\n ")) or ";" in text or not expressions


@given(st.lists(EXPRESSIONS, max_size=4), st.sampled_from((" ", "\n", " ; a comment (\n", "|)")), st.integers(1, 9))
def test_a_text_in_pieces_ends_where_the_whole_does(expressions: list[Expression], between: str, size: int) -> None:
    text = between.join(show(Listing([e], 0)) for e in expressions) + "\n"
    ends, found, held, gone = Ends(), [], "", 0
    for k in range(0, len(text), size):
        held, start = held + text[k : k + size], 0
        for start in ends.found(held):
            found.append(gone + start)
        held, gone = held[start:], gone + start
        ends.cut(start)
    assert found == list(Ends().found(text))


def test_offsets() -> None:
    (first, second) = parse("(f |a b| ; (\n 1.5) x", fail)
    assert isinstance(first, Listing) and first.at == 0 and second == Word("SYMBOL", "x", 19)
    assert first.items == [Word("SYMBOL", "f", 1), Word("SYMBOL", "a b", 3), Word("NUMBER", "1.5", 14)]


@each(
    ("(a (b) c", "0: unbalanced brackets: this '(' is never closed"),
    ("(a) (b (c", "7: unbalanced brackets: this '(' is never closed"),
    ("(a)) b", "3: unbalanced brackets: this ')' has no partner"),
    ("(a |b)", "3: this | is never closed"),
    ('(a "b)', '3: this " is never closed'),
    ("(a 1x)", "3: malformed number; write (/ 1 2) for 1/2"),
    ("(a 1.x)", "3: malformed number; write (/ 1 2) for 1/2"),
    ("(a ä)", "3: unknown character 'ä'"),
)
def test_what_cannot_be_read(text: str, said: str) -> None:
    with pytest.raises(InputError) as error:
        parse(text, fail)
    assert str(error.value) == said


@each(
    ("", 0),
    ("(a) (b", 3),
    ("(a) (b)", 7),
    ("(a) b", 3),  # the symbol may go on
    ("(a) b ", 5),
    ("(a)\n; rest", 3),
    ("(a) (b))", 8),  # an error, which is reported at once
    (") (a", 1),  # the error is told at once
    ("(a |b", 0),
    ("(a) |b", 3),
)
def test_the_end_of_the_last_whole_expression(text: str, end: int) -> None:
    assert max(Ends().found(text), default=0) == end


@given(st.text(alphabet='(a|") ;\n:1\u00e4#', max_size=12))
def test_a_text_with_an_end_is_read_the_same_piece_by_piece(text: str) -> None:
    """What is between the ends is read on its own, or the whole cannot be read either."""
    stops = [0, *Ends().found(text), len(text)]
    try:
        whole = parse(text, fail)
    except InputError:
        return
    parts = [e for start, stop in pairwise(stops) for e in parse(text[start:stop], fail)]
    assert len(parts) == len(whole) and all(map(same, parts, whole))
