"""Joint sequences and the motion of the joints in time; their files and page."""

from __future__ import annotations

import csv
import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from bezier.arm.joint_path import joint_path
from bezier.arm.joint_plan import JointPlan, joint_plan, to_csv, to_json
from bezier.arm.kinematics import positions
from bezier.arm.motion import joint_motion
from bezier.arm.reader import load_arm, read_arm
from bezier.arm.sequence import joint_sequence, samples_of
from bezier.cli.app import main
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.motion.timelaw import Law, TimeLaw
from bezier.planner.arm import render
from qe.errors import InputError, Unable
from tests.tables import each

ARM = load_arm("ev3-120")
QUINTIC = TimeLaw.of(Law.QUINTIC)
WHOLE = (Fraction(1),)
LINE = Bezier.of([(10, 40, 80), (40, 100, 20)])
EV3 = Path(__file__).parents[3] / "bezier" / "arm" / "data" / "ev3-120.toml"


@pytest.fixture(scope="module")
def plan() -> JointPlan:
    return joint_plan(ARM, {"line": LINE}, QUINTIC, Fraction(50), 51)


def test_the_published_trajectory(plan: JointPlan, shared: Path) -> None:
    assert plan.is_proved and plan.sequence is not None and plan.sequence.run is not None
    assert not plan.sequence.switches
    rows = [json.loads(x) for x in (shared / "corpora/ev3/trajectory_51_L120.jsonl").read_text().splitlines()]
    for row, angles in zip(rows, plan.sequence.angles, strict=True):
        known = np.array(row["solutions_theta1_theta4_theta7"], dtype=float)
        gaps = np.abs((known - angles + np.pi) % (2 * np.pi) - np.pi).max(axis=1)
        assert gaps.min() < 1e-7


def test_the_sequence_has_the_least_change(plan: JointPlan) -> None:
    """Against the change of each of the four continuous motions."""
    assert plan.sequence is not None
    totals = []
    for run in plan.path.whole_runs:
        branch = run.branch(0)
        assert branch is not None
        q = np.array([branch.at(sample.s) for sample in plan.sequence.samples])
        totals.append(np.abs(np.diff(q, axis=0)).sum())
    assert plan.sequence.change == pytest.approx(min(totals), abs=1e-2)
    steps = np.diff(np.array(plan.sequence.angles), axis=0)
    assert np.abs(steps).sum() == pytest.approx(plan.sequence.change)


def test_bounds_hold_at_all_times(plan: JointPlan) -> None:
    assert plan.motion is not None
    for row in csv.DictReader(to_csv(plan).splitlines()):
        for joint, v in zip(plan.motion.joints, plan.motion.speeds):
            assert abs(float(row[f"{joint.name}_velocity"])) <= float(v.high) + 1e-9
    data = to_json(plan)
    columns = np.array(data["rows"], dtype=float)
    speeds = np.abs(np.diff(columns[:, 1:4], axis=0) / np.diff(columns[:, 0])[:, None]).max(axis=0)
    assert all(s <= float(v.high) + 1e-6 for s, v in zip(speeds, plan.motion.speeds))
    pushes = np.abs(np.diff(columns[:, 4:7], axis=0) / np.diff(columns[:, 0])[:, None]).max(axis=0)
    assert all(p <= float(a.high) + 1e-7 for p, a in zip(pushes, plan.motion.accelerations))
    assert all(p > float(a.high) / 8 for p, a in zip(pushes, plan.motion.accelerations))
    assert all(float(v.low) <= float(v.high) for v in (*plan.motion.speeds, *plan.motion.accelerations))
    assert all(s >= float(v.low) * 0.5 for s, v in zip(speeds, plan.motion.speeds))


def test_half_the_time_doubles_the_speed(plan: JointPlan) -> None:
    run = plan.path.whole_runs[0]
    slow, fast = (joint_motion(plan.path, run, QUINTIC, Fraction(t), WHOLE) for t in (50, 25))
    assert [b.high / a.high for a, b in zip(slow.speeds, fast.speeds)] == [2, 2, 2]
    assert [b.high / a.high for a, b in zip(slow.accelerations, fast.accelerations)] == [4, 4, 4]


@pytest.mark.parametrize("law", [Law.CUBIC, Law.QUINTIC, Law.TRAPEZOID])
def test_every_law_is_bounded(plan: JointPlan, law: Law) -> None:
    motion = joint_motion(plan.path, plan.path.whole_runs[0], TimeLaw.of(law), Fraction(10), WHOLE)
    assert all(0 < v.low <= v.high for v in motion.speeds)


def limited(key: str, value: str) -> JointPlan:
    text = EV3.read_text().replace('joint = "theta7"', f'joint = "theta7"\n{key} = {value}')
    return joint_plan(read_arm(text), {"line": LINE}, QUINTIC, Fraction(50), 11)


def test_limits_of_velocity() -> None:
    kept, broken = limited("max_velocity", "1"), limited("max_velocity", '"1/1000"')
    assert kept.is_proved and kept.motion is not None and kept.motion.kept == {"theta7 velocity": True}
    assert not broken.is_proved and broken.motion is not None
    assert broken.motion.kept == {"theta7 velocity": False}
    run = next(r for r in broken.path.runs if broken.sequence is not None and r.number == broken.sequence.run)
    again = joint_motion(broken.path, run, QUINTIC, broken.motion.enough, WHOLE)
    assert again.keeps_limits and any(str(broken.motion.enough) in r for r in broken.remarks)


def test_limits_of_acceleration() -> None:
    broken = limited("max_acceleration", '"1/100000"')
    assert broken.motion is not None and broken.motion.kept == {"theta7 acceleration": False}
    run = next(r for r in broken.path.runs if broken.sequence is not None and r.number == broken.sequence.run)
    assert joint_motion(broken.path, run, QUINTIC, broken.motion.enough, WHOLE).keeps_limits


def test_a_limit_between_the_bounds_is_not_decided() -> None:
    assert Enclosure(Fraction(1), Fraction(3)).keeps(Fraction(2)) is None


def test_limits_of_angles_choose_the_branch() -> None:
    plan = limited("limits", "[0, 3]")
    assert plan.sequence is not None and all(0 <= q[2] <= 3 for q in plan.sequence.angles)
    none = limited("limits", '["3/1000", "4/1000"]')
    assert none.sequence is None and any("within the limits" in r for r in none.remarks)


def test_across_the_axis_the_free_angle_goes_on() -> None:
    path = joint_path(ARM, {"line": Bezier.of([(-50, 0, 100), (50, 0, 100)])})
    found = joint_sequence(path, samples_of(WHOLE, QUINTIC, 21))
    assert found.run is not None and not found.switches
    assert np.abs(np.diff(np.array(found.angles), axis=0)).max() < 0.3


def test_a_path_that_leaves() -> None:
    plan = joint_plan(ARM, {"line": Bezier.of([(400, 0, 100), (390, 0, 100)])}, QUINTIC, Fraction(5), 11)
    assert not plan.is_proved and plan.sequence is None and plan.remarks
    assert "leaves" in render(plan, "line.toml")
    with pytest.raises(Unable, match="does not go from start to goal"):
        hole = joint_path(ARM, {"line": Bezier.of([(20, 0, 166), (60, 0, 166)])})
        joint_motion(hole, next(r for r in hole.runs if not r.covers(1)), QUINTIC, Fraction(1), WHOLE)


def test_no_samples_are_refused_on_a_path_that_leaves_too() -> None:
    """ "--samples 0" ended like a path that cannot be followed."""
    out = Bezier.of([(100, 0, 100), (400, 0, 100)])
    for count in (0, -1, 10**6):
        with pytest.raises(InputError, match="samples: 2 to"):
            joint_plan(ARM, {"out": out}, QUINTIC, Fraction(50), count)


@each(1, 0, 10**6)
def test_numbers_of_samples(count: int) -> None:
    with pytest.raises(InputError, match="samples"):
        samples_of(WHOLE, QUINTIC, count)


def test_the_page_is_whole(plan: JointPlan) -> None:
    page = render(plan, "line.toml")
    assert "http" not in page.replace("http://www.w3.org", "")
    frames = json.loads(page.split('type="application/json">')[1].split("</script>")[0])["arm"]["frames"]
    tips = [frame["p"][-1] for frame in frames]
    assert np.allclose(tips, positions(ARM, [frame["q"] for frame in frames]), atol=0.02)


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = tmp_path / "line.toml"
    source.write_text("[[curve]]\npoints = [[10, 40, 80], [40, 100, 20]]\n")
    out = tmp_path / "out"
    assert main(["joints", "ev3-120", str(source), "--out", str(out), "--samples", "11", "--duration", "20"]) == 0
    assert "certificates of the joint motions: accepted (4 of motions held" in capsys.readouterr().out
    names = ["joints.csv", "joints.html", "joints.json", "joints_certificate.json"]
    assert sorted(p.name for p in out.iterdir()) == names
    rows = list(csv.reader((out / "joints.csv").read_text().splitlines()))
    assert len(rows) == 12 and rows[-1][0] == "20.000000000"
    assert main(["joints", "ev3-120", str(source), "--out", str(out), "--duration", "0"]) == 2


def test_an_angle_that_can_be_chosen_keeps_its_limits() -> None:
    """With all samples on the axis, the first joint was put to 0, outside its limits."""
    rows = ('alpha = "pi/2"\nd = 100\nlimits = ["1/2", "5/2"]', "a = 120", "a = 90")
    body = "".join(f'[[row]]\njoint = "q{k}"\n{row}\n' for k, row in enumerate(rows))
    arm = read_arm('convention = "standard"\n' + body)
    found = joint_path(arm, {"c": Bezier.of([(0, 0, 150), (20, 60, 160), (0, 0, 200)])})
    for count in (2, 3):
        sequence = joint_sequence(found, samples_of([Fraction(1)], TimeLaw.of(Law.QUINTIC), count))
        assert all(0.5 <= first <= 2.5 for first, *_ in sequence.angles)
