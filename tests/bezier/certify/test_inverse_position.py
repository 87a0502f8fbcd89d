"""The checker of all joint positions, asked directly: what it names where a certificate is wrong."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from bezier.certify.inverse_position import check_positions
from qe.errors import BudgetExceeded, CertificateRejected
from qe.proof.entry import Entry
from tests.certificates.test_inverse_position import POINT, made
from tests.tables import each
from tests.unit.certify.claims import limits


@pytest.fixture(scope="module")
def right() -> dict[str, Any]:
    return made("ev3-120", POINT)


def test_it_is_accepted(right: dict[str, Any]) -> None:
    check_positions(Entry(right, "payload"), limits())


@each(
    {
        "one more": (lambda p: p.update(count=p["count"] + 1), "payload.count", "not the number of solutions"),
        "a root less": (
            lambda p: p.update(roots=p["roots"][1:], count=p["count"] - len(p["roots"][0]["solutions"])),
            "payload.roots",
            "not all roots with a solution are listed",
        ),
        "another order": (lambda p: p["roots"].reverse(), "payload.roots[1]", "in ascending order"),
        "an overlap": (
            lambda p: p["roots"][1].update(low=p["roots"][0]["low"]),
            "payload.roots[1]",
            "in ascending order",
        ),
        "a common end": (lambda p: p["roots"][1].update(low=p["roots"][0]["high"]), "payload.roots[1]", "ascending"),
        "an empty interval": (
            lambda p: p["roots"][0].update(low=p["roots"][0]["high"]),
            "payload.roots[0]",
            "ascending",
        ),
        "a solution less": (lambda p: p["roots"][0]["solutions"].pop(), "payload.roots[0].solutions", "not the number"),
        "the boxes of another root": (
            lambda p: p["roots"][0].update(solutions=p["roots"][1]["solutions"]),
            "payload.roots[0].solutions",
            "not proved to lie in a box of its own",
        ),
        "no rotation": (lambda p: p.update(rotation=[[[["1", 1]]] * 3] * 3), "payload.rotation", "rows of a rotation"),
    }
)
def test_the_wrong_entry_is_named(change: Any, where: str, reason: str, right: dict[str, Any]) -> None:
    wrong = copy.deepcopy(right)
    change(wrong)
    with pytest.raises(CertificateRejected, match=reason) as refused:
        check_positions(Entry(wrong, "payload"), limits())
    assert refused.value.step == where


def test_a_budget_ends_it(right: dict[str, Any]) -> None:
    with pytest.raises(BudgetExceeded):
        check_positions(Entry(right, "payload"), limits(0))
