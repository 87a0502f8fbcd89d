"""Polynomial witnesses: what they prove is so, and what is not so is never proved."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.elimination.witness import find, instantiate, substituted
from qe.formula.build import forall, implies
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.run_log import RunLog
from tests.tables import each

TRUE = [
    "all a, b. ex x. 4*(x - a)^2 <= (a - b)^2 and 4*(x - b)^2 <= (a - b)^2",
    "all a, b, r. a^2 + b^2 <= r^2 -> (ex x, y. x^2 + y^2 <= r^2 and (2*a - x)^2 + (2*b - y)^2 <= r^2)",
    "all a, r. a^2 <= r^2 and r >= 0 -> (ex x. r >= 0 and x^2 <= r^2 and (2*a - x)^2 <= r^2)",
    "all a, b, c, d. c = 0 and d = 0 and a > 10 and a^2 + b^2 + c^2 <= 900 ->"
    " (ex x, y. x^2 + y^2 + d <= 900 and (2*a - x)^2 + (2*b - y)^2 <= 900)",
    "all a, b. (ex x. (x - a)^2 + (x - b)^2 <= (a - b)^2) and (ex y. (y - a)^2 < 1)",
]
ELLIPSES = "all a, b, r. a^2 + 2*b^2 <= r^2 -> (ex x, y. x^2 + 2*y^2 <= r^2 and (2*a - x)^2 + 2*(2*b - y)^2 <= r^2)"
TRUE.append(ELLIPSES)
FALSE = [
    "all a, r. ex x. x^2 <= r^2 and (3*a - x)^2 <= r^2",
    "all a, b. ex x. (x - a)^2 <= 1 and (x - b)^2 <= 1",
    "all a. ex x. x^2 + a <= 0",
]


def read(text: str) -> Formula:
    return read_formula(text)


@pytest.mark.parametrize("text", TRUE)
def test_witnesses_are_found_and_the_sentence_is_true(text: str) -> None:
    found = find(read(text), budget=Budget(20))
    assert found is not None, text
    for witness in found:
        assert qe.decide(forall(free(witness), witness_claim(witness))) is True


def witness_claim(witness: object) -> Formula:

    return implies(witness.assumptions, substituted(witness.claim, witness.terms))  # type: ignore[attr-defined]


def free(witness: object) -> tuple[str, ...]:
    return witness_claim(witness).free


@pytest.mark.parametrize("text", FALSE)
def test_nothing_false_is_proved(text: str) -> None:
    assert find(read(text), budget=Budget(20)) is None
    assert qe.decide(text) is False


def test_the_engine_uses_and_tells_them() -> None:
    answer = qe.eliminate(ELLIPSES)
    assert answer.truth is True
    assert "witness in the parameters: x = a, y = b" in answer.stats["plan"]
    assert "cad" not in answer.stats and "vs" not in answer.stats


def test_free_variables_are_parameters_too() -> None:
    assert str(qe.eliminate("all a. a^2 <= r^2 -> (ex x. x^2 <= r^2 and (2*a - x)^2 <= r^2)").formula) == "true"


def test_a_method_asked_for_is_used() -> None:
    answer = qe.eliminate("all a. ex x. (x - a)^2 <= 0", method="cad")
    assert answer.truth is True and "witness" not in str(answer.stats)


numbers = st.fractions(min_value=-3, max_value=3, max_denominator=4)


@settings(max_examples=25)
@given(numbers, numbers, numbers, numbers)
def test_substitution_multiplies_by_a_positive_number(a: Fraction, b: Fraction, u: Fraction, v: Fraction) -> None:
    """f[x := u a + v b] holds at (a, b) iff f holds at (a, b, u a + v b)."""
    from qe.elimination.witness import Term
    from qe.exact.ring import Ring
    from qe.formula.build import convert

    ring = Ring.of(("a", "b", "x"))
    common = u.denominator * v.denominator
    term = Term(ring.var("a") * int(u * common) + ring.var("b") * int(v * common), common)
    for text in ("x^3 - a*x + b < 0", "a*x >= b^2", "x^2 - 2*a*x + a^2 = 0"):
        formula = convert(read(text), ring)
        replaced = substituted(formula, {"x": term})
        assert holds_at(replaced, {"a": a, "b": b}) == holds_at(formula, {"a": a, "b": b, "x": u * a + v * b})


@each(({"x": "a"}, True), ({"x": "(a + b)/2"}, True), ({"x": "2*b"}, False))
def test_an_offered_witness_is_checked(witness: dict[str, str], expected: bool) -> None:
    assert qe.check_witness("all a, b. ex x. (x - a)^2 <= (a - b)^2", witness) is expected


def test_part_of_a_witness_may_be_offered() -> None:
    sentence = "all a. ex x, y. x + y = a and x*y <= 0"
    assert qe.check_witness(sentence, {"x": "a"}) is True
    assert qe.check_witness(sentence, {"x": "a - y"}) is True
    assert qe.check_witness("all a. ex x. x^3 = a^3 + 1", {"x": "a"}) is False
    assert qe.check_witness("not (ex a. all x. not x = a^2)", {"x": "a^2"}) is True


@each(
    ("all a. ex x. x = a", {"z": "a"}, "z not found"),
    ("all a. ex x. x = a", {"a": "1"}, "a not found"),
    ("all a. ex x. all b. x + b^2 > a", {"x": "a + b"}, "depends on b"),
    ("all a. ex x, y. x = y", {"x": "y", "y": "a"}, "depends on y"),
    ("all a. ex x. x = a", {"x": "a +"}, "expected"),
    ("all a. ex x. x = a", {"x": "1/a"}, "division"),
)
def test_a_witness_that_makes_no_sense_is_refused(sentence: str, witness: dict[str, str], message: str) -> None:
    with pytest.raises(qe.InputError, match=message):
        qe.check_witness(sentence, witness)


def test_the_instance_is_stronger() -> None:
    from qe.elimination.witness import Term
    from qe.exact.ring import Ring
    from qe.formula.build import convert

    ring = Ring.of(("a", "x"))
    sentence = convert(read("all a. ex x. x^2 >= a"), ring)
    assert str(instantiate(sentence, {"x": Term(ring.var("a"))})) == "all a. a^2 - a >= 0"


def test_blocks_that_no_centre_can_satisfy_are_not_prepared_again_and_again() -> None:
    """A long sentence repeats its blocks; those with blocks of the other kind inside are left alone."""
    block = "(ex x, y. x^2 + y^2 = a^2 and x*y = b and x + y >= a)"
    inner = "(ex x. all y. x*y >= a or y^2 > b)"
    log = RunLog()
    assert find(read_formula(f"all a, b. {inner} or {block} or a > b and {block}"), budget=Budget(), log=log) is None
    assert {step.rule for step in log.steps()} <= {"renaming", "negation normal form"}
