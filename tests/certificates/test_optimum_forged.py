"""Forged proofs that an optimum is not attained, or that nothing satisfies the conditions: each breaks one rule."""

from __future__ import annotations

import json
from typing import Any

import pytest

import qe
from qe.certify.verify import verify_json
from tests.certificates.mutation import EVIDENCE, PLACE, evidence_in, replaced

Link = dict[str, list[list[str]]]


def numbers(*values: int) -> list[list[str]]:
    return [[str(v)] for v in values]


def link(weights: list[list[str]], equations: int) -> Link:
    """Weights of the constraints, and zeros for the equations known by then."""
    return {"weights": weights, "derived": numbers(*[0] * equations)}


def forged(constraints: str, links: list[Link] | None) -> Any:
    """The least x, which is 0 and attained, turned into the claim that it is not: seen from the origin."""
    found = qe.minimize("x", constraints)
    assert found.value == 0 and found.attained
    whole = json.loads(found.certificate.to_json())
    payload = evidence_in(whole)
    problem = payload["problem"]["constraints"]
    payload["values"] = [next(([c] for c, exponents in p["terms"] if not any(exponents)), ["0"]) for p in problem]
    payload["inner"] = {"field": payload["field"], "point": payload["point"]}
    payload |= {"point": numbers(0, 0), "attained": False, "unique": False}
    if links is not None:
        payload["links"] = links
    return verify_json(replaced(whole, EVIDENCE, payload))


KNOWN = 3 + 3
"""Equations of the objective and of the one constraint with a multiplier: n + 1 each in n = 2 variables."""


@pytest.mark.parametrize(
    ("constraints", "links", "step"),
    [
        ("x >= 0 and y > 0 and y < 1", None, f"{PLACE}.links"),
        ("x >= 0 and y > 0 and y < 1", [], f"{PLACE}.links"),
        # -y + (y - 1) has no slope, but is negative, as the second condition is not active
        ("x >= 0 and y > 0 and y < 1", [link(numbers(0, 1, 1), KNOWN)], f"{PLACE}.links[0].weights"),
        # 2*(-y) + (2*y) with a negative weight for 2*y >= 0
        (
            "x >= 0 and y > 0 and y < 1 and x + 2*y >= 0",
            [link(numbers(1, 2, 0, -1), KNOWN)],
            f"{PLACE}.links[0].weights[3]",
        ),
        ("x >= 0 and y > 0 and y < 1", [link(numbers(0, 1, 0), KNOWN)], f"{PLACE}.links[0]"),
        ("x >= 0 and y > 0 and y < 1", [link(numbers(0, 0, 0), KNOWN)], f"{PLACE}.links[0]"),
        ("x >= 0 and y > 0 and y < 1", [link(numbers(0, 1, 0), KNOWN - 1)], f"{PLACE}.links[0].derived"),
    ],
)
def test_a_forged_proof_that_an_optimum_is_not_attained_is_rejected(
    constraints: str, links: list[Link] | None, step: str
) -> None:
    verdict = forged(constraints, links)
    assert not verdict.accepted and verdict.step.startswith(step), verdict


def test_links_where_none_are_needed_are_rejected() -> None:
    for objective, constraints in (("x", "x > 0"), ("x", "x >= 0"), ("x", "x <= 0")):
        whole = json.loads(qe.minimize(objective, constraints).certificate.to_json())
        payload = {**evidence_in(whole), "links": [link(numbers(1), 2)]}
        assert not verify_json(replaced(whole, EVIDENCE, payload)).accepted


def test_the_last_link_has_to_exclude_a_strict_condition() -> None:
    whole = json.loads(qe.minimize("x", "x >= y^2 and x >= z^2 and y > z").certificate.to_json())
    links = evidence_in(whole)["links"]
    assert len(links) == 2 and verify_json(json.dumps(whole)).accepted
    verdict = verify_json(replaced(whole, (*EVIDENCE, "links"), links[:1]))
    assert not verdict.accepted and verdict.step == f"{PLACE}.links"
    verdict = verify_json(replaced(whole, (*EVIDENCE, "links"), links[1:]))
    assert not verdict.accepted


@pytest.mark.parametrize("status", [[], ["optimal"], {}, {"optimal": 1}, None, True, 1, "", "Optimal"])
def test_a_status_of_another_type_is_refused_and_breaks_nothing(status: Any) -> None:
    whole = json.loads(qe.minimize("x", "x >= 0").certificate.to_json())
    verdict = verify_json(replaced(whole, (*EVIDENCE, "status"), status))
    assert not verdict.accepted and verdict.step == f"{PLACE}.status"
