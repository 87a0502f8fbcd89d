"""Certificates of optima: accepted as made, rejected when any number in them is altered, or when they are forged.

Every leaf is altered twice: with the digest as it was (always rejected) and with a fresh digest, so that only the
meaning can reject it. What then survives has to be a true certificate about the altered problem, which is solved anew.
"""

from __future__ import annotations

import json
import random
from fractions import Fraction
from typing import Any

import pytest

import qe
from qe.certify.verify import verify, verify_json
from qe.convex.optimum import Optimum, minimize
from qe.exact.ring import Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Relation
from tests.certificates.false_claims import KINDS
from tests.certificates.mutation import EVIDENCE, PLACE, evidence_in, leaves, replaced, without
from tests.optimum_problems import at_most_zero, cubic, quadratic

RING = Ring.of(("x", "y", "z", "v"))
X, Y, Z, V = (RING.gen(i) for i in range(4))
DISC = atom(X * X + Y * Y - 3, Relation.LE)


def _of(parts) -> Optimum:
    return minimize(parts[0], at_most_zero(parts[1]))


def _tangent(objective, relation: Relation) -> Optimum:
    discs = (atom(X * X + Y * Y - 1, relation), atom((X - 2) * (X - 2) + Y * Y - 1, Relation.LE))
    return minimize(objective, conj((*discs, atom(Z * Z - 2, Relation.LE), atom(X + Z - Y, Relation.GE))))


CASES = {
    "cubic": lambda: _of(cubic((-4, 2), (3, 2), 21)),
    "quadratic hemisphere": lambda: _of(quadratic((-3, 1, 3), (1, 4, 3), 32, hemisphere=True)),
    "infeasible": lambda: _of(quadratic((-1, 3, 3), (1, 3, 3), 19)),
    "face": lambda: _tangent(Y + Z, Relation.LE),
    "empty strict": lambda: _tangent(Y, Relation.LT),
    "not attained": lambda: minimize(X + Y, atom(X * X + 2 * Y * Y - 3, Relation.LT)),
    "not attained by a link": lambda: minimize(
        X, conj((atom(X - Y * Y, Relation.GE), atom(X - Z * Z, Relation.GE), atom(Y - Z, Relation.GT)))
    ),
    "not attained by a link, irrational": lambda: minimize(
        X + Y, conj((DISC, atom(Z * Z + (X + Y) ** 2 - 6, Relation.LE), atom(Z, Relation.GT)))
    ),
    "empty by a link, irrational": lambda: minimize(
        X + Y, conj((DISC, atom((Z - X) ** 2 - V, Relation.LE), atom(V, Relation.LE), atom(Z - X, Relation.LT)))
    ),
    "unbounded": lambda: minimize(X, conj((atom(Y - 1, Relation.LE), atom(Z - X, Relation.LE)))),
    "equations": lambda: minimize(
        X * X + Y * Y, conj((atom(X + Y - 1, Relation.EQ), atom(X - 2 * Y, Relation.LE), atom(Z - 1, Relation.EQ)))
    ),
}


@pytest.fixture(params=CASES, scope="module")
def whole(request: pytest.FixtureRequest) -> Any:
    """A certificate as JSON data."""
    return json.loads(CASES[request.param]().certificate.to_json())


def _alterations(value: Any) -> list[Any]:
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, -1]
    try:
        number = Fraction(value)
    except ValueError:
        return [value + "x", ""]
    step = max(abs(number) / 10**9, Fraction(1, 10**9))
    return [str(n) for n in {-number, number + 1, number * 2, number + step} if n != number]


def test_accepted_after_a_round_trip(whole: Any) -> None:
    assert verify_json(json.dumps(whole)).accepted


def test_every_altered_leaf_is_rejected(whole: Any) -> None:
    for path, value in list(leaves(evidence_in(whole)))[::3]:  # the digest is compared before anything else
        for other in _alterations(value)[:1]:
            verdict = verify_json(replaced(whole, (*EVIDENCE, *path), other, signed=False))
            assert not verdict.accepted, (path, value, other)
            assert verdict.step


def test_altered_meaning_is_rejected_whatever_the_digest_says(whole: Any) -> None:
    """Every entry is altered in one way, entries of one kind in different ones."""
    _accepted_only_if_true(whole, 1)


@pytest.mark.deep
def test_every_altered_meaning_is_rejected_whatever_the_digest_says(whole: Any) -> None:
    _accepted_only_if_true(whole, 4)


def _accepted_only_if_true(whole: Any, ways: int) -> None:
    survivors, rng = 0, random.Random(0)
    for place, (path, value) in enumerate(leaves(evidence_in(whole))):
        others = _alterations(value)
        first = place % len(others)
        for other in (others[first:] + others[:first])[:ways]:
            text = replaced(whole, (*EVIDENCE, *path), other)
            if verify_json(text).accepted:
                survivors += 1
                assert not KINDS["optimum"][1](rng, json.loads(text)), (path, value, other)
    assert survivors < 60


def test_every_entry_left_out_is_rejected(whole: Any) -> None:
    payload = evidence_in(whole)
    for name in list(payload):
        altered = {**payload, name: None}
        assert not verify_json(replaced(whole, EVIDENCE, altered)).accepted, name
        del altered[name]
        assert not verify_json(replaced(whole, EVIDENCE, altered)).accepted, name
    for name in ("point", "multipliers", "values", "derived"):
        for i in range(len(payload.get(name, []))):
            assert not verify_json(without(whole, (*EVIDENCE, name), i)).accepted, (name, i)


def test_digest_of_a_certificate_in_memory_is_not_needed() -> None:
    assert verify(CASES["cubic"]().certificate).accepted


@pytest.mark.parametrize(
    ("p", "interval", "accepted"),
    [
        (["-2", "0", "1"], ["1", "2"], True),
        (["-2", "0", "1"], ["-2", "2"], False),  # two roots
        (["-2", "0", "1"], ["2", "3"], False),  # none
        (["4", "0", "-4", "0", "1"], ["1", "2"], True),  # a double root, but the only one
        (["2", "0", "-1"], ["7/5", "3/2"], False),  # not normalised
        (["-4", "0", "2"], ["7/5", "3/2"], False),  # not primitive
        (["-2"], ["1", "2"], False),
        (["-2", "0", "1"], ["1"], False),
        (["-4", "0", "1"], ["2", "2"], True),  # reducible, but 2 is a root
        (["-4", "0", "1"], ["1", "1"], False),
    ],
)
def test_field_of_a_certificate(p: list[str], interval: list[str], accepted: bool) -> None:
    whole = json.loads(minimize(X * X - 2 * X, conj((atom(X, Relation.GE),))).certificate.to_json())
    field = {"minimal_polynomial": p, "interval": interval}
    assert verify_json(replaced(whole, (*EVIDENCE, "field"), field)).accepted is accepted


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
