"""The distance of a point, or of the end point of an arm, from a path at the same time: decided for all t."""

from __future__ import annotations

import json
from fractions import Fraction as F
from pathlib import Path
from random import Random

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

import bezier
import qe
from bezier.arm.reader import load_arm, read_arm
from bezier.arm.robot import Robot
from bezier.arm.tip import tip_of
from bezier.cli import main
from bezier.trajectories.readers import from_scipy
from qe.errors import InputError, QEError

KNOTS = np.linspace(0, 2, 5)


def joints(arm: str, seed: int) -> CubicSpline:
    count = len(load_arm(arm).joints)
    return CubicSpline(KNOTS, np.random.default_rng(seed).uniform(-0.5, 0.5, (5, count)))


@pytest.mark.parametrize("arm", ["ev3-120", "cylindrical", "six-joints"])
def test_the_end_point_is_as_near_to_its_polynomials_as_they_say(arm: str) -> None:
    motion, error = joints(arm, 2), F(1, 2**20)
    tip = tip_of(load_arm(arm), from_scipy(motion), error)
    for start, length, row in zip(tip.breaks, tip.lengths, tip.pieces, strict=False):
        local = np.linspace(0, float(length), 30)
        ours = np.stack([np.polynomial.polynomial.polyval(local, p.floats()) for p in row], axis=1)
        exact = Robot.load(arm).positions(motion(float(start) + local))
        assert np.linalg.norm(ours - exact, axis=1).max() < float(error) + 1e-12


def test_the_largest_distance_of_an_arm_is_what_an_optimizer_finds() -> None:
    robot, motion = Robot.load("ev3-120"), joints("ev3-120", 1)
    times = KNOTS
    path = CubicSpline(times, robot.positions(motion(times)))

    def distance(t: float) -> float:
        return float(np.linalg.norm(robot.positions(motion([t])) - path([t])))

    values = np.linalg.norm(robot.positions(motion(np.linspace(0, 2, 5001))) - path(np.linspace(0, 2, 5001)), axis=1)
    near = values.argmax() * 2 / 5000
    best = minimize_scalar(lambda t: -distance(t), bounds=(near - 1e-3, near + 1e-3), options={"xatol": 1e-12})
    for share, kept in ((1 + 1e-9, True), (1 - 1e-9, False), (0.5, False)):
        result = bezier.certify(motion, robot=robot, along=path, within=-best.fun * share)
        assert result.along is not None and result.along.is_kept is kept is result.kept
        assert abs(result.along.to_json()["worst"] + best.fun) <= float(result.along.error) + 1e-10
        assert qe.verify(result.certificate).accepted
        result.check(result.certificate)


def test_altered_certificates_of_an_arm_are_rejected() -> None:
    motion, random = joints("ev3-120", 1), Random(5)
    path = CubicSpline(KNOTS, Robot.load("ev3-120").positions(motion(KNOTS)))
    result = bezier.certify(motion, robot="ev3-120", along=path, within=200)
    assert result.kept
    text = result.certificate.to_json()
    with pytest.raises(QEError):
        bezier.certify(motion, robot="ev3-112", along=path, within=200).check(result.certificate)
    for _ in range(40):
        data = json.loads(text)
        data.pop("digest", None)
        listed = next(value for value in data.values() if isinstance(value, list))
        i = random.randrange(len(listed))
        whole = json.dumps(listed[i])
        k = random.choice([k for k, c in enumerate(whole) if c.isdigit() and k < whole.index('"steps"')])
        listed[i] = json.loads(f"{whole[:k]}{9 - int(whole[k])}{whole[k + 1 :]}")
        with pytest.raises(QEError):
            result.check(qe.Certificate.from_json(json.dumps(data)))


def test_a_distance_that_is_just_reached_is_kept_and_any_smaller_one_is_not(tmp_path: Path) -> None:
    file, path = tmp_path / "m.csv", tmp_path / "p.toml"
    file.write_text("duration,x^0,x^1,y^2,z^0\n1,0,6,0,0\n1,6,6,3,0\n")  # y leaves the path behind t = 1
    path.write_text("[[curve]]\npoints = [[0, 0, 0], [12, 0, 0]]\n")
    kept = bezier.certify(str(file), along=str(path), within=3)
    broken = bezier.certify(str(file), along=str(path), within=F(3) - F(1, 10**40))
    assert kept.kept and not broken.kept
    for result in (kept, broken):
        result.check(result.certificate)
    path.write_text("[[curve]]\npoints = [[0, 0, 0], [6, 0, 0]]\n[[curve]]\npoints = [[6, 0, 0], [12, 3, 0]]\n")
    halves = bezier.certify(str(file), along=path, within=1).along  # 3 u - 3 u^2 is largest in the middle of its piece
    assert halves is not None and halves.to_json()["worst"] == 0.75 and halves.to_json()["time"]["exact"] == "3/2"


def test_both_doors_say_the_same_of_a_robot(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arm = '[[row]]\njoint = "a"\na = 100\nlimits = [-1, 1]\nmax_velocity = 2\n[[row]]\njoint = "b"\na = 50\n'
    (tmp_path / "arm.toml").write_text('name = "two"\nconvention = "standard"\n' + arm)
    (tmp_path / "q.csv").write_text("time,b,a\n0,0,0\n1,0.5,0.5\n2,0.5,1.25\n")  # columns in another order
    (tmp_path / "p.csv").write_text("time,x,y,z\n0,150,0,0\n1,100,90,0\n2,10,140,0\n")
    files = {name: str(tmp_path / name) for name in ("q.csv", "arm.toml", "p.csv")}
    result = bezier.certify(files["q.csv"], robot=files["arm.toml"], along=files["p.csv"], within=30)
    words = ["certify", files["q.csv"], "--robot", files["arm.toml"], "--along", files["p.csv"], "--within", "30"]
    page, proof = tmp_path / "page.html", tmp_path / "proof.json"
    assert main([*words, "--json", "--page", str(page), "--certificate", str(proof)]) == 0
    assert json.loads(capsys.readouterr().out) == json.loads(json.dumps(result.to_json()))
    assert "position of a: EXCEEDED, worst 1.25 at t = 2" in str(result) and result.along is not None
    assert result.along.is_kept and not result.kept and "distance from the path" in page.read_text()
    sampled = np.stack([np.interp(np.linspace(0, 2, 2001), [0, 1, 2], q) for q in ([0, 0.5, 1.25], [0, 0.5, 0.5])], 1)
    places = Robot(read_arm((tmp_path / "arm.toml").read_text())).positions(sampled)
    path = np.stack([np.interp(np.linspace(0, 2, 2001), [0, 1, 2], p) for p in ([150, 100, 10], [0, 90, 140])], 1)
    assert abs(np.linalg.norm(places[:, :2] - path, axis=1).max() - result.along.to_json()["worst"]) < 1e-3
    assert main([*words, "--check", str(proof)]) == 0


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"along": "p.csv"}, "expected both"),
        ({"along": "p.csv", "within": 0}, "within"),
        ({"along": "p.csv", "within": 1, "robot": "ev3-120"}, "theta1, theta4, theta7"),
        ({"along": "long.csv", "within": 1}, "from t = 0 to 1"),
        ({"along": "flat.csv", "within": 1}, "as many coordinates"),
        ({"robot": "nobody"}, "arm: expected a file"),
    ],
)
def test_bad_paths_are_one_clear_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: dict[str, object], says: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("p.csv").write_text("time,x,y,z\n0,0,0,0\n1,1,1,1\n")
    Path("long.csv").write_text("time,x,y,z\n0,0,0,0\n2,1,1,1\n")
    Path("flat.csv").write_text("time,x,y\n0,0,0\n1,1,1\n")
    with pytest.raises(InputError) as raised:
        bezier.certify("p.csv", **arguments)
    assert says in str(raised.value) and "\n" not in str(raised.value)
