"""The page's sections about quality, motion and obstacles, as plain values for the template."""

from __future__ import annotations

from typing import Any

from bezier.curves.enclosure import Enclosure
from bezier.curves.scalar import decimal_text
from bezier.motion.motion import Motion
from bezier.obstacles import survey
from bezier.obstacles.clearance import Clear
from bezier.plans import Outcome, Plan

Row = dict[str, Any]


def sections(plan: Plan) -> dict[str, Any]:
    """Empty lists and None where there is nothing to say."""
    quality = plan.quality
    return {
        "lengths": [] if quality is None else [_curve(plan, name) for name in quality.lengths],
        "whole_length": "" if quality is None else _between(quality.length),
        "motion": None if quality is None or quality.motion is None else _motion(quality.motion),
        "clearances": [_finding(finding) for finding in plan.findings],
        "attempts": [_attempt(item) for item in plan.attempts] if len(plan.attempts) > 1 else [],
        "blocked": plan.outcome is Outcome.BLOCKED,
    }


def _curve(plan: Plan, name: str) -> Row:
    assert plan.quality is not None
    bend = plan.quality.curvatures[name]
    curvature = "one point" if bend is None else _between(bend)
    return {"curve": name, "length": _between(plan.quality.lengths[name]), "curvature": curvature}


def _between(value: Enclosure) -> str:
    """Both ends, rounded outwards; one number where they are equal."""
    if not value.is_bounded:
        return "unbounded (cusp)"
    ends = value.to_json(8)
    return ends["low"] if ends["low"] == ends["high"] else f"{ends['low']} … {ends['high']}"


def _motion(motion: Motion) -> dict[str, Any]:
    rows = []
    values = {"max_speed": motion.extremes.speed, "max_acceleration": motion.extremes.acceleration}
    units = {"max_speed": ("speed", "mm/s"), "max_acceleration": ("acceleration", "mm/s²")}
    for key, value in values.items():
        what, unit = units[key]
        limit, kept = motion.timing.limits.get(key), motion.kept.get(key)
        said = {True: "kept at all times", False: "exceeded", None: "not decided"}[kept] if limit else "no limit"
        rows.append(
            {
                "what": f"largest {what}",
                "value": f"{_between(value)} {unit}",
                "limit": f"{limit} {unit}" if limit else "",
                "result": said,
                "tone": "" if limit is None else ("good" if kept else "bad"),
            }
        )
    return {"law": motion.timing.law.value, "duration": decimal_text(motion.duration, 8), "rows": rows}


def _finding(finding: survey.Finding) -> Row:
    outcome = finding.outcome
    row = {"curve": finding.name, "obstacle": finding.obstacle.name, "tone": "good" if finding.is_clear else "bad"}
    row["distance"] = "" if finding.distance is None else _between(finding.distance)
    if isinstance(outcome, Clear):
        return {**row, "result": "clear for all t", "how": outcome.argument.value}
    how = "enters" if outcome.enters else "touches"
    where = f"first at t = {survey.parameter(outcome)}, {survey.place(outcome)}"
    return {**row, "result": f"{how}: {where}", "how": "roots of the conditions along the curve"}


def _attempt(attempt: Any) -> Row:
    solved = attempt.outcome is Outcome.SOLVED
    return {"what": attempt.what, "detail": attempt.detail, "tone": "good" if solved else "bad"}
