"""The command ``bezier`` as a user runs it, judged by files, output, message and exit status."""

from __future__ import annotations

import csv
import json
import re
import subprocess
import time
from fractions import Fraction
from pathlib import Path

import pytest

from tests.cli import command
from tests.tables import each

BEZIER, QE = "bezier", "qe"
FILES = {"report.html", "region.json", "certificate.json", "path.csv", "path.json", "region.png", "path.png"}
PROBLEM = """\
method = "quadratic"
workspace = "ball"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
"""


def run(*arguments: object, program: str = BEZIER) -> subprocess.CompletedProcess[str]:
    return command.run(program, *arguments)


def refused(process: subprocess.CompletedProcess[str], code: int, *words: str) -> None:
    """One line on stderr, nothing on stdout, the exit status asked for."""
    assert process.returncode == code, (process.stdout, process.stderr)
    assert process.stdout == "" and len(process.stderr.splitlines()) == 1, process.stderr
    assert "Traceback" not in process.stderr
    for word in words:
        assert word in process.stderr


@pytest.fixture(scope="module")
def main_example(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The main example with pictures, planned once."""
    out = tmp_path_factory.mktemp("plan") / "out"
    process = command.in_a_shell(BEZIER, "plan", root / "examples" / "three_balls.toml", "--out", out)
    assert process.returncode == 0, process.stderr
    assert process.stderr == "" and "best Q1 = (0, 3, 3)" in process.stdout
    return out


def planned(root: Path, tmp_path: Path, name: str) -> tuple[dict[str, object], Path, int]:
    """An example without pictures: its JSON, its folder, its exit status."""
    out = tmp_path / "out"
    process = run("plan", root / "examples" / f"{name}.toml", "--out", out, "--no-plots", "--json")
    return json.loads(process.stdout), out, process.returncode


def test_all_files_are_there(main_example: Path) -> None:
    sizes = {path.name: path.stat().st_size for path in main_example.iterdir()}
    assert sizes.keys() >= FILES and all(sizes.values())
    assert sorted(p.name for p in main_example.parent.iterdir()) == ["out"], "no working folder is left"
    for picture in ("region.png", "path.png"):
        assert (main_example / picture).read_bytes().startswith(b"\x89PNG")


def test_the_page_is_whole_and_needs_nothing_else(main_example: Path) -> None:
    page = (main_example / "report.html").read_text()
    head = page[: page.rindex("<script>")]
    for heading in ("The problem", "The question", "quantifier-free answer", "The region", "Bounds", "The best"):
        assert heading in head
    for part in ("Cylindrical description", "Above the table?", "What was certified", "Timings", "<svg", "<math"):
        assert part in head
    assert not re.search(r"""<(script|link|img)[^>]+(src|href)\s*=\s*["']?(https?:)?//""", page)
    assert head.count("<canvas") == 2 and len(page) < 1_500_000


def test_the_certificates_hold(main_example: Path) -> None:
    assert run("check", main_example / "certificate.json", program=QE).returncode == 0
    process = command.in_a_shell(BEZIER, "check", main_example)
    assert process.returncode == 0 and "C1 at every join" in process.stdout


def test_the_sampled_path(main_example: Path) -> None:
    lines = (main_example / "path.csv").read_text().splitlines()
    assert any("mm" in line for line in lines if line.startswith("#"))
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert {"t", "x", "y", "z", "vx", "vy", "vz", "segment", "u"} == set(rows[0])
    assert [rows[0][a] for a in "xyz"] == ["-4", "1", "1"] and [rows[-1][a] for a in "xyz"] == ["4.5", "1", "1"]
    times = [float(row["t"]) for row in rows]
    assert times == sorted(times) and times[-1] == 3
    assert {row["segment"] for row in rows} == {"P", "Q", "R"}
    assert all(sum(float(row[a]) ** 2 for a in "xyz") <= 22.25 + 1e-9 for row in rows)


def test_exact_control_points(main_example: Path) -> None:
    stored = json.loads((main_example / "path.json").read_text())
    points = {n: tuple(Fraction(c["exact"]) for c in p) for n, p in stored["points"].items()}
    assert points["Q1"] == (0, 3, 3) and points["P1"] == (-2, 3, 3) and points["R1"] == (2, 3, 3)
    assert stored["curves"]["P"][0] == "P0" and [j["smoothness"] for j in stored["joins"]] == ["C1", "C1"]


def test_region_json_is_a_region(main_example: Path) -> None:
    import qe

    region = qe.Region.from_json((main_example / "region.json").read_text())
    assert region.contains({"q1x": 0, "q1y": 3, "q1z": 3}) and not region.contains({"q1x": 1, "q1y": 3, "q1z": 3})


def test_json_of_an_irrational_optimum(root: Path, tmp_path: Path) -> None:
    found, out, code = planned(root, tmp_path, "tight_radius")
    assert code == 0 and found["status"] == "solved" and found["certified"] is True
    assert found["active"] == ["P1", "R1"] and found["radius"] == {"exact": "5", "decimal": "5"}
    assert found["objective"]["exact"] == "52 - 12*sqrt(13)"
    assert abs(float(found["objective"]["decimal"]) - (52 - 12 * 13**0.5)) < 1e-9
    assert {"method", "points", "files", "seconds"} <= found.keys()
    assert set(found["points"]) == {f"{curve}{k}" for curve in "PQR" for k in range(3)}
    assert sorted(Path(f).name for f in found["files"]) == sorted(p.name for p in out.iterdir())
    assert not (FILES - {"region.png", "path.png"}) - {p.name for p in out.iterdir()}
    assert run("check", out).returncode == 0


def test_the_hemisphere_example(root: Path, tmp_path: Path) -> None:
    found, out, code = planned(root, tmp_path, "hemisphere_gap")
    assert code == 0 and found["workspace"] == "hemisphere"
    assert found["leaves_hemisphere"] == {"allowed": True, "chosen": False}
    page = (out / "report.html").read_text()
    assert "it allows control points below the table" in page and "The corrected region" in page
    assert run("check", out).returncode == 0


def test_no_control_point(root: Path, tmp_path: Path) -> None:
    found, out, code = planned(root, tmp_path, "no_control_point")
    assert code == 3 and found["status"] == "infeasible" and found["points"] == {}
    assert "at least 6" in found["reason"] and "cubic" in found["suggestion"]
    page = (out / "report.html").read_text()
    assert "Why there is no path" in page and "multiplier" in page
    assert not (out / "path.csv").exists()
    assert "no control point exists" in run("check", out).stdout
    words = run("plan", root / "examples" / "no_control_point.toml", "--out", out, "--no-plots")
    assert words.returncode == 3 and "cubic" in words.stdout


@each(
    {
        "a coordinate": ("path.json", '"exact": "3"', '"exact": "4"'),
        "the problem": ("path.json", '"radius_squared": "89/4"', '"radius_squared": "22"'),
        "the smoothness": ("path.json", '"smoothness": "C1"', '"smoothness": "C2"'),
        "the region": ("region.json", '"<="', '"<"'),
        "the table of the path": ("path.csv", "\n0.02,", "\n0.03,"),
        "the points of the summary": ("summary.json", '"decimal": "3"', '"decimal": "4"'),
        "the certificate": ("certificate.json", '"relation":"<="', '"relation":"<"'),
    }
)
def test_altered_files_are_rejected(name: str, old: str, new: str, main_example: Path, tmp_path: Path) -> None:
    for path in main_example.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    text = (tmp_path / name).read_text()
    assert old in text
    (tmp_path / name).write_text(text.replace(old, new, 1))
    refused(run("check", tmp_path), 4, name)


BAD = {
    "start = [1,2]": "start",
    'start = [1,2,"x"]': "start[2]",
    "start = [1,2,nan]": "start[2]",
    'start = ["1/0",1,1]': "zero",
    'colour = "red"': "colour",
    'radius = "1/2"': "radius",
    'method = "octic"': "method",
    "via = [[1,1,1]]": "via",
    "via = [[1,1,1],[1,1,1]]": "via[1]",
    "goal = [": "TOML",
}


@pytest.mark.parametrize("line", BAD)
def test_bad_problems_get_one_line_and_nothing_is_written(tmp_path: Path, line: str) -> None:
    key = line.split("=")[0].strip()
    kept = [old for old in PROBLEM.splitlines() if old.split("=")[0].strip() != key]
    (tmp_path / "p.toml").write_text("\n".join([*kept, line]) + "\n")
    refused(run("plan", tmp_path / "p.toml", "--out", tmp_path / "out"), 2, "p.toml", BAD[line], "expected")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["p.toml"]


def test_files_and_folders_that_cannot_be_used(root: Path, tmp_path: Path) -> None:
    example = root / "examples" / "three_balls.toml"
    refused(run("plan", tmp_path / "none.toml", "--out", tmp_path / "out"), 2, "none.toml", "readable")
    (tmp_path / "taken").write_text("")
    refused(run("plan", example, "--out", tmp_path / "taken"), 2, "taken", "folder")
    refused(run("plan", example, "--out", "/proc/out"), 2, "writable")
    refused(run("check", tmp_path), 2, "certificate.json")
    refused(run("plan", example), 2, "--out")
    refused(run("plan", example, "--out", tmp_path / "out", "--timeout", "-1"), 2, "--timeout")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["taken"]


def test_a_time_limit_leaves_nothing_half_written(root: Path, tmp_path: Path) -> None:
    example = root / "examples" / "three_balls.toml"
    refused(run("plan", example, "--out", tmp_path / "out", "--timeout", "0.001"), 3, "limit")
    assert list(tmp_path.iterdir()) == []


def stuck(channel: object, folder: Path) -> None:
    time.sleep(600)


def test_a_check_holds_its_time_limit(main_example: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    refused(run("check", main_example, "--timeout", "0"), 2, "--timeout")
    assert run("check", main_example, "--timeout", "100").returncode == 0
    monkeypatch.setattr("bezier.check.recheck.recheck", stuck)
    refused(run("check", main_example, "--timeout", "0.01"), 3, "time limit of 0.01 s reached")


def test_a_second_plan_leaves_nothing_of_the_first(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for name, code in (("three_balls", 0), ("single_dip", 3)):
        process = run("plan", root / "examples" / f"{name}.toml", "--out", out, "--no-plots")
        assert process.returncode == code, process.stderr
    pages = {f"derivation_{k}.html" for k in (1, 2, 3)}
    assert {p.name for p in out.iterdir()} == {
        "certificate.json",
        "problem.json",
        "report.html",
        "summary.json",
        *pages,
    }
    assert run("check", out).returncode == 0


def test_pages_of_derivations_that_are_not_written_again_go(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for name, count in (("single_dip", 3), ("cubic_joins", 1)):
        run("plan", root / "examples" / f"{name}.toml", "--out", out, "--no-plots")
        assert len(list(out.glob("derivation_*.html"))) == count
    assert 'href="derivation_1.html"' in (out / "report.html").read_text()


def test_help_names_the_commands() -> None:
    text = command.in_a_shell(BEZIER, "--help").stdout
    assert all(command in text for command in ("plan", "check", "compare"))
