"""Coverings as certificates of former releases have them, made when they had a checker of their own."""

import json
from pathlib import Path
from typing import Any

import pytest

from qe.certify.verify import verify
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import neg
from qe.formula.normal import nnf
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.certificate import Certificate, written
from qe.proof.entry import Entry, formula_from_json, formula_to_json
from qe.proving.older import recent

STEPS: list[dict[str, Any]] = json.loads((Path(__file__).parent / "older_coverings.json").read_text())


def sides(step: dict[str, Any]) -> tuple[Formula, Formula]:
    ring = Ring.of(tuple(step["order"]))
    before, after = (formula_from_json(Entry(step[name], name), ring, quantified=True) for name in ("before", "after"))
    return before, after


def verdict(step: dict[str, Any], before: Formula, after: Formula) -> bool:
    """Whether the certificate of this step alone is accepted, after its conversion."""
    steps = [written("covering", (), before, after, (), step["evidence"])]
    certificate = Certificate.derivation(step["order"], before, steps, after)
    try:
        return verify(recent(certificate, Budget(20)), Budget(20)).accepted
    except CertificateRejected:
        return False


@pytest.mark.parametrize("step", STEPS, ids=lambda step: str(step["after"])[:40])
def test_they_are_accepted_for_their_answer_alone(step: dict[str, Any]) -> None:
    before, after = sides(step)
    assert verdict(step, before, after)
    assert not verdict(step, before, nnf(neg(after)))
    assert not verdict(step, nnf(neg(before)), after)


@pytest.mark.parametrize("step", STEPS, ids=lambda step: str(step["after"])[:40])
def test_universal_blocks_are_read_as_negations(step: dict[str, Any]) -> None:
    before, after = (nnf(neg(side)) for side in sides(step))
    dual = {"E": "A", "A": "E", "": ""}
    evidence = dict(step["evidence"])
    evidence["quantifiers"] = [dual[kind] for kind in evidence["quantifiers"]]
    matrix = nnf(neg(formula_from_json(Entry(evidence["matrix"], "matrix"), Ring.of(tuple(step["order"])))))
    assert verdict({**step, "evidence": {**evidence, "matrix": formula_to_json(matrix)}}, before, after)


@pytest.mark.parametrize("step", [s for s in STEPS if {*s["evidence"]["quantifiers"]} == {"E"}])
def test_the_oldest_are_about_closed_blocks_without_solutions(step: dict[str, Any]) -> None:
    renamed = json.loads(json.dumps(step["evidence"]).replace('"atoms":', '"false":'))
    oldest = {**step, "evidence": {name: renamed[name] for name in ("order", "factors", "line")}}
    before, after = sides(step)
    assert verdict(oldest, before, after) and verdict(oldest, nnf(neg(before)), nnf(neg(after)))
    assert not verdict(oldest, before, nnf(neg(after)))
    for name in oldest["evidence"]:
        assert not verdict({**oldest, "evidence": {**oldest["evidence"], name: None}}, before, after)
