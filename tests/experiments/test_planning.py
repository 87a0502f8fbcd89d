"""``experiments planning``: agreement with clarabel, toppra's timings refuted, a page with pictures."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from experiments import planning


def test_the_comparison_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planning, "CORPUS", tmp_path)
    (first,) = planning.path_cases(1)
    monkeypatch.setattr(planning, "path_cases", lambda count: [first])
    notes: list[str] = []
    data, page = planning.run(tmp_path / "out", 4, notes.append)
    rows = json.loads(data.read_text())["chains"]
    assert (
        len(rows) == 4
        and all(row["accepted"] for row in rows)
        and {row["value"] is None for row in rows} == {True, False}
    )
    assert "yes" in page.read_text() and ">NO<" not in page.read_text() and "<svg" in page.read_text()
    (slit,) = json.loads(data.read_text())["scenes"]
    assert slit["ours"].startswith("path") and slit["accepted"] and slit["flood"] is False  # the grid is too coarse
    assert "<svg" in page.read_text() and len(notes) >= 6


def test_the_two_models_agree_and_disagreement_is_seen() -> None:
    points = [[0, 0], [2, 1], [3, 3], [5, 2]]
    row, plan = planning.chain_row(points, 6)
    assert row.agrees and plan.feasible and abs(row.value - row.clarabel_value) < 1e-8
    assert not planning.ChainRow(1, "", 1.0, 0.0, 0.0, True, "Solved", 1.1, 0.0).agrees
    assert not planning.ChainRow(1, "", None, None, 0.0, True, "Solved", 1.1, 0.0).agrees


def test_what_toppra_times_is_certified() -> None:
    pytest.importorskip("toppra")
    made = planning.path_row(next(planning.path_cases(1)), 100)
    assert made is not None and not made[0].kept and made[0].slower_by is not None and 1 < made[0].slower_by < 1.1
    assert made[0].at_least <= made[0].ours <= 1.004 * made[0].at_least and made[0].ours < 1.005 * made[0].duration
