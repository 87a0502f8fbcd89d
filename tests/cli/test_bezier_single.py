"""``bezier plan`` and ``bezier check`` for Method 1."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.test_bezier_plan import QE, run


@pytest.fixture(scope="module")
def leaves(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example that Method 1* repairs, with pictures, planned once."""
    out = tmp_path_factory.mktemp("single") / "out"
    process = run("plan", root / "examples" / "single_leaves.toml", "--out", out)
    assert process.returncode == 0, process.stderr
    assert "LEAVES the ball" in process.stdout and "path: proved to lie in the workspace" in process.stdout
    return out


def test_the_files_and_the_page(leaves: Path) -> None:
    names = {path.name for path in leaves.iterdir() if path.stat().st_size}
    assert names >= {"report.html", "certificate.json", "path.json", "path.csv", "path.png", "profile.png"}
    page = (leaves / "report.html").read_text()
    head = page[: page.rindex("<script>")]
    for part in (
        "Method 1",
        "What (4) leaves open",
        "the conditions for all t",
        "dual proof",
        "lexicographically",
        " mm</span>",
    ):
        assert part in head, part
    assert "Joins" not in head and head.count("<canvas") == 1 and head.count("<svg") >= 4


def test_the_certificates_hold(leaves: Path) -> None:
    assert run("check", leaves / "certificate.json", program=QE).returncode == 0
    process = run("check", leaves)
    assert process.returncode == 0 and "Method 1*" in process.stdout and "keeps its heights" in process.stdout


def test_an_altered_path_is_rejected(leaves: Path, tmp_path: Path) -> None:
    for file in leaves.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    stored = json.loads((leaves / "path.json").read_text())
    stored["points"]["P3"][1] = {"exact": "3", "decimal": "3"}
    (tmp_path / "path.json").write_text(json.dumps(stored))
    process = run("check", tmp_path)
    assert process.returncode == 4 and "path.json: points: the y coordinates do not satisfy (4)" in process.stderr


def test_a_problem_without_a_curve(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    process = run("plan", root / "examples" / "single_dip.toml", "--out", out, "--no-plots", "--json")
    found = json.loads(process.stdout)
    assert process.returncode == 3 and found["status"] == "infeasible" and found["certified"] is True
    assert len(found["dips"]) == 1 and "no curve of degree 7" in found["reason"]
    assert run("check", out).returncode == 0


def test_a_bad_table(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text(
        'method = "single"\nstart = [0,0,0]\ngoal = [9,0,0]\n[single]\ndegree = 3\na = 1\nb = 2\nheight_y = 1\n'
    )
    process = run("plan", file, "--out", tmp_path / "out")
    assert process.returncode == 2 and process.stderr.count("\n") == 1
    assert "single.degree" in process.stderr and "the least degree that works is" in process.stderr
