"""``bezier compare`` as a user runs it."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

from bezier.compare import comparison
from tests.cli import command
from tests.tables import each

PROBLEM = """\
method = "cubic"
workspace = "ball"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
radius = "sqrt(89/4)"
"""
PROGRESS = re.compile(r".+ \.\.\. \(\d+\.\d s\)")


def run(*arguments: object) -> subprocess.CompletedProcess[str]:
    return command.run("bezier", *arguments, seconds=400)


@pytest.fixture(scope="module")
def compared(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """The table, and the folder with all files but the slowest proof, which takes most of a minute."""
    folder = tmp_path_factory.mktemp("compare")
    (folder / "problem.toml").write_text(PROBLEM)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(comparison, "PROOF_SECONDS", 4.0)
        process = run("compare", folder / "problem.toml", "--out", folder / "out")
    assert process.returncode == 0, process.stderr
    lines = process.stderr.splitlines()
    assert lines and all(PROGRESS.fullmatch(line) for line in lines), "progress is told where there is no terminal"
    assert sorted(p.name for p in folder.iterdir()) == ["out", "problem.toml"], "no working folder is left"
    return process.stdout, folder / "out"


def test_the_table_sets_both_methods_side_by_side(compared: tuple[str, Path]) -> None:
    text, _ = compared
    lines = {line.split("│")[1].strip(): line.split("│")[2:4] for line in text.splitlines() if line.count("│") == 4}
    assert [cell.strip() for cell in lines["result"]] == ["path found", "path found"]
    assert [cell.strip() for cell in lines["joins, proved"]] == ["C1", "C2"]
    assert "1.3368639" in lines["objective, mm²"][1] and "P1, R2" in lines["active conditions"][1]
    assert "15.4 s" in lines["the paper reports"][0] and "not yet been successful" in lines["the paper reports"][1]
    for label in ("length, mm", "largest curvature, 1/mm", "quantifier elimination", "step: elimination"):
        assert all(cell.strip() for cell in lines[label]), label
    assert "not reached" not in text and "REJECTED" not in text and "REFUTED" not in text
    assert "always has the solution Q1 = Q0, Q2 = R0" in text and "the engine proved that every Q1 of (8)" in text


def test_the_data_are_exact_and_consistent(compared: tuple[str, Path]) -> None:
    _, out = compared
    data = json.loads((out / "compare.json").read_text())
    sides = data["methods"]
    assert sides["quadratic"]["smoothness"] == "C1" and sides["cubic"]["smoothness"] == "C2"
    assert abs(float(sides["cubic"]["objective"]["decimal"]) - 1.336864) < 1e-6
    for side in sides.values():
        assert side["certified"] is True
        for name in ("length", "curvature"):
            low, high = float(side[name]["low"]), float(side[name]["high"])
            assert 0 < low <= high <= low * (1 + 1e-8)
        assert float(side["length"]["low"]) >= sum(float(e["low"]) for e in side["lengths"].values()) - 1e-9
    areas = {name: region["area"] for name, region in data["planar"]["regions"].items()}
    assert float(areas["(8)"]["high"]) < float(areas["(8*)"]["low"]), "whole curves leave more room than polygons"
    assert float(areas["(8)"]["low"]) == pytest.approx(0.4193, rel=2e-3)
    assert float(areas["(7)"]["low"]) == pytest.approx(0.8611, rel=2e-3)
    assert data["planar"]["polygon_lies_in_whole"] is True
    assert data["existence"]["truth"] is True and data["existence"]["witness"].startswith("q1x = q0x")
    assert {Path(f).name for f in data["files"]} == {p.name for p in out.iterdir()}


def test_the_page_is_whole_and_needs_nothing_else(compared: tuple[str, Path]) -> None:
    _, out = compared
    page = (out / "compare.html").read_text()
    for part in ("Side by side", "Where Q1 may be", "Timings", "cylindrical description", "15.4 s", "not yet been"):
        assert part in page
    assert page.count('<svg role="img"') == 5
    assert "The elimination of formula (8)" in page and "not every step checked: " in page
    assert not re.search(r"""<(script|link|img)[^>]+(src|href)\s*=\s*["']?(https?:)?//""", page)
    for picture in ("regions.png", "paths.png"):
        assert (out / picture).read_bytes().startswith(b"\x89PNG")


@pytest.mark.deep
def test_every_step_of_every_elimination_is_checked(tmp_path: Path) -> None:
    (tmp_path / "problem.toml").write_text(PROBLEM)
    process = run("compare", tmp_path / "problem.toml", "--out", tmp_path / "out", "--timeout", "300")
    assert process.returncode == 0, process.stderr
    page = (tmp_path / "out" / "compare.html").read_text()
    assert "The planar region of (8*)" in page and "not every step checked" not in page


def test_a_comparison_has_nothing_to_check(compared: tuple[str, Path]) -> None:
    process = run("check", compared[1])
    assert process.returncode == 2 and "found a comparison (qe check" in process.stderr


@each(
    (PROBLEM.replace('"sqrt(89/4)"', '"3"'), ("radius", "expected")),
    (PROBLEM.replace("via", "vias"), ("vias",)),
)
def test_bad_input_writes_nothing(text: str, words: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "problem.toml").write_text(text)
    process = run("compare", tmp_path / "problem.toml", "--out", tmp_path / "out")
    assert process.returncode == 2 and process.stdout == "" and len(process.stderr.splitlines()) == 1
    assert all(word in process.stderr for word in words)
    assert not (tmp_path / "out").exists()


def test_a_limit_ends_it_with_what_is_known(tmp_path: Path) -> None:
    (tmp_path / "problem.toml").write_text(PROBLEM)
    process = run("compare", tmp_path / "problem.toml", "--out", tmp_path / "out", "--timeout", "0.05")
    said = [line for line in process.stderr.splitlines() if not PROGRESS.fullmatch(line)]
    assert process.returncode == 3 and process.stdout == "" and len(said) == 1
    assert not (tmp_path / "out").exists()
