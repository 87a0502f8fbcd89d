"""Conjunctions in which products are told by the signs of their factors."""

from __future__ import annotations

import pytest

import qe
from qe.elimination.protocol import Context
from qe.engine.factor_signs import has_products, signs_of_factors
from qe.engine.run import outcome_for
from qe.formula.features import length
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each

LENGTHS = "p > 0 and q > 0 and r > 0"
CUBIC = "p^3 - p^2*q - p*q^2 + q^3 - p^2*r + 2*p*q*r - q^2*r - p*r^2 - q*r^2 + r^3 < 0"


def shortened(given: Formula, decide=outcome_for) -> tuple[Formula, RunLog]:
    context = Context(Options(certify=True), Budget(), RunLog(), decide)
    assert has_products(given, context)
    return signs_of_factors(given, context), context.log


@each(
    ("p > 0 and p*(p - q)*(p + q) < 0 and q > 0", "p > 0 and p - q < 0"),
    (f"{LENGTHS} and {CUBIC}", "p + q - r > 0 and p - q + r > 0 and p - q - r < 0"),
    ("x^2 - y^2 < 0 and x + y > 0", "x - y < 0 and x + y > 0"),
    ("x*y - x >= 0 and x^2 + y^2 < 1/2", "x <= 0 and 2*x^2 + 2*y^2 - 1 < 0"),
)
def test_a_product_is_told_by_signs_of_its_factors(given: str, expected: str) -> None:
    found, log = shortened(read(given))
    assert length(found) <= length(read(expected))
    assert qe.equivalent(found, read(expected)) and qe.equivalent(found, read(given))
    (step,) = log.steps()
    assert accepted(step) or "1/2" in given  # which takes a decomposition


@each("x*y > 0 and x + y < 3", "x*y >= 0 and x^2 - y^2 <= 0 and z > 0", "(x - 9/10)*(x + 7/3) >= 0 and y > x")
def test_factors_without_a_sign_of_their_own_stay(given: str) -> None:
    found, log = shortened(read(given))
    assert found == read(given) and not [*log.steps()]


def test_signs_at_few_points_are_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    """At no point that is tried first is x*y positive with both negative: it is found by deciding."""
    monkeypatch.setattr("qe.engine.redundant.SMALL", (1, 2, 3))
    monkeypatch.setattr("qe.engine.redundant.CLOSE", (1, 2, 3))
    given = read("x*y > 0 and x^2 + y^2 > 1/9 and x*z > 0")
    found, _ = shortened(given)
    assert qe.equivalent(found, given)


def test_medians_of_a_triangle_were_told_by_a_cubic() -> None:
    triangle = "a > 0 and b > 0 and c > 0 and a < b + c and b < c + a and c < a + b"
    medians = "4*p^2 = 2*b^2 + 2*c^2 - a^2 and 4*q^2 = 2*c^2 + 2*a^2 - b^2 and 4*r^2 = 2*a^2 + 2*b^2 - c^2"
    answer = qe.eliminate(f"{LENGTHS} and ex a, b, c. {triangle} and {medians}", check=True)
    assert answer.guarantee is qe.Guarantee.CHECKED and len(str(answer)) < 60
