"""Blocks that only look at lengths and angles: one coordinate is 0, another not negative."""

from __future__ import annotations

from typing import Any

from qe.expert.rotation import check_rotation
from tests.tables import each
from tests.unit.certify.claims import objection
from tests.unit.proving.rotations import NOT_TURNED, TURNED, XY, by, turn


@each(
    *TURNED,
    (
        "ex x, y. x^2 + y^2 < a and (ex z, c. x*z + y*c > b)",
        "ex x. x >= 0 and x^2 < a and (ex z, c. x*z > b)",
        by(turn("y", "x", XY, ("z", "c", "1"))),
    ),
)
def test_turned_into_an_axis(before: str, after: str, turns: Any) -> None:
    assert objection(check_rotation, before, after, turns) == ""


@each(*NOT_TURNED)
def test_what_breaks_a_rotation(before: str, after: str, turns: Any, reason: str) -> None:
    said = objection(check_rotation, before, after, turns)
    assert said and reason in said
