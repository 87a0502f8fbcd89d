"""What is said about the continuous joint motions of a path: in words, and as JSON data."""

from __future__ import annotations

from typing import Any

from bezier.arm.continuous import Arcs, ContinuousMotion, ContinuousMotions, Junction
from bezier.arm.critical import Number
from bezier.arm.joint_path import JointPath
from bezier.curves.scalar import brief, described

MOST_SHOWN = 16


def to_json(found: JointPath) -> dict[str, Any]:
    """``count``: of all continuous motions from start to goal, null where it is not decided (``undecided`` says why).

    ``junctions``: the places where solutions meet or the axis is passed: ``before``, ``after``: the numbers of arcs,
    ``through``: of the pairs of them with the same limit. ``listed``: for each motion a joint position in each interval
    between such places, by its parameter (rad, mm)."""
    if found.motions is None:
        return {"count": found.count, "undecided": found.undecided if found.count is None else ""}
    motions, names = found.motions, list(found.curves)
    return {
        "count": motions.count,
        "undecided": "",
        "junctions": [
            {
                "curve": names[j.curve],
                "s": described(j.s),
                "before": len(motions.arcs[k].labels),
                "after": len(motions.arcs[k + 1].labels),
                "through": len(j.passes),
            }
            for k, j in enumerate(motions.junctions)
        ],
        "listed": [
            {
                "number": motion.number,
                "positions": [
                    {"curve": names[a.curve], "s": str(a.sample), "joints": list(_position(motion, k, a))}
                    for k, a in enumerate(motions.arcs)
                ],
            }
            for motion in motions.motions
        ],
    }


def number_in_words(found: JointPath) -> str:
    """How many continuous joint motions there are from start to goal."""
    return f"at least {_number(len(found.whole_runs))}" if found.count is None else _number(found.count)


def in_words(found: JointPath) -> list[str]:
    """The same for people."""
    count, whole = found.count, len(found.whole_runs)
    boxes = f"boxes (which bound the velocities) hold {whole} of them"
    if count is None:
        rest = f"how many others there are is not decided: {found.undecided}"
        return [f"{number_in_words(found)} from start to goal, proved by boxes; {rest}", *_parts(found)]
    limits = ", limits of the joints left aside" if any(joint.limits for joint in found.arm.joints) else ""
    if count == 0:
        lines = [f"no continuous joint motion from start to goal (proved{limits})"]
    else:
        lines = [f"{number_in_words(found)} from start to goal (proved: these are all{limits}); {boxes}"]
    if found.motions is None:
        return [*lines, *_parts(found)]
    names = list(found.curves)
    for k, junction in enumerate(found.motions.junctions):
        where = f"{names[junction.curve]} s = {_short(junction.s)}"
        lines += [f"  at {where}: {text}" for text in _passage(found.motions, k, junction)]
    shown = found.motions.motions[:MOST_SHOWN]
    for motion in shown:
        places = []
        for k, arcs in enumerate(found.motions.arcs):
            joints = ", ".join(f"{value:.6g}" for value in _position(motion, k, arcs))
            places.append(f"({joints}) at {names[arcs.curve]} s = {_short(arcs.sample)}")
        lines.append(f"  motion {motion.number}: {', '.join(places)}")
    return lines + ([f"  and {count - len(shown)} more"] if count > len(shown) else [])


def _parts(found: JointPath) -> list[str]:
    """The runs that do not go from start to goal."""
    names, lines = list(found.curves), []
    for run in found.runs:
        if run not in found.whole_runs:
            ends = ((run.parts[0], run.parts[0][1].low), (run.parts[-1], run.parts[-1][1].high))
            begin, end = (f"{names[k]} s = {float(s):.9g}" for (k, _), s in ends)
            lines.append(f"  motion {run.number} from {begin} to {end} only")
    return lines


def _passage(motions: ContinuousMotions, k: int, junction: Junction) -> list[str]:
    """What happens between two intervals, if anything does."""
    before, after = motions.arcs[k].labels, motions.arcs[k + 1].labels
    going = len({one for one, _ in junction.passes})
    coming = len({other for _, other in junction.passes})
    name = motions.arm.joints[0].name
    if going < len(before) or coming < len(after):
        why = f"{name} would have to jump" if junction.on_axis else "solutions meet there"
        ends = f"{len(before) - going} of {len(before)} motions end and {len(after) - coming} of {len(after)} begin"
        return [f"{ends} here (proved: {why})"]
    if junction.on_axis:
        return [f"all {len(before)} motions go on through the axis (proved: {name} has one limit on both sides)"]
    if junction.meets and len(junction.passes) > len(before):
        return [f"all {len(before)} motions go on (proved); where solutions meet, each can go on as either"]
    return []


def _position(motion: ContinuousMotion, k: int, arcs: Arcs) -> tuple[float, ...]:
    found = arcs.solutions[arcs.labels.index(motion.labels[k])].angles
    return tuple(value for value in found if value is not None)


def _number(count: int) -> str:
    return f"{count} continuous joint motion{'s' * (count != 1)}"


def _short(s: Number) -> str:
    return f"{float(s):.9g}" if len(brief(s)) > 12 else brief(s)
