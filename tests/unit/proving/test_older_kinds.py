"""Certificates of kinds of former releases: read as derivations, and no better than they were."""

import json
from typing import Any

import pytest

import qe
from qe.certify.claims import parts_of
from qe.certify.verify import verify_json
from qe.convex.optimum import minimize
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.groebner.evidence import solutions_certificate
from qe.io.text import read
from qe.proof.certificate import Certificate, digest
from qe.proof.entry import formula_to_json
from qe.proving.older_kinds import recent
from tests.certificates.producing import cell_table
from tests.tables import each


def written(text: str, names: str) -> Any:
    """A formula as certificates hold it."""
    return formula_to_json(convert(read(text), Ring.of(tuple(names.split()))), quantified=True)


RING = Ring.of(("x", "y"))
x, y = RING.gen(0), RING.gen(1)
TABLE = cell_table("x^2 + b*x + c = 0", "b c x", "..E").evidence_for("cells")["cells"]
DISC = cell_table("x^2 + y^2 < 4", "x y").evidence_for("cells")["cells"]
LINEAR = {"order": ["a", "x"], "variables": ["x"], "solved": [["x", "-a + x"]], "answer": written("a > 1", "a x")}
BODY = written("a - x = 0 and x > 1", "a x")
DISCRIMINANT = written("b^2 - 4*c >= 0", "b c x")
OPTIMUM = minimize(x**2 + y**2, convert(read("x + y >= 1"), RING)).certificate.evidence_for("multipliers")
SOLUTIONS = solutions_certificate([x**2 - 2, y - x]).evidence_for("solutions")
PARTS = {"parts": [written("b^2 > 4*c", "b c x"), written("b^2 < 4*c", "b c x")], "answer": None}
QUESTION = written("ex x. x^2 + b*x + c = 0", "b c x")

OLD: dict[str, tuple[str, Any, list[tuple[str, Any]]]] = {
    "cells": (
        "cells",
        {**TABLE, "answer": DISCRIMINANT},
        [("answer", written("b^2 - 4*c > 0", "b c x")), ("matrix", True)],
    ),
    "region": ("cells", {**DISC, "answer": None}, [("answer", True), ("matrix", written("x^2 + y^2 <= 4", "x y"))]),
    "decided": ("cells", {**TABLE, **PARTS}, [("parts", PARTS["parts"][::-1]), ("parts", [DISCRIMINANT, True])]),
    "witness": (
        "witness",
        {"order": ["x", "y"], "matrix": written("x^2 = y", "x y"), "values": ["2", "4"]},
        [("values", ["2", "3"]), ("matrix", written("x^2 > y", "x y")), ("order", ["y", "x"])],
    ),
    "substitution": (
        "substitution",
        {**LINEAR, "matrix": BODY},
        [("answer", written("a >= 1", "a x")), ("solved", [["x", "x + a"]]), ("solved", []), ("matrix", BODY[1])],
    ),
    "optimum": ("optimum", OPTIMUM, [("value", ["1/3"]), ("status", "infeasible"), ("problem", {}), ("unique", 1)]),
    "solutions": ("solutions", SOLUTIONS, [("solutions", SOLUTIONS["solutions"][:1]), ("equations", ["x^2 - 3"])]),
    "parts": (
        "parts",
        {
            "order": ["b", "c", "x"],
            "question": QUESTION,
            "true": PARTS["parts"][0],
            "false": PARTS["parts"][1],
            "proofs": [{"kind": "cells", "payload": {**TABLE, **PARTS}}],
        },
        [("true", DISCRIMINANT), ("proofs", []), ("question", ["forall", *QUESTION[1:]])],
    ),
}


def text_of(kind: str, payload: Any) -> str:
    whole = {"format": "bezier-qe certificate", "version": 2, "kind": kind, "payload": payload}
    return json.dumps({**whole, "digest": digest(whole)})


@pytest.mark.parametrize("name", OLD)
def test_what_was_accepted_is_accepted(name: str) -> None:
    kind, payload, _ = OLD[name]
    old = Certificate.from_json(text_of(kind, payload))
    assert qe.verify(old, timeout=None).accepted
    new = recent(old)
    assert {part.kind.value for part in new.parts} == {"derivation"} and recent(new) is new
    assert verify_json(new.to_json()).accepted


@each(*[(n, e, v) for n, (_, _, made) in OLD.items() for e, v in made])
def test_what_was_rejected_is_rejected(name: str, entry: str, value: Any) -> None:
    kind, payload, _ = OLD[name]
    verdict = qe.verify(Certificate.from_json(text_of(kind, {**payload, entry: value})), timeout=None)
    assert verdict.decided and not verdict.accepted


def test_the_digest_is_the_one_of_the_file() -> None:
    kind, payload, _ = OLD["witness"]
    text = text_of(kind, payload).replace('"version": 2', '"version": 1')
    assert qe.verify(Certificate.from_json(text), timeout=None).step == "digest"


def test_what_was_decided_is_about_the_question() -> None:
    kind, payload, _ = OLD["parts"]
    found = parts_of(recent(Certificate.from_json(text_of(kind, payload))), read("ex t. t^2 + t*b + c = 0"))
    assert found is not None and [str(part) for part in found] == ["b^2 - 4*c > 0", "b^2 - 4*c < 0"]


TABLED = ("cells", {**TABLE, "answer": DISCRIMINANT})
SIDES = written("ex x. x^2 + b*x + c = 0", "b c x y"), written("b^2 - 4*c >= 0", "b c x y")


@pytest.mark.parametrize(
    ("rule", "inside", "before", "after"),
    [
        ("shorter", TABLED, *SIDES),
        ("constant", TABLED, *SIDES),
        ("convex", ("witness", OLD["witness"][1]), written("ex x, y. x^2 = y", "b c x y"), True),
    ],
)
def test_certificates_inside_steps(rule: str, inside: tuple[str, Any], before: Any, after: Any) -> None:
    for right in (True, False):
        evidence = {"certificate": {"kind": inside[0], "payload": inside[1]}}
        step = {"rule": rule, "at": [], "before": before, "after": after, "context": [], "evidence": evidence}
        if not right:
            step["after"] = after = False if after is True else written("b^2 - 4*c > 0", "b c x y")
        names = ["b", "c", "x", "y"]
        text = text_of("derivation", {"order": names, "start": before, "steps": [step], "answer": after})
        assert qe.verify(Certificate.from_json(text), timeout=None).accepted is right


def test_a_table_is_about_formulas_of_which_it_has_a_prenex_form() -> None:
    """It named no question but that form."""
    whole = {"format": "bezier-qe certificate", "version": 1, "kind": "cells", "payload": OLD["cells"][1]}
    old = Certificate.from_json(json.dumps({**whole, "digest": digest(whole)}))
    for text in ("ex x. b*x + x^2 + c = 0", "not all x. x^2 + b*x + c /= 0", "ex b_1. b_1^2 + b*b_1 + c = 0"):
        assert qe.verify(old, formula=read(text)).accepted
    assert qe.verify(old, formula=read("ex x. x^2 + b*x - c = 0")).step == "claim"
