"""``bezier.certify``: the same as the command says, from Python."""

from __future__ import annotations

import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import bezier
import qe
from bezier.cli import main
from tests.tables import each

ROWS = "time,x,y\n0,0,0\n1,2,1\n3,3,5\n"


@pytest.fixture
def states(tmp_path: Path) -> Path:
    file = tmp_path / "states.csv"
    file.write_text(ROWS)
    return file


@pytest.mark.parametrize("limit", ["2", "1.5"])
def test_both_doors_say_the_same(states: Path, limit: str) -> None:
    limits = states.with_name("limits.toml")
    limits.write_text(f"velocity = [{limit}, 3]\n")
    command = [sys.executable, "-m", "bezier", "certify", str(states), "--limits", str(limits), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    result = bezier.certify(states, velocity=[limit, 3])
    assert json.loads(done.stdout) == json.loads(json.dumps(result.to_json()))
    assert result.kept is (limit == "2")
    assert result.slower_by is not None and result.slower_by >= max(Fraction(1), 2 / Fraction(limit))


def test_the_certificate_is_about_this_trajectory(states: Path) -> None:
    kept = bezier.certify(states, velocity=2)
    broken = bezier.certify(states, velocity=1)
    for result in (kept, broken):
        qe.verify(result.certificate)
        result.check(result.certificate)
    with pytest.raises(qe.CertificateRejected):
        kept.check(broken.certificate)


def test_obstacles_are_tables_as_for_plan(states: Path) -> None:
    states.write_text("time,x,y,z\n0,0,0,0\n1,2,1,0\n3,3,5,0\n")
    far = {"kind": "ball", "centre": [9, 9, 0], "radius": 1}
    near = {"kind": "ball", "centre": [1, 1, 0], "radius": 1}
    assert bezier.certify(states, obstacles=[far]).kept
    met = bezier.certify(states, obstacles=[far, near])
    assert not met.kept and not met.clear and "ball 2" in str(met)


def test_splines_of_scipy() -> None:
    from scipy.interpolate import CubicSpline

    spline = CubicSpline([0, 1, 2], np.array([[0, 0], [1, 2], [3, 1]]))
    result = bezier.certify(spline, velocity=[3, 4])
    assert result.kept and "<svg" in result.page("two axes")


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"velocity": "fast"}, "velocity"),
        ({"velocity": [1, 2, 3]}, "velocity"),
        ({"acceleration": -1}, "acceleration"),
        ({"position": [3, 1]}, "position"),
        ({"obstacles": {"kind": "ball"}}, "obstacles"),
        ({"obstacles": [3]}, "obstacles"),
        ({"tolerance": -1}, "tolerance"),
        ({"timeout": "soon"}, "timeout"),
        ({"memory": 0}, "memory"),
        ({"progress": 3}, "progress"),
    ],
)
def test_a_wrong_argument_is_one_line_that_names_it(states: Path, arguments: dict[str, object], word: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        bezier.certify(states, **arguments)
    assert word in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize("trajectory", [3, None, "no such file.csv", [[0, 1], [1, 2]]])
def test_what_is_no_trajectory_is_refused(trajectory: object) -> None:
    with pytest.raises(qe.InputError):
        bezier.certify(trajectory)


@each("json", "toml", daily=2)
def test_scenes_of_the_plane_are_read_as_route_reads_them(
    form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, scene = tmp_path / "m.csv", tmp_path / f"s.{form}"
    walls = [{"kind": "box", "low": [4, 0], "high": [6, 5]}, {"kind": "ball", "centre": [5, 7], "radius": "1.9"}]
    if form == "json":
        data = {"domain": {"low": [0, 0], "high": [10, 10]}, "start": [1, 5], "goal": [9, 5], "obstacle": walls}
        scene.write_text(json.dumps(data))
    else:
        box, ball = "kind = 'box'\nlow = [4, 0]\nhigh = [6, 5]", "kind = 'ball'\ncentre = [5, 7]\nradius = '1.9'"
        scene.write_text(f"domain = {{low = [0, 0], high = [10, 10]}}\n[[obstacle]]\n{box}\n[[obstacle]]\n{ball}\n")
    for height, status in (("5.05", True), ("-1", False)):
        file.write_text(f"time,x,y\n0,3,{height}\n1,7,{height}\n")
        assert main(["certify", str(file), "--scene", str(scene), "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["kept"] is status, height
        assert bezier.certify(file, obstacles=walls).clear is (status or height == "-1")
    other = tmp_path / "three.json"
    other.write_text(json.dumps({"domain": {"low": [0, 0, 0], "high": [1, 1, 1]}, "obstacle": walls}))
    assert main(["certify", str(file), "--scene", str(other)]) == 2
    assert "domain.low: expected" in capsys.readouterr().err


def test_plans_and_chains_are_trajectories_and_paths() -> None:
    chain = bezier.chain(start=[0, 0], via=[[2, 1], [3, 3]], goal=[5, 2], radius=6)
    assert bezier.certify(chain, velocity_norm=9).kept
    fast = bezier.retime(chain, velocity_norm=1, acceleration_norm=2, accuracy="1/50")
    assert fast.verdict.is_kept and fast.trajectory.names == ("x", "y") and fast.gap < Fraction(1, 50)
    limits = {"max_speed": 2, "max_acceleration": 1.5}
    ends = {"start": [-4, 2, 1], "via": [[-1.5, 2, 3], [1.5, 2, 3]], "goal": [4, 2, 1], "radius": 6}
    plan = bezier.plan(**ends, limits=limits)  # type: ignore[arg-type]
    assert bezier.certify(plan, velocity_norm=2, acceleration_norm=1.5).kept
    quicker = bezier.retime(plan, velocity_norm=2, acceleration_norm=1.5, accuracy="1/50")
    assert quicker.bound < quicker.duration < plan.duration * Fraction(3, 4)
    none = bezier.chain(start=[0, 0], via=[[2, 1], [3, 3]], goal=[5, 2], radius=5)
    with pytest.raises(qe.InputError, match="expected a chain, found none"):
        bezier.retime(none, acceleration=1)
