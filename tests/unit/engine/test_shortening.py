"""Shorter answers: equations of an answer and of its negation taken apart, and cells within little work."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.certify.verify import verify
from qe.elimination.protocol import Context
from qe.engine import shortening
from qe.engine.constant import Start
from qe.engine.shortening import shortened
from qe.errors import Unable
from qe.formula.features import length
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.tables import each


def context() -> Context:
    return Context(Options(), Budget(), RunLog())


def rules(given_: Context) -> list[str]:
    return [step.rule for step in given_.log.steps()]


def test_where_an_equation_is_denied_the_others_are_reduced(monkeypatch: pytest.MonkeyPatch) -> None:
    """In ``a /= b or p`` the polynomial p matters only where a = b."""
    monkeypatch.setattr(shortening, "SHORTEN_DEGREE", {})
    given_ = context()
    found = shortened(read("c > 0 and (a /= b or a^4*b - b^5 + a^2*c - b^2*c + c*d > 0)"), given_)
    assert str(found) == "c > 0 and (a /= b or d > 0)"
    assert rules(given_) == ["negation normal form", "equations taken apart", "negation normal form"]


def test_products_are_not_split_where_that_makes_it_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shortening, "SHORTEN_DEGREE", {})
    found = shortened(read("a^2 /= b^2 or a^4 - b^4 + c^2 + a^2*c - b^2*c > 0 or d^3 > a^2 - b^2"), context())
    assert length(found) < (3, 9)
    assert qe.decide(f"all a, b, c, d. ({found}) <-> (a^2 /= b^2 or c /= 0 or d > 0)", process=False)


@each(
    (  # an ellipse inside the unit circle
        "all x, y. a > 0 and b > 0 and (b^2*(x-c)^2 + a^2*y^2 - a^2*b^2 = 0 -> x^2 + y^2 - 1 <= 0)",
        "a > 0 and b > 0 and c + a <= 1 and c + 1 >= a and (a > b^2 or b^2*c^2 + b^4 - a^2*b^2 - b^2 + a^2 <= 0)",
        160,
    ),
    (
        "all x, y. b^2*(x-c)^2 + a^2*y^2 - a^2*b^2 = 0 -> x^2 + y^2 <= 1",
        "a /= 0 and b /= 0 and a + c <= 1 and a - c <= 1 and c - a <= 1 and -c - a <= 1 and"
        " (2*b^2 + c^2 < a^2 + 1 or b^4 - a^2*b^2 + b^2*c^2 + a^2 - b^2 <= 0)",
        400,
    ),
)
def test_ellipses_in_a_circle(question: str, expected: str, most: int) -> None:
    """Lengths as a guard against blunders: the answers were 501 and 578 characters long."""
    answer = qe.eliminate(question, process=False)
    assert len(str(answer.formula)) <= most
    for a in ("4/5", "-1/3", "2"):
        for b in ("1/3", "9/10"):
            values = f"a = {a} and b = {b}"
            assert qe.decide(f"all a, b, c. {values} -> (({answer.formula}) <-> ({expected}))", process=False)


def test_a_rule_that_gives_up_leaves_no_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """The derivation would go on from what was not reached."""

    def half_done(formula: Formula, context: Context, start: object) -> Formula:
        context.log.step("half", formula, read("b > 0"))
        raise Unable("too much work")

    monkeypatch.setattr(shortening, "RULES", (shortening.Rule("half", half_done),))
    given_ = context()
    assert str(shortened(read("a > 0 and b > 0"), given_)) == "a > 0 and b > 0"
    assert rules(given_) == []


def test_rules_for_whole_answers_are_not_tried_between(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[object] = []

    def noted(formula: Formula, context: Context, start: object) -> Formula:
        tried.append(start)
        return formula

    monkeypatch.setattr(shortening, "RULES", (shortening.Rule("noted", noted, last=True),))
    formula, start = read("a > 0"), Start(read("ex x. x < a and x > 0"), 0)
    assert shortened(formula, context()) == shortened(formula, context(), start) == formula
    assert tried == [start]


ATOMS = ("a - b", "a^2 - b^2", "a*b - 1", "a^2 + b - 2", "b", "a^3 - a", "a + b - 1")


@settings(deadline=None, max_examples=40, derandomize=True)
@given(
    st.lists(
        st.lists(st.tuples(st.sampled_from(ATOMS), st.sampled_from(["=", "/=", "<", ">="])), min_size=1, max_size=3),
        min_size=1,
        max_size=3,
    ),
    st.booleans(),
)
def test_what_is_shorter_is_equivalent(rows: list[list[tuple[str, str]]], conjunctive: bool) -> None:
    inner, outer = (" and ", " or ") if conjunctive else (" or ", " and ")
    text = outer.join("(" + inner.join(f"{p} {r} 0" for p, r in row) + ")" for row in rows)
    found = shortened(read(text), context())
    assert qe.decide(f"all a, b. ({text}) <-> ({found})", method="cad", process=False)


def test_the_steps_have_evidence() -> None:
    answer = qe.eliminate(
        "all x. x /= 0 or (a - b)*(x + 1)^2 /= 0 or a^4*b - b^5 + a^2*c + a*x - b^2*c + c*d > 0", check=True
    )
    assert "equations taken apart" in [step.rule for step in answer.derivation.steps]
    assert answer.certificate is not None
    assert verify(answer.certificate).accepted
    assert answer.unchecked_steps == ()


def test_no_condition_is_left_that_follows_from_the_others() -> None:
    """Bounds of a coordinate beside a disc said nothing: every point of the disc has them."""
    answer = qe.eliminate("all x, y. x^2 + y^2 <= 1 -> a*x + b*y <= 1", check=True)
    assert str(answer.formula) == "a^2 + b^2 <= 1"
    assert answer.unchecked_steps == ()
    assert str(shortened(read("a^2 + b^2 <= 1 and b <= 1 and b >= -1"), context())) == "a^2 + b^2 <= 1"
