"""False sentences: every conjunction of the body has a system without real solution among its members."""

from __future__ import annotations

from typing import Any

import pytest

from qe.errors import Unable
from qe.expert.no_solutions import MOST_CONJUNCTIONS, check_no_solutions
from tests.tables import each
from tests.unit.certify.claims import objection


def system(equations: list[str], conditions: list[list[str]] = [], order: str = "x", **other: Any) -> Any:
    count = len(order)
    payload: dict[str, Any] = {
        "order": list(order),
        "equations": equations,
        "conditions": conditions,
        "weights": [1] * count,
        "form": [1] * count,
        "solutions": [],
        **other,
    }
    return payload


def by(*systems: Any) -> dict[str, Any]:
    return {"systems": list(systems)}


NONE = system(["x^2 + 1"])
FAR = system(["x^2 - 2"], [["x - 2", ">"]])


@each(
    ("ex x. x^2 + 1 = 0", "false", by(NONE), ""),
    ("all x. x^2 + 1 /= 0", "true", by(NONE), ""),
    ("ex x, y. x^2 + 1 = 0 and y > x", "false", by(NONE), ""),
    ("ex x. x^2 = 2 and x > 2", "false", by(FAR), ""),
    ("ex x. x^2 = 2 and x > 2 or x^2 + 1 = 0", "false", by(FAR, NONE), ""),
    ("ex x. (x^2 = 2 or x^2 + 1 = 0) and x > 2", "false", by(FAR, NONE), ""),
    ("ex x. (x^2 = 2 or x^2 + 1 = 0) and x > 2", "false", by(FAR), "not refuted"),
    ("ex x. x^2 = 2 and x > 1", "false", by(FAR), "not refuted"),
    ("ex x. x^2 = 2", "false", by(FAR), "not refuted"),
    ("ex x. x^2 = 3 and x > 2", "false", by(FAR), "not refuted"),
    ("ex x. x^2 + 1 = 0", "false", by(), "not refuted"),
    ("ex x. x^2 + 1 = 0", "true", by(NONE), "expected a sentence"),
    ("ex x. x^2 + 1 = 0 and a > 0", "false", by(NONE), "expected a sentence"),
    ("x^2 + 1 = 0", "false", by(NONE), "expected a sentence"),
    ("ex x. x^2 + 1 = 0 and (all y. y > x)", "false", by(NONE), "expected a sentence"),
    ("ex x. x > 2", "false", by(system(["x^2 - 2"])), "there are 2 solutions"),
)
def test_every_conjunction_is_refuted(before: str, after: str, evidence: Any, reason: str) -> None:
    found = objection(check_no_solutions, before, after, evidence)
    assert (reason in found) if reason else found == ""


def test_a_certificate_with_solutions_refutes_nothing() -> None:
    field = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
    one = system(["x"], solutions=[{"field": field, "values": [["0"]]}])
    assert "no solution" in objection(check_no_solutions, "ex x. x = 0", "false", by(one))
    point = {"order": [], "values": []}
    assert "missing" in objection(check_no_solutions, "ex x. x = 0", "false", by(point))


def test_a_system_in_other_variables_refutes_nothing() -> None:
    other = system(["w^2 + 1"], order="w")
    assert "other variables than those" in objection(check_no_solutions, "ex x. x^2 + 1 = 0", "false", by(other))


def test_long_normal_forms_are_not_attempted() -> None:
    """2^k conjunctions, none of which is refuted before the limit."""
    parts = " and ".join(f"(x = {k} or x + y = {k})" for k in range(MOST_CONJUNCTIONS.bit_length()))
    bad = system(["x^2 + 1"])
    with pytest.raises(Unable, match=f"more than {MOST_CONJUNCTIONS} conjunctions"):
        objection(check_no_solutions, f"ex x, y. x^2 + 1 = 0 and {parts}", "false", by(bad))
