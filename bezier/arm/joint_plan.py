"""From a path to a motion of the joints: study, sequence of least change, time law with proved limits, files."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from typing import Any

from bezier.arm import path_report
from bezier.arm.joint_path import JointPath, joint_path
from bezier.arm.kinematics import jacobians, positions, skeleton
from bezier.arm.model import Arm, JointKind
from bezier.arm.motion import JointMotion, joint_motion
from bezier.arm.sequence import JointSequence, joint_sequence, samples_of
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.motion.timelaw import TimeLaw
from qe.errors import Unable

DECIMALS, FRAMES = 9, 150


@dataclass(frozen=True, eq=False)
class JointPlan:
    """``sequence`` and ``motion`` are None where there is none; ``remarks`` say why, in words."""

    path: JointPath
    law: TimeLaw
    ends: tuple[Fraction, ...]
    """The share of the law's path at which each curve ends."""
    duration: Fraction
    sequence: JointSequence | None
    motion: JointMotion | None
    remarks: tuple[str, ...]

    @property
    def is_proved(self) -> bool:
        """Whether one continuous motion reaches the whole path and keeps all limits at all times."""
        return self.is_followed and self.motion is not None and self.motion.keeps_limits

    @property
    def is_followed(self) -> bool:
        """Whether every point is reached, the samples by a sequence, and a continuous motion from start to goal within
        the limits is not refuted (nor, where all that boxes hold pass a limit, left open)."""
        return self.path.is_reachable and self.sequence is not None and not self.path.is_stopped


def joint_plan(
    arm: Arm,
    curves: Mapping[str, Bezier],
    law: TimeLaw,
    duration: Fraction,
    samples: int,
    parts: Mapping[str, Fraction] | None = None,
) -> JointPlan:
    """Plan the joints for a path (curves with rational control points, mm) run through in ``duration`` seconds.

    ``parts``: what each curve takes of the path's parameter; all the same by default.
    """
    sizes = [Fraction(1) if parts is None else parts[name] for name in curves]
    ends = tuple(total / sum(sizes) for total in accumulate(sizes))
    moments = samples_of(ends, law, samples)
    path = joint_path(arm, curves)
    remarks: list[str] = []
    if path.is_stopped and (path.excesses or path.is_reachable):
        within = " within the limits of the joints" if path.excesses else ""
        remarks.append(f"no continuous motion from start to goal{within}{' is known' * (path.allowed_count is None)}")
    if not path.is_reachable:
        within = " within the limits of its joints" if any(s.within != s.stretches for s in path.studies) else ""
        remarks.append(f"the path leaves what the arm can reach{within}")
        return JointPlan(path, law, ends, duration, None, None, tuple(remarks))
    sequence = motion = None
    try:
        sequence = joint_sequence(path, moments)
        for s in sequence.switches:
            where = f"between {float(s.before.tau):.4g} and {float(s.after.tau):.4g} of the time"
            remarks.append(f"{where} no proved motion goes on: the sequence changes by {s.change:.4g} rad there")
        run = next((run for run in path.runs if run.number == sequence.run), None)
        if run is not None and not run.excesses:
            motion = joint_motion(path, run, law, duration, ends)
            if not motion.keeps_limits:
                remarks.append(f"limits of the joints are not proved to be kept; {motion.enough} s are enough")
        elif sequence.run is not None:
            remarks.append(f"motion {sequence.run} goes where boxes do not: its velocities have no proved bounds")
    except Unable as error:
        remarks.append(str(error))
    return JointPlan(path, law, ends, duration, sequence, motion, tuple(remarks))


def table(plan: JointPlan) -> tuple[list[str], list[list[float]]]:
    """The sequence as a table: time (s), angles (rad), velocities (rad/s), position (mm).

    Velocities are those of the path's solution, J^-1 p' in floating point; NaN where the arm is singular.
    """
    import numpy as np

    assert plan.sequence is not None, "only plans with a sequence have a table"
    names = [joint.name for joint in plan.path.arm.joints]
    header = ["time", *names, *(f"{name}_velocity" for name in names), "x", "y", "z"]
    curves, arm, total = list(plan.path.curves.values()), plan.path.arm, float(plan.duration)
    matrices = jacobians(arm, plan.sequence.angles)
    reached = positions(arm, plan.sequence.angles)
    rows = []
    for k, (sample, angles) in enumerate(zip(plan.sequence.samples, plan.sequence.angles, strict=True)):
        tangent = np.array([float(c) for c in curves[sample.curve].derivative(1, sample.s)])
        share = plan.ends[sample.curve] - (plan.ends[sample.curve - 1] if sample.curve else 0)
        rate = float(plan.law.derivatives(sample.tau)[1] / share) / total
        singular = abs(np.linalg.det(matrices[k])) < 1e-6
        speed = np.full(len(names), np.nan) if singular else np.linalg.solve(matrices[k], tangent * rate)
        rows.append([float(sample.tau) * total, *angles, *map(float, speed), *map(float, reached[k])])
    return header, rows


def to_csv(plan: JointPlan) -> str:
    """``joints.csv``."""
    header, rows = table(plan)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([[f"{value:.{DECIMALS}f}" for value in row] for row in rows])
    return out.getvalue()


def to_json(plan: JointPlan) -> dict[str, Any]:
    """``joints.json``: the study of the path, the sequence, and what is proved about the motion, such as bounds of the
    largest absolute velocity (rad/s) and acceleration (rad/s²) of each joint."""
    extremes = {
        joint.name: {"velocity": _bounds(v), "acceleration": _bounds(a)}
        for m in ([] if plan.motion is None else [plan.motion])
        for joint, v, a in zip(m.joints, m.speeds, m.accelerations, strict=True)
    }
    data: dict[str, Any] = {
        **path_report.to_json(plan.path),
        "duration": str(plan.duration),
        "proved": plan.is_proved,
        "remarks": list(plan.remarks),
        "run": None if plan.sequence is None else plan.sequence.run,
        "total_change": None if plan.sequence is None else round(plan.sequence.change, DECIMALS),
        "limits": {} if plan.motion is None else plan.motion.kept,
        "extremes": extremes,
        "columns": [],
        "rows": [],
    }
    if plan.sequence is not None:
        header, rows = table(plan)
        data["columns"] = header
        data["rows"] = [[None if v != v else round(v, DECIMALS) for v in row] for row in rows]
    return data


def _bounds(value: Enclosure) -> list[float]:
    low, high = map(float, value.finite)
    return [float(f"{low:.6g}"), float(f"{high * (1 + 1e-5):.6g}")]


def animation(plan: JointPlan) -> dict[str, Any]:
    """What the moving picture needs: the path, and frames with points (mm) and angles of the arm."""
    assert plan.sequence is not None, "only plans with a sequence move"
    arm, sequence = plan.path.arm, plan.sequence
    step = max(1, len(sequence.angles) // FRAMES)
    chosen = sorted({*range(0, len(sequence.angles), step), len(sequence.angles) - 1})
    curves = plan.path.curves.values()
    trace = [[round(float(c), 2) for c in curve.point(Fraction(k, 40))] for curve in curves for k in range(41)]
    return {
        "names": [joint.name for joint in arm.joints],
        "turns": [joint.motion is JointKind.REVOLUTE for joint in arm.joints],
        "moving": [arm.rows[k - 1].joint is not None for k in arm.ends[1:]],
        "path": trace,
        "frames": [
            {
                "t": round(float(sequence.samples[k].tau * plan.duration), 4),
                "q": [round(a, 5) for a in sequence.angles[k]],
                "p": [[round(c, 2) for c in point] for point in skeleton(arm, sequence.angles[k])],
            }
            for k in chosen
        ],
    }


def in_words(plan: JointPlan) -> list[str]:
    """The plan of the joints for people."""
    lines = path_report.in_words(plan.path)
    if plan.sequence is not None:
        kept = f"motion {plan.sequence.run} kept throughout" if plan.sequence.run else "no single motion kept"
        size, change = len(plan.sequence.angles), plan.sequence.change
        lines.append(f"sequence of {size} joint positions: {change:.6g} rad in all, {kept}")
    if plan.motion is not None:
        for joint, v, a in zip(plan.motion.joints, plan.motion.speeds, plan.motion.accelerations, strict=True):
            unit = "rad" if joint.motion is JointKind.REVOLUTE else "mm"
            speed, push = f"{float(v.finite[1]):.4g} {unit}/s", f"{float(a.finite[1]):.4g} {unit}/s^2"
            lines.append(f"  {joint.name}: at most {speed} and {push} at all times (proved)")
        words = {True: "kept (proved)", False: "EXCEEDED", None: "closer than the bounds can tell"}
        lines += [f"  limit of {name}: {words[kept]}" for name, kept in plan.motion.kept.items()]
    return lines + [f"note: {remark}" for remark in plan.remarks]
