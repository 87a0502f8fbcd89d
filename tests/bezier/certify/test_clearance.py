"""Curves that miss obstacles, or first meet them: a parabola beside a line and a disc, by hand."""

from __future__ import annotations

from typing import Any

import pytest

from bezier.certify.clearance import check_clearance
from qe.errors import CertificateRejected
from tests.tables import each

RATIONAL = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
ARCH = [["-1", "0"], ["0", "2"], ["1", "0"]]  # (2t - 1, 4t(1 - t)), at most 1 high


def half_plane(offset: str, strict: bool = False) -> dict[str, Any]:
    """y >= offset."""
    negative = offset.removeprefix("-") if offset.startswith("-") else f"-{offset}"
    terms = [[[0, 1], "1"]] + ([[[0, 0], negative]] if offset != "0" else [])
    return {"terms": terms, "strict": strict}


def payload(constraints: list[Any], spans: list[Any], contact: Any = None, points: Any = ARCH) -> dict[str, Any]:
    given = {
        "field": RATIONAL,
        "points": [[[c] for c in p] for p in points],
        "pieces": [{"constraints": constraints, "spans": spans}],
    }
    return given if contact is None else {**given, "contact": contact}


HALVES = [["0", "1/2", 0], ["1/2", "1", 0]]
DISC = {"terms": [[[2, 0], "-1"], [[0, 2], "-1"], [[0, 1], "-6"], [[0, 0], "-8"]], "strict": False}  # around (0, -3)
LEFT = {"terms": [[[1, 0], "-1"]], "strict": False}  # x <= 0
RIGHT = {"terms": [[[1, 0], "1"], [[0, 0], "-1/2"]], "strict": False}  # x >= 1/2


@each(
    ([half_plane("3")], [["0", "1", 0]]),
    ([half_plane("2", strict=True)], [["0", "1", 0]]),  # a control point touches; the half-plane is open
    ([half_plane("3/2")], HALVES),
    ([DISC], [["0", "1", 0]]),
    ([LEFT, RIGHT], [["0", "5/8", 1], ["5/8", "1", 0]]),
    ([half_plane("1", strict=True)], HALVES),
)
def test_the_curve_misses(constraints: list[Any], spans: list[Any]) -> None:
    check_clearance(payload(constraints, spans))


@each(
    ([half_plane("3/2")], [["0", "1", 0]], "does not fail"),
    ([half_plane("1")], HALVES, "does not fail"),  # it touches at 1/2
    ([half_plane("0")], HALVES, "does not fail"),
    ([half_plane("3")], [["0", "1/2", 0]], "do not reach 1"),
    ([half_plane("3")], [], "do not reach 1"),
    ([half_plane("3")], [["0", "1/2", 0], ["3/4", "1", 0]], "an interval from 1/2"),
    ([half_plane("3")], [["1/4", "1", 0]], "an interval from 0"),
    ([half_plane("3")], [["0", "2", 0]], "an interval from 0"),
    ([half_plane("3")], [["0", "0", 0], ["0", "1", 0]], "an interval from 0"),
    ([half_plane("3")], [["0", "1", 1]], "one of 1 constraints"),
    ([half_plane("3")], [["0", "1"]], "low, high, index"),
    ([half_plane("3")], [["0", "1", 0, 0]], "low, high, index"),
    ([{"terms": [[[0, 1], "1"]], "strict": None}], [["0", "1", 0]], "true or false"),
    ([{"terms": [[[1], "1"]], "strict": False}], [["0", "1", 0]], "expected 2 exponents"),
    ([{"terms": [[[0, 1], "1"], [[0, 1], "1"]], "strict": False}], [["0", "1", 0]], "each combination once"),
    ([{"terms": [[[0, 1]]], "strict": False}], [["0", "1", 0]], "exponents, coefficient"),
    ([{"terms": [[[0, 10**4], "1"]], "strict": False}], [["0", "1", 0]], "a degree of at most"),
)
def test_what_is_refused(constraints: list[Any], spans: list[Any], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        check_clearance(payload(constraints, spans))


def test_a_first_contact() -> None:
    """y >= 3/4 is reached at t = 1/4, where 4t(1-t) = 3/4."""
    wall = [half_plane("3/4")]
    before = [["0", "1/8", 0]]
    at = {"after": "1/8", "t": "1/4", "piece": 0}
    check_clearance(payload(wall, before, at))
    check_clearance(payload([half_plane("0")], [], {"after": "0", "t": "0", "piece": 0}))
    for wrong, reason in (
        ({**at, "t": "1/5"}, "does not hold at t"),
        ({**at, "t": "1/9"}, "0 <= after <= t <= 1"),
        ({**at, "t": "9/8"}, "0 <= after <= t <= 1"),
        ({**at, "piece": 1}, "one of 1 pieces"),
        ({**at, "after": "1/4"}, "do not reach 1/4"),
    ):
        with pytest.raises(CertificateRejected, match=reason):
            check_clearance(payload(wall, before, wrong))
    with pytest.raises(CertificateRejected, match="does not hold at t"):
        check_clearance(payload([half_plane("3/4", strict=True)], before, at))


def test_at_least_one_piece() -> None:
    with pytest.raises(CertificateRejected, match="at least one piece"):
        check_clearance({**payload([], []), "pieces": []})
