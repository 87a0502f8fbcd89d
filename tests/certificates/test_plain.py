"""The second reader and the first one say the same about everything that both can read."""

from __future__ import annotations

import ast
import json
import random
import subprocess
import sys
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest

import qe
from qe.certify import plain
from qe.certify.verify import verify_json
from qe.options import Projection
from tests.certificates.mutation import leaves, other_numbers, other_signs, replaced, without
from tests.certificates.producing import cell_table

TABLES = [
    ("x^2 + y^2 < 1 or x*y = 2", "x y", ""),
    ("x^2 + y^2 < 1 or x*y = 2", "x y", ".E"),
    ("a*x^2 + 2*x + 1 = 0 and x > a", "a x", ".E"),
    ("y^3 - x*y + 1 > 0", "x y", ".A"),
    ("x^3 - 2 < 0 and x^2 > 2", "x", ""),
    ("x^2 - 2 = 0 and x > 1", "x", "E"),
    ("(x - 1)*y^2 + x*y - 1 = 0 and y > x", "x y", ".E"),
    ("x*y^2 - x >= 0", "x y", "AE"),
]
QUESTIONS = [
    "ex x, y. 2*x + 3*y = a and x - y = 1 and x*y > 2",
    "ex x. x^2 = 2 and x > 0",
    "ex x, y. x^2 + y^2 = 2 and x > y and y > 1/2",
    "all x. x^2 + a*x + 1 > 0",
]
PROBLEMS = [
    ("x + y", "x^2 + y^2 <= 2"),
    ("x + y", "x^2 + y^2 <= 3 and x >= y"),
    ("x", "x^2 <= 1 and x > 1"),
    ("x", "y >= x^2 and y < 0"),
    ("x", "y <= 1 and x < y"),
    ("x", "x > 1 and x^2 + y^2 <= 4"),
]


@lru_cache(maxsize=1)
def certificates() -> tuple[str, ...]:
    found = [cell_table(*table, projection).to_json() for table in TABLES for projection in Projection]
    for text in QUESTIONS:
        certificate = qe.eliminate(text, check=True, process=False).certificate
        assert certificate is not None
        found.append(certificate.to_json())
    for objective, constraints in PROBLEMS:
        optimum = qe.minimize(objective, constraints, process=False)
        assert optimum.certificate is not None
        found.append(optimum.certificate.to_json())
    return tuple(found)


def said_plainly(text: str) -> str:
    try:
        plain.check(text)
    except plain.Undecided:
        return "undecided"
    except (plain.Rejected, ValueError):
        return "rejected"
    return "accepted"


def said(text: str) -> str:
    verdict = verify_json(text)
    return "accepted" if verdict.accepted else "rejected" if verdict.decided else "undecided"


def altered(text: str, chance: random.Random, count: int) -> list[str]:
    whole = json.loads(text)
    found = []
    # of the interval of a number field the first reader wants more: bounds that keep the derivative away from 0
    inside = [leaf for leaf in leaves(whole) if leaf[0][0] == "payload" and leaf[0][1:3] != ("field", "interval")]
    for path, value in chance.sample(inside, min(count, len(inside))):
        found += [replaced(whole, path, new) for new in _others(value) if new != value]
        if isinstance(path[-1], int):
            found.append(without(whole, path[:-1], path[-1]))
    return found


def _others(value: Any) -> list[Any]:
    if isinstance(value, bool) or value is None:
        return [True, False, None]
    if isinstance(value, int):
        return [value + 1, 0]
    if set(value) <= set("+-0?"):
        return list(other_signs(value))[:2]
    try:
        return [*other_numbers(str(Fraction(value)))][:2]
    except ValueError:
        return ["0", "1", "x", "x - 1", "<", "E"]


def test_both_accept_what_is_right() -> None:
    for text in certificates():
        assert (said(text), said_plainly(text)) == ("accepted", "accepted"), text[:300]


@pytest.mark.parametrize("seed", [0])
def test_both_reject_what_is_altered(seed: int) -> None:
    _compare(seed, 3)


@pytest.mark.deep
def test_both_reject_whatever_is_altered() -> None:
    _compare(7, 150)


def _compare(seed: int, count: int) -> None:
    chance, both = random.Random(seed), 0
    for text in certificates():
        for made in altered(text, chance, count):
            first, second = said(made), said_plainly(made)
            assert {first, second} != {"accepted", "rejected"}, (first, second, made)
            both += first == second == "rejected"
    assert both > 50


@pytest.mark.parametrize("value", [[], {}, None, True, ""])
def test_an_entry_of_another_type_is_refused_by_both_and_breaks_neither(value: Any) -> None:
    for text in certificates():
        whole = json.loads(text)
        listed = [path for path, old in leaves(whole) if old != value and path not in (("digest",), ("format",))]
        for path in random.Random(len(text)).sample(listed, min(6, len(listed))):
            made = replaced(whole, path, value)
            assert {said(made), said_plainly(made)} != {"accepted", "rejected"}, made


@pytest.mark.parametrize("other", [[], ["atom"], {}, {"x": 1}, None, 1])
def test_rules_relations_and_quantifiers_that_nobody_knows_are_no_crash(other: Any) -> None:
    derivation = json.loads(_derivation(True, []))
    table = json.loads(cell_table(*TABLES[1], Projection.LAZARD).to_json())
    altered = [
        replaced(derivation, ("payload", "steps", 0, "rule"), other),
        replaced(derivation, ("payload", "steps", 0, "evidence"), other),
        replaced(derivation, ("payload", "start", 2, 1, 2), other),
        replaced(table, ("payload", "quantifiers", 1), other),
        replaced(table, ("payload", "projection"), other),
    ]
    for text in altered:
        assert said(text) == "rejected" and said_plainly(text) != "accepted", text


def test_the_version_is_that_of_what_a_certificate_holds() -> None:
    for text in certificates():
        whole = json.loads(text)
        for version in (3 - whole["version"], True, "1", 0):
            made = replaced(whole, ("version",), version)
            assert (said(made), said_plainly(made)) == ("rejected", "rejected")


def test_texts_nested_without_end_are_no_certificates(tmp_path: Path) -> None:
    path = tmp_path / "deep.json"
    path.write_text("[" * 200_000)
    assert plain.main([str(path)]) == 2


def _derivation(after: Any, lemmas: list[Any]) -> str:
    order = ["a", "x"]
    start = ["exists", ["x"], ["and", ["atom", "x", ">"], ["atom", "a*x", ">"]]]
    theory = {"polynomials": ["x", "a", "a*x"], "lemmas": lemmas, "cases": []}
    step = {
        "rule": "signs",
        "at": [],
        "before": start,
        "after": after,
        "context": [],
        "evidence": {"theory": theory},
    }
    whole: dict[str, Any] = {
        "format": "bezier-qe certificate",
        "version": 2,
        "kind": "derivation",
        "payload": {"order": order, "start": start, "steps": [step], "answer": after},
    }
    return replaced(whole, ("version",), 2)


def test_boolean_steps() -> None:
    product = {"identity": [["1", [[2, 1]]], ["-1", [[0, 1], [1, 1]]]]}
    right = ["exists", ["x"], ["and", ["atom", "x", ">"], ["atom", "a", ">"]]]
    wrong = ["exists", ["x"], ["and", ["atom", "x", ">"], ["atom", "a", ">="]]]
    false = {"identity": [["1", [[2, 1]]], ["1", [[0, 1], [1, 1]]]]}
    constant = {"identity": [["1", []], ["-1", []]]}
    cases = [(right, [product], "accepted"), (wrong, [product], "rejected"), (right, [], "rejected")]
    cases += [(right, [false], "rejected"), (wrong, [product, constant], "rejected"), (False, [constant], "rejected")]
    for after, lemmas, verdict in cases:
        text = _derivation(after, lemmas)
        assert (said(text), said_plainly(text)) == (verdict, verdict), (after, lemmas)


def test_the_command_runs_alone(tmp_path: Path) -> None:
    path = tmp_path / "certificate.json"
    path.write_text(certificates()[0])
    for command in ([str(plain.__file__)], ["-m", "qe.certify.plain"]):
        done = subprocess.run([sys.executable, *command, str(path)], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stdout) == (0, "accepted\n")
    path.write_text(certificates()[0].replace("true", "false"))
    done = subprocess.run([sys.executable, plain.__file__, str(path)], capture_output=True, text=True, check=False)
    assert done.returncode == 4
    path.write_text("{}")
    done = subprocess.run([sys.executable, plain.__file__, str(path)], capture_output=True, text=True, check=False)
    assert done.returncode == 2


def test_it_imports_the_standard_library_alone() -> None:
    text = Path(plain.__file__).read_text()
    found = [n for n in ast.walk(ast.parse(text)) if isinstance(n, ast.Import | ast.ImportFrom)]
    names = {n.module if isinstance(n, ast.ImportFrom) else alias.name for n in found for alias in n.names}
    assert {str(name).split(".")[0] for name in names} <= sys.stdlib_module_names | {"__future__"}
    assert text.count("\n") <= 1500
