"""Quantifiers of one kind drawn together, unless a name is captured."""

from __future__ import annotations

import pytest

from qe.certify.gathering import check_gathering
from tests.unit.certify.claims import objection


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("ex x. x > a and (ex y. y > x)", "ex x, y. x > a and y > x"),
        ("ex x. (ex y. y > x and (ex z. z > y)) and x > a", "ex x, y, z. y > x and z > y and x > a"),
        ("ex x. (ex y. y > x) and (ex z. z < x)", "ex x, y, z. y > x and z < x"),
        ("ex x. (ex y. y > x) and (ex z. z < x)", "ex x, y. y > x and (ex z. z < x)"),
        ("all x. x > a or (all y. y > x)", "all x, y. x > a or y > x"),
        ("all x. (all y. y > x or b > 0) or x > a", "all x, y. x > a or y > x or b > 0"),
        ("ex x. x > a and (all y. y > x)", "ex x. x > a and (all y. y > x)"),
    ],
)
def test_inner_blocks_are_opened(before: str, after: str) -> None:
    assert objection(check_gathering, before, after) == ""
    assert objection(check_gathering, after, before) == ""  # variables move inwards


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("ex x. x > a and (ex y. y > x) and y < a", "ex x, y. x > a and y > x and y < a", "captured"),
        ("ex x. (ex y. y > x) and (ex y. y < x)", "ex x, y. y > x and y < x", "captured"),
        ("ex x. y < x and (ex y. y > x)", "ex x, y. y < x and y > x", "captured"),
        ("ex x. x > a and (ex x. x < b)", "ex x. x > a and x < b", "captured"),
        ("ex x. x > a and (all y. y > x)", "ex x, y. x > a and y > x", "not the block"),
        ("ex x. x > a or (ex y. y > x)", "ex x, y. x > a or y > x", "not the block"),
        ("all x. x > a and (all y. y > x)", "all x, y. x > a and y > x", "not the block"),
        ("ex x. x > a and (ex y. y > x)", "ex x, y, z. x > a and y > x and z > a", "not the block"),
        ("ex x. x > a and (ex y. y > x)", "ex x, y. y > x", "not the block"),
        ("ex x. x > a and (ex y. y > x)", "all x, y. x > a and y > x", "two blocks of one kind"),
        ("x > a", "ex x. x > a", "two blocks of one kind"),
    ],
)
def test_what_is_no_gathering(before: str, after: str, reason: str) -> None:
    assert reason in objection(check_gathering, before, after)
    assert objection(check_gathering, after, before)


def test_there_is_no_evidence() -> None:
    assert objection(check_gathering, "ex x. x > a", "ex x. x > a", {"names": []})
