"""The primitive "root": where signs at two places, or far out, show that a value is taken."""

from __future__ import annotations

from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.formula.traverse import conjuncts
from qe.kernel.root import root_goals
from qe.kernel.step import Claim
from qe.proof.entry import Entry
from qe.proving.lemmas import refuting
from tests.unit.certify.claims import NO_LEMMAS, RING, formula, limits, objection

ZERO, ONE, A = ["0", "1"], ["1", "1"], ["a", "1"]


def refused(block: str, low: Any, high: Any, rising: int, given: str = "true") -> str:
    """Why it is not shown that the block is true, with all lemmas that the prover finds."""
    evidence = {"low": low, "high": high, "rising": rising, "theory": NO_LEMMAS}
    context = conjuncts(formula(given)) if given != "true" else ()
    claim = Claim("root", formula(block), formula("true"), RING, Entry(evidence, "evidence"), "step")
    try:
        goals = root_goals(claim, context)
    except CertificateRejected as error:
        return str(error)
    theory = refuting(goals, RING, limits()) or NO_LEMMAS
    return objection("root", block, "true", {**evidence, "theory": theory}, given)


@pytest.mark.parametrize(
    ("block", "low", "high", "rising", "given"),
    [
        ("ex x. x^3 + a*x + b = 0", None, None, 0, "true"),
        ("ex x. c*x^3 = b", None, None, 0, "c /= 0"),
        ("ex x. x^2 = b", ZERO, None, 1, "b >= 0"),
        ("ex x. x^2 = b and x >= 0", ZERO, None, 1, "b >= 0"),
        ("ex x. x = b and x >= a", A, None, 1, "a <= b"),
        ("ex x. c*x^3 = b and x >= 0", ZERO, None, -1, "c < 0 and b <= 0"),
        ("ex x. x^2 > b", None, None, 1, "true"),
        ("ex x. c*x^3 > b", None, None, 0, "c /= 0"),
        ("ex x. c*x <= b", None, None, 0, "c /= 0"),
        ("ex x. c*x < b", None, None, -1, "c > 0"),
        ("ex x. c*x^2 + x /= b", None, None, 1, "c /= 0"),
    ],
)
def test_a_value_that_is_taken(block: str, low: Any, high: Any, rising: int, given: str) -> None:
    assert refused(block, low, high, rising, given) == ""


@pytest.mark.parametrize(
    ("block", "low", "high", "rising", "given"),
    [
        ("ex x. x^2 = b", None, None, 0, "true"),
        ("ex x. x^2 = b", ZERO, None, 1, "true"),
        ("ex x. x^2 = b and x > 0", ZERO, None, 1, "b >= 0"),  # the root may be the end
        ("ex x. x^2 = b and x <= 0", ZERO, None, 1, "b >= 0"),
        ("ex x. c*x^3 = b", None, None, 0, "true"),
        ("ex x. x^2 = b and x >= 0 and x <= 1", ZERO, ONE, 1, "b >= 0"),
        ("ex x. x^2 = b and x >= 0", ZERO, None, 0, "b >= 0"),
        ("ex x. x^2 >= b and x >= 0", ZERO, None, 1, "b >= 0"),
        ("ex x. x^3 = b", None, None, 1, "true"),
        ("ex x. x = 0 and x >= 1 and x <= a", ONE, A, -1, "a <= 0"),  # the places change order
        ("ex x. c*x = b", None, None, 1, "c = 0"),  # no equation holds far out
        ("ex x. c*x > b", None, None, 1, "c >= 0"),
        ("ex x. c*x > b", None, None, 0, "c >= 0"),
        ("ex x. c*x >= b", None, None, 1, "c >= 0"),  # with c = 0 nothing rises
        ("ex x. c*x >= b", None, None, 0, "c >= 0"),
        ("ex x. c*x^2 > b", None, None, 0, "c /= 0"),
        ("ex x. x^2 < b", None, None, 1, "true"),
        ("ex x. x^2 = b and x >= 0", ["x", "1"], None, 1, "b >= 0"),
        ("ex x. x^2 = b and x >= 0", ["0", "-1"], None, 1, "b >= 0"),
        ("ex x. x^3 = b and x <= 0", ["0", "-1"], None, 1, "b >= 0"),  # the other side of the place
        ("ex x, y. x^2 = y", ZERO, None, 1, "true"),
        ("ex x. b = 0", None, None, 0, "true"),
    ],
)
def test_a_value_that_need_not_be_taken(block: str, low: Any, high: Any, rising: int, given: str) -> None:
    assert refused(block, low, high, rising, given)


@pytest.mark.parametrize(
    ("before", "after"), [("false", "ex x. x = 0"), ("b > 0", "ex x. x = b"), ("ex x. x = 0", "false")]
)
def test_one_of_both_sides_is_true(before: str, after: str) -> None:
    """That the block is true says nothing of what is no constant."""
    evidence = {"low": None, "high": None, "rising": 0, "theory": NO_LEMMAS}
    assert objection("root", before, after, evidence)
    assert not objection("root", "true", "ex x. x = 0", evidence)
