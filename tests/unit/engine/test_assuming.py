"""Answers under assumptions: forms, generic answers, contradictions, and what breaks them."""

from __future__ import annotations

import pathlib
import warnings

import pytest
import sympy

import qe
from qe.engine import assuming
from qe.engine.assuming import can_hold
from qe.formula.assumed import Aim, Posed, claimed, restricted
from qe.formula.syntax import TRUE
from qe.io.substitution import over_one_ring
from qe.io.text import read
from qe.options import Budget, Options
from tests.tables import each

QUADRATIC = "ex x. a*x^2 + b*x + c = 0"


@each(
    ("ex x. a*x^2 + b*x + c < 0", "a > 0", "b^2 - 4*a*c > 0"),
    ("all x. a*x^2 + b*x + c > 0", "a > 0", "b^2 - 4*a*c < 0"),
    (QUADRATIC, "a > 0 and b > 0", "b^2 - 4*a*c >= 0"),
    ("ex x. a*x = b", "a /= 0", "true"),
    ("ex x. x^2 = a", "a = c^2", "true"),
    ("ex x. x^3 + p*x + q = 0 and x > 0", "p > 0", "q < 0"),
    ("ex x. x > 0 and a*x^2 + b*x + c = 0", "a > 0 and c < 0", "true"),
    ("all x. ex y. x^2 + y^2 = a*x*y + b", "a > 0 and b > 0", "a >= 2"),
    ("a^2 >= 4", "a > 0", "a >= 2"),
    ("a*b > 0", ["a > 0"], "b > 0"),
    ("a > 3", "a > 0", "a > 3"),
    ("ex x. x^2 = 2", "a > 0", "true"),
    ("a*c <= b*d", "0 < a and a < b and 0 < c and c < d", "true"),  # only deciding finds that nothing is excepted
)
@pytest.mark.filterwarnings("ignore::qe.DoubtfulInput")
def test_what_the_assumptions_say_is_not_repeated(text: str, assumed: object, said: str) -> None:
    answer = qe.eliminate(text, assuming=assumed, check=True)
    assert str(answer) == said and answer.guarantee is qe.Guarantee.CHECKED
    assert qe.verify(qe.Certificate.from_json(answer.certificate.to_json()), core=True).accepted  # type: ignore
    if answer.derivation.start.free:
        assert qe.verify(answer.certificate, formula=text, assuming=assumed).accepted  # type: ignore


def test_what_is_claimed_says_that_the_assumptions_imply_the_equivalence() -> None:
    known, universal, other, answer = over_one_ring(*map(read, ("a > 0", "all x. x > a", "a > 1", "a > 5")))
    for question in (universal, other):
        sides = qe.equivalent(claimed(known, question, question), claimed(known, question, answer))
        assert sides == qe.equivalent(question, answer, assuming=known)
        assert qe.equivalent(claimed(known, question, question), claimed(known, question, restricted(known, question)))
    assert claimed(TRUE, other, other) == other
    assert Posed(other, known).closed(other).free == () and Posed(other).closed(other) == other
    assert qe.equivalent(Posed(other, known).restricted, "a > 1") and Posed(other).aim is Aim.EQUIVALENT


def test_a_certificate_under_other_assumptions_is_about_something_else() -> None:
    answer = qe.eliminate(QUADRATIC, assuming="a > 0", check=True)
    assert answer.certificate is not None
    for other in (None, "a >= 0", "a < 0", "b > 0"):
        assert qe.verify(answer.certificate, formula=QUADRATIC, assuming=other).step == "claim"


def test_a_wrong_answer_under_assumptions_has_no_certificate(monkeypatch: pytest.MonkeyPatch) -> None:
    """A simplifier that says too much is found out by the checker: there is no answer and no certificate."""
    monkeypatch.setattr(assuming, "shortened_under", lambda formula, known, question, context: read("a > 7"))
    with pytest.raises(qe.InternalError, match="the certificate of an answer was rejected"):
        qe.eliminate("ex x. x^2 = a and x > 2", assuming="a > 1", check=True, process=False)


def test_contradicting_assumptions(monkeypatch: pytest.MonkeyPatch) -> None:
    for text in (QUADRATIC, "all x. x > a", "a > 0"):
        with pytest.warns(qe.DoubtfulInput, match="nothing meets these conditions, so every answer is right"):
            answer = qe.eliminate(text, assuming="a > 0 and a^2 + 1 < 0", check=True)
        assert answer.truth is True and answer.guarantee is qe.Guarantee.CHECKED
    with pytest.warns(qe.DoubtfulInput):
        assert qe.decide("a > 0", assuming="a < 0 and a > 1") and qe.find("a > b", assuming="a < 0 and a > 1") == []
    assert not can_hold(read("a^2 < 0"), Options(), Budget()) and can_hold(read("a > 0"), Options(), Budget())
    hard = read("a^7*b^9*c^8 + a^9*b^2 + c^11*b - a = 1 and a^8 + b^9 + c^11*a = 5 and a*b*c*(a + b^7) > 1")
    monkeypatch.setattr(assuming, "CONSISTENT_WORK", 3)
    assert can_hold(hard, Options(), Budget())  # what is not known costs nothing but the note


@each(
    (QUADRATIC, "b^2 - 4*a*c >= 0", ["a /= 0"]),
    ("ex x. a*x = b", "true", ["a /= 0"]),
    ("ex x. a*x = b and c*x = d", "a*d - b*c = 0", ["c /= 0"]),
    ("ex x. (a*b - 1)*x^2 + x + 1 < 0", "4*a*b < 5", []),
    ("ex x. x = a and x = b", "a = b", []),
    ("a = 0 and b > 0 or a /= 0 and b < 0", "b < 0", ["a /= 0"]),
)
def test_generic_answers_list_what_they_assume(text: str, said: str, listed: list[str]) -> None:
    answer = qe.eliminate(text, generic=True, check=True)
    if text.startswith("ex x. a*x = b and"):  # a /= 0 would do as well
        assert len(answer.generic) == 1
    else:
        assert str(answer) == said and [*map(str, answer.generic)] == listed
    assert answer.guarantee is qe.Guarantee.CHECKED
    assert qe.verify(answer.certificate, formula=text, assuming=list(answer.generic)).accepted  # type: ignore


@each("a = 0", "a*d = 0", "a = 0 or b^2 + d^2 < 0")
def test_nothing_is_assumed_against_what_the_caller_assumes(assumed: str) -> None:
    """a /= 0 (and d /= 0) would contradict it, and everything would be right."""
    text = "ex x, y. a*x = b and d*y = c"
    plain, answer = qe.eliminate(text), qe.eliminate(text, assuming=assumed, generic=True, check=True)
    assert qe.find_instance(answer.assuming) is not None and answer.guarantee is qe.Guarantee.CHECKED
    assert qe.equivalent(plain, answer, assuming=answer.assuming)


def test_symbols_of_sympy_say_what_is_assumed() -> None:
    a, x = sympy.Symbol("a", positive=True), sympy.Symbol("x", real=True)
    c = sympy.Symbol("c")
    assert str(qe.eliminate(qe.Exists(x, sympy.Eq(a * x**2, 1)))) == "true"
    assert str(qe.eliminate(qe.ForAll(x, x**2 + a * x + c > 0))) == "a^2 - 4*c < 0"
    assert qe.decide(a**2 > 0) and str(qe.simplify(sympy.Or(a * c > 0, a < 0))) == "c > 0"
    assert qe.equivalent(a * c > 0, c > 0) and not qe.equivalent("a*c > 0", "c > 0")
    assert str(qe.solve(sympy.Eq(x**2, a), "x")) == "x = -sqrt(a) or\nx = sqrt(a)"
    assert qe.find(sympy.Eq(a**2, 4)) == [{"a": 2}]


def test_every_door_takes_assumptions() -> None:
    assert qe.decide("a + 1/a >= 2", assuming="a > 0") and not qe.decide("a > 1", assuming="a > 0")
    assert qe.find_instance("x*y = 1", assuming="x > 5")["x"] > 5  # type: ignore[index]
    assert [point["x"] for point in qe.find("x^2 = 4", 3, assuming="x > 0")] == [2]
    assert qe.find_instances("x^2 = 4", 3, assuming="x > 0") == [{"x": 2}]
    assert str(qe.solve("x^2 + y^2 = r^2 and x = y", "x,y", assuming="r > 0")).count("or") == 1
    assert qe.region("x^2 < a", assuming="a > 0 and a < 1").bounds("x") == qe.region("x^2 < 1").bounds("x")
    assert [str(one) for one in qe.witnesses("ex x. a*x = b", assuming="a /= 0")] == ["x = b/a if true"]
    assert len(qe.witnesses("all x. a*x /= b", assuming="a /= 0")) == 1
    assert qe.check_witness("ex x. a*x = b and a*x > 0", {"x": "1"}, assuming="a > 0 and b = a")
    assert qe.minimize("x + 1/x", assuming="x > 0").value == 2
    assert str(qe.minimize("x^2 + a*x", "x >= 0", parameters="a", assuming="a < 0")).startswith("-a^2/4 at x = -a/2")
    low, high = qe.optimum("x", "x^2 <= 4", assuming="x > 1")
    assert (low.value, low.attained, high.value) == (1, False, 2)  # type: ignore[union-attr]
    assert qe.simplify("ex x. a*x > 0 and x > 0", assuming="a > 0", check=True).guarantee is qe.Guarantee.CHECKED


@each(
    ("x > 0", "x is bound"),
    ("ex y. a = y^2", "without quantifiers"),
    ("a > ", "assuming: "),
    (5, "assuming: "),
    ([1], "assuming: "),
    (pathlib.Path("no-such-file.qe"), "No such file"),
    (b"\xff", "UTF-8"),
    ("root(1, a^2 - 2, a) < a", "assuming: "),
)
def test_what_cannot_be_assumed(given: object, part: str) -> None:
    with pytest.raises(qe.InputError, match=part) as caught:
        qe.eliminate("ex x. x = a", assuming=given)
    assert "\n" not in str(caught.value) and "assuming" in str(caught.value)


def test_an_assumption_about_something_else_is_noted() -> None:
    with pytest.warns(qe.DoubtfulInput, match="A > 0 says nothing of the free variables"):
        qe.eliminate("ex x. x^2 = a", assuming="A > 0")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        qe.eliminate("ex x. x^2 = a", assuming="a = c^2")


def test_limits_hold_under_assumptions() -> None:
    hard = "ex x, y, z. x^5 + a*x*y^4 + z^5*b = 1 and x*y*z > a*b^4 and x^3*z^4 + y^5 < a^3 - b"
    assert qe.eliminate(hard, assuming="a^3 > b", timeout=1).status is qe.Status.UNABLE
    assert str(qe.eliminate("x > root(1, y^3 - 2, y) and a > 0", assuming="a > 0")) != ""
