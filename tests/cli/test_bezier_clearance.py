"""``bezier clearance`` and plans with obstacles, as a user runs them."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.cli.test_bezier_plan import QE, refused, run

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
