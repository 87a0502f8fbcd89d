"""All real solutions of a system: these, and as many as there are."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest

from qe.errors import CertificateRejected, Unable
from qe.expert.sentences import Sentence
from qe.expert.solutions import check_solutions
from qe.proof.entry import Entry
from tests.tables import each
from tests.unit.certify.claims import limits

SQRT2 = {"minimal_polynomial": ["-2", "0", "1"], "interval": ["1", "2"]}
MINUS = {"minimal_polynomial": ["-2", "0", "1"], "interval": ["-2", "-1"]}


def point(field: Any, *values: list[str]) -> dict[str, Any]:
    return {"field": field, "values": list(values)}


def checked(evidence: dict[str, Any]) -> Sentence:
    return check_solutions(Entry(evidence, "evidence"), limits())


def payload(**other: Any) -> dict[str, Any]:
    """x^2 = 2 and y = x + 1."""
    return {
        "order": ["x", "y"],
        "equations": ["x^2 - 2", "x - y + 1"],
        "conditions": [],
        "weights": [1, 1],
        "form": [1, 0],
        "solutions": [point(MINUS, ["0", "1"], ["1", "1"]), point(SQRT2, ["0", "1"], ["1", "1"])],
        **other,
    }


ONE = [payload()["solutions"][1]]


@each(
    {},
    {"weights": [3, 2]},
    {"solutions": payload()["solutions"][::-1]},
    {"conditions": [["x", ">"]], "solutions": ONE},
    {"conditions": [["y", ">"]], "solutions": ONE},
    {"conditions": [["x", ">"], ["y - 2", ">="], ["x - 1", "/="]], "solutions": ONE},
    {"conditions": [["x^2 - 2", ">="]]},
    {"conditions": [["x^2 - 2", ">"]], "solutions": []},
    {"conditions": [["x^2 - 2", "/="]], "solutions": []},
    {"conditions": [["x", "/="]]},
)
def test_the_solutions(other: Any) -> None:
    checked(payload(**other))


@each(
    ({"solutions": ONE}, "there are 2 solutions, and 1 are listed"),
    ({"solutions": []}, "there are 2 solutions"),
    ({"solutions": ONE * 2}, "meets that of another"),
    ({"conditions": [["x", ">"]]}, "do not satisfy a condition"),
    ({"conditions": [["x^2 - 2", ">"]]}, "do not satisfy a condition"),
    ({"conditions": [["x", "<"]]}, 'expected ">" or ">=" or "/="'),
    ({"form": [0, 1]}, "the linear form has another value"),
    ({"form": [2, 0]}, "the linear form has another value"),
    ({"form": [1]}, "expected 2 numbers"),
    ({"form": [1, True]}, "expected an integer"),
    ({"weights": [1]}, "expected 2 numbers"),
    ({"weights": [1, 0]}, "expected an integer of at least 1"),
    ({"weights": [1, 10**6]}, "at most"),
    ({"order": ["x", "x"]}, "listed twice"),
    ({"order": []}, "different variables"),
    ({"equations": ["x^2 - 2"], "solutions": []}, "infinitely many"),
    ({"equations": ["x^2 - 2", "x - y + 2"]}, "do not satisfy an equation"),
    ({"solutions": [point(SQRT2, ["0", "1"])]}, "expected 2 numbers"),
)
def test_what_is_refused(other: Any, reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        checked(payload(**deepcopy(other)))


def test_rational_solutions_have_their_own_field() -> None:
    three = {"minimal_polynomial": ["-3", "2"], "interval": ["3/2", "3/2"]}
    given = payload(order=["x"], equations=["2*x - 3"], weights=[1], form=[1], solutions=[point(three, ["3/2"])])
    checked(given)
    with pytest.raises(CertificateRejected):
        checked({**given, "solutions": [point(three, ["1"])]})


def test_too_many_conditions() -> None:
    with pytest.raises(Unable, match="signatures"):
        checked(payload(conditions=[["x", ">"]] * 9, solutions=[]))
