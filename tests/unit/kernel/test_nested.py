"""The primitives "steps", "converse" and "no exception": one step made of others."""

from __future__ import annotations

from typing import Any

import pytest

from tests.unit.certify.claims import NO_LEMMAS, objection, step


def solved(before: str, after: str) -> dict[str, Any]:
    return step("linear equation solved", before, after, {"solved": [["x", "-a + x", 1]], "theory": NO_LEMMAS})


def test_the_steps_lead_from_the_block_to_what_became_of_it() -> None:
    steps = {"steps": [solved("ex x. x = a and x > b", "a > b")]}
    assert objection("steps", "ex x. x = a and x > b", "a > b", steps) == ""
    assert objection("steps", "all x. x /= a or x <= b", "a <= b", steps) == ""
    assert "do not lead there" in objection("steps", "ex x. x = a and x > b", "a >= b", steps)
    assert "do not lead there" in objection("steps", "ex x. x = a and x > b", "a > b", {"steps": []})
    assert "do not lead there" in objection("steps", "all x. x /= a or x <= b", "a > b", steps)
    assert "does not stand there" in objection("steps", "all x. x = a and x > b", "a > b", steps)


def test_the_steps_of_a_converse_lead_from_what_became_of_it_back() -> None:
    steps = {"steps": [solved("ex x. x = a and x > b", "a > b")]}
    assert objection("converse", "a > b", "ex x. x = a and x > b", steps) == ""
    assert "do not lead back" in objection("converse", "a >= b", "ex x. x = a and x > b", steps)
    assert "do not lead back" in objection("converse", "a > b", "ex x. x = a and x > b", {"steps": []})
    assert "does not stand there" in objection("converse", "ex x. x = a and x > b", "a > b", steps)


def test_a_wrong_step_inside_is_named() -> None:
    steps = {"steps": [solved("ex x. x = a and x > b", "a >= b")]}
    found = objection("steps", "ex x. x = a and x > b", "a >= b", steps)
    assert found.startswith("evidence.steps[0]: linear equation solved")


def test_a_step_inside_may_use_what_holds_at_the_place() -> None:
    inner = step("signs", "ex x. x > b and a > 0", "ex x. x > b", {"theory": NO_LEMMAS}, given="a > 0")
    assert objection("steps", "ex x. x > b and a > 0", "ex x. x > b", {"steps": [inner]}, given="a > 0") == ""
    assert "no other condition at the place" in objection(
        "steps", "ex x. x > b and a > 0", "ex x. x > b", {"steps": [inner]}
    )


REFUTED = [solved("ex a, x. x = a and x > a", "false")]
ONLY_ONE = [solved("ex a, x. x = a and x > b", "ex a. a > b")]


@pytest.mark.parametrize(
    ("before", "after", "exceptions", "given", "reason"),
    [
        ("x = a and x > a", "false", [REFUTED], "true", ""),
        ("x /= a or x <= a", "true", [REFUTED], "true", ""),
        ("x > a", "false", [REFUTED], "x = a", ""),
        ("x > a", "false", [REFUTED], "true", "does not stand there"),
        ("x = a and x > a", "true", [REFUTED], "true", "does not stand there"),
        ("x = a and x > a", "false", [], "true", "expected 1 list"),
        ("x = a and x > a", "false", [REFUTED, REFUTED], "true", "expected 1 list"),
        ("x = a and x > b", "false", [ONLY_ONE], "true", "does not stand there"),
        ("a > 0", "a >= 0", [[], []], "true", "no exception"),
        ("false", "false", [], "true", ""),
        ("true", "false", [[]], "true", "no exception"),
    ],
)
def test_no_exception_is_left(before: str, after: str, exceptions: Any, given: str, reason: str) -> None:
    found = objection("no exception", before, after, {"exceptions": exceptions}, given)
    assert (reason in found) if reason else found == ""
