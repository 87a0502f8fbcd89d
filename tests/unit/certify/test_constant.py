"""Formulas that hold nowhere or everywhere: there is no point, or no exception."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.constant import check_constant
from tests.unit.certify.claims import NO_LEMMAS, objection, step

SOLVED = {"solved": [["x", "-a + x", 1]], "theory": NO_LEMMAS}
REFUTED = [step("linear equation solved", "ex a, x. x = a and x > a", "false", SOLVED)]
ONLY_ONE = [step("linear equation solved", "ex a, x. x = a and x > b", "ex a. a > b", SOLVED)]


@pytest.mark.parametrize(
    ("before", "after", "steps", "reason"),
    [
        ("x = a and x > a", "false", REFUTED, ""),
        ("x /= a or x <= a", "true", REFUTED, ""),
        ("x = a and x > a", "true", REFUTED, "does not stand there"),
        ("x /= a or x <= a", "false", REFUTED, "does not stand there"),
        ("x = a and x > a", "false", [], "no exception"),
        ("x = a and x > b", "false", ONLY_ONE, "does not stand there"),
        ("x = a and x > a", "a > 0", REFUTED, "expected true or false"),
        ("false", "false", [], ""),
        ("true", "true", [], ""),
        ("true", "false", [], "no exception"),
    ],
)
def test_no_exception_is_left(before: str, after: str, steps: Any, reason: str) -> None:
    found = objection(check_constant, before, after, {"steps": steps})
    assert (reason in found) if reason else found == ""


def test_a_table_is_checked_as_a_table() -> None:
    assert "certificate" in objection(check_constant, "x > a", "false", {"certificate": None})
