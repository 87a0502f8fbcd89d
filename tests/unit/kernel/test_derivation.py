"""The frame: what holds at a place, and what stands there after a step."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.registry import RULES
from qe.errors import CertificateRejected
from qe.kernel.derivation import check_derivation
from qe.options import Budget
from qe.proof.entry import formula_to_json
from tests.unit.certify.claims import NO_LEMMAS, RING, formula

WEAK = ["a >= 0"]


def written(text: str) -> Any:
    return formula_to_json(formula(text), quantified=True)


def objection(start: str, at: list[int], before: str, after: str, answer: str, *facts: str) -> str:
    """Why a derivation of one step by signs, without lemmas, is refused; empty if it is not."""
    step = {"rule": "signs", "at": at, "before": written(before), "after": written(after)}
    step |= {"context": [written(f) for f in facts], "evidence": {"theory": NO_LEMMAS}}
    payload: Any = {"order": list(RING.names), "start": written(start), "steps": [step], "answer": written(answer)}
    try:
        check_derivation(payload, Budget(), RULES)
    except CertificateRejected as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("start", "at", "before", "after", "answer", "facts"),
    [
        ("a > 0 and b > 0", [1], "b > 0", "b > 0 and a >= 0", "a > 0 and b > 0 and a >= 0", ["a > 0"]),
        ("a > 0 or b > 0", [1], "b > 0", "b > 0 and a <= 0", "a > 0 or (b > 0 and a <= 0)", ["a <= 0"]),
        ("a > 0 and b > 0 and a >= 0", [], "a > 0 and b > 0", "a /= 0 and b > 0", "a >= 0 and a /= 0 and b > 0", WEAK),
        ("a > 0 and (ex x. x > b)", [1, 0], "x > b", "a >= 0 and x > b", "a > 0 and ex x. a >= 0 and x > b", ["a > 0"]),
    ],
)
def test_what_holds_at_a_place(start: str, at: list[int], before: str, after: str, answer: str, facts: Any) -> None:
    assert objection(start, at, before, after, answer, *facts) == ""


@pytest.mark.parametrize(
    ("start", "at", "before", "after", "answer", "facts"),
    [
        # beside a disjunct the others fail
        ("a > 0 or b > 0", [1], "b > 0", "b > 0 and a > 0", "a > 0 or (b > 0 and a > 0)", ["a > 0"]),
        # no part holds for itself
        ("a > 0 and b > 0", [0], "a > 0", "true", "b > 0", ["a > 0"]),
        # the x outside is another one
        ("x > 0 and (ex x. x < b)", [1, 0], "x < b", "x < b and x > 0", "x > 0 and (ex x. x < b and x > 0)", ["x > 0"]),
        # what does not stand there
        ("a > 0 and b > 0", [1], "b > 0", "false", "false", ["b <= 0"]),
        ("a > 0 and b > 0", [0], "b > 0", "b > 0 and b >= 0", "a > 0 and b > 0", []),
        ("a > 0 and b > 0", [], "a > 0 and a < 0", "false", "false", []),
        ("a > 0 or b > 0", [], "a > 0 and a < 0", "false", "false", []),
        ("a > 0 and b > 0", [2], "a > 0", "a > 0", "a > 0 and b > 0", []),
        ("a > 0", [0], "a > 0", "a > 0", "a > 0", []),
        # the steps lead elsewhere
        ("a > 0 and a >= 0", [], "a > 0 and a >= 0", "a > 0", "a >= 0", []),
    ],
)
def test_what_does_not(start: str, at: list[int], before: str, after: str, answer: str, facts: Any) -> None:
    assert objection(start, at, before, after, answer, *facts)


def test_a_negation_keeps_facts_and_turns_what_is_under_it() -> None:
    inner, changed = "a > root(1, a^2 - b) and a >= 0", "a > root(1, a^2 - b)"
    start, answer = f"a > 0 and not ({inner})", f"a > 0 and not ({changed})"
    assert objection(start, [1, 0], inner, changed, answer, "a > 0") == ""
    assert objection(start, [1, 0], inner, changed, f"a > 0 and {changed}", "a > 0")


def test_nothing_after_a_step_binds_what_is_seen_there() -> None:
    start, after = "x > 0 and (ex y. y > x)", "ex x. x > b"
    assert "bound where it is seen" in objection(start, [1], "ex y. y > x", after, "x > 0")
