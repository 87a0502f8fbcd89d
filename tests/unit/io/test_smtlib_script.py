"""S-expressions and scripts of them: offsets, where a text that may go on has ended, declarations, levels."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import InputError
from qe.io.smtlib_parser import Ends, Expression, parse, place, show
from qe.io.smtlib_script import Script
from tests.tables import each
from tests.unit.io.failing import fail

WORDS = st.one_of(
    st.from_regex(r"[a-z+<=][a-z0-9!@.-]{0,4}", fullmatch=True),
    st.sampled_from(("|two words|", "||", "|a(b|", "|1x|", "|;|", "|1|")),
    st.sampled_from(("0", "12", "1.50", ":named", ":a-b", '"a ""quoted"" (word"', '""', "#x1F", "#b01")),
)

EXPRESSIONS: st.SearchStrategy[Expression] = st.recursive(
    WORDS, lambda inner: st.lists(inner, max_size=3), max_leaves=6
)


def both(text: str) -> list[Expression]:
    """What the text says, which is the same with places and without."""
    expressions = parse(text, fail)
    assert parse(text, fail, placed=False) == expressions
    return expressions


@given(st.lists(EXPRESSIONS, max_size=3), st.sampled_from((" ", "\n", " ; a comment (\n")))
def test_what_is_shown_is_read_back(expressions: list[Expression], between: str) -> None:
    text = between.join(map(show, expressions))
    assert both(text) == expressions
    assert max(Ends().found(text + " "), default=0) == len(text.rstrip("\n ")) or ";" in text or not expressions


@given(st.lists(EXPRESSIONS, max_size=4), st.sampled_from((" ", "\n", " ; a comment (\n", "|)")), st.integers(1, 9))
def test_a_text_in_pieces_ends_where_the_whole_does(expressions: list[Expression], between: str, size: int) -> None:
    text = between.join(show([e]) for e in expressions) + "\n"
    ends, found, held, gone = Ends(), [], "", 0
    for k in range(0, len(text), size):
        held, start = held + text[k : k + size], 0
        for start in ends.found(held):
            found.append(gone + start)
        held, gone = held[start:], gone + start
        ends.cut(start)
    assert found == list(Ends().found(text))


def test_offsets() -> None:
    (first, second) = parse("(f |a b| ; (\n 1.5 |c|) x", fail)
    assert first == ["f", "|a b|", "1.5", "c"] and second == "x"
    assert [place(part) for part in (first, second, *first)] == [0, 23, 1, 3, 14, 18]


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
    with pytest.raises(InputError):
        parse(text, fail, placed=False)


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
        with pytest.raises(InputError):
            parse(text, fail, placed=False)
        return
    assert [e for start, stop in pairwise(stops) for e in both(text[start:stop])] == whole == both(text)


def script(text: str) -> Script:
    made = Script(fail)
    run(made, text)
    return made


def run(made: Script, text: str) -> None:
    for command in parse(text, fail):
        head = made.head(command)
        assert isinstance(command, list)
        if head in ("push", "pop"):
            count = int(str(command[1]))
            made.push(count) if head == "push" else made.pop(count, command)
        else:
            assert made.change(command)


def test_declarations_and_definitions() -> None:
    made = script(
        "(declare-const x Real)(declare-fun p () Bool)(define-const two Real 2)"
        "(define-fun f ((u Real) (b Bool)) Real (ite b u (- u)))(define-fun q () Bool (< x two))"
        "(assert (! (and q p) :named first))(assert (= (f x p) 1))(assert first)"
    )
    assert made.constants == {"x": ("Real", "x"), "p": ("Bool", "p")}
    assert [a.name for a in made.assertions] == ["first", None, None]
    assert show(made.assertions[1].written) == "(= (f x p) 1)"
    assert str(made.whole()) == "x < 2 and p > 0 and (p > 0 and x = 1 or p <= 0 and x = -1)"


def test_levels_take_declarations_and_assertions_back() -> None:
    made = script("(declare-const x Real)(assert (> x 0))(push 2)(declare-const y Real)(assert (> y x))(push 1)")
    run(made, "(declare-const z Real)(assert (> z y))")
    assert str(made.whole()) == "0 < x < y and y < z"
    run(made, "(pop 1)")
    assert list(made.constants) == ["x", "y"] and str(made.whole()) == "0 < x < y"
    run(made, "(pop 2)(declare-const y Bool)")
    assert made.constants == {"x": ("Real", "x"), "y": ("Bool", "y")} and str(made.whole()) == "x > 0"
    with pytest.raises(InputError, match="7: pop 1, but there are only 0 levels"):
        run(made, "       (pop 1)")


def test_a_name_kept_for_a_later_declaration_is_not_taken_by_a_bound_variable() -> None:
    made = Script(fail)
    made.reserve(["declare-const", "x", "Real"])
    run(made, "(assert (exists ((x Real)) (> x 0)))(declare-const x Real)")
    assert made.constants["x"] == ("Real", "x") and made.bound == {"x_1"}


@each(
    ("x", "0: a command in brackets expected"),
    ("()", "0: a command in brackets expected"),
    ("((a))", "0: a command in brackets expected"),
    ("(assert)", "0: 1 arguments expected, 0 found"),
    ("(declare-const x)", "0: 2 arguments expected, 1 found"),
    ("(declare-fun f (Real) Real)", "15: only functions without arguments"),
    ("(declare-fun f x Real)", "15: only functions without arguments"),
    ("(declare-const x Real)(declare-const x Bool)", "37: x is declared twice"),
    ("(define-const x Real true)", "21: a term of sort Real"),
    ("(define-const x Real)", "0: 3 arguments expected"),
    ("(define-fun x () Real)", "0: 4 arguments expected"),
    ("(define-fun-rec f () Real 1)", "1: recursive functions"),
    ("(declare-sort A 0)", "1: only the sorts Real and Bool"),
    ("(assert 1)", "8: a term of sort Bool"),
)
def test_what_is_refused(text: str, said: str) -> None:
    with pytest.raises(InputError) as error:
        script(text)
    assert str(error.value).startswith(said)


def test_other_commands_are_left_to_the_caller() -> None:
    (command,) = parse("(check-sat)", fail)
    assert isinstance(command, list) and not Script(fail).change(command)


def test_division_by_zero_is_some_function() -> None:
    """What is free can be written down, with a name for the value; what is bound cannot."""
    made = script("(declare-const x Real)(assert (= (/ 1 x) 2))")
    assert "x /= 0" in str(made.whole()) and str(made.whole()).startswith("ex ")
    bound = script("(assert (forall ((x Real)) (= (/ x 0) 2)))")
    with pytest.raises(InputError, match="any function of x"):
        bound.whole()
