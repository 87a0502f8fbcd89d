"""Plans in the forms of other programs, compared with exact evaluation."""

from __future__ import annotations

import io
import json
import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bezier
import qe
from bezier.exports.formats import ppoly
from bezier.exports.plane import polyline
from bezier.interface.work import Work
from bezier.motion.motion import in_time, state
from bezier.motion.track import Track
from tests.tables import each

BALL = {"kind": "ball", "name": "a <ball> & co", "centre": [0, 2, 1], "radius": 1.5}
GIVEN = {"start": [-4, 2, 1], "via": [[-1.5, 2, 3], [1.5, 2, 3]], "goal": [4, 2, 1], "radius": 6, "method": "cubic"}


@pytest.fixture(scope="module")
def timed() -> bezier.Planned:
    limits = {"law": "trapezoid", "max_speed": 2, "max_acceleration": 1.5}
    return bezier.plan(**GIVEN, obstacles=[BALL], limits=limits, ratio=0.75)


@pytest.fixture(scope="module")
def plain() -> bezier.Planned:
    return bezier.plan(**GIVEN)


def times(plan: bezier.Planned) -> np.ndarray:
    return np.linspace(0, float(plan.duration), 203)


def test_positions_are_those_of_the_exact_motion(timed: bezier.Planned) -> None:
    for k in range(38):
        tau = Fraction(k, 37)
        _, _, exact = state(timed.path, timed.motion, tau)
        t = min(float(tau * timed.duration), float(timed.duration))
        for found, vector in zip((timed(t), timed.velocity(t), timed.acceleration(t)), exact):
            assert found == pytest.approx([float(c) for c in vector], abs=1e-9)


def test_pieces_meet_and_last_as_long_as_the_motion(timed: bezier.Planned, plain: bezier.Planned) -> None:
    for plan in (timed, plain):
        chain = in_time(plan.path, plan.motion)
        assert (chain.breaks[0], chain.breaks[-1]) == (0, plan.duration)
        assert chain.jump(0) is None or chain.jump(0).size < Fraction(1, 10**15)


def test_positions_without_a_motion(plain: bezier.Planned) -> None:
    assert plain.duration == 3 and plain.motion is None
    for t in (0, 0.5, 1, 1.25, 2, 3):
        name = "PQR"[min(int(t), 2)]
        exact = plain.curves[name].point(Fraction(t) - "PQR".index(name))
        assert plain(t) == pytest.approx([float(c) for c in exact], abs=1e-12)
    assert plain([[0, 1], [2, 3]]).shape == (2, 2, 3) and plain([]).shape == (0, 3)


@each(-1e-9, 3.1, math.nan, math.inf, "x", None, [0, 5], 1j)
def test_times_outside_are_refused(t: object, plain: bezier.Planned) -> None:
    with pytest.raises(qe.InputError, match=r"^t: "):
        plain(t)


def test_scipy_says_the_same(timed: bezier.Planned, plain: bezier.Planned) -> None:
    for plan in (timed, plain):
        spline, powers, at = plan.to_bspline(), plan.to_ppoly(), times(plan)
        for order, own in enumerate((plan, plan.velocity)):
            scale = np.abs(own(at)).max()
            assert np.abs(spline(at, nu=order) - own(at)).max() < 1e-9 * scale
            assert np.abs(powers(at, nu=order) - own(at)).max() < 1e-9 * scale
        assert np.isnan(spline(float(plan.duration) + 1)).all() and np.isnan(powers(-1.0)).all()


def test_without_scipy_one_line_says_what_is_missing(plain: bezier.Planned, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "scipy.interpolate", None)
    for ask in (plain.to_bspline, plain.to_ppoly):
        with pytest.raises(qe.Unable, match=r"scipy is not installed; it comes with: pip install 'bezier-qe\[plan\]'"):
            ask()


def test_arrays(timed: bezier.Planned, tmp_path: Path) -> None:
    (file,) = timed.save(tmp_path / "path.npz")
    with np.load(file, allow_pickle=False) as found:
        assert np.array_equal(found["position"], timed(found["time"]))
        assert np.array_equal(found["velocity"], timed.velocity(found["time"]))
        assert found["time"][-1] == float(timed.duration) and found["control"].shape[2] == 3
        speed = np.linalg.norm(found["velocity"], axis=1).max()
        assert speed <= 2 + 1e-9 and np.linalg.norm(found["acceleration"], axis=1).max() <= 1.5 + 1e-9


def test_csv_and_json(timed: bezier.Planned, plain: bezier.Planned, tmp_path: Path) -> None:
    assert plain.to_csv().splitlines()[3].startswith("t,x,y,z")
    stored = json.loads(plain.save(tmp_path / "path.json")[0].read_text())
    assert stored["points"]["P0"][0]["exact"] == "-4"
    table = np.genfromtxt(io.StringIO(timed.to_csv()), delimiter=",", skip_header=4, usecols=range(4))
    assert timed(np.minimum(table[:, 0], float(timed.duration))) == pytest.approx(table[:, 1:], abs=1e-7)


def test_ros_messages(timed: bezier.Planned, plain: bezier.Planned) -> None:
    yaml = pytest.importorskip("yaml")
    free = yaml.safe_load(timed.to_ros(frame='a "frame": #1', rows=11))
    gantry = yaml.safe_load(timed.to_ros(joints=["x", "y", "z"], rows=11))
    assert free["header"]["frame_id"] == 'a "frame": #1' and gantry["joint_names"] == ["x", "y", "z"]
    assert len(free["points"]) == len(gantry["points"]) == 11
    for one, other in zip(free["points"], gantry["points"]):
        assert one["time_from_start"] == other["time_from_start"]
        t = one["time_from_start"]["sec"] + one["time_from_start"]["nanosec"] / 1e9
        t = min(t, float(timed.duration))
        place = [one["transforms"][0]["translation"][axis] for axis in "xyz"]
        assert place == other["positions"] and np.array(place) * 1000 == pytest.approx(timed(t), abs=1e-6)
        velocity = [one["velocities"][0]["linear"][axis] for axis in "xyz"]
        assert velocity == other["velocities"] and np.array(velocity) * 1000 == pytest.approx(
            timed.velocity(t), abs=1e-6
        )
        assert one["transforms"][0]["rotation"] == {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
    assert all(isinstance(v, float) for p in gantry["points"] for v in p["accelerations"])
    with pytest.raises(qe.InputError, match="a plan with limits= expected"):
        plain.to_ros()
    for wrong in (
        {"joints": ["x"]},
        {"joints": "xyz"},
        {"joints": [1, 2, 3]},
        {"rows": 1},
        {"rows": 2.5},
        {"frame": 3},
    ):
        with pytest.raises(qe.InputError):
            timed.to_ros(**wrong)


def places(code: str) -> np.ndarray:
    moves = [line.split() for line in code.splitlines() if " X" in line]
    return np.array([[float(word[1:]) for word in move if word[0] in "XY"] for move in moves])


@each(0.5, 0.01)
def test_gcode_stays_within_the_tolerance(tolerance: float, plain: bezier.Planned) -> None:
    code = plain.to_gcode(plane="xz", tolerance=tolerance, feed=600)
    lines = code.splitlines()
    assert lines[1:3] == ["G21", "G90"] and lines[-1] == "M2" and lines[-2] == "G0 Z5" and "F600" in code
    corners = places(code)
    assert corners[0].tolist() == [-4, 1] and corners[-1].tolist() == [4, 1]
    path = plain(np.linspace(0, 3, 3001))[:, [0, 2]]
    a, b = corners[:-1, None], corners[1:, None]
    share = np.clip(((path - a) * (b - a)).sum(-1) / ((b - a) ** 2).sum(-1), 0, 1)[..., None]
    assert np.linalg.norm(a + share * (b - a) - path, axis=-1).min(0).max() < tolerance + 1e-4
    assert len(plain.to_gcode(plane="xz", tolerance=0.001).splitlines()) > len(lines)


def test_chords_are_as_near_as_asked() -> None:
    arc = np.array([[0.0, 0.0], [0.0, 8.0], [8.0, 8.0]])
    points = polyline(arc, 0.1)
    u = np.linspace(0, 1, len(points))[:, None]
    middle = (u[:-1] + u[1:]) / 2
    on = (1 - middle) ** 2 * arc[0] + 2 * middle * (1 - middle) * arc[1] + middle**2 * arc[2]
    assert np.linalg.norm((points[:-1] + points[1:]) / 2 - on, axis=1).max() <= 0.1
    assert len(polyline(np.array([[0.0, 0.0], [3.0, 4.0]]), 1e-9)) == 2


def test_svg_is_an_image_of_the_path(timed: bezier.Planned, plain: bezier.Planned) -> None:
    space = "{http://www.w3.org/2000/svg}"
    for plane, plan in (("xy", plain), ("xz", timed), ("yz", timed)):
        root = ET.fromstring(plan.to_svg(plane=plane))
        assert root.tag == f"{space}svg" and root.get("aria-label")
        assert len(root.findall(f"{space}circle")) == 4
        (path,) = [p for p in root.findall(f"{space}path") if "C" in p.get("d")]
        assert path.get("d").startswith("M-4,-2 C" if plane == "xy" else "M-4,-1 C" if plane == "xz" else "M2,-1 C")
    assert ET.fromstring(timed.to_svg()).find(f"{space}polygon/{space}title").text == "a <ball> & co"
    assert "<polygon" not in plain.to_svg()


def test_curves_of_high_degree_are_drawn_by_chords() -> None:
    single = {"degree": 6, "a": -2, "b": 2, "height_y": 1, "height_z": 3}
    plan = bezier.plan(start=[-4, 0, 1], goal=[4, 0, 1], method="single", radius=8, single=single)
    assert "C" not in plan.to_svg(plane="xz").split('fill="none"')[2] and " L" in plan.to_svg(plane="xz")


@each(
    (lambda p: p.to_svg(plane="zx"), "plane: one of xy, xz, yz expected"),
    (lambda p: p.to_gcode(plane=3), "plane: one of"),
    (lambda p: p.to_gcode(tolerance=0), "tolerance: a number above zero"),
    (lambda p: p.to_gcode(tolerance="x"), "tolerance: a number above zero"),
    (lambda p: p.to_gcode(tolerance=1e-30), "tolerance: one with at most 200000 lines"),
    (lambda p: p.to_gcode(tolerance="1e-400"), "within the range of floating point"),
    (lambda p: p.to_gcode(feed="1e400"), "within the range of floating point"),
    (lambda p: p.to_gcode(feed=-1), "feed: a number above zero"),
    (
        lambda p: p.save("path.docx"),
        "target: one of .csv, .json, .npz, .yaml, .gcode, .svg or the name of a folder",
    ),
    (lambda p: p.save(3), "target: the name of a file expected"),
    (lambda p: p.save("/nowhere/at/all/path.csv"), "cannot be written"),
)
def test_misuse(ask, told: str, plain: bezier.Planned) -> None:
    with pytest.raises(qe.InputError) as caught:
        ask(plain)
    assert told in str(caught.value) and "\n" not in str(caught.value)


def test_a_distance_that_is_not_known_is_not_left_out(timed: bezier.Planned) -> None:
    first, *rest = timed.findings
    unknown = bezier.Planned(Work.done(replace(timed.found, findings=(replace(first, distance=None), *rest))))
    assert unknown.clearance is None and len(unknown.findings) == 3


def test_the_least_distance(timed: bezier.Planned, plain: bezier.Planned) -> None:
    assert plain.clearance is None and timed.clearance is not None
    at = timed(np.linspace(0, float(timed.duration), 4001))
    nearest = np.linalg.norm(at - [0, 2, 1], axis=1).min() - 1.5
    assert float(timed.clearance.low) <= nearest <= float(timed.clearance.high) + 1e-4
    assert float(timed.length.low) <= np.linalg.norm(np.diff(at, axis=0), axis=1).sum() + 1e-4


def test_times_that_floating_point_cannot_tell_apart_are_no_jump() -> None:
    plan = bezier.plan(**GIVEN, limits={"law": "trapezoid", "ramp": "1e-30", "duration": 5})
    assert plan.certified and plan.curves
    for ask in (lambda: plan(0), plan.to_bspline, plan.to_ros):
        with pytest.raises(qe.Unable, match="shorter than floating point can resolve"):
            ask()
    assert plan.to_gcode() and plan.to_csv()


def test_a_motion_of_centuries_has_no_message() -> None:
    plan = bezier.plan(**GIVEN, limits={"duration": 10**10})
    with pytest.raises(qe.InputError, match=r"less than 2\^31 s expected"):
        plan.to_ros()
    assert plan(1e10) == pytest.approx([4, 2, 1])


@given(st.integers(1, 31), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_powers_are_as_good_as_control_points(degree: int, pieces: int, seed: int) -> None:
    """Over a whole piece of degree 30, the single curve with limits, they were 1e-7 mm off."""
    random = np.random.default_rng(seed)
    track = Track(np.linspace(0, 9, pieces + 1), random.uniform(-6, 6, (pieces, degree + 1, 3)))
    at = np.linspace(0, 9, 100)
    assert np.allclose(ppoly(track)(at), track.at(at), rtol=0, atol=1e-9)
    assert np.allclose(track.halved().at(at), track.at(at), rtol=0, atol=1e-12)
