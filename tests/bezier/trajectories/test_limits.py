"""Trajectories against limits: exact peaks, decisions at the limit itself, the least slowing down, certificates."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from random import Random
from time import process_time
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BSpline, CubicSpline

import qe
from bezier.cli import main
from bezier.curves.sentences import verified
from bezier.trajectories.evidence import members, stated
from bezier.trajectories.exact import composed
from bezier.trajectories.limits import Limit, Verdict, decided, is_below
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.readers import from_scipy, load
from qe.errors import CertificateRejected, InputError, QEError
from qe.exact.rational_poly import RationalPoly
from tests.bezier.trajectories.timed import least_time_law, spline, timed
from tests.tables import each

F, TOLERANCE = Fraction, Fraction(1, 10**9)


def slowed(trajectory: Trajectory, factor: F) -> Trajectory:
    """The same path in ``factor`` times the time."""
    laws = [RationalPoly.of([start, 1 / factor]) for start in trajectory.breaks[:-1]]
    return composed(trajectory, [t * factor for t in trajectory.breaks], laws)


def one(coefficients: list[int], length: int = 1) -> Trajectory:
    return Trajectory(("x",), (F(0), F(length)), ((RationalPoly.of(coefficients),),))


def limits_of(axes: int) -> list[Limit]:
    return [Limit(order, k, F(order)) for order in (1, 2) for k in range(axes)]


def samples(path: CubicSpline, law: tuple[Any, ...], breaks: Any, count: int) -> Any:
    """The largest velocities and accelerations in floats, both ends of every piece among the samples."""
    shares = np.linspace(0, 1, max(count // (len(breaks) - 1), 2))
    t = breaks[:-1, None] + np.diff(breaks)[:, None] * shares
    i = np.searchsorted(law[0], (breaks[:-1] + breaks[1:]) / 2)[:, None] - 1
    u = t - law[0][i]
    s, speed, force = law[1][i] + law[2][i] * u + law[3][i] * u * u / 2, law[2][i] + law[3][i] * u, law[3][i]
    velocity, bend = path(s, 1) * speed[..., None], path(s, 2) * speed[..., None] ** 2
    return np.array([np.abs(velocity).max((0, 1)), np.abs(bend + path(s, 1) * force[..., None]).max((0, 1))]).ravel()


@each(-1, 0, 1)
def test_a_limit_exceeded_by_less_than_any_enclosure_tells_where_an_end_just_reaches_it(sign: int) -> None:
    """1 - t*(t^2 - c)^2 + sign*t/10^k is 1 at t = 0 and, next to the square root of c, above 1 by 10^-k."""
    rng = Random(sign)
    for k in rng.sample(range(30, 200), 12):
        t, c = RationalPoly.of([0, 1]), F(rng.randint(1, 9), 11)
        square = RationalPoly.of([-c, 0, 1])
        above = t * (RationalPoly.of([sign * F(1, 10**k)]) - square * square)
        side = rng.choice((1, -1))
        moving = Trajectory(("x",), (F(0), F(1)), ((RationalPoly.of([side]) + RationalPoly.of([side]) * above,),))
        assert decided(moving, [Limit(0, 0, F(1), F(-1))], TOLERANCE).is_kept == (sign <= 0)


@each((3, 100), (6, 100), (6, 1000), (3, 1000), daily=3)
def test_paths_timed_by_toppra_break_their_limits_between_grid_points(axes: int, count: int) -> None:
    pytest.importorskip("toppra")
    path = spline(np.random.default_rng(axes).uniform(-1, 1, (7, axes)))
    law = least_time_law(path, axes, count)
    trajectory, start = timed(path, law), process_time()
    verdict = decided(trajectory, limits_of(axes), TOLERANCE)
    assert process_time() - start < 1
    assert not verdict.is_kept and not verdict.breaking
    assert verdict.factor is not None and 1 < verdict.factor <= F(104, 100)
    sampled = samples(path, law, np.array(list(map(float, trajectory.breaks))), 10**6)
    exact = np.array([abs(o.value) for o in verdict.outcomes])
    assert np.all(exact >= sampled - 1e-12)
    assert np.all(exact <= sampled + 1e-9)
    slower = decided(slowed(trajectory, verdict.factor), limits_of(axes), TOLERANCE)
    assert slower.is_kept
    faster = decided(slowed(trajectory, verdict.factor - F(1, 10**6)), limits_of(axes), TOLERANCE)
    assert not faster.is_kept


def test_a_limit_that_is_touched_at_an_irrational_time_is_kept_and_any_lower_one_is_not() -> None:
    trajectory = one([0, 2, 0, -1], 2)  # velocity 2 - 3 t^2, acceleration -6 t
    assert decided(one([0, 0, 0, 2, 0, -1]), [Limit(0, 0, F(2), F(0))], TOLERANCE).is_kept
    assert decided(trajectory, [Limit(1, 0, F(10))], TOLERANCE).is_kept
    tight = decided(trajectory, [Limit(1, 0, F(10) - F(1, 10**60))], TOLERANCE)
    assert not tight.is_kept and tight.factor is not None
    square = RationalPoly.of([F(5), -1])  # (t^2 - 2)^2 touches 0 at the root of 2
    p = RationalPoly.of([-2, 0, 1]) * RationalPoly.of([-2, 0, 1])
    assert is_below(p, F(2), -1, F(0)) and not is_below(p, F(2), -1, F(-1, 10**50))
    assert is_below(square, F(1), 1, F(5))


def test_the_time_of_a_peak_is_an_algebraic_number() -> None:
    verdict = decided(one([0, 3, 0, -1], 2), [Limit(0, 0, F(1), F(-2))], TOLERANCE)  # 3 t - t^3, largest at 1
    worst = verdict.worst
    assert worst is not None and worst.time(verdict.trajectory) == 1 and worst.value == 2 and verdict.factor is None
    peak = decided(one([0, 2, 0, -1], 2), [Limit(0, 0, F(1), F(-4))], TOLERANCE).worst
    assert peak is not None and peak.time(one([0, 2, 0, -1], 2)).minimal_polynomial == (-2, 0, 3)


def test_norms_and_jerk_are_repaired_by_their_powers() -> None:
    trajectory = Trajectory(("x", "y"), (F(0), F(1)), ((RationalPoly.of([0, 3]), RationalPoly.of([0, 4])),))
    verdict = decided(trajectory, [Limit(1, None, F(4))], TOLERANCE)
    assert verdict.worst is not None and verdict.worst.value == 5 and verdict.factor == F(5, 4)
    jerk = decided(one([0, 0, 0, 1]), [Limit(3, 0, F(3, 4))], TOLERANCE)  # jerk 6, eight times its limit
    assert jerk.factor == 2


def test_a_jump_of_what_must_be_continuous_refutes_and_no_slowing_down_repairs_it() -> None:
    pieces = ((RationalPoly.of([0, 1]),), (RationalPoly.of([1, 2]),))
    verdict = decided(Trajectory(("x",), (F(0), F(1), F(2)), pieces), [Limit(2, 0, F(1))], TOLERANCE)
    assert [j.size for j in verdict.breaking] == [1] and not verdict.is_kept and verdict.factor is None
    assert decided(verdict.trajectory, [Limit(1, 0, F(2))], TOLERANCE).is_kept


def test_numbers_far_beyond_floats_are_decided() -> None:
    for scale in (10**400, F(1, 10**400)):
        trajectory = Trajectory(("x",), (F(0), F(1)), ((RationalPoly.of([0, F(scale), -F(scale)]),),))
        assert decided(trajectory, [Limit(0, 0, F(scale) / 4, F(0))], TOLERANCE).is_kept
        assert not decided(trajectory, [Limit(0, 0, F(scale) * F(24, 100), F(0))], TOLERANCE).is_kept


# --- certificates -----------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def proved() -> tuple[Verdict, str]:
    path = CubicSpline([0, 0.7, 1.5, 2], np.random.default_rng(3).uniform(-1, 1, (4, 2)))
    listed = [*limits_of(2), Limit(1, None, F(2))]
    verdict = decided(from_scipy(path), listed, TOLERANCE)
    assert not verdict.is_kept and verdict.factor is not None
    return verdict, qe.Certificate.bundle(members(verdict)).to_json()


def test_a_certificate_is_accepted_and_says_the_repair(proved: tuple[Verdict, str]) -> None:
    verdict, text = proved
    verified(qe.Certificate.from_json(text), stated(verdict))


@pytest.mark.parametrize("count", [100, pytest.param(1000, marks=pytest.mark.deep)])
def test_altered_sentences_are_rejected(proved: tuple[Verdict, str], count: int) -> None:
    verdict, text = proved
    random = Random(count)
    for _ in range(count):
        data = json.loads(text)
        data.pop("digest", None)
        altered = _altered(data, random)
        with pytest.raises(QEError):
            verified(qe.Certificate.from_json(json.dumps(altered)), stated(verdict))


def _altered(data: Any, random: Random) -> Any:
    """One member dropped, doubled or exchanged, or one number of a sentence, of an answer or of a label changed."""
    listed = next(v for v in data.values() if isinstance(v, list))
    i = random.randrange(len(listed))
    what = random.choice(["drop", "double", "exchange", "number", "number", "number"])
    if what == "drop":
        del listed[i]
    elif what == "double":
        listed.insert(i, listed[i])
    elif what == "exchange":
        listed[i], listed[i - 1] = listed[i - 1], listed[i]
    else:
        whole = json.dumps(listed[i])
        first = whole.index('"start"')
        places = [k for k, c in enumerate(whole) if c.isdigit() and first < k < whole.index('"steps"')]
        k = random.choice(places)
        listed[i] = json.loads(f"{whole[:k]}{(int(whole[k]) + random.randint(1, 8)) % 9 + 1}{whole[k + 1 :]}")
        if listed[i] == json.loads(whole):
            del listed[i]
    return data


def test_the_certificate_of_another_trajectory_is_rejected(proved: tuple[Verdict, str]) -> None:
    verdict, text = proved
    other = decided(slowed(verdict.trajectory, F(101, 100)), [o.limit for o in verdict.outcomes], TOLERANCE)
    with pytest.raises(CertificateRejected):
        verified(qe.Certificate.from_json(text), stated(other))


# --- readers ----------------------------------------------------------------------------------------------------------


def test_splines_of_scipy_are_what_scipy_evaluates(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    cubic = CubicSpline(np.sort(random.uniform(0, 5, 6)), random.uniform(-1, 1, (6, 3)))
    basis = BSpline(np.r_[[0.0] * 4, 1, 2, 2, [3.0] * 4], random.uniform(-1, 1, (7, 2)), 3)
    np.savez(tmp_path / "a.npz", c=cubic.c, x=cubic.x)
    np.savez(tmp_path / "b.npz", t=basis.t, c=basis.c, k=3)
    for value, file in ((cubic, "a.npz"), (basis, "b.npz")):
        read = load(tmp_path / file)
        assert read == from_scipy(value)
        for i, row in enumerate(read.pieces):
            at = read.lengths[i] / 3
            ours = [float(p(at)) for p in row]
            assert np.allclose(ours, value(float(read.breaks[i] + at)), atol=1e-12)


def test_the_same_motion_in_every_format(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time,q1,q1_velocity\n0,0,0\n2,1,0.5\n")
    (tmp_path / "b.csv").write_text("duration,q1^0,q1^2,q1^3\n2,0,0.5,-0.125\n")
    point = {"positions": ["1"], "velocities": [0.5], "time_from_start": {"sec": 2, "nanosec": 0}}
    start = {"positions": [0], "velocities": [0], "time_from_start": {"sec": 0, "nanosec": 0}}
    (tmp_path / "c.json").write_text(json.dumps({"trajectory": {"joint_names": ["q1"], "points": [start, point]}}))
    (tmp_path / "d.yaml").write_text(
        "joint_names: [q1]\npoints:\n- {positions: [0], velocities: [0.0], time_from_start: {sec: 0, nanosec: 0}}\n"
        "- {positions: [1.0], velocities: [0.5], time_from_start: {sec: 2, nanosec: 0}}\n"
    )
    control = [[0, 0, "2/3", 1]]
    (tmp_path / "e.json").write_text(json.dumps({"start_time": 0, "end_time": 2, "control_points": control}))
    basis = {"order": 4, "knots": [0, 0, 0, 0, 2, 2, 2, 2]}
    (tmp_path / "f.json").write_text(json.dumps({"basis": basis, "control_points": control}))
    expected = load(tmp_path / "a.csv")
    for name in ("b.csv", "c.json", "d.yaml", "e.json", "f.json"):
        assert load(tmp_path / name) == expected, name
    assert load(tmp_path / "a.csv", "linear").pieces[0][0] == RationalPoly.of([F(0), F(1, 2)])


TWICE = [{"positions": [k, k], "time_from_start": k} for k in (0, 1)]


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("a.csv", "time,x\n0,0\n", "two times"),
        ("a.csv", "time,x\n0,0\n0,1\n", "a.csv: trajectory: expected times that ascend"),
        ("a.csv", "duration,x^0,^1\n1,0,0\n", "a.csv: trajectory: expected different names of axes"),
        ("a.csv", "time,x\n0,nan\n1,1\n", "row 2, column x: expected a number"),
        ("a.csv", "time,x,y,x_velocity\n0,0,0,0\n1,1,1,1\n", "for every axis"),
        ("a.csv", "", "names of columns"),
        ("a.json", '{"points": 3}', "joint_names"),
        ("a.json", json.dumps({"joint_names": ["a", "a"], "points": TWICE}), "names of axes, found a, a"),
        ("a.json", json.dumps({"joint_names": ["a"], "points": [{"positions": [0]}] * 2}), "number, found nothing"),
        ("a.json", "[]", "expected points"),
        ("a.json", '{"basis": {"order": 2, "knots": [0, 1]}, "control_points": [[1, 2]]}', "knots"),
        ("a.yaml", "points: [", "expected YAML"),
        ("a.txt", "", "ending .txt"),
        ("a.npz", "nothing", "expected an .npz file"),
    ],
)
def test_bad_files_are_one_clear_line(tmp_path: Path, name: str, text: str, says: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError) as raised:
        load(tmp_path / name)
    assert says in str(raised.value) and "\n" not in str(raised.value)


# --- the command ------------------------------------------------------------------------------------------------------


def test_the_command_proves_checks_and_rejects(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, limits, scene = tmp_path / "m.csv", tmp_path / "l.toml", tmp_path / "s.toml"
    file.write_text("time,x,y\n0,0,0\n1,1,0\n2,1,2\n")
    limits.write_text("velocity = [1, 1]\n")
    ball = 'kind = "ball"\ncentre = [0, 2, 0]\nradius = 0.5'
    bowl = 'kind = "formula"\nformula = "y >= 1 + 4*(x - %s)^2"'
    scene.write_text(f"[[obstacle]]\n{ball}\n[[obstacle]]\n{bowl % 0.4}\n")
    proof = tmp_path / "c.json"
    words = ["certify", str(file), "--limits", str(limits), "--scene", str(scene)]
    assert main([*words, "--certificate", str(proof)]) == 0
    said = capsys.readouterr().out
    assert "velocity of y: EXCEEDED, worst 2 at t = 1" in said and "2 = 2 times as slow" in said and "clear of" in said
    page = tmp_path / "page.html"
    assert main([*words, "--check", str(proof), "--page", str(page)]) == 0
    assert page.read_text().count("<figure>") == 3 and "EXCEEDED" in page.read_text()
    assert "accepted" in capsys.readouterr().out and "distance from ball 1" in page.read_text()
    limits.write_text("velocity = [1, 1.5]\n")
    assert main([*words, "--check", str(proof)]) == 4
    scene.write_text(f"[[obstacle]]\n{ball}\n[[obstacle]]\n{bowl % 0.6}\n")  # the corner at (1, 2) is on its boundary
    assert main(words) == 0 and "formula 2, first at t = " in capsys.readouterr().out
    huge = tmp_path / "huge.csv"
    huge.write_text("time,x,y\n0,0,0\n1,1e400,0\n")
    assert main(["certify", str(huge), "--limits", str(limits)]) == 2
    assert "beyond 10^308" in capsys.readouterr().err
    limits.write_text("speed = 1\n")
    assert main(words) == 2
    assert "unknown key" in capsys.readouterr().err
