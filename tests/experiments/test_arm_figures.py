"""The suite ``arm``: what its table says, and that its points are right."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments import arm_figures
from experiments.arm_figures import Figure, table
from experiments.cli import main


def test_the_table() -> None:
    found = [Figure("quick", (0.001, 0.003, 0.002), 0.003, "9 s"), Figure("slow", (2.0,), 1.0, remark="why")]
    lines = table(found).splitlines()
    assert lines[2] == "| quick | 2.0 ms | 3.0 ms | 9 s |  |"
    assert lines[3] == "| slow | 2.00 s | 1.00 s (OVER) |  | why |"


def test_without_the_authors_points_others_are_drawn(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(arm_figures, "CORPUS", tmp_path)
    monkeypatch.setattr(arm_figures, "POINTS", 6)
    found = list(arm_figures._points())
    assert len(found) == 3
    assert all("6 points, 0 wrong counts" in f.remark and len(f.seconds) == 6 for f in found)


def test_a_wrong_count_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(arm_figures, "CORPUS", tmp_path)
    monkeypatch.setattr(arm_figures, "POINTS", 2)
    monkeypatch.setattr(arm_figures, "_closed_form", lambda point, length: 3)
    assert "2 wrong counts" in next(arm_figures._points()).remark


def test_the_command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    asked = []

    def figures(repeat: int) -> list[Figure]:
        asked.append(repeat)
        return [Figure("a question", (1.0,), None)]

    monkeypatch.setattr(arm_figures, "figures", figures)
    assert main(["run", "--suite", "arm", "--repeat", "5"]) == 0
    assert asked == [5]
    assert "| a question | 1.00 s |" in capsys.readouterr().out
