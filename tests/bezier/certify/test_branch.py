"""Branches of an arm: a Cartesian arm whose joint values are the coordinates, so that every solution is known."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

from bezier.certify.branch import check_branch
from qe.errors import CertificateRejected
from qe.proof.entry import Entry
from tests.tables import each
from tests.unit.certify.claims import limits


def row(theta: Any, alpha: Any, joint: str | None = "prismatic") -> dict[str, Any]:
    return {"a": "0", "alpha": alpha, "d": "0", "theta": theta, "joint": joint}


ROWS = [row(0, 6), row(6, 6), row(0, 0)]
"""Three slides: the end point is (q3, -q2, q1)."""
LINE = [["0", "0", "0"], ["1", "2", "3"]]
NEXT = [["1", "2", "3"], ["1", "4", "3"]]


def piece(curve: int, low: str, high: str, centre: str, slope: str, radius: str = "1/10 1/10 1/10") -> dict[str, Any]:
    found: dict[str, Any] = {"curve": curve, "low": low, "high": high}
    return {**found, "centre": centre.split(), "slope": slope.split(), "radius": radius.split()}


WHOLE = piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1")
FIRST = piece(0, "0", "1/2", "3/4 -1/2 1/4", "3 -2 1")
SECOND = piece(0, "1/2", "1", "9/4 -3/2 3/4", "3 -2 1")
THIRD = piece(1, "0", "1", "3 -3 1", "0 -2 0")


def payload(*pieces: dict[str, Any], **changed: Any) -> Any:
    arm = {"convention": "standard", "rows": ROWS, **changed}
    return {"arm": arm, "curves": [LINE, NEXT], "limits": [None, None, None], "pieces": list(pieces)}


def objection(given: Any) -> str:
    try:
        check_branch(Entry(deepcopy(given), "payload"), limits())
    except CertificateRejected as error:
        return f"{error.step}: {error.reason}"
    return ""


@each(
    payload(WHOLE),
    payload(FIRST, SECOND),
    payload(FIRST, SECOND, THIRD),
    payload(SECOND, THIRD),
    payload(WHOLE, rows=[row(["1", "0"], ["0", "1"]), row(["0", "1"], 6), row(0, 0)]),  # the same angles as numbers
    payload(WHOLE, rows=[*ROWS[:2], row(12, 0, None), row(12, 0, None), row(0, 0)]),  # half a turn, and back
)
def test_a_slide_follows_lines(given: Any) -> None:
    assert objection(given) == ""


def test_the_modified_convention_turns_before_it_slides() -> None:
    """Links come first there: row i carries the alpha of the row before in the other convention."""
    rows = [row(0, 0), row(6, 6), row(0, 6)]
    assert objection(payload(WHOLE, rows=rows, convention="modified")) == ""
    assert objection(payload(WHOLE, rows=rows)) != ""
    assert objection(payload(WHOLE, convention="modified")) != ""


@each(
    (payload(piece(0, "0", "1", "8/5 -1 1/2", "3 -2 1")), "exactly one solution"),  # on the rim of the box
    (payload(piece(0, "0", "1", "2 -1 1/2", "3 -2 1")), "exactly one solution"),
    (payload(piece(0, "0", "1", "3/2 -1 1/2", "3 -2 2")), "exactly one solution"),
    (payload(piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1", "1/10 0 1/10")), "radii above 0"),
    (payload(piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1", "1/10 1/10")), "each of three joints"),
    (payload(piece(2, "0", "1", "3/2 -1 1/2", "3 -2 1")), "one of 2 curves"),
    (payload(piece(0, "1", "0", "3/2 -1 1/2", "3 -2 1")), "0 <= low < high <= 1"),
    (payload(piece(0, "0", "2", "3 -2 1", "3 -2 1")), "0 <= low < high <= 1"),
    (payload(FIRST, piece(0, "3/4", "1", "21/8 -7/4 7/8", "3 -2 1")), "where the one before ends"),
    (payload(SECOND, FIRST), "where the one before ends"),
    (payload(FIRST, THIRD), "where the one before ends"),
    (payload(THIRD, WHOLE), "where the one before ends"),
    (payload(), "at least one piece"),
    (payload(WHOLE, rows=ROWS[:2]), "three of them with a joint"),
    (payload(WHOLE, rows=[*ROWS, row(0, 0)]), "three of them with a joint"),
    (payload(WHOLE, rows=[*ROWS, *[row(0, 0, None)] * 40]), "at most 40 rows"),
    (payload(WHOLE, rows=[row(0, 6, "spherical"), *ROWS[1:]]), "null, revolute or prismatic"),
    (payload(WHOLE, convention="classic"), "modified or standard"),
    (payload(WHOLE, rows=[row(["1", "1"], 6), *ROWS[1:]]), "cosine and sine"),
    (payload(WHOLE, rows=[row(25, 6), *ROWS[1:]]), "twelfths of pi"),
    (payload(WHOLE, rows=[row(0, 0), row(0, 0), row(0, 0)]), "exactly one solution"),  # all slides along z
)
def test_what_is_no_branch(given: Any, reason: str) -> None:
    assert reason in objection(given)


def test_curves_that_do_not_meet_are_not_joined() -> None:
    given = payload(WHOLE, THIRD)
    assert objection(given) == ""
    given["curves"] = [LINE, [["1", "2", "4"], ["1", "4", "4"]]]
    assert objection(given)
    for curve in ([], [["0", "0"]], [["0", "0", "0"]] * 61):
        given["curves"] = [curve, NEXT]
        assert "points of three coordinates" in objection(given)


def test_a_turning_arm_has_two_solutions_and_a_piece_holds_one() -> None:
    """Two links of length 1 in a plane, and a slide: at distance sqrt 2 the elbow is at 90 degrees, on either side."""
    rows = [
        {"a": "1", "alpha": 0, "d": "0", "theta": 0, "joint": "revolute"},
        {"a": "1", "alpha": 0, "d": "0", "theta": 0, "joint": "revolute"},
        row(0, 0),
    ]
    still = [["1", "1", "0"], ["1", "1", "1"]]

    def given(*pieces: dict[str, Any]) -> Any:
        arm = {"convention": "standard", "rows": rows}
        return {"arm": arm, "curves": [still], "limits": [None] * 3, "pieces": list(pieces)}

    quarter = "15707963/10000000"
    down, up = f"0 {quarter} 1/2", f"{quarter} -{quarter} 1/2"
    for centre in (down, up):
        assert objection(given(piece(0, "0", "1", centre, "0 0 1"))) == ""
    assert objection(given(piece(0, "0", "1", down, "0 0 1", "2 2 1/10")))  # a box with both
    halves = [piece(0, "0", "1/2", f"0 {quarter} 1/4", "0 0 1"), piece(0, "1/2", "1", f"0 {quarter} 3/4", "0 0 1")]
    assert objection(given(*halves)) == ""
    other = piece(0, "1/2", "1", f"{quarter} -{quarter} 3/4", "0 0 1")
    assert "that of the piece before" in objection(given(halves[0], other))
