"""A block eliminated by steps of its own; a universal one as the negation of an existential one."""

from __future__ import annotations

from typing import Any

from qe.certify.replayed_block import check_replayed_block
from tests.unit.certify.claims import NO_LEMMAS, objection, step

RULE = check_replayed_block


def solved(before: str, after: str) -> dict[str, Any]:
    return step("linear equation solved", before, after, {"solved": [["x", "-a + x", 1]], "theory": NO_LEMMAS})


def test_the_steps_lead_from_the_block_to_what_became_of_it() -> None:
    steps = {"steps": [solved("ex x. x = a and x > b", "a > b")]}
    assert objection(RULE, "ex x. x = a and x > b", "a > b", steps) == ""
    assert objection(RULE, "all x. x /= a or x <= b", "a <= b", steps) == ""
    assert "do not lead there" in objection(RULE, "ex x. x = a and x > b", "a >= b", steps)
    assert "do not lead there" in objection(RULE, "ex x. x = a and x > b", "a > b", {"steps": []})
    assert "do not lead there" in objection(RULE, "all x. x /= a or x <= b", "a > b", steps)
    assert "does not stand there" in objection(RULE, "all x. x = a and x > b", "a > b", steps)


def test_a_wrong_step_inside_is_named() -> None:
    steps = {"steps": [solved("ex x. x = a and x > b", "a >= b")]}
    found = objection(RULE, "ex x. x = a and x > b", "a >= b", steps)
    assert found.startswith("evidence.steps[0]: linear equation solved")


def test_a_step_inside_may_use_what_stands_beside_the_block() -> None:
    inner = step("simplification", "ex x. x > b and a > 0", "ex x. x > b", {"theory": NO_LEMMAS}, given="a > 0")
    assert objection(RULE, "ex x. x > b and a > 0", "ex x. x > b", {"steps": [inner]}, given="a > 0") == ""
    assert "beside the place" in objection(RULE, "ex x. x > b and a > 0", "ex x. x > b", {"steps": [inner]})
