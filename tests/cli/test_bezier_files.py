"""``bezier clearance``, plans with obstacles and ``bezier compare``, as a user runs them."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli import command
from tests.cli.test_bezier_plan import QE, refused, run
from tests.tables import each

CURVES = """\
[[curve]]
name = "arch"
points = [[-2, 0, 0], [0, 0, 4], [2, 0, 0]]

[[obstacle]]
name = "under"
kind = "ball"
centre = [0, 0, 0]
radius = 1
"""


def test_every_kind_of_obstacle(root: Path) -> None:
    process = run("clearance", root / "examples" / "obstacle_curves.toml")
    assert process.returncode == 0, process.stderr
    lines = process.stdout.splitlines()
    assert lines[0] == "arch: touches balloon, first at t = 1/2, (0, 0, 2)"
    assert lines[-2].startswith("arch: enters saddle, first at t = 3/8")
    assert lines[-1] == "2 of 8 pairs meet; certificates: accepted"


def test_json_and_certificate(tmp_path: Path) -> None:
    curves, certificate = tmp_path / "curves.toml", tmp_path / "clearance.json"
    curves.write_text(CURVES)
    process = run("clearance", curves, "--json", "--certificate", certificate)
    told = json.loads(process.stdout)
    assert told["clear"] is True and told["certificates"] == "accepted"
    assert told["findings"][0]["distance"]["low"].startswith("0.73205")
    assert run("check", certificate, program=QE).returncode == 0


def test_an_obstacle_with_quantifiers_comes_with_its_derivation(tmp_path: Path) -> None:
    curves, certificate = tmp_path / "curves.toml", tmp_path / "clearance.json"
    curves.write_text(
        CURVES + '\n[[obstacle]]\nname = "hill"\nkind = "formula"\nformula = "ex w. x^2+y^2+z^2+w^2 < 1"\n'
    )
    assert run("clearance", curves, "--certificate", certificate).returncode == 0
    members = {item["label"]: item["kind"] for item in json.loads(certificate.read_text())["certificates"]}
    assert members["derivation of the obstacle hill"] == "derivation"
    checked = run("check", certificate, program=QE)
    assert checked.returncode == 0 and "derivation of the obstacle hill: by " in checked.stdout


@pytest.fixture(scope="module")
def planned(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a path over a box."""
    out = tmp_path_factory.mktemp("planned") / "out"
    process = run("plan", root / "examples" / "obstacle_box.toml", "--out", out, "--no-plots")
    assert process.returncode == 0 and "P: clear of crate for all t" in process.stdout
    return out


def test_a_planned_folder_and_other_obstacles(planned: Path, tmp_path: Path) -> None:
    out, others = shutil.copytree(planned, tmp_path / "out"), tmp_path / "others.toml"
    checked = run("check", out)
    assert checked.returncode == 0 and "every curve proved clear of every obstacle (1)" in checked.stdout
    others.write_text(CURVES.split("\n\n")[1].replace("[0, 0, 0]", "[0, 2, 3]"))
    assert "Q: enters under, first at t = " in run("clearance", out, "--obstacles", others).stdout
    found = json.loads((out / "path.json").read_text())
    found["problem"]["obstacle"][0]["high"] = [1, 3, 3]
    (out / "path.json").write_text(json.dumps(found))
    refused(run("check", out), 4, "path.json: problem.obstacle[0].high[2]")


def test_bad_input_is_one_line(root: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text(CURVES.replace("radius = 1", "radius = -1"))
    refused(run("clearance", bad), 2, "obstacle[0].radius: expected a number above zero, found -1")
    refused(run("clearance", root / "examples" / "three_balls.toml"), 2, "expected [[obstacle]] tables, found none")


def test_a_motion_with_limits_is_planned_and_checked_again(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    planned = run("plan", root / "examples" / "obstacle_motion.toml", "--out", out, "--no-plots")
    assert planned.returncode == 0, planned.stderr
    assert "max speed kept at all times, max acceleration kept at all times" in planned.stdout
    assert len((out / "motion.csv").read_text().splitlines()) == 3 + 1 + 151
    assert "max speed and max acceleration proved to be kept at all times" in run("check", out).stdout
    stored = json.loads((out / "motion.json").read_text())
    stored["largest_speed"]["high"] = "1"
    (out / "motion.json").write_text(json.dumps(stored))
    refused(run("check", out), 4, "motion.json")


def test_a_motion_that_does_not_keep_its_limits_is_not_solved(root: Path, tmp_path: Path) -> None:
    example = (root / "examples" / "obstacle_motion.toml").read_text().partition("[[obstacle]]")[0]
    problem, out = tmp_path / "fast.toml", tmp_path / "out"
    problem.write_text(example.replace("max_speed", "duration = 2\nmax_speed"))
    process = run("plan", problem, "--out", out, "--no-plots")
    assert process.returncode == 3 and "max_acceleration = 3/2 mm/s^2 is EXCEEDED" in process.stdout
    told = json.loads((out / "summary.json").read_text())
    assert told["status"] == "limits_not_kept" and "max_speed = 2 mm/s is EXCEEDED" in told["reason"]
    checked = run("check", out)
    assert checked.returncode == 0 and "does not keep its limits" in checked.stdout
    problem.write_text(example.replace("max_speed", f"{told['suggestion']}\nmax_speed"))
    again = run("plan", problem, "--out", out, "--no-plots")
    assert again.returncode == 0 and "max speed kept at all times, max acceleration kept at all times" in again.stdout


def test_a_point_with_two_coordinates_is_refused(planned: Path, tmp_path: Path) -> None:
    out, others = shutil.copytree(planned, tmp_path / "out"), tmp_path / "others.toml"
    others.write_text(CURVES.split("\n\n")[1])
    found = json.loads((out / "path.json").read_text())
    found["points"]["P1"] = found["points"]["P1"][:2]
    (out / "path.json").write_text(json.dumps(found))
    refused(run("check", out), 4, "path.json: points.P1")
    refused(run("clearance", out, "--obstacles", others), 4, "path.json: points.P1: expected a point of 3 coordinates")


PROBLEM = """\
method = "cubic"
workspace = "ball"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
radius = "sqrt(89/4)"
"""
PROGRESS = re.compile(r".+ \.\.\. \(\d+\.\d s\)")


def run_compare(*arguments: object) -> subprocess.CompletedProcess[str]:
    return command.run("bezier", *arguments, seconds=400)


@pytest.fixture(scope="module")
def compared(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """The table, and the folder with all files."""
    folder = tmp_path_factory.mktemp("compare")
    (folder / "problem.toml").write_text(PROBLEM)
    process = run_compare("compare", folder / "problem.toml", "--out", folder / "out")
    assert process.returncode == 0, process.stderr
    lines = process.stderr.splitlines()
    assert lines and all(PROGRESS.fullmatch(line) for line in lines), "progress is told where there is no terminal"
    assert sorted(p.name for p in folder.iterdir()) == ["out", "problem.toml"], "no working folder is left"
    return process.stdout, folder / "out"


@pytest.mark.deep
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


@pytest.mark.deep
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


@pytest.mark.deep
def test_the_page_is_whole_and_needs_nothing_else(compared: tuple[str, Path]) -> None:
    _, out = compared
    page = (out / "compare.html").read_text()
    for part in ("Side by side", "Where Q1 may be", "Timings", "cylindrical description", "15.4 s", "not yet been"):
        assert part in page
    assert page.count('<svg role="img"') == 5
    assert "The elimination of formula (8)" in page and "The planar region of (8*)" in page
    assert not re.search(r"""<(script|link|img)[^>]+(src|href)\s*=\s*["']?(https?:)?//""", page)
    for picture in ("regions.png", "paths.png"):
        assert (out / picture).read_bytes().startswith(b"\x89PNG")


@pytest.mark.deep
def test_a_comparison_has_nothing_to_check(compared: tuple[str, Path]) -> None:
    process = run_compare("check", compared[1])
    assert process.returncode == 2 and "found a comparison (qe check" in process.stderr


@each(
    (PROBLEM.replace('"sqrt(89/4)"', '"3"'), ("radius", "expected")),
    (PROBLEM.replace("via", "vias"), ("vias",)),
)
def test_bad_input_writes_nothing(text: str, words: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "problem.toml").write_text(text)
    process = run_compare("compare", tmp_path / "problem.toml", "--out", tmp_path / "out")
    assert process.returncode == 2 and process.stdout == "" and len(process.stderr.splitlines()) == 1
    assert all(word in process.stderr for word in words)
    assert not (tmp_path / "out").exists()


def test_a_limit_ends_it_with_what_is_known(tmp_path: Path) -> None:
    (tmp_path / "problem.toml").write_text(PROBLEM)
    process = run_compare("compare", tmp_path / "problem.toml", "--out", tmp_path / "out", "--timeout", "0.05")
    said = [line for line in process.stderr.splitlines() if not PROGRESS.fullmatch(line)]
    assert process.returncode == 3 and process.stdout == "" and len(said) == 1
    assert not (tmp_path / "out").exists()
