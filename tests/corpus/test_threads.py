"""Questions of people in public threads, typed as they were asked there: the answers are those the threads agree on.

Each line of threads.jsonl names its thread; the scripts were run by z3, too. What other words alone would mend is not
here: ``kx`` for ``k*x`` is noted, not read, where k stands nowhere alone.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import qe

ROWS = [json.loads(line) for line in (Path(__file__).parent / "threads.jsonl").read_text("utf-8").splitlines()]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["source"])
def test_as_typed(row: dict[str, str]) -> None:
    question, more, expected = row["question"], row.get("more"), row["expected"]
    match row["door"]:
        case "eliminate":
            assert qe.equivalent(qe.eliminate(question), expected)
        case "solve":
            assert qe.equivalent(str(qe.solve(question, more)), expected)
        case "minimize" | "maximize" as door:
            best = getattr(qe, door)(question, more or "true")
            assert qe.equivalent(f"value = {best.value}", f"value = {expected}")
        case "find":
            found = sorted(float(point[str(more)]) for point in qe.find(question, 5))
            assert found == pytest.approx([float(number) for number in expected.split()])
        case _:
            assert (qe.find_instance(question, format="smtlib") is not None) is (expected == "sat")
