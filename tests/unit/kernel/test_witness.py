"""Points that satisfy a formula: rational and algebraic coordinates, signs decided exactly."""

from __future__ import annotations

from typing import Any

import pytest

from tests.unit.certify.claims import objection


def said(text: str, *values: Any, order: str = "xy") -> str:
    """What the checker says of a point of the body."""
    evidence = {"order": list(order), "values": list(values)}
    return objection("instance", f"ex x, y. {text}", "true", evidence)


def root(polynomial: str, low: str, high: str) -> dict[str, Any]:
    return {"polynomial": polynomial, "interval": [low, high]}


ROOT = root("x^2 - 2", "1", "2")
OTHER = root("y^2 - 3", "-2", "-1")


@pytest.mark.parametrize(
    ("text", "values", "holds"),
    [
        ("x^2 + y^2 = 1", ("3/5", "-4/5"), True),
        ("x^2 + y^2 < 1", ("3/5", "-4/5"), False),
        ("x > y", ("-1/2", "-3/5"), True),
        ("x < y", ("-1/2", "-3/5"), False),
        ("3*x + 7*y > 1", ("1/3", "0"), False),
        ("3*x + 7*y < 1", ("1/3", "-1/1000000000000"), True),
        ("x + 7*y >= 2", (ROOT, "1/14"), False),
        ("x^2*y = 2*y", (ROOT, "7"), True),
        ("x^2*y /= 2*y", (ROOT, "7"), False),
        ("x*y < -12/5 and x*y > -5/2", (ROOT, OTHER), True),
        ("x*y >= -12/5", (ROOT, OTHER), False),
        ("x^2*y^2 = 6", (ROOT, OTHER), True),
        ("x > 1 and not y > 0 or x > 100", (ROOT, "0"), True),
        ("(x > 5 or y > 5) and x > 1", (ROOT, "0"), False),
        ("not (x > 0 and y > 0)", (ROOT, "0"), True),
        ("not (x > 0 and y >= 0)", (ROOT, "0"), False),
        ("x*y = 0 or y > x", ("0", ROOT | {"polynomial": "y^2 - 2"}), True),
    ],
)
def test_what_a_point_satisfies(text: str, values: Any, holds: bool) -> None:
    assert ("do not satisfy" in said(text, *values)) is not holds
    assert (said(text, *values) == "") is holds


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        (root("x^2 - 2", "-2", "2"), "exactly one root"),
        (root("x^2 - 2", "2", "3"), "exactly one root"),
        (root("x^2 - 4", "2", "3"), "exactly one root"),
        (root("x^2 - 4", "1", "2"), "exactly one root"),
        (root("x^2 - 2", "2", "1"), "two ascending ends"),
        (root("x^2 - 2", "1", "1"), "two ascending ends"),
        ({"polynomial": "x^2 - 2", "interval": ["1"]}, "two ascending ends"),
        (root("y^2 - 2", "1", "2"), "a polynomial in x"),
        (root("1", "1", "2"), "a polynomial in x"),
        (root("x*y - 2", "1", "2"), "a polynomial in x"),
        ("0.5", "a rational number"),
    ],
)
def test_what_is_no_number(value: Any, reason: str) -> None:
    assert reason in said("x > y", value, "1")


def test_a_double_root_is_one_root_without_a_change_of_sign() -> None:
    assert said("x = 1 and y = 0", root("x^2 - 2*x + 1", "0", "2"), "0") == ""


def test_one_value_for_each_variable() -> None:
    assert "expected 2 values" in said("x > y", "1")
    assert "expected 2 values" in said("x > y", "1", "1", "1")
    assert "listed twice" in said("x > y", "1", "1", order="xx")
    assert "other variables" in said("x > y", "1", order="x")
    assert "other variables" in said("x > y", "1", "1", "1", order="xyw")


BODY = "x > 1 and x = 2*y"
POINT = {"order": ["x", "y"], "values": ["2", "1"]}


@pytest.mark.parametrize(
    ("before", "after", "evidence", "accepted"),
    [
        (f"ex x, y. {BODY}", "true", POINT, True),
        (f"ex y, x. {BODY}", "true", POINT, True),
        (f"ex y, x. {BODY}", "true", {"order": ["y", "x"], "values": ["1", "2"]}, True),
        (f"all x, y. not ({BODY})", "false", POINT, True),
        (f"all x, y. not ({BODY})", "true", POINT, False),
        (f"ex x, y. {BODY}", "true", {**POINT, "values": ["2", "2"]}, False),
        (f"ex x, y. {BODY}", "false", POINT, False),
        (f"ex x, y. {BODY} and x > 3", "true", POINT, False),
        (f"ex x. {BODY}", "true", POINT, False),  # y is free
        (f"all x, y. {BODY}", "true", POINT, False),
        (f"ex x, y, z. {BODY}", "true", {"order": ["x", "y", "z"], "values": ["2", "1", "7"]}, True),
        (f"ex x. all y. {BODY} or x > 1", "true", POINT, False),
        ("ex x, y. x = y and y > root(1, y^2 - x)", "true", POINT, False),
    ],
)
def test_numbers_for_the_block(before: str, after: str, evidence: Any, accepted: bool) -> None:
    assert (objection("instance", before, after, evidence) == "") is accepted
