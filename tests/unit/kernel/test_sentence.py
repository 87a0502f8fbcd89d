"""Sentences decided by a point or by multipliers: the certificate must be about this very sentence."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import Any

import pytest

from qe.convex.optimum import minimize
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.proof.certificate import Certificate
from tests.certificates.producing import cell_table
from tests.unit.certify.claims import objection

RULE = "convex"


@lru_cache
def point(text: str, names: str, *values: int) -> Any:
    order = tuple(names.split())
    matrix = convert(read(text), Ring.of(order))
    return Certificate.witness(matrix, order, [Fraction(v) for v in values]).to_data()


@lru_cache
def multipliers(text: str, names: str = "x y") -> Any:
    ring = Ring.of(tuple(names.split()))
    found = minimize(ring.constant(0), convert(read(text), ring)).certificate
    assert found is not None
    return found.to_data()


EMPTY = "x^2 + y^2 <= 1 and x > 1"


@pytest.mark.parametrize(
    ("before", "after", "certificate"),
    [
        ("ex x, y. x*y = 6 and x < y", "true", point("x*y = 6 and x < y", "x y", 2, 3)),
        ("all x. x^2 > 1", "false", point("x^2 <= 1", "x", 1)),
        (f"ex x, y. {EMPTY}", "false", multipliers(EMPTY)),
        (f"ex x, y. {EMPTY} and x^3 < y", "false", multipliers(EMPTY)),  # more conjuncts
        ("all x, y. x^2 + y^2 > 1 or x <= 1", "true", multipliers(EMPTY)),
    ],
)
def test_a_sentence_is_decided(before: str, after: str, certificate: Any) -> None:
    for rule in (RULE, "point or multipliers"):
        assert objection(rule, before, after, {"certificate": certificate}) == ""


@pytest.mark.parametrize(
    ("before", "after", "certificate", "reason"),
    [
        ("ex x, y. x*y = 6 and x < y", "false", point("x*y = 6 and x < y", "x y", 2, 3), "expected a point"),
        ("ex x, y. x*y = 6 and x < y", "true", point("x*y = 6 and x <= y", "x y", 2, 3), "not the formula"),
        ("ex x, y. x*y = 6 and x < y", "true", point("x*y = 6", "x y", 2, 3), "not the formula"),
        ("ex x, y. x*y = 6 and x < y", "true", point("x*y = 6 and x < y", "x y", 3, 2), "do not satisfy"),
        ("ex x, y. x*y = a and x < y", "true", point("x*y = 6 and x < y", "x y", 2, 3), "a sentence of one block"),
        ("ex x. all y. x*y = 0", "true", point("x*y = 0", "x y", 0, 0), "not the formula"),
        ("all x. x^2 > 1", "true", point("x^2 <= 1", "x", 1), "expected a point"),
        ("ex x. x > 1", "true", point("u > 1", "u", 2), "other variables"),
        ("1 > 0", "true", point("x > 1", "x", 2), "a sentence of one block"),
        (f"ex x, y. {EMPTY}", "true", multipliers(EMPTY), "expected a point"),
        ("ex x, y. x^2 + y^2 <= 1 and x >= 1", "false", multipliers(EMPTY), "not a conjunct"),
        (f"ex x, y. {EMPTY} or y > 7", "false", multipliers(EMPTY), "not a conjunct"),
        ("ex x, y. x^2 + y^2 <= 1 and x > 0", "false", multipliers("x^2 + y^2 <= 1 and x > 0"), "no solution"),
        ("ex x. x^2 < 0", "false", multipliers("u^2 < 0", "u"), "other variables"),
        ("ex x. x^2 < 0", "false", cell_table("x^2 < 0", "x", "E").to_data(), "expected a point"),
    ],
)
def test_what_is_about_something_else(before: str, after: str, certificate: Any, reason: str) -> None:
    assert reason in objection(RULE, before, after, {"certificate": certificate})


def test_an_instance_is_a_point_for_a_true_sentence() -> None:
    def found(before: str, after: str, certificate: Any) -> str:
        return objection("instance", before, after, {"certificate": certificate})

    good = point("x*y = 6 and x < y", "x y", 2, 3)
    assert found("ex x, y. x*y = 6 and x < y", "true", good) == ""
    assert "expected a point" in found("ex x, y. x*y = 6 and x < y", "false", good)
    assert "expected a point" in found("all x, y. x*y = 6 and x < y", "true", good)
    assert "expected a sentence" in found("ex x. x*y = 6 and x < y", "true", good)
    assert "not the formula" in found("ex x, y. x*y = 6 and x > y", "true", good)
    assert "do not satisfy" in found("ex x, y. x*y = 6 and x < y", "true", point("x*y = 6 and x < y", "x y", 1, 3))
    assert "expected a point" in found("ex x, y. x*y = 6", "true", multipliers(EMPTY))
