"""Certificates for Coq: what is written, what is refused, and (where installed) that Coq accepts the right alone."""

import copy
import shutil
import subprocess
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import qe
from qe.coq.export import to_coq
from qe.coq.squares import read_form, squares
from qe.errors import Unable
from qe.io.text import read
from qe.proof.certificate import Certificate, Kind
from tests.tables import each

FORMULAS = [
    "ex x, y. 2*x + 3*y = a and x - y = 1 and x*y > 2",
    "ex x, y. x = 2*a*b + 1 and y = x - 3 and x^2*y /= 2 and (y > x or a > x^3)",
    "ex x, y. x^2 + y^2 < 2 and x /= 1/2 and (x > 3 or y > 1/3)",
    "ex x. a*x^2 + b*x + c = 0 and x > 1",
]
PROBLEMS = [
    ("x + y", "x^2 + y^2 <= 2"),
    ("x", "x^2 <= 1 and x > 1"),
    ("x^2 + y^2 - x", "x + y = 1 and y <= 1/3"),
    ("x^2 + x*y + y^2 + z^2", "x + y + z >= 3 and (x - 1)^2 + z^2 <= 1"),
    ("x", "x^2 + y^2 <= 1 and (x - 3)^2 + y^2 <= 1"),
]


def certificates() -> list[Certificate]:
    found = [qe.eliminate(text, check=True, process=False).certificate for text in FORMULAS]
    found += [qe.minimize(*problem, process=False).certificate for problem in PROBLEMS]
    return [c for c in found if c is not None]


def accepted_by_coq(text: str, folder: Path) -> bool:
    path = folder / "proof.v"
    path.write_text(text)
    return (
        subprocess.run(["coqc", path.name], cwd=folder, capture_output=True, timeout=120, check=False).returncode == 0
    )


def test_a_witness_is_written_with_its_point() -> None:
    matrix = read("x > 3 or x /= 1 and x^2 <= 1/4")
    text = to_coq(Certificate.witness(matrix, ("x",), [Fraction(-1, 2)]))
    assert "Theorem main" in text and "(witness " in text and "(-1)" in text


def test_names_are_made_into_identifiers() -> None:
    matrix = read("`*) Admitted. (*` > 3 and x' = 1")
    names = matrix.free
    values = [Fraction(1) if name == "x'" else Fraction(4) for name in names]
    text = to_coq(Certificate.witness(matrix, names, values))
    assert "Admitted" not in text


def test_squares_make_up_the_quadratic_part() -> None:
    form = read_form([["2", [2, 0]], ["-2", [1, 1]], ["3", [0, 2]], ["5", [1, 0]]])
    total = [[Fraction(0)] * 2 for _ in range(2)]
    for factor, row in squares([(Fraction(3), form)]):
        assert factor > 0
        for i in range(2):
            for j in range(2):
                total[i][j] += factor * row[i] * row[j]
    assert total == [[6, -3], [-3, 9]]


@each(("x", "x <= 1"), ("x + y", "x^2 + y^2 <= 3"), ("x", "x > 1 and x^2 + y^2 <= 4"))
def test_what_cannot_be_written_is_refused(objective: str, constraints: str) -> None:
    certificate = qe.minimize(objective, constraints, process=False).certificate
    assert certificate is not None
    with pytest.raises(Unable, match="Coq"):
        to_coq(certificate)


def test_other_kinds_are_refused() -> None:
    other = Certificate(Kind("branch"), {})
    with pytest.raises(Unable, match="kind branch"):
        to_coq(other)
    with pytest.raises(Unable, match="nothing to prove"):
        to_coq(Certificate.bundle([]))
    with pytest.raises(Unable, match="kind branch"):
        to_coq(Certificate.bundle([("arm", other)]))


@pytest.mark.deep
@pytest.mark.skipif(shutil.which("coqc") is None, reason="coqc is not installed")
def test_coq_accepts_what_is_right(tmp_path: Path) -> None:
    whole = certificates()
    rules = {c.single_step.get("rule") for c in whole}
    assert rules >= {"instance", "linear equation solved", "multipliers"}
    for certificate in whole:
        assert accepted_by_coq(to_coq(certificate), tmp_path), certificate.to_json()
    bundle = Certificate.bundle([(str(k), c) for k, c in enumerate(whole)])
    assert accepted_by_coq(to_coq(bundle), tmp_path)


@pytest.mark.deep
@pytest.mark.skipif(shutil.which("coqc") is None, reason="coqc is not installed")
def test_coq_refuses_what_is_wrong(tmp_path: Path) -> None:
    for certificate in certificates():
        payload: Any = copy.deepcopy(certificate.payload)
        rule, evidence = certificate.single_step.get("rule"), payload["steps"][0]["evidence"]
        if rule == "instance":
            evidence["values"] = ["17"] * len(evidence["values"])
        elif rule == "multipliers":
            evidence["problem"]["constraints"], evidence["multipliers"] = [], []
        else:
            continue
        text = to_coq(replace(certificate, payload=payload))
        assert not accepted_by_coq(text, tmp_path), payload
