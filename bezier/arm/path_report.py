"""What ``bezier certify-path`` says about a path: in words, and as JSON data."""

from __future__ import annotations

from typing import Any

from bezier.arm import motions_report
from bezier.arm.critical import Reason
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.motions_report import place_to_json, short
from bezier.arm.study import Special, Stretch, Study
from bezier.curves.scalar import described


def to_json(found: JointPath) -> dict[str, Any]:
    """The path as JSON data: parameters exactly and as decimals, an entry for each curve, the continuous motions, and
    the runs."""
    return {
        "arm": found.arm.name,
        "reachable": found.is_reachable,
        "curves": [
            {"name": name, **_study(studied)} for name, studied in zip(found.curves, found.studies, strict=True)
        ],
        "motions": motions_report.to_json(found),
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
        "stops": [place_to_json(p.low) for p in found.gaps],
    }


def _stretch(part: Stretch) -> dict[str, Any]:
    return {"from": place_to_json(part.low), "to": place_to_json(part.high), "solutions": part.count}


def _run(found: JointPath, run: Run) -> dict[str, Any]:
    names = list(found.curves)
    return {
        "number": run.number,
        "whole": run.covers(len(names)),
        "parts": [
            {"curve": names[k], "from": str(b.low), "to": str(b.high), "boxes": len(b.pieces)} for k, b in run.parts
        ],
        "beyond_limits": motions_report.excesses_to_json(found, run.excesses),
    }


def in_words(found: JointPath) -> list[str]:
    """The same for people."""
    lines = [found.arm.name]
    for name, studied in zip(found.curves, found.studies, strict=True):
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
        lines += [f"  at s = {short(p.s)}: {_special(p)}" for p in studied.specials if p.reasons]
        lines += [f"  at s = {short(s)}: {Reason.SINE.value} (nothing happens to the arm)" for s in studied.shared]
    return lines + motions_report.in_words(found)


def _verdict(found: Study) -> str:
    limited = " within the limits of the joints" if found.within != found.stretches else ""
    if found.is_reachable:
        return f"every point can be reached{limited} (proved for all s in [0, 1])"
    first = found.gaps[0] if found.gaps else None
    return f"NOT reachable{limited}" + ("" if first is None else f" from s = {short(first.low)} on")


def _special(p: Special) -> str:
    count = "infinitely many solutions" if p.inverse.count is None else f"{p.inverse.count} different solutions"
    return f"{' and '.join(r.value for r in p.reasons)}; {count}"
