"""What ``bezier certify-path`` says about a path: in words, and as JSON data."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from bezier.arm.critical import Reason
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.limit_places import Near, Place
from bezier.arm.motion_limits import Excess
from bezier.arm.study import Special, Stretch, Study
from bezier.curves.scalar import brief, decimal_text, described


def to_json(found: JointPath) -> dict[str, Any]:
    """The path as JSON data: parameters exactly and as decimals, one entry for each curve, and the runs."""
    return {
        "arm": found.arm.name,
        "reachable": found.is_reachable,
        "curves": [
            {"name": name, **_study(studied)} for name, studied in zip(found.curves, found.studies, strict=True)
        ],
        "runs": [_run(found, run) for run in found.runs],
    }


def _study(found: Study) -> dict[str, Any]:
    return {
        "reachable": found.is_reachable,
        "intervals": [_stretch(p) for p in found.stretches],
        "within_limits": [_stretch(p) for p in found.within],
        "special": [
            {
                "s": described(p.s),
                "solutions": p.inverse.count,
                "free": list(p.inverse.free),
                "what": [reason.value for reason in p.reasons],
            }
            for p in found.specials
            if p.reasons or p.s in (0, 1)
        ],
        "shared_sine": [described(s) for s in found.shared],
        "stops": [_place(p.low) for p in found.gaps],
    }


def _stretch(part: Stretch) -> dict[str, Any]:
    return {"from": _place(part.low), "to": _place(part.high), "solutions": part.count}


def _place(place: Place) -> dict[str, Any]:
    """Where there is no exact number, rational ones around it."""
    if isinstance(place, Near):
        return {"between": [str(place.low), str(place.high)], "decimal": decimal_text(place.low)}
    return dict(described(place))


def _run(found: JointPath, run: Run) -> dict[str, Any]:
    names = list(found.curves)
    return {
        "number": run.number,
        "whole": run.covers(len(names)),
        "parts": [
            {"curve": names[k], "from": str(b.low), "to": str(b.high), "boxes": len(b.pieces)} for k, b in run.parts
        ],
        "beyond_limits": [
            {
                "curve": names[e.curve],
                "joint": e.joint.name,
                "limit": str(e.limit),
                "from": _place(e.low),
                "to": _place(e.high),
            }
            for e in run.excesses
        ],
    }


def in_words(found: JointPath) -> list[str]:
    """The same for people."""
    lines = [found.arm.name]
    for name, studied in zip(found.curves, found.studies, strict=True):
        lines.append(f"{name}: " + _verdict(studied))
        lines += [
            f"  {p.count} solution{'s' * (p.count != 1)} for every s in ({_short(p.low)}, {_short(p.high)})"
            for p in studied.stretches
        ]
        if studied.within != studied.stretches:
            lines += [
                f"  {p.count or 'none'} within the limits for every s in ({_short(p.low)}, {_short(p.high)})"
                for p in studied.within
            ]
        lines += [f"  at s = {_short(p.s)}: {_special(p)}" for p in studied.specials if p.reasons]
        lines += [f"  at s = {_short(s)}: {Reason.SINE.value} (nothing happens to the arm)" for s in studied.shared]
    complete = len(found.whole_runs)
    within = " within the limits" if any(run.excesses for run in found.runs) else ""
    motions = f"{complete} continuous joint motion{'s' * (complete != 1)}"
    lines.append(f"{motions} from start to goal{within}, proved by boxes")
    names = list(found.curves)
    lines += [f"  {line}" for line in excesses_in_words(found)]
    for run in found.runs:
        if not run.covers(len(names)):
            first, last = run.parts[0], run.parts[-1]
            begin, end = (
                f"{names[k]} s = {float(s):.9g}" for k, s in ((first[0], first[1].low), (last[0], last[1].high))
            )
            lines.append(f"  motion {run.number} from {begin} to {end} only")
    return lines


def excesses_in_words(found: JointPath) -> list[str]:
    """Where motions are beyond limits of the joints."""
    names = list(found.curves)
    return [f"motion {run.number}: {_excess(e, names)}" for run in found.runs for e in run.excesses]


def _excess(found: Excess, names: Sequence[str]) -> str:
    limits = found.joint.limits
    sign = ">" if limits is not None and found.limit == limits[1] else "<"
    where = f"{names[found.curve]} s in ({_short(found.low)}, {_short(found.high)})"
    return f"{found.joint.name} {sign} {brief(found.limit)}, its limit, for {where}"


def _verdict(found: Study) -> str:
    limited = " within the limits of the joints" if found.within != found.stretches else ""
    if found.is_reachable:
        return f"every point can be reached{limited} (proved for all s in [0, 1])"
    first = found.gaps[0] if found.gaps else None
    return f"NOT reachable{limited}" + ("" if first is None else f" from s = {_short(first.low)} on")


def _special(p: Special) -> str:
    count = "infinitely many solutions" if p.inverse.count is None else f"{p.inverse.count} different solutions"
    return f"{' and '.join(r.value for r in p.reasons)}; {count}"


def _short(s: Place) -> str:
    return brief(s) if isinstance(s, Fraction) else f"{float(s):.12g}"
