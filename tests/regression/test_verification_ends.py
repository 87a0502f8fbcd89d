"""Verification ends, and asking and checking agree."""

from __future__ import annotations

import json
import random
import re
import time
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe import Guarantee, Status, eliminate, equivalent
from qe.api.input import read_formula
from qe.certify.claims import is_about
from qe.certify.verify import verify, verify_json
from qe.cli.app import main
from qe.formula.syntax import FALSE, TRUE, Constant
from qe.kernel.renaming import is_same
from qe.kernel.verdict import Verdict
from qe.options import Budget
from qe.proof.certificate import Certificate, digest
from tests.certificates.producing import cell_table
from tests.differential.generate import Shape, random_formula
from tests.tables import each

ROOT = {"polynomial": "x^10000 - 2", "interval": ["1", "2"]}
LONG = "7" * 4000
LONG_END = f"{LONG}3/{LONG}"


def _step(rule: str, order: list[str], before: Any, after: Any, evidence: Any) -> str:
    """A certificate of one step, written by hand: nothing looks at it before the checker does."""
    step = {"rule": rule, "at": [], "context": [], "before": before, "after": after, "evidence": evidence}
    payload = {"order": order, "start": before, "steps": [step], "answer": after}
    whole: dict[str, Any] = {"format": "bezier-qe certificate", "version": 3, "kind": "derivation", "payload": payload}
    whole["digest"] = digest(whole)
    return json.dumps(whole)


def _witness(polynomial: str, values: list[Any], names: str = "x") -> str:
    order = names.split()
    question = ["exists", order, ["atom", polynomial, "="]]
    return _step("instance", order, question, True, {"order": order, "values": values})


def _cells(rising: str) -> str:
    """A table that is right at its samples: a polynomial that rises with y in place of another one."""
    payload = cell_table("y > x^3", "x y").evidence_for("cells")["cells"]
    matrix = ["atom", rising, ">"]
    table = {**payload, "factors": [[], [rising]], "matrix": matrix}
    return _step("cells", ["x", "y"], matrix, matrix, {"cells": table})


def _many_variables(count: int) -> str:
    field = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
    problem = {"variables": [f"x{i}" for i in range(count)], "minimise": [], "constraints": []}
    empty = {key: [] for key in ("faces", "point", "multipliers", "derived", "values")}
    rest = {"field": field, **empty, "value": ["0"], "attained": True, "unique": False}
    evidence = {"problem": problem, "status": "optimal", **rest}
    return _step("multipliers", ["x0"], True, True, evidence)


def _substitution(degree: int) -> str:
    sum_of_three = "-z - y + x - 1"
    matrix = ["and", ["atom", sum_of_three, "="], ["atom", f"x^{degree} - y", "="]]
    evidence = {"solved": [["x", sum_of_three, 1]], "theory": {"polynomials": [], "lemmas": [], "cases": []}}
    question = ["exists", ["x"], matrix]
    return _step("linear equation solved", ["z", "y", "x"], question, ["atom", "-z + y", "="], evidence)


TOO_LARGE = "not decided: .* is needed"

HOSTILE = {
    "a large exponent": (_witness("x^10000 - 2", [ROOT]), "accepted"),
    "a huge exponent": (_witness("x^1000000000 - 2", [{**ROOT, "polynomial": "x^1000000000 - 2"}]), "rejected"),
    "a long number": (_witness(f"{LONG}*x - 1", [f"1/{LONG}"]), "accepted"),
    "a power of a long number": (_witness("x^10000 - 2", [f"1/{LONG}"]), TOO_LARGE),
    "a root between long numbers": (
        _witness("x^10000 - 2", [{**ROOT, "interval": ["1", LONG_END]}]),
        TOO_LARGE,
    ),
    "a resultant of large degree": (_cells("y^9999 - x^3 + y"), "not decided"),
    "a resultant of many steps": (_cells("x^400*y^399 + y^401 - x^3 + y"), "not decided"),
    "many variables": (_many_variables(30_000), TOO_LARGE),
    "a power of a sum": (_substitution(9999), TOO_LARGE),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_certificate_that_asks_for_too_much_has_a_clear_verdict_soon(name: str) -> None:
    text, expected = HOSTILE[name]
    start = time.monotonic()
    try:
        verdict = qe.verify(Certificate.from_json(text), timeout=1)
    except qe.CertificateRejected as error:
        verdict = Verdict(False, error.step, error.reason)
    assert time.monotonic() - start < 30  # 1 s and a little is asked; the tests' machine may be busy
    assert re.match(expected, str(verdict))
    assert verdict.accepted is (expected == "accepted")
    assert verdict.decided is not expected.startswith("not decided")
    assert verdict.reason or verdict.accepted


def test_nesting_has_a_limit() -> None:
    deep: Any = ["atom", "x", "="]
    for _ in range(400):
        deep = ["not", deep]
    question = ["exists", ["x"], deep]
    assert not verify_json(_step("instance", ["x"], question, True, {"order": ["x"], "values": ["0"]})).accepted


def test_a_budget_that_is_used_up_gives_no_decision() -> None:
    certificate = qe.region("x^2 + y^2 < 4 and x*y > 1").certificate
    assert verify(certificate).accepted
    late = verify(certificate, Budget(-1.0))
    assert not late.accepted and not late.decided and not late and "time" in str(late)


@settings(max_examples=25)
@given(st.integers(0, 200))
def test_whatever_the_limit_a_right_certificate_is_accepted_or_not_decided(after: int) -> None:
    """Never rejected: a limit that cuts the work anywhere must not look like a fault of the certificate."""
    left = [after]

    class Counted(Budget):
        __slots__ = ()

        def check(self, phase: str = "work", done: int = 0, total: int | None = None) -> None:
            left[0] -= 1
            if left[0] < 0:
                self.cancel()
            super().check(phase, done, total)

    verdict = verify(cell_table("x^3 - y^2 = 2 and y < x", "x y"), Counted())
    assert verdict.accepted if verdict.decided else left[0] < 0


@each("10", 0, -1, float("nan"), float("inf"))
def test_limits_of_a_verification_are_checked(limit: Any) -> None:
    with pytest.raises(qe.InputError, match="timeout"):
        qe.verify(cell_table("x^2 <= 2", "x"), timeout=limit)


def test_a_verification_that_does_not_end_costs_the_certificate_not_the_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "ex y. x^2 + y^2 = 1 and y > x"
    checked = qe.eliminate(text, check=True)
    monkeypatch.setattr("qe.api.verify.VERIFY_SECONDS", 1e-9)
    answer = qe.eliminate(text, check=True)
    assert checked.guarantee is qe.Guarantee.CHECKED and not checked.reason
    assert answer.status is qe.Status.SOLVED and answer.formula == checked.formula
    assert answer.guarantee is qe.Guarantee.DERIVED and answer.certificate is None
    assert "not verified" in answer.reason and "not verified" in answer.explanation


def test_the_command_tells_rejected_and_undecided_apart(tmp_path: Any, capsys: Any) -> None:
    path = tmp_path / "certificate.json"
    for text, seconds, status, said in (
        (HOSTILE["a large exponent"][0], "60", 0, "accepted"),
        (HOSTILE["a power of a long number"][0], "60", 3, "not decided"),
        (HOSTILE["a resultant of many steps"][0], "4", 3, "limit"),
        (HOSTILE["a huge exponent"][0], "60", 4, "rejected"),
    ):
        path.write_text(text)
        assert main(["check", str(path), "--timeout", seconds]) == status
        out = capsys.readouterr()
        assert said in out.out + out.err


@each(
    "ex z. (y*z + x /= 0 or x + y /= 0)",
    "all z. (y*z + x = 0 and x + y = 0)",
    "ex z. (x*z + y /= 0 or x - y /= 0 or x*y > 0)",
    "all z. (x^2 - y = 0 and z*y = x)",
)
@each("auto", "cad")
def test_simplified_answers_needed_signs_that_the_table_does_not_know(method: str, text: str) -> None:
    """The certificate was rejected at payload.answer: the simplified answer had a factor beside a constraint."""
    answer = qe.eliminate(text, check=True, method=method)
    assert answer.guarantee is qe.Guarantee.CHECKED
    assert qe.equivalent(answer.formula, read_formula(text))


CUBIC = "ex x. x^3 + a*x + b = 0 and x > 0"


@each("ex x. x^5 + a*x + b = 0 and x > 0", "ex x, y. x^4 + y^5 + x*y = 1 and x*y^3 + x > 2", "all x. x^4 + p*x + q > 0")
def test_substitution_asked_for_alone_was_finished_by_decomposition(text: str) -> None:
    answer = eliminate(text, method="vs")
    assert answer.status is Status.UNABLE and "substitution alone" in answer.reason
    assert "cad" not in answer.stats


def test_a_switch_from_substitution_to_decomposition_is_recorded() -> None:
    answer = eliminate("ex x, y. x + a*y > 0 and y^4 + b*x < c", without="roots")
    assert "vs" in answer.stats and "cad" in answer.stats
    assert "vs: y left for another method" in answer.stats["switches"]


@pytest.mark.parametrize(
    "text",
    [
        CUBIC,
        "ex x. a*x^2 + b*x + c = 0",
        "all x, y. a*x^2 + 2*b*x*y + c*y^2 + d > 0",
        "ex x, y. x^2 + y^2 < a and x*y > b",
        "all x. not (a*x^2 + b*x + 1 < 0)",
    ],
)
def test_a_check_changed_the_answer(text: str) -> None:
    plain, checked = eliminate(text), eliminate(text, check=True)
    assert str(checked.formula) == str(plain.formula)
    assert checked.guarantee is Guarantee.CHECKED


@pytest.mark.parametrize("seed", range(24))
def test_a_check_changes_no_answer(seed: int) -> None:
    """The property behind the symptom, with a certificate that claims the very formula that is returned."""
    formula = random_formula(random.Random(seed), (Shape(1, 1, 3, 3), Shape(2, 1, 2, 3), Shape(1, 2, 2, 3))[seed % 3])
    plain, checked = eliminate(formula), eliminate(formula, check=True)
    assert checked.formula == plain.formula
    assert checked.certificate is not None and checked.guarantee is Guarantee.CHECKED
    said = is_about(checked.certificate, formula)
    assert said is not None and is_same(said, plain.formula)


@each(
    ("x + y = 0 and x - y = 0 and x > 0", FALSE),
    ("x > 0 and y > x and z > y and z < 0", FALSE),
    ("a*b = 0 and c*d = 1 and a - b = 3 and c = d + 1 and d > 4", FALSE),
    ("x <= 0 or y <= x or z <= y or z >= 0", TRUE),
)
def test_formulas_without_solution_were_returned_as_they_stood(text: str, expected: Constant) -> None:
    assert eliminate(text).formula == expected
    assert eliminate(text, check=True).formula == expected


@pytest.mark.parametrize("seed", range(40))
def test_small_answers_are_constant_only_in_form(seed: int) -> None:
    """No quantifier-free formula that is cheap to decide comes back when it is equivalent to true or to false."""
    rng = random.Random(1000 + seed)
    formula = random_formula(rng, Shape(2, 0, 2, 4))
    found = eliminate(formula).formula
    if not isinstance(found, Constant):
        assert not equivalent(found, TRUE) and not equivalent(found, FALSE), str(found)
