"""Elimination sets with roots of cubics: accepted; altered evidence and broken producers are not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.vs import candidates, clusters, cubic, points, roots
from qe.formula.syntax import Not, Relation
from qe.kernel.cubic_root import asks_one
from tests.certificates.elimination_claims import accepted, claimed, evidence_for, examined, unchecked
from tests.certificates.test_elimination_sets import over_ring

EXAMPLES = [
    "ex x. a*x^3 + b*x^2 + c*x + d = 0 and x > 0",
    "ex x. x^3 + a*x + b = 0 and c*x + d > 0",
    "ex x. x^3 + a*x + b = 0 and x^2 + c*x + d < 0",
    "ex x. x^3 + a*x + b < 0 and x > c and x < d",
    "ex x. x^3 + a*x^2 + b*x + c <= 0 and x >= 0 and x <= 1",
    "ex x. a*x^3 + b*x + c > 0 and x^2 < d",
    "all x. x^3 + a*x + b > 0 or x < c",
    "ex x, y. x^3 + a*x = y and y > b and y < c*x and x < d",
]


@pytest.mark.parametrize("text", EXAMPLES)
def test_every_step_is_checked(text: str) -> None:
    answer = qe.eliminate(text, method="vs", check=True, process=False)
    assert answer.unchecked_steps == () and answer.certificate is not None
    assert qe.verify(qe.Certificate.from_json(answer.certificate.to_json())).accepted


@settings(max_examples=4, deadline=None)
@given(st.integers(0, 10**6))
def test_what_is_accepted_is_true_and_what_is_produced_is_accepted(seed: int) -> None:
    examined(seed, 3, 3)


@pytest.mark.deep
def test_no_altered_claim_that_is_false_is_accepted() -> None:
    looked, right = examined(1994, 1_500, 3)
    assert looked > 3_000
    assert right < looked / 2


SETS = ["x^3 + a*x + b < 0 and x > a", "a*x^3 + x = b and x > a and x < 1", "x^3 - x >= a and x <= b"]


@pytest.mark.parametrize("text", SETS)
def test_no_point_can_be_left_out_that_is_needed(text: str) -> None:
    body = over_ring(text)
    found = evidence_for(body, 3)
    assert found is not None
    whole, evidence = found["body"], found["evidence"]
    assert accepted(whole, claimed(whole, evidence), evidence)
    for k in range(len(evidence["points"])):
        fewer = {**evidence, "points": evidence["points"][:k] + evidence["points"][k + 1 :]}
        assert not accepted(whole, claimed(whole, fewer), fewer)


Break = Callable[[pytest.MonkeyPatch], None]


def _no_lower_degree(patch: pytest.MonkeyPatch) -> None:
    whole = candidates._roots

    def found(given: Any, coefficients: Any, *others: Any) -> Any:
        return [c for c in whole(given, coefficients, *others) if isinstance(c.point, points.CubicRoot)]

    patch.setattr(candidates, "_roots", found)


def _rows(patch: pytest.MonkeyPatch, rows: Any) -> None:
    patch.setattr(roots, "CUBIC", rows)


def _simple_roots_only(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, tuple((k, Relation.GT if r is Relation.GE else r, s) for k, r, s in roots.CUBIC))


def _no_single_root(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, roots.CUBIC[1:])


def _other_root(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, tuple((4 - k if k else 0, r, s) for k, r, s in roots.CUBIC[:2]) + roots.CUBIC[2:])


def _wrong_direction(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, tuple((k, r, -s) for k, r, s in roots.CUBIC))


def _no_epsilon(patch: pytest.MonkeyPatch) -> None:
    rows = candidates.ROWS[3]
    patch.setitem(candidates.ROWS, 3, lambda coefficients, epsilon: rows(coefficients, 0))


def _always_one_thing(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(clusters, "asks_one", lambda formula, x, e: True)


def _wrong_line(patch: pytest.MonkeyPatch) -> None:
    first, second = cubic.TABLE[3]
    patch.setitem(cubic.TABLE, 3, (first, (second[0], first[1])))


def _wrong_rank(patch: pytest.MonkeyPatch) -> None:
    ranked = cubic._ranked
    patch.setattr(cubic, "_ranked", lambda e, rank, *others: ranked(e, cubic.Rank.LEAST, *others))


def _leading_sign_forgotten(patch: pytest.MonkeyPatch) -> None:
    remainder = cubic.remainder
    patch.setattr(cubic, "remainder", lambda f, x, e: (remainder(f, x, e)[0], False))


def _complex_zeros_forgotten(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(cubic, "_at_only", lambda e, u, v, w, r, atom: atom(cubic.symmetric(e, u, v, w)[2], r))


def _double_roots_forgotten(patch: pytest.MonkeyPatch) -> None:
    rule = cubic._at_critical
    patch.setattr(
        cubic, "_at_critical", lambda e, u, r, atom: rule(replace(e, index=2 if e.index != 2 else 1), u, r, atom)
    )


BROKEN = [
    (_no_lower_degree, "ex x. a*x^3 + b*x < 1 and x > b"),
    (_no_lower_degree, "ex x. a*x^3 + b*x = 1 and x > b and x < 1"),
    (_simple_roots_only, "ex x. x^3 + a*x + b = 0 and x > a and x < 1"),
    (_simple_roots_only, "ex x. x^3 + a*x + b <= 0 and x > a"),
    (_no_single_root, "ex x. x^3 + a*x + b = 0 and x > a"),
    (_other_root, "ex x. x^3 + a*x + b = 0 and x > a and x < 1"),
    (_wrong_direction, "ex x. x^3 + a*x + b < 0 and x > a"),
    (_no_epsilon, "ex x. x^3 + a*x + b < 0 and x > a"),
    (_always_one_thing, "ex x. x^3 + a*x + b = 0 and x > a and x < b"),
    (_wrong_line, "ex x. x^3 + a*x + b = 0 and x^2 + a*x < 1 and x < b"),
    (_wrong_rank, "ex x. x^3 + a*x + b = 0 and x > a and x < b"),
    (_leading_sign_forgotten, "ex x. b*x^3 + a*x + 1 = 0 and x^3 < a and x < 2"),
    (_complex_zeros_forgotten, "ex x. x^3 + a*x + b = 0 and x^2 + a*x > b"),
    (_double_roots_forgotten, "ex x. x^3 + a*x + b = 0 and 3*x^2 + a > 0 and x > 1"),
]


@pytest.mark.parametrize(("breaking", "text"), BROKEN, ids=[f"{b.__name__} {k}" for k, (b, _) in enumerate(BROKEN)])
def test_a_broken_producer_is_caught(breaking: Break, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each side condition switched off: its steps are accepted no more."""
    assert unchecked(text, 3) == ()
    breaking(monkeypatch)
    assert unchecked(text, 3) != ()


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"branch": 5}, "0 to 4"),
        ({"branch": -1}, "0 to 4"),
        ({"branch": 4, "shift": 1}, "0 for any root"),
        ({"branch": 4}, "more than one thing"),
        ({"coefficients": ["1", "0", "0", "0", "a"]}, "two to four"),
        ({"coefficients": ["1", "b", "0", "a"]}, "may be none here"),
        ({"branch": 0}, "may be none here"),
    ],
)
def test_what_is_no_root_of_a_cubic(change: dict[str, Any], word: str) -> None:
    body = over_ring("x^3 + a*x + b = 0 and x > a and x < 1")
    found = evidence_for(body, 3)
    assert found is not None
    evidence = found["evidence"]
    point = next(p for p in evidence["points"] if p["point"]["branch"] == 1)
    point["point"].update(change)
    with pytest.raises(qe.CertificateRejected, match=word):
        claimed(body, evidence)


def test_some_root_is_not_put_under_a_negation() -> None:
    """That not x > 0 holds at some root is not that x > 0 holds at none: x^3 = x has roots on both sides."""
    positive = over_ring("x > 0 and x < 2")
    cube = over_ring("x^3 - x > 0").poly.coefficients(2)  # type: ignore[union-attr]
    assert asks_one(over_ring("x > 0"), 2, cube)
    assert not asks_one(Not(positive.args[0]), 2, cube)  # type: ignore[union-attr]
