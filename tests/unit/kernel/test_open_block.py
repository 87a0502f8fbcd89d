"""Equations that hold nowhere inside an open set are left out; the set must be seen to be open."""

from __future__ import annotations

from typing import Any

import pytest

from qe.kernel.open_block import inside, shows_open
from tests.unit.certify.claims import NO_LEMMAS, formula, objection, step, written

RULE = "open block"
BLOCK = "ex x, y. x > y and x < a"


def point(coefficients: list[str], shift: int) -> dict[str, Any]:
    where = {"coefficients": coefficients, "branch": 0, "shift": shift}
    return {"point": where, "guard": True, "formula": None, "settled": []}


SET = {
    "variable": "x",
    "side": 1,
    "quadratics": [],
    "points": [point([], -1), point(["y", "-1"], 1)],
    "parts": [[], []],
}
"""Test points for x > y and x < a: minus infinity, and the places just above y."""

INNER = step("elimination set", "ex x. x > y and x < a", "y < a", SET)


def by(pieces: list[str], parts: list[Any], steps: list[Any], variable: str = "x") -> dict[str, Any]:
    return {"variable": variable, "steps": steps, "pieces": [written(p) for p in pieces], "parts": parts}


def cases(before: str, after: str) -> dict[str, Any]:
    return step("signs", before, after, {"theory": NO_LEMMAS})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x > y and x*y /= 1", True),
        ("x > y or x < a and b = 0", True),
        ("x >= y", False),
        ("x > y and (x = a or y > 1)", False),
        ("a >= 0 and b = 0", True),  # nothing is said of x and y
        ("not (x > root(1, x^2 - a))", False),
        ("a > 0 and (ex z. z^2 = b)", True),
        ("ex z. z^2 = x", False),
        ("x > root(1, x^2 - a)", False),
    ],
)
def test_openness_by_the_syntax(text: str, expected: bool) -> None:
    assert shows_open(formula(text), ("x", "y")) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("y = a", "false"),
        ("b*y = a", "b = 0 and a = 0"),
        ("y <= a", "y < a"),
        ("b*y >= a", "b*y > a or b = 0 and a = 0"),
        ("y < a and y /= b", "y < a and y /= b"),
        ("a <= b and c = 0", "a <= b and c = 0"),
        ("y^2 = a or y >= a and c = 0", "y > a and c = 0"),
        ("ex z. z^2 = y", "ex z. z^2 = y"),
        ("y > root(1, y^2 - a)", "y > root(1, y^2 - a)"),
    ],
)
def test_what_of_a_condition_matters_inside(text: str, expected: str) -> None:
    found = inside(formula(text), ("y",))
    assert set(map(str, parts(found))) == set(map(str, parts(formula(expected))))


def parts(found: Any) -> tuple[Any, ...]:
    return getattr(found, "args", (found,))


def test_a_piece_with_an_equation_is_left_out() -> None:
    """y = b holds at one y only, so that this piece adds nothing; c*y = b is more where c and b are 0."""
    for equation, more in (("y = b", ""), ("c*y = b", " or (c = 0 and b = 0 and (ex y. y < a))")):
        pieces = ["y < a", f"{equation} and y < a"]
        evidence = by(pieces, [[], []], [INNER, cases("y < a", f"y < a or ({equation} and y < a)")])
        if not more:
            assert objection(RULE, BLOCK, "ex y. y < a", evidence) == ""
        else:
            assert objection(RULE, BLOCK, "(ex y. y < a) or (ex y. c = 0 and b = 0 and y < a)", evidence) == ""
            assert "not the disjunction" in objection(RULE, BLOCK, "ex y. y < a", evidence)


@pytest.mark.parametrize(
    ("before", "evidence", "reason"),
    [
        ("ex x, y. x >= y and x < a", by(["y < a"], [[]], [INNER]), "open set"),
        ("ex x, y. x > y and x < a and y = b", by(["y < a"], [[]], [INNER]), "open set"),
        ("all x, y. x > y and x < a", by(["y < a"], [[]], [INNER]), "existential block"),
        (BLOCK, by(["y < a"], [[]], [INNER], "z"), "existential block"),
        (BLOCK, by(["y < a", "y = b"], [[], []], [INNER]), "not the formulas"),
        (BLOCK, by(["y < a"], [], [INNER]), "lists of steps"),
        (BLOCK, by(["y < a"], [[]], []), "not the formulas"),
        (BLOCK, by(["y < b"], [[]], [INNER]), "not the formulas"),
    ],
)
def test_what_breaks_a_side_condition(before: str, evidence: Any, reason: str) -> None:
    assert reason in objection(RULE, before, "ex y. y < a", evidence)
    assert objection(RULE, BLOCK, "ex y. y < a", by(["y < a"], [[]], [INNER])) == ""


def test_what_is_known_of_the_same_names_outside_says_nothing() -> None:
    """y < a is known of another y, so that this is no step from y < a to true."""
    wrong = cases("y < a", "true") | {"context": [written("y < a")]}
    found = objection(RULE, BLOCK, "true", by(["true"], [[]], [INNER, wrong]), given="y < a")
    assert "no other condition at the place" in found
