"""Limits of joints in certificates of kind "branch": of three slides, whose values are the coordinates, and others."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

from bezier.arm.evidence import certificates
from bezier.arm.joint_path import joint_path
from bezier.arm.reader import load_arm
from bezier.curves.curve import Bezier
from qe.certify.verify import verify
from tests.bezier.certify.test_branch import LINE, ROWS, objection, piece
from tests.certificates.restated import evidence_of, verdict_by
from tests.tables import each

TINY = Fraction(1, 10**12)


def slides(limits: list[Any], curve: list[list[str]], *pieces: dict[str, Any]) -> str:
    arm = {"convention": "standard", "rows": ROWS}
    return objection({"arm": arm, "curves": [curve], "limits": limits, "pieces": list(pieces)})


def test_limits_at_both_ends_are_kept() -> None:
    """The joints go from 0 to 3, -2 and 1: exactly the limits, and then a little less than they need."""
    whole = piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1")
    exact = [["0", "3"], ["-2", "0"], ["0", "1"]]
    assert slides(exact, LINE, whole) == ""
    for j in range(3):
        for k, less in ((0, TINY), (1, -TINY)):
            limits = json.loads(json.dumps(exact))
            limits[j][k] = str(Fraction(limits[j][k]) + less)
            assert f"joint {j + 1} is not proved" in slides(limits, LINE, whole)


def test_a_limit_that_is_touched_is_kept() -> None:
    """q3 = 2 s (1 - s) goes from 0 to 1/2 and back."""
    arch = [["0", "0", "0"], ["1", "0", "0"], ["0", "0", "0"]]
    halves = [
        piece(0, "0", "1/2", "0 0 3/8", "0 0 1", "1/10 1/10 3/10"),
        piece(0, "1/2", "1", "0 0 3/8", "0 0 -1", "1/10 1/10 3/10"),
    ]
    assert slides([None, None, ["0", "1/2"]], arch, *halves) == ""
    assert "joint 3" in slides([None, None, ["0", str(Fraction(1, 2) - TINY)]], arch, *halves)
    assert "joint 3" in slides([None, None, [str(TINY), "1/2"]], arch, *halves)
    whole = piece(0, "0", "1", "0 0 1/2", "0 0 0", "1/10 1/10 6/5")
    assert slides([None, None, ["-1", "1/2"]], arch, whole) == ""
    assert "joint 3" in slides([None, None, ["-1", "499/1000"]], arch, whole)


def test_a_joint_that_stands_at_its_limit_keeps_it() -> None:
    level, whole = [["0", "1", "0"], ["1", "1", "3"]], piece(0, "0", "1", "3/2 -1 1/2", "3 0 1")
    assert slides([None, ["-1", "0"], None], level, whole) == ""
    assert slides([None, ["-2", "-1"], None], level, whole) == ""
    assert "joint 2" in slides([None, [str(TINY - 1), "0"], None], level, whole)
    assert "joint 2" in slides([None, ["-2", str(-1 - TINY)], None], level, whole)


@each(
    ([None, None], "limits of 3 joints"),
    ([None] * 4, "limits of 3 joints"),
    ([None, None, ["1", "0"]], "a least value below"),
    ([None, None, ["0"]], "a least value below"),
    ([None, None, ["0", 1.5]], "limits[2][1]"),
    ([None, None, "01"], "expected a list"),
    ({}, "expected a list"),
    (None, "expected a list"),
)
def test_what_are_no_limits(limits: Any, reason: str) -> None:
    assert reason in slides(limits, LINE, piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1"))


def test_altered_limits_are_rejected() -> None:
    """The lift touches 250 mm halfway; the angle, close to its limit, has boxes only."""
    arm = load_arm("cylindrical")
    found = joint_path(arm, {"c": Bezier.of([(20, -300, 100), (20, -200, 600), (21, -300, 100)])})
    (_, certificate), _ = certificates(found)
    assert verify(certificate).accepted

    def verdict(change: Any) -> Any:
        payload = evidence_of(certificate)
        change(payload)
        return verdict_by("joints along curves", payload)

    changes = [
        lambda p: p.pop("limits"),
        lambda p: p["limits"].pop(),
        lambda p: p["limits"][1].__setitem__(1, "249999999999/1000000000"),
        lambda p: p["limits"][1].__setitem__(0, "1/1000000000"),
        lambda p: p["limits"][2].__setitem__(1, "264"),
        lambda p: p["limits"][0].__setitem__(1, "0"),
        lambda p: p["limits"].reverse(),
        lambda p: p["arm"]["rows"][0].update(d="99"),
    ]
    for change in changes:
        given = verdict(change)
        assert not given.accepted and given.decided and given.step.startswith("payload"), given
