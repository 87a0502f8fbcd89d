"""Questions and scripts from public threads, where they are beside the project: never wrong, never a crash.

What is refused or not reached counts as undecided; the floors say how many have to be answered at least.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import qe
from qe.api.input import read_formula
from qe.formula.build import exists

WILD = Path(__file__).resolve().parents[3] / "shared" / "corpora" / "wild.jsonl"
SECONDS = 10.0
FLOORS = {"smt2": 20, "eliminate": 18, "decide": 8}

pytestmark = [pytest.mark.deep, pytest.mark.skipif(not WILD.exists(), reason="needs the problems from public threads")]


@cache
def records() -> list[dict[str, Any]]:
    return [json.loads(line) for line in WILD.read_text().splitlines()] if WILD.exists() else []


def question(text: str) -> Any:
    if not text.startswith("sympy:"):
        return text
    import sympy

    return sympy.sympify(text.removeprefix("sympy:"), evaluate=False)


def verdict(record: dict[str, Any]) -> bool | None:
    """Whether the answer agrees with the expected one; None where there is none, or where it is not a formula."""
    expected = str(record["expected"]).strip()
    try:
        if record["kind"] == "smt2":
            if not isinstance(record["text"], str) or expected not in ("sat", "unsat"):
                return None
            asserted = read_formula(record["text"], "smtlib")
            closed = exists(asserted.free, asserted)
            return qe.decide(closed, timeout=SECONDS) is (expected == "sat")
        answer = qe.eliminate(question(record["text"]), format=record.get("format", "text"), timeout=SECONDS)
        if answer.formula is None:
            return None
        if record["kind"] == "decide":
            return str(answer.truth).lower() == expected.lower() if expected.lower() in ("true", "false") else None
        wanted = read_formula(expected)
    except qe.QEError:
        return None
    try:
        return qe.equivalent(answer.formula, wanted, timeout=2 * SECONDS)
    except qe.Unable:
        return None


@pytest.mark.parametrize("kind", FLOORS)
def test_questions_from_public_threads(kind: str) -> None:
    found = {r["id"]: verdict(r) for r in records() if r["kind"] == kind}
    assert not [name for name, agrees in found.items() if agrees is False]
    assert sum(agrees is True for agrees in found.values()) >= FLOORS[kind], found
