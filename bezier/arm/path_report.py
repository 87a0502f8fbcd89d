"""What ``bezier certify-path`` says about a path: in words, and as JSON data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bezier.arm.continuous import Arcs, ContinuousMotion, ContinuousMotions, Junction
from bezier.arm.critical import Reason
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.limited_motions import Excess
from bezier.arm.study import Near, Place, Stretch, Study
from bezier.curves.scalar import brief, decimal_text, described

MOST_SHOWN = 16


def _motions_json(path: JointPath) -> dict[str, Any]:
    """``count``: of all continuous motions from start to goal, limits of the joints left aside, and
    ``count_within_limits``: of those that keep them for all s; null where it is not decided (``undecided`` says why).

    ``junctions``: the places where solutions meet or the axis is passed: ``before``, ``after``: the numbers of arcs,
    ``through``: of the pairs of them with the same limit. ``listed``: for each motion a joint position in each interval
    between such places, by its parameter (rad, mm), and where it is beyond limits."""
    counts = {"count": path.count, "count_within_limits": path.allowed_count}
    if path.motions is None or path.limited is None:
        return {**counts, "undecided": path.undecided if None in counts.values() else ""}
    motions, limited, names = path.motions, path.limited, list(path.curves)
    return {
        **counts,
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
                "beyond_limits": excesses_to_json(path, limited.listed[motion.number].excesses),
            }
            for motion in motions.motions
        ],
    }


def excesses_to_json(path: JointPath, excesses: Sequence[Excess]) -> list[dict[str, Any]]:
    """Where a motion is beyond limits."""
    names = list(path.curves)
    return [
        {
            "curve": names[e.curve],
            "joint": e.joint.name,
            "limit": str(e.limit),
            "from": place_to_json(e.low),
            "to": place_to_json(e.high),
        }
        for e in excesses
    ]


def place_to_json(place: Place) -> dict[str, Any]:
    """Where there is no exact number, rational ones around it."""
    if isinstance(place, Near):
        return {"between": [str(place.low), str(place.high)], "decimal": decimal_text(place.low)}
    return dict(described(place))


def number_in_words(path: JointPath) -> str:
    """How many continuous joint motions there are from start to goal, and how many keep the limits."""
    text = f"at least {_number(len(path.covering_runs))}" if path.count is None else _number(path.count)
    if not path.arm.has_limits or path.count == 0:
        return text
    kept = path.allowed_count
    return f"{text}, {f'at least {len(path.whole_runs)}' if kept is None else kept or 'none'} within the limits"


def _numbers(path: JointPath) -> list[str]:
    count, kept = path.count, path.allowed_count
    boxes = f"boxes (which bound the velocities) hold {len(path.covering_runs)} of them"
    if count is None:
        text = f"at least {_number(len(path.covering_runs))} from start to goal, proved by boxes"
        lines = [f"{text}; how many others there are is not decided: {path.undecided}"]
    elif count == 0:
        lines = ["no continuous joint motion from start to goal (proved)"]
    else:
        lines = [f"{_number(count)} from start to goal (proved: these are all); {boxes}"]
    if path.arm.has_limits and count != 0:
        if kept is None:
            lines.append(f"  at least {len(path.whole_runs)} within the limits of the joints for all s")
        else:
            lines.append(f"  {kept or 'none'} of them within the limits of the joints for all s (decided exactly)")
    return lines


def _details(path: JointPath) -> list[str]:
    if path.motions is None:
        return _parts(path)
    lines, names = list[str](), list(path.curves)
    for k, junction in enumerate(path.motions.junctions):
        where = f"{names[junction.curve]} s = {short(junction.s)}"
        lines += [f"  at {where}: {text}" for text in _passage(path.motions, k, junction)]
    shown = path.motions.motions[:MOST_SHOWN]
    for motion in shown:
        places = []
        for k, arcs in enumerate(path.motions.arcs):
            joints = ", ".join(f"{value:.6g}" for value in _position(motion, k, arcs))
            places.append(f"({joints}) at {names[arcs.curve]} s = {short(arcs.sample)}")
        lines.append(f"  motion {motion.number}: {', '.join(places)}")
    more = path.motions.count - len(shown)
    return [*lines, f"  and {more} more"] if more > 0 else lines


def excesses_in_words(path: JointPath) -> list[str]:
    """Where motions are beyond limits of the joints: those from start to goal, or, if these are not all known, what
    boxes hold."""
    names, known = list(path.curves), path.excesses if path.limited is None else path.limited.listed
    return [f"motion {n}: {_excess(e, names)}" for n in known for e in path.excesses.get(n, ())]


def _excess(excess: Excess, names: Sequence[str]) -> str:
    limits = excess.joint.limits
    sign = ">" if limits is not None and excess.limit == limits[1] else "<"
    where = f"{names[excess.curve]} s in ({short(excess.low)}, {short(excess.high)})"
    return f"{excess.joint.name} {sign} {brief(excess.limit)}, its limit, for {where}"


def _parts(path: JointPath) -> list[str]:
    """The runs that do not go from start to goal."""
    names, lines = list(path.curves), []
    for run in path.runs:
        if run not in path.covering_runs:
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
    result = arcs.solutions[arcs.labels.index(motion.labels[k])].angles
    return tuple(value for value in result if value is not None)


def _number(count: int) -> str:
    return f"{count} continuous joint motion{'s' * (count != 1)}"


def short(s: Place) -> str:
    """A parameter for people: exactly if that is short."""
    exact = None if isinstance(s, Near) else brief(s)
    return exact if exact is not None and len(exact) <= 12 else f"{float(s):.12g}"


def to_json(path: JointPath) -> dict[str, Any]:
    """The path as JSON: parameters exactly and as decimals, each curve, the continuous motions, and the runs."""
    return {
        "arm": path.arm.name,
        "reachable": path.is_reachable,
        "curves": [{"name": name, **_study(studied)} for name, studied in zip(path.curves, path.studies, strict=True)],
        "motions": _motions_json(path),
        "runs": [_run(path, run) for run in path.runs],
    }


def _study(studied: Study) -> dict[str, Any]:
    return {
        "reachable": studied.is_reachable,
        "intervals": [_stretch(p) for p in studied.stretches],
        "within_limits": [_stretch(p) for p in studied.within],
        "special": [
            {
                "s": described(p.s),
                "solutions": p.inverse.count,
                "free": list(p.inverse.free),
                "what": [reason.value for reason in p.reasons],
            }
            for p in studied.specials
            if p.reasons or p.s in (0, 1)
        ],
        "shared_sine": [described(s) for s in studied.shared],
        "stops": [place_to_json(p.low) for p in studied.gaps],
    }


def _stretch(part: Stretch) -> dict[str, Any]:
    return {"from": place_to_json(part.low), "to": place_to_json(part.high), "solutions": part.count}


def _run(path: JointPath, run: Run) -> dict[str, Any]:
    names = list(path.curves)
    return {
        "number": run.number,
        "whole": run.covers(len(names)),
        "parts": [
            {"curve": names[k], "from": str(b.low), "to": str(b.high), "boxes": len(b.pieces)} for k, b in run.parts
        ],
        "beyond_limits": excesses_to_json(path, run.excesses),
    }


def in_words(path: JointPath) -> list[str]:
    """The same for people."""
    lines = [path.arm.name]
    for name, studied in zip(path.curves, path.studies, strict=True):
        lines.append(f"{name}: " + _verdict(studied))
        lines += [
            f"  {p.count} solution{'s' * (p.count != 1)} for every s in ({short(p.low)}, {short(p.high)})"
            for p in studied.stretches
        ]
        if studied.within != studied.stretches:
            lines += [
                f"  {p.count or 'none'} within the limits for every s in ({short(p.low)}, {short(p.high)})"
                for p in studied.within
            ]
        for p in studied.specials:
            count = "infinitely many solutions" if p.inverse.count is None else f"{p.inverse.count} different solutions"
            what = " and ".join(r.value for r in p.reasons)
            lines += [f"  at s = {short(p.s)}: {what}; {count}"] if what else []
        lines += [f"  at s = {short(s)}: {Reason.SINE.value} (nothing happens to the arm)" for s in studied.shared]
    return [*lines, *_numbers(path), *(f"  {line}" for line in excesses_in_words(path)), *_details(path)]


def _verdict(studied: Study) -> str:
    limited = " within the limits of the joints" if studied.within != studied.stretches else ""
    if studied.is_reachable:
        return f"every point can be reached{limited} (proved for all s in [0, 1])"
    first = studied.gaps[0] if studied.gaps else None
    return f"NOT reachable{limited}" + ("" if first is None else f" from s = {short(first.low)} on")
