"""Test points as they are read: real where their guard holds, tried with a formula that implies the body."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.verify import verify
from qe.proof.certificate import Certificate, Kind
from tests.unit.certify.claims import NO_LEMMAS, objection, step, written

RULE = "elimination set"


def point(
    coefficients: list[str] | None,
    shift: int = 0,
    branch: int = 0,
    guard: str = "true",
    formula: str | None = None,
    settled: tuple[str, ...] = (),
) -> dict[str, Any]:
    where = None if coefficients is None else {"coefficients": coefficients, "branch": branch, "shift": shift}
    return {
        "point": where,
        "guard": written(guard),
        "formula": None if formula is None else written(formula),
        "settled": [written(s) for s in settled],
    }


def by(*points: dict[str, Any], side: int = 1, parts: Any = None, **others: Any) -> dict[str, Any]:
    return {
        "variable": "x",
        "side": side,
        "quadratics": [],
        "points": list(points),
        "parts": [[] for _ in points] if parts is None else parts,
        **others,
    }


FAR = point([], -1)


@pytest.mark.parametrize(
    ("before", "after", "evidence"),
    [
        ("ex x. x = a and x^2 > b", "a^2 > b", by(point(["-a", "1"]))),
        ("ex x. a*x = b", "a /= 0 or (ex x. a*x = b and a = 0 and b = 0)", None),
        ("ex x. x > a and x < b", "a < b", by(FAR, point(["-a", "1"], 1))),
        ("ex x. x > a and x < b", "a < b", by(point([], 1), point(["-b", "1"], -1), side=-1)),
        ("ex x. x >= a and x < b", "a < b", by(FAR, point(["-a", "1"]))),
        ("ex x, y. x = a and y > x", "ex y. y > a", by(point(["-a", "1"]))),
        ("ex x. x > a", "true", by(point([], 1))),  # one point is enough
    ],
)
def test_sets_of_points(before: str, after: str, evidence: Any) -> None:
    if evidence is None:
        root = point(["-b", "a"], guard="a /= 0")
        kept = point(None, guard="a = 0 and b = 0")
        evidence = by(root, kept)
        after = "a /= 0 or (ex x. a = 0 and b = 0 and a*x = b)"
    assert objection(RULE, before, after, evidence) == ""


@pytest.mark.parametrize(
    ("before", "after", "evidence", "reason"),
    [
        ("ex x. a*x = b", "true", by(point(["-b", "a"])), "may be none here"),
        ("ex x. a*x = b", "a >= 0", by(point(["-b", "a"], guard="a >= 0")), "may be none here"),
        ("ex x. x^2 = a", "true", by(point(["-a", "0", "1"], branch=1)), "may be none here"),
        ("ex x. x > a", "x > 7", by(point(["-a", "1"], 1, guard="x > 7")), "condition on the other variables"),
        ("ex x. x > a and x < b", "true", by(point(["-a", "1"], 1, formula="x > a")), "does not imply"),
        ("ex x. x > a and x < b", "true", by(point(None, formula="x > a")), "does not imply"),
        ("ex x. x > a and x < b", "a < b", by(point(["-a", "1"], 1)), "no point for"),  # -oo is missing
        ("ex x. x > a and x < b", "false", by(FAR), "no point for"),
        ("ex x. x >= a and x <= b", "a < b", by(FAR, point(["-a", "1"], 1)), "no point for"),
        ("ex x. x = a and x^2 > b", "a^2 > b", by(point(["-a", "1"], 0, 1)), "for a root of a quadratic"),
        ("ex x. x^2 = a", "true", by(point(["-a", "0", "1"])), "for a root of a quadratic"),
        ("ex x. x = a", "true", by(point(["-a"])), "two or three polynomials"),
        ("ex x. x = a", "true", by(point(["-x", "1"])), "two or three polynomials"),
        ("ex x. x = a", "true", by(point(["-a", "1"], 2)), "-1, 0 or 1"),
        ("ex x. x = a", "true", by(point([])), "not 0 for infinity"),
        ("ex x. x > a", "a < 0", by(point(["-a", "1"], 1), side=2), "expected -1, 0 or 1"),
        (
            "ex x. x > a and x < b",
            "a < b",
            by(FAR, point(["-a", "1"], 1), variable="a"),
            "of the existential block",
        ),
        ("all x. x > a", "true", by(FAR), "existential block"),
        ("ex x. x > a and (ex y. y > x)", "true", by(FAR), "quantifier-free"),
        ("ex x. x^4 - a*x = b and x > a", "false", by(FAR), "degree of the variable is too high"),
    ],
)
def test_what_is_no_set_of_points(before: str, after: str, evidence: Any, reason: str) -> None:
    assert reason in objection(RULE, before, after, evidence)


@pytest.mark.parametrize(
    ("coefficients", "shift", "settled", "reason"),
    [
        (["-a", "1"], 1, ("x < b",), ""),
        (["-a", "1"], 1, ("x > a",), "may vanish at a point"),  # it holds right of the point and not there
        (["-a", "1"], 1, ("x <= b",), "strict conjuncts"),
        (["-a", "1"], 1, ("x < c",), "strict conjuncts"),
        (["-a", "1"], 0, ("x < b",), "strict conjuncts"),
        ([], -1, ("x < b",), "strict conjuncts"),
    ],
)
def test_settled_atoms(coefficients: list[str], shift: int, settled: tuple[str, ...], reason: str) -> None:
    after = "a < b" if shift else "false"
    found = objection(RULE, "ex x. x > a and x < b", after, by(FAR, point(coefficients, shift, settled=settled)))
    assert reason in found and bool(found) is bool(reason)


def test_nothing_is_settled_where_the_problem_is_kept() -> None:
    kept = point(None, settled=("x > a",))
    assert "strict conjuncts" in objection(RULE, "ex x. x > a and x < b", "ex x. x > a and x < b", by(kept))


LOW = "x < root(1, x^2 - 100)"


def test_a_variable_left_in_a_root_atom_is_not_taken_for_one_outside() -> None:
    """x < -10 and ex x (x < -10 and x = 5) is false; the x left in the root atom is not the one outside."""
    inner = f"ex x. {LOW} and x = 5"
    nested = step("signs", LOW, "true", {"theory": NO_LEMMAS}, given=LOW)
    wrong = step(RULE, inner, "true", by(point(["-5", "1"]), parts=[[nested]]), given=LOW)
    evidence = by(point(["-5", "1"]), parts=[[nested]])
    assert "root atoms" in objection(RULE, inner, "true", evidence, given=LOW)
    wrong = step(RULE, inner, "true", evidence, given=LOW)
    payload = {
        "order": ["x"],
        "start": ["and", written(LOW), written(inner)],
        "answer": written(LOW),
        "steps": [{**wrong, "at": [1]}],
    }
    verdict = verify(Certificate(Kind.DERIVATION, payload))
    assert (verdict.step, verdict.reason) == ("payload.start", "x is both free and bound")


def test_a_root_atom_without_the_variable_stays_as_it_is() -> None:
    text = "b > root(1, b^2 - c)"
    assert objection(RULE, f"ex x. x = a and {text}", text, by(point(["-a", "1"]))) == ""
