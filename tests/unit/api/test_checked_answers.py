"""``check=True`` for regions, optima and witnesses in parameters: the same answers, with checked derivations."""

import copy
import json
import pickle
from fractions import Fraction

import pytest

import qe
import qe.proving.prover as proving
from qe.certify.verify import verify_json
from qe.cli.region import _in_words
from qe.convex.optimum import Optimum
from qe.optimization.global_optimum import GlobalOptimum
from qe.optimization.parametric_optimum import ParametricOptimum
from qe.proof.answer import Guarantee
from qe.proof.certificate import digest
from tests.tables import each

REGIONS = ("ex y. x^2 + y^2 < a", "x^2 + y^2 < 1 and x > y", "ex z. x*z = y and z > 1 and z < 2")


@pytest.mark.parametrize("text", REGIONS)
def test_regions(text: str) -> None:
    found, plain = qe.region(text, check=True), qe.region(text)
    assert found.guarantee is Guarantee.CHECKED
    assert not found.reason
    assert found.formula == plain.formula
    assert str(found.cells) == str(plain.cells)
    assert qe.verify(found.proof).accepted
    if text.startswith("ex"):
        assert found.answer is not None
        assert found.answer.certificate is not None
        assert qe.verify(found.answer.certificate, formula=text).accepted
        assert found.answer.derivation.is_complete
    assert plain.guarantee is Guarantee.DERIVED
    assert pickle.loads(pickle.dumps(found)).guarantee is Guarantee.CHECKED


def test_a_region_in_many_variables_says_what_it_rests_on() -> None:
    found = qe.region("ex t. t^2 + x^2 + y^2 + u^2 + v^2 < 4", check=True)
    assert found.guarantee is Guarantee.DERIVED
    assert "convex optimisation" in found.reason


def test_a_region_whose_elimination_is_not_proved(monkeypatch: pytest.MonkeyPatch) -> None:
    """No rule has a checker, and decompositions do not help."""
    monkeypatch.setattr(proving.Prover, "evidence", lambda self, step, context: None)
    monkeypatch.setattr(proving.Prover, "own", lambda self, step, context: None)
    monkeypatch.setattr(proving.Prover, "_tabulated", lambda self, step: None)
    monkeypatch.setattr("qe.elimination.cad.certificate_for", lambda *given: None)
    found = qe.region(REGIONS[-1], check=True, process=False)
    assert found.guarantee is Guarantee.DERIVED
    assert found.answer is not None
    assert found.answer.unchecked_steps
    assert all(rule in found.reason for rule in found.answer.unchecked_steps)
    assert found.proof == found.certificate
    assert _in_words(found, 0.0)[-1] == f"not proved: {found.reason}"


@each(
    ("x^4 + y^4 - x*y", "true"),
    ("x*y", "x^2 + y^2 = 1"),
    ("x", "x*y = 1 and x > 0"),
    ("x", "x^3 > 1"),
    ("x", "x^4 < -1 and x^3 > 2"),
    ("x", "ex t. t^2 = x and t^3 > 1"),
)
def test_global_optima(objective: str, constraints: str) -> None:
    for find in (qe.minimize, qe.maximize):
        found, plain = find(objective, constraints, check=True), find(objective, constraints)
        assert isinstance(found, GlobalOptimum)
        assert isinstance(plain, GlobalOptimum)
        assert (found.status, found.value, found.point) == (plain.status, plain.value, plain.point)
        assert (found.minimisers, found.values) == (plain.minimisers, plain.values)
        assert found.guarantee is Guarantee.CHECKED, found.reason
        assert found.certificate is not None
        assert qe.verify(found.certificate).accepted
        assert found.answer.derivation.is_complete
        if found.point:
            point = json.loads(found.certificate.to_json())["certificates"][-1]
            assert point["label"] == "point"
            assert [step["rule"] for step in point["payload"]["steps"]] == ["instance"]


def test_a_point_under_quantifiers_is_not_proved() -> None:
    found = qe.minimize("x^2", "ex t. t^3 = x and t^2 >= 1 and t > 0", check=True, method="elimination")
    assert isinstance(found, GlobalOptimum)
    assert found.point == {"x": 1}
    assert found.guarantee is Guarantee.DERIVED
    assert found.unchecked_steps[-1] == "point"
    assert "point" in found.reason


def test_an_optimum_of_parameters() -> None:
    asked = {"parameters": "a"}
    found = qe.minimize("x^2 - a*x^3", "x >= 0 and x <= 1", check=True, **asked)  # type: ignore[call-overload]
    assert isinstance(found, ParametricOptimum)
    assert found.guarantee is Guarantee.CHECKED
    assert str(found) == str(qe.minimize("x^2 - a*x^3", "x >= 0 and x <= 1", **asked))  # type: ignore[call-overload]


def test_a_convex_optimum() -> None:
    found = qe.minimize("x^2 + y^2", "x + y >= 1", check=True)
    assert isinstance(found, Optimum)
    assert found.value == Fraction(1, 2)
    assert found.guarantee is Guarantee.CHECKED
    assert qe.minimize("x^2 + y^2", "x + y >= 1").guarantee is Guarantee.DERIVED


@each(
    "ex x. a*x^2 + b*x + c = 0",
    "all x. x > a or x < b",
    "ex x. x > a and (ex y. y^2 = x and y > b)",
    "ex x. x^2 < 0",
)
def test_witnesses_in_parameters(text: str) -> None:
    found, plain = qe.parametric_witnesses(text, check=True), qe.parametric_witnesses(text)
    assert [str(w) for w in found] == [str(w) for w in plain]
    assert found.answer.guarantee is Guarantee.CHECKED
    assert found.answer.certificate is not None
    assert qe.verify(found.answer.certificate, formula=text).accepted
    assert plain.answer.formula == found.answer.formula
    assert plain.answer.guarantee is Guarantee.DERIVED
    assert qe.equivalent(found.answer.formula, text)


def test_an_altered_guard_is_refused() -> None:
    answer = qe.parametric_witnesses("ex x. a*x = b and x > 1", check=True).answer
    assert answer.certificate is not None
    whole = json.loads(answer.certificate.to_json())
    other = copy.deepcopy(whole)
    other["payload"]["answer"] = other["payload"]["answer"][1]
    other["digest"] = digest(other)
    verdict = verify_json(json.dumps(other))
    assert verdict.step == "payload.answer"
