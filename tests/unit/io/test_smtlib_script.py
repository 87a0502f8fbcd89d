"""The state of a script: declarations, levels, and what is asserted on them."""

from __future__ import annotations

import pytest

from qe.errors import InputError
from qe.io.smtlib_parser import Listing, parse, show
from qe.io.smtlib_script import Script
from tests.tables import each


def fail(message: str, at: int) -> InputError:
    return InputError(f"{at}: {message}")


def script(text: str) -> Script:
    made = Script(fail)
    run(made, text)
    return made


def run(made: Script, text: str) -> None:
    for command in parse(text, fail):
        head = made.head(command)
        assert isinstance(command, Listing)
        if head.text in ("push", "pop"):
            count = int(command.items[1].text)  # type: ignore[union-attr]
            made.push(count) if head.text == "push" else made.pop(count, command.at)
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
    assert str(made.whole()) == "x - 2 < 0 and p > 0 and (p > 0 and x - 1 = 0 or p <= 0 and x + 1 = 0)"


def test_levels_take_declarations_and_assertions_back() -> None:
    made = script("(declare-const x Real)(assert (> x 0))(push 2)(declare-const y Real)(assert (> y x))(push 1)")
    run(made, "(declare-const z Real)(assert (> z y))")
    assert str(made.whole()) == "x > 0 and x - y < 0 and y - z < 0"
    run(made, "(pop 1)")
    assert list(made.constants) == ["x", "y"] and str(made.whole()) == "x > 0 and x - y < 0"
    run(made, "(pop 2)(declare-const y Bool)")
    assert made.constants == {"x": ("Real", "x"), "y": ("Bool", "y")} and str(made.whole()) == "x > 0"
    with pytest.raises(InputError, match="7: pop 1, but there are only 0 levels"):
        made.pop(1, 7)


def test_a_name_kept_for_a_later_declaration_is_not_taken_by_a_bound_variable() -> None:
    made = Script(fail)
    made.reserve(parse("(declare-const x Real)", fail)[0])
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
    assert isinstance(command, Listing) and not Script(fail).change(command)


def test_division_by_zero_is_some_function() -> None:
    """What is free can be written down, with a name for the value; what is bound cannot."""
    made = script("(declare-const x Real)(assert (= (/ 1 x) 2))")
    assert "x /= 0" in str(made.whole()) and str(made.whole()).startswith("ex ")
    bound = script("(assert (forall ((x Real)) (= (/ x 0) 2)))")
    with pytest.raises(InputError, match="any function of x"):
        bound.whole()
