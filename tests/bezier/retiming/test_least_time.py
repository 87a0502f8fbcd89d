"""The least time along a path: known times, independent numbers, broken proposers, altered certificates, both doors."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import bezier
import qe
from bezier.cli import main
from bezier.interface.trajectory import LIMITED, limited_motion
from bezier.motion.timelaw import Law
from bezier.retiming.bound import bound, weights
from bezier.retiming.grid import Bounds, Grid, stops_of
from bezier.retiming.law import Step, fastest, is_motion, usual
from bezier.retiming.least_time import checked, least_time
from bezier.retiming.proposals import proposal
from bezier.trajectories.limits import Limit
from bezier.trajectories.piecewise import Trajectory
from qe.errors import CertificateRejected, InputError, Unable
from qe.exact.rational_poly import RationalPoly
from tests.bezier.trajectories.timed import least_time_law, spline
from tests.tables import each

F = Fraction
JOINTS = Path(__file__).resolve().parents[3] / "examples" / "joints"
HERMITE, QUINTIC = [0, 0, 3, -2], [0, 0, 0, 10, -15, 6]


def path(*rows: list[list[Any]], breaks: tuple[int, ...] = ()) -> Trajectory:
    pieces = tuple(tuple(RationalPoly.of(c) for c in row) for row in rows)
    return Trajectory(tuple("xyz"[: len(rows[0])]), tuple(map(F, breaks or range(len(rows) + 1))), pieces)


def limits_of(axes: int) -> list[Limit]:
    return [Limit(order, k, F(order)) for order in (1, 2) for k in range(axes)]


def kept(motion: bezier.LeastTime, limits: dict[str, float]) -> None:
    """By samples in floats, without any of the exact code."""
    for piece, h in zip(motion.trajectory.pieces, motion.trajectory.lengths, strict=True):
        t = np.linspace(0, float(h), 40)
        values = [np.polynomial.Polynomial([float(c) for c in p.coefficients()] or [0.0]) for p in piece]
        for order, name in ((1, "velocity"), (2, "acceleration"), (3, "jerk")):
            rows = np.array([p.deriv(order)(t) for p in values])
            assert np.abs(rows).max() <= limits.get(name, np.inf) * (1 + 1e-12)
            assert np.linalg.norm(rows, axis=0).max() <= limits.get(f"{name}_norm", np.inf) * (1 + 1e-12)


def test_numbers_stay_short_where_the_speed_stays_the_same() -> None:
    grid = Grid.of(path([[0, 10], [0, F(1, 3)]]))
    steps = fastest(grid, [0.3 * k / grid.nodes if k < 9 else 0.1 for k in range(grid.nodes)])
    assert is_motion(grid.path, grid.stops, steps) and len(steps) > 40
    assert max(len(str(step)) for step in steps) < 300  # 6,000 where each step makes up for the rounding before it


@each(1e-9, 1.0, 1e6, 1e9)
def test_the_unit_of_a_path_of_floats_does_not_matter(unit: float) -> None:
    """Its pieces join up to rounding errors, which are as large as the numbers are."""
    places = np.array([[0, 0], [1, 2.3], [3.7, 1], [5, 4.1]]) * unit
    found = bezier.retime(CubicSpline([0, 1.1, 2, 3.3], places), velocity=3 * unit, acceleration=4 * unit)
    assert found.verdict.is_kept and abs(float(found.duration) - 4.8596) < 1e-3
    found.check(found.certificate)


@each(
    {
        "speeds up, stays, slows down": (path([[0, 10]]), {"velocity": 2, "acceleration": 4}, 5.5),
        "without a limit of velocity": (path([[0, 10]]), {"acceleration": 4}, 2 * 2.5**0.5),
        "a constant coordinate": (path([[0, 10], [3], [0, -10]]), {"velocity": 2, "acceleration": 4}, 5.5),
        "norms": (path([[0, 3], [0, 4]]), {"velocity_norm": 2, "acceleration_norm": 4}, 3.0),
        "another parameter": (path([[0, F(1, 10**6)]], breaks=(0, 10**6)), {"velocity": 1, "acceleration": 2}, 1.5),
        "turns back": (path([[0, 2, -1]], breaks=(0, 2)), {"velocity": 2, "acceleration": 4}, 2.0),
        "a corner": (path([[0, 1], [0]], [[1], [0, 1]]), {"velocity": 2, "acceleration": 4}, 2.0),
        "begins and ends with q' = 0": (path([HERMITE]), {"velocity": 2, "acceleration": 4}, 1.0),
        "a corner with q' = 0": (path([HERMITE, [0]], [[1], HERMITE]), {"velocity": 2, "acceleration": 4}, 2.0),
        "a corner with q'' = 0, too": (path([QUINTIC, [0]], [[1], QUINTIC]), {"velocity": 2, "acceleration": 4}, 2.0),
        "another speed of the parameter": (path([[0, 1]], [[1, 2]]), {"velocity": 2, "acceleration": 4}, 2.0),
        "q' = 0 on the way": (path([HERMITE], [[1, 0, 3, -2]]), {"velocity": 2, "acceleration": 4}, 2.0),
        "q' = 0 inside": (path([[0, 3, -3, 1]], breaks=(0, 2)), {"velocity": 2, "acceleration": 4}, 2.0),
        "tiny": (path([[0, F(1, 10**12)]]), {"velocity": 1, "acceleration": 4}, 1e-6),
    },
    daily=3,
)
def test_the_least_time_lies_between_both_sides(along: Trajectory, limits: dict[str, float], seconds: float) -> None:
    motion = bezier.retime(along, **limits)  # type: ignore[arg-type]
    assert motion.bound <= seconds * (1 + 1e-12) and motion.duration >= seconds * (1 - 1e-12)
    assert motion.gap <= F(1, 250) and motion.verdict.is_kept
    kept(motion, limits)
    assert len(motion.rests) == ("rests where the parameter of the path stands still" in str(motion))
    if along.breaks[-1] != motion.path.breaks[-1]:
        listed = limited_motion({**dict.fromkeys(LIMITED), **limits}, len(along.names), "test")
        assert checked(along, listed, motion.certificate).duration == motion.duration


def test_a_limit_of_velocity_that_is_far_away_changes_nothing() -> None:
    """It took five times as long: the solver met rows that it could not scale, and its failure looked like a gap."""
    back = spline(np.array([[-0.747], [-0.747], [0.011]]))
    motion = bezier.retime(back, velocity=1000, acceleration=1)
    assert motion.gap <= F(1, 250) and motion.duration < F(5, 2)


@each((3, "norms"), (6, "axes"), (3, "axes"), daily=3)
def test_paths_are_as_fast_as_those_of_toppra_and_keep_their_limits(axes: int, kind: str) -> None:
    curve = spline(np.random.default_rng(axes).uniform(-1, 1, (7, axes)))
    limits = {"velocity": 1, "acceleration": 2}
    if kind == "norms":
        limits |= {"velocity_norm": F(3, 2), "acceleration_norm": F(5, 2)}
    motion = bezier.retime(curve, **limits)
    kept(motion, {name: float(value) for name, value in limits.items()})
    assert 1 < 1 + motion.gap <= F(251, 250)
    if kind == "axes":
        times = least_time_law(curve, axes, 1000)[0]
        assert float(motion.duration) <= 1.0025 * times[-1]
        assert float(motion.bound) <= 1.001 * times[-1]  # toppra's motion is at most that much too fast
    finer = bezier.retime(curve, **limits, accuracy=F(1, 700))
    assert motion.bound < finer.duration < motion.duration
    assert finer.gap <= F(1, 700)


@each(("cubic", 1.5), ("quintic", 1.875))
def test_a_law_with_a_formula_takes_its_own_least_time(law: str, peak: float) -> None:
    motion = bezier.retime(path([[0, 10]]), velocity=2, acceleration=100, law=law)
    assert float(motion.duration) == pytest.approx(10 / 2 * peak, rel=1e-5)
    assert motion.bound <= F(502, 100) and motion.verdict.is_kept
    with pytest.raises(qe.Unable, match="corners"):
        bezier.retime(path([[0, 1], [0]], [[1], [0, 1]]), acceleration=1, law=law)


def test_a_limit_of_jerk_is_kept_and_the_bound_is_that_without_it() -> None:
    limits = {"velocity": 100, "acceleration": 100, "jerk": 75}
    line = bezier.retime(path([[0, 10]]), **limits, law="quintic")
    assert float(line.duration) == pytest.approx(2, rel=1e-5)  # 60 * 10 / T^3 = 75
    least = bezier.retime(path([[0, 10]]), **limits)
    assert (32 * 10 / 75) ** (1 / 3) < float(least.duration) < 1.97  # with jerk as large as can be: 1.62
    curve, limits = path([[0, 3, -1], [0, 1, 2, -1]]), {"velocity": 1, "acceleration": 2}
    motion = bezier.retime(curve, **limits, jerk=F(1, 2), jerk_norm=1)
    kept(motion, {**limits, "jerk": 0.5, "jerk_norm": 1})
    assert motion.verdict.is_kept and motion.bound == bezier.retime(curve, **limits).bound < motion.duration
    with pytest.raises(InputError, match="acceleration jumps"):  # q'' does, at the break
        bezier.retime(path([[0, 1]], [[1, 1, 1]]), **limits, jerk=1, law="quintic")
    resting = bezier.retime(path([[0, 1]], [[1, 1, 1]]), **limits, jerk=1)  # there
    kept(resting, {**limits, "jerk": 1})
    assert any(step.state(F(0)) == (1, 0) for step in resting.steps)
    with pytest.raises(InputError, match="expected least or quintic with a limit of jerk"):
        bezier.retime(curve, **limits, jerk=20, law="trapezoid")


@each((7, 3), (8, 6), daily=1)
def test_with_a_limit_of_jerk_the_time_is_near_the_bound_without_it(seed: int, axes: int) -> None:
    """It was that of the quintic law, twice as much."""
    limits = {"velocity": 1, "acceleration": 2, "jerk": 20}
    curve = spline(np.random.default_rng(seed).uniform(-1, 1, (8, axes)))
    motion = bezier.retime(curve, **limits)
    kept(motion, limits)
    assert motion.bound < motion.duration < motion.bound * F(115, 100)
    quintic = bezier.retime(curve, **limits, law="quintic")
    assert motion.duration * F(3, 2) < quintic.duration
    motion.check(qe.Certificate.from_json(motion.certificate.to_json()))
    other = replace(motion, steps=(replace(motion.steps[0], duration=motion.steps[0].duration * 2), *motion.steps[1:]))
    with pytest.raises(CertificateRejected):
        other.check(motion.certificate)


def test_a_limit_of_time_gives_the_best_of_the_grids_that_are_solved() -> None:
    """They were forgotten, and the answer was that the limit was reached."""
    curve, limits = CubicSpline([0, 1, 2], [[0, 0], [1, 2], [3, 1]]), {"velocity": 3, "acceleration": 4}
    motion = bezier.retime(curve, **limits, accuracy="1e-300", timeout=3)  # type: ignore[arg-type]
    assert motion.missed == F(1, 10**300) and motion.verdict.is_kept and motion.gap < F(1, 250)
    assert "the accuracy 1e-300 was not reached" in motion.lines and motion.to_json()["accuracy not reached"]
    assert bezier.retime(curve, **limits, timeout=20).missed is None  # type: ignore[arg-type]
    with pytest.raises(qe.BudgetExceeded):
        bezier.retime(curve, **limits, timeout=1e-6)  # type: ignore[arg-type]


def test_a_motion_with_a_limit_of_jerk_rests_at_corners() -> None:
    """The quintic law cannot."""
    motion = bezier.retime(path([[0, 1], [0]], [[1], [0, 1]]), acceleration=2, velocity=1, jerk=50)
    kept(motion, {"velocity": 1, "acceleration": 2, "jerk": 50})
    assert "the bound is that without the limit of jerk, which it leaves aside" in motion.lines
    assert motion.duration < motion.bound * F(108, 100) and len(motion.steps) > 100


@each(
    {
        "stands still": (path([[1]]), "moves everywhere"),
        "jumps": (path([[0, 1]], [[2, 1]]), "continuous"),
        "too large": (path([[0, 10**400]]), "10\\^308"),
    }
)
def test_what_is_no_path_is_refused(along: Trajectory, words: str) -> None:
    with pytest.raises(InputError, match=words):
        bezier.retime(along, velocity=1, acceleration=1)


@pytest.mark.parametrize("along", [path([[0, 10**300]]), path([[0, F(10) ** 300]], breaks=(0, F(1, 10**300)))])
def test_numbers_beyond_floating_point_are_one_line(along: Trajectory) -> None:
    with pytest.raises(qe.Unable, match="floating point cannot hold"):
        bezier.retime(along, velocity=2, acceleration=5)


def test_arguments_that_make_no_sense_are_one_line() -> None:
    line = path([[0, 1]])
    for arguments, words in (
        ({"velocity": 1}, "acceleration or acceleration_norm"),
        ({"velocity": 1, "acceleration": [1, 2]}, "one for each of 1 axes"),
        ({"acceleration": -1}, "acceleration"),
        ({"acceleration": 1, "law": "linear"}, '"cubic" or "quintic" or "trapezoid" or "least"'),
        ({"acceleration": 1, "accuracy": 0}, "accuracy"),
        ({"acceleration": 1, "position": [2, 3]}, "no motion along it keeps the limits: position"),
    ):
        with pytest.raises(InputError, match=words):
            bezier.retime(line, **arguments)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="PPoly"):
        bezier.retime(3, acceleration=1)
    with pytest.raises(InputError, match="each of 2 axes"):
        least_time(path([[0, 1], [0, 2]]), [Limit(2, 1, F(1)), Limit(2, 1, F(2))])


# --- proofs -----------------------------------------------------------------------------------------------------------


@each({"all": ((1, 1), 1, (2, 2), 2), "axes": ((1, 1), None, (2, 2), None), "norms": (None, 1, None, 2)}, daily=3)
def test_whatever_is_proposed_no_bound_is_above_a_motion(
    velocity: Any, velocity_norm: Any, acceleration: Any, acceleration_norm: Any
) -> None:
    limits = Bounds(velocity, velocity_norm, acceleration, acceleration_norm)
    curve = path([[0, 1, 1], [0, 0, 1]])
    grid = Grid.of(curve)
    right = proposal(grid, limits)
    chance, proved = np.random.default_rng(7), 0
    for k in range(18):
        noise = {name: chance.normal(1, 10.0 ** -(k % 6), getattr(right, name).shape) for name in _PROPOSED}
        wrong = replace(right, **{name: getattr(right, name) * noise[name] for name in _PROPOSED})
        try:
            seconds = bound(curve, grid.stops, limits, tuple(weights(grid, wrong)))
        except (Unable, ValueError):
            continue
        proved += 1
        assert seconds <= right.duration
    assert proved


_PROPOSED = ("axes", "norm", "speeds", "rates")


def test_a_motion_of_another_path_or_without_rest_is_none() -> None:
    line, corner = path([[0, 1]]), path([[0, 1], [0]], [[1], [0, 1]])
    steps = least_time(line, limits_of(1)).steps
    stops = stops_of(line)
    assert is_motion(line, stops, steps)
    assert not is_motion(path([[0, 1]], breaks=(0, 2)), stops, steps)
    assert not is_motion(line, stops, steps[1:]) and not is_motion(line, stops, ())
    assert not is_motion(line, stops, (replace(steps[0], duration=steps[0].duration / 2), *steps[1:]))
    assert not is_motion(corner, stops_of(corner), usual(corner, Law.CUBIC, F(5)))
    even = (Step(RationalPoly.of([0, 1]), F(1)), Step(RationalPoly.of([1, 1]), F(1)))
    assert not is_motion(corner, stops_of(corner), even)  # round the corner without a rest
    rest = Step(RationalPoly.of([0, 0, 3, -2]), F(1))
    assert is_motion(corner, stops_of(corner), (rest, replace(rest, place=rest.place + RationalPoly.of([1]))))
    halves = (Step(RationalPoly.of([0, 0, 1]), F(1, 2)), Step(RationalPoly.of([F(1, 4), 2, F(-4, 3)]), F(3, 4)))
    assert [halves[0].state(F(1, 2))[0], *halves[1].state(F(3, 4))] == [F(1, 4), 1, 0]
    assert not is_motion(line, stops, halves)  # the speed jumps from 1 to 2


@pytest.fixture(scope="module")
def proved() -> tuple[Trajectory, list[Limit], str]:
    curve = path([[0, 1, 1], [0, 0, 1]])
    limits = [*limits_of(2), Limit(1, None, F(1))]
    return curve, limits, least_time(curve, limits, accuracy=F(1, 50)).certificate.to_json()


def test_a_certificate_proves_both_sides(proved: tuple[Trajectory, list[Limit], str]) -> None:
    curve, limits, text = proved
    certificate = qe.Certificate.from_json(text)
    assert qe.verify(certificate).accepted
    again = checked(curve, limits, certificate)
    assert again.bound < again.duration < again.bound * F(51, 50)
    again.check(certificate)
    tighter = [*limits[:-1], Limit(1, None, F(99, 100))]
    for other, listed in ((curve, tighter), (curve, limits[:-1]), (path([[0, 1, 1], [0, 0, 2]]), limits)):
        with pytest.raises(CertificateRejected):
            checked(other, listed, certificate)
    for row in ([[0, 10**400]], [[0, F(1, 10**400)]], [[0, 1, F(1, 10**400)]]):
        with pytest.raises((CertificateRejected, InputError)):
            checked(path([*row, [0, 0, 1]]), limits, certificate)


@each(40, pytest.param(1000, marks=pytest.mark.deep))
def test_altered_certificates_are_rejected(count: int, proved: tuple[Trajectory, list[Limit], str]) -> None:
    curve, limits, text = proved
    chance = Random(count)
    for _ in range(count):
        data = json.loads(text)
        data.pop("digest", None)
        members = next(v for v in data.values() if isinstance(v, list))
        member = chance.choice(members)
        head, _, said = member["label"].partition(": ")
        kind = chance.randrange(4)
        if kind == 0:
            members.remove(member)
        elif kind == 1:
            members.insert(chance.randrange(len(members)), member)
        elif said:
            numbers = said.split(" ")
            places = [i for i, word in enumerate(numbers) if word.strip(":").replace("/", "").lstrip("-").isdigit()]
            i = chance.choice(places)
            old = F(numbers[i].strip(":"))
            new = old * F(chance.choice(["-1", "1/2", "3/2", "1000001/1000000"])) if old else F(1, 1000)
            numbers[i] = numbers[i].replace(numbers[i].strip(":"), str(new))
            member["label"] = f"{head}: {' '.join(numbers)}"
        else:
            continue
        with pytest.raises(qe.QEError):
            checked(curve, limits, qe.Certificate.from_json(json.dumps(data)))


# --- doors ------------------------------------------------------------------------------------------------------------


def test_the_command_writes_a_motion_that_certify_accepts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["retime", str(JOINTS / "path.csv"), "--limits", str(JOINTS / "limits.toml")]
    out, proof, page = (tmp_path / name for name in ("m.csv", "p.json", "p.html"))
    assert main([*words, "--out", str(out), "--certificate", str(proof), "--page", str(page), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    limits = {"position": [[-2, 2], ["-1.5", "1.5"]], "velocity": "0.9", "acceleration": [4, 5]}
    motion = bezier.retime(JOINTS / "path.csv", **limits)  # type: ignore[arg-type]
    assert data == json.loads(json.dumps(motion.to_json())) and motion.to_csv() == out.read_text()
    assert main(["certify", str(out), *words[2:]]) == 0
    assert "all limits are kept for all t" in capsys.readouterr().out
    assert "at least" in page.read_text() and page.read_text().count("<figure>") == 6
    assert main([*words, "--check", str(proof)]) == 0
    assert capsys.readouterr().out.endswith("accepted\n")
    other = tmp_path / "l.toml"
    other.write_text("velocity = 0.8\nacceleration = [4, 5]\n")
    assert main([*words[:3], str(other), "--check", str(proof)]) == 4
    assert main([*words, "--law", "cubic"]) == 0
    capsys.readouterr()
    assert main([*words, "--accuracy", "1e-300", "--timeout", "4"]) == 0
    assert "the accuracy 1e-300 was not reached\n" in capsys.readouterr().out
    assert main([*words, "--accuracy", "x"]) == 2
    assert main([*words, "--out", str(tmp_path / "m.json")]) == 2


def test_splines_of_scipy_are_paths() -> None:
    curve = CubicSpline([0, 1, 2], [[0, 0], [1, 2], [3, 1]])
    motion = bezier.retime(curve, velocity=3, acceleration=4, accuracy="1/50")
    assert str(motion).splitlines()[-1] == "all limits are kept for all t"
    certified = bezier.certify(motion.trajectory, velocity=3, acceleration=4)
    assert certified.kept
