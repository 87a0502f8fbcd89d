"""Answers and their measures, witnesses in parameters."""

import time
from fractions import Fraction
from itertools import product

import pytest

import qe
from qe.api.input import read_formula
from qe.io import formats
from tests.tables import each

HARD = "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5"


def test_a_time_limit_holds_inside_one_long_operation() -> None:
    start = time.monotonic()
    answer = qe.eliminate(HARD, timeout=0.3)
    assert answer.status is qe.Status.UNABLE
    assert answer.formula is None and "time" in answer.reason
    assert time.monotonic() - start < 30  # a bound on blunders: without the hard limit it takes minutes


def test_answers_survive_the_worker() -> None:
    answer = qe.eliminate("ex x. x^2 = 2 and x > 0", timeout=30)
    assert answer.truth is True and answer.witness is not None
    assert answer.witness["x"] == qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)
    assert answer.guarantee is qe.Guarantee.CHECKED


def test_a_checked_answer_with_free_variables() -> None:
    answer = qe.eliminate("all x. x^3*a + x^2 + b > 0", check=True, method="cad")
    assert answer.guarantee is qe.Guarantee.CHECKED
    assert qe.equivalent(answer.formula, "a = 0 and b > 0")


@each(
    (lambda: qe.eliminate("x > 0", method="magic"), "method"),
    (lambda: qe.decide("x > 0"), "free: x"),
    (lambda: qe.region("x^2 + y^2 < 1", order=("x",)), "order"),
    (lambda: qe.minimize("1/0", "x > 0"), "divi"),
)
def test_bad_calls_get_one_line(call, message: str) -> None:
    with pytest.raises(qe.InputError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_equivalence_and_instances() -> None:
    assert qe.equivalent("x^2 < 1", "-1 < x and x < 1")
    assert not qe.equivalent("x^2 <= 1", "-1 < x and x < 1")
    found = qe.find_instance("x^2 + y^2 = 1 and y = 2*x and x > 0")
    assert found is not None and found["y"] == found["x"] * 2
    assert qe.find_instance("x^2 + y^2 < 0") is None


@pytest.mark.parametrize("stage", [stage.value for stage in qe.Stage])
@each("ex x. x^2 + b*x + c < 0 and x > 0", "ex x, y. x^2 + y^2 = 1 and y = a*x + b", "all x. x^4 + p*x + q > 0")
def test_leaving_a_stage_out_changes_no_answer(text: str, stage: str) -> None:
    assert qe.equivalent(qe.eliminate(text, without=(stage,)).formula, qe.eliminate(text).formula)


def test_the_explanation_names_what_was_done(capsys: pytest.CaptureFixture[str]) -> None:
    answer = qe.eliminate("ex x, y. x + y = a and x^3 + y^3 < b", explain=True)
    told = capsys.readouterr().err
    assert told.strip() == answer.explanation
    assert told.startswith("1. linear equation solved (") and "planned" in told and "<==>" in told
    slow = qe.eliminate("ex x, y. x + y = a and x^3 + y^3 < b", without=("substitution",))
    assert "substitution" not in slow.explanation.split("planned")[1] and "decomposition order" in slow.explanation


@each(
    "ex x. a*x + b > 0 and x < c",
    "ex x, y. x*y = a and x + y = b",
    "ex x. all y. y^2 + x > b and x < 3",
    "all x. x > 0 -> x^2 + a*x + 1 > 0",
    "all x. ex y. y^3 + x*y = 1",
    "a > 0 and (ex x. x^2 = a) or b = 3",
)
def test_check_gets_a_certificate_whatever_the_method(text: str) -> None:
    answer = qe.eliminate(text, check=True)
    assert answer.certificate is not None
    assert answer.guarantee is qe.Guarantee.CHECKED
    plain = qe.eliminate(text)
    assert answer.truth is plain.truth and (answer.truth is not None or qe.equivalent(answer.formula, plain.formula))


@each(
    ("ex x, y, z. x^2 + y^2 + z^2 < 1 and a*x + b*y + c*z > 1", "a^2 + b^2 + c^2 - 1 > 0"),
    ("ex u, v. x = u*v and y = v and z = u^2", "y^2*z - x^2 = 0 and z >= 0"),
    ("all x, y. a*x^2 + 2*b*x*y + c*y^2 + d > 0", "a*c - b^2 >= 0 and d > 0 and c >= 0 and a >= 0"),
)
def test_answers_are_as_short_as_a_textbook_has_them(text: str, answer: str) -> None:
    found = qe.eliminate(text)
    assert len(str(found.formula)) <= len(answer)
    assert qe.equivalent(found.formula, answer)


def test_an_answer_in_every_language() -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0")
    for written, format in (
        (answer.to_smtlib(), "smtlib"),
        (answer.to_qepcad(), "qepcad"),
        (answer.to_redlog(), "redlog"),
        (str(answer), "text"),
    ):
        assert qe.equivalent(formats.read(written, format), "b^2 - 4*c >= 0")
    assert qe.equivalent(answer.to_sympy(), "b^2 - 4*c >= 0")
    assert "b^{2}" in answer.to_latex()


def test_what_was_not_answered_is_not_written() -> None:
    answer = qe.eliminate(HARD, timeout=0.3)
    assert answer.status is qe.Status.UNABLE
    for write in (answer.to_smtlib, answer.to_sympy):
        with pytest.raises(qe.Unable):
            write()


def test_an_order_is_followed_or_refused() -> None:
    text = "ex x, y, z. x^2 + y^2 + z^2 < a and x*y*z > b"
    answer = qe.eliminate(text, order=("z", "b"), method="cad")
    order = answer.stats["cad"][0]["order"]
    assert order.index("b") < order.index("a") and order[2] == "z"
    for strange in (("z", "w"), ("z", "z")):
        with pytest.raises(qe.InputError, match="order"):
            qe.eliminate(text, order=strange)


BLOCKS = [
    "ex x. a*x^2 + b*x + c = 0",
    "ex x. a*x + b > 0 and x < c",
    "ex x, y. x + y = a and x*y > b",
    "ex x. (x^2 = a or x^2 = b) and x > c",
    "ex x. a*x^2 + b*x + c < 0 and x > 1",
]


@pytest.mark.parametrize("text", BLOCKS)
def test_the_guards_together_are_the_block(text: str) -> None:
    found = qe.parametric_witnesses(text)
    assert found
    guards = " or ".join(f"({w.guard})" for w in found)
    assert qe.equivalent(qe.eliminate(text).formula, guards)


@pytest.mark.parametrize("text", BLOCKS)
def test_values_solve_the_body_where_the_guard_holds(text: str) -> None:
    from qe.exact.ring import Ring
    from qe.exact.sample import Point
    from qe.formula.build import convert
    from qe.formula.evaluate import truth_under

    block = read_formula(text)
    found = qe.parametric_witnesses(block)
    tried = 0
    for numbers in product((-2, 0, 1, Fraction(3, 2)), repeat=3):
        parameters = dict(zip("abc", numbers))
        for witness in found:
            try:
                values = witness.at(parameters)
            except qe.InputError:
                continue
            tried += 1
            everything = parameters | values
            ring = Ring.of(tuple(everything))
            place = Point.of(ring, [v if isinstance(v, qe.RealAlgebraic) else Fraction(v) for v in everything.values()])
            assert truth_under(convert(block.body, ring), place.sign) is True, (parameters, str(witness))
    assert tried > 10


@each(
    ("all x. x^2 + b*x + c > 0", "b^2 - 4*c >= 0", {"b": 0, "c": -1}),  # counterexamples
    ("ex x. all y. y^2 + a > x and x > b", "a > b", {"a": 1, "b": 0}),  # inner quantifiers are eliminated first
)
def test_guards_and_values(text: str, guard: str, at: dict[str, int]) -> None:
    (found,) = qe.parametric_witnesses(text)
    assert qe.equivalent(found.guard, guard) and found.at(at).keys() == {"x"}


@each(("x > 0", qe.InputError), ("ex x. x^5 + a*x + b = 0 and x > a", qe.DegreeTooHigh))
def test_what_has_none_says_so(text: str, error: type[qe.QEError]) -> None:
    with pytest.raises(error):
        qe.parametric_witnesses(text)


def test_a_missing_parameter_is_named() -> None:
    witness = qe.parametric_witnesses("ex x. x^2 = a")[0]
    with pytest.raises(qe.InputError, match="a value for a expected"):
        witness.at({})
