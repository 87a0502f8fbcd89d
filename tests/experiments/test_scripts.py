"""``experiments scripts``: verdicts are counted, contradictions found, known answers taken from script or index."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from experiments.cli import main
from experiments.scripts import known_answers


def write(folder: Path, name: str, status: str, condition: str) -> None:
    text = f"(set-info :status {status})(declare-const x Real)(assert {condition})(check-sat)(get-info :name)"
    (folder / name).write_text(text)


def test_verdicts_are_counted_and_contradictions_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path, "right.smt2", "sat", "(= (* x x) 2)")
    assert main(["scripts", str(tmp_path)]) == 0
    assert "1 of 1 scripts decided in 20 s, 0 wrong, 0 open" in capsys.readouterr().out
    write(tmp_path, "wrong.smt2", "unsat", "(= (* x x) 2)")
    assert main(["scripts", str(tmp_path), "--only", "wrong"]) == 1
    printed = capsys.readouterr().out
    assert "WRONG" in printed
    assert "0 of 1 scripts decided in 20 s, 1 wrong, 0 open" in printed


def test_what_is_known_comes_from_the_script_or_the_index(tmp_path: Path) -> None:
    write(tmp_path, "a.smt2", "unsat", "true")
    write(tmp_path, "b.smt2", "unknown", "true")
    write(tmp_path, "c.smt2", "unknown", "true")
    rows = [{"file": "a.smt2", "status": "sat"}, {"file": "b.smt2", "status": "unknown", "z3": "sat"}]
    (tmp_path / "index.jsonl").write_text("\n".join(map(json.dumps, rows)))
    assert known_answers(tmp_path) == {"a.smt2": "unsat", "b.smt2": "sat"}


def test_a_folder_without_scripts_is_refused(tmp_path: Path) -> None:
    assert main(["scripts", str(tmp_path)]) == 2
