"""What is said of a verdict: lines for people, JSON for programs."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.curves.scalar import described
from bezier.trajectories.limits import Outcome, Verdict
from bezier.trajectories.piecewise import QUANTITIES, Trajectory


def to_json(verdict: Verdict) -> dict[str, Any]:
    """Everything about limits, with exact numbers."""
    names, factor = verdict.trajectory.names, verdict.factor
    return {
        "status": "solved",
        "kept": verdict.is_kept,
        "limits": [_outcome(o, verdict.trajectory) for o in verdict.outcomes],
        "jumps": [
            {"of": QUANTITIES[j.order], "axis": names[j.axis], "time": described(j.time), "size": described(j.size)}
            for j in verdict.jumps
        ],
        "broken by jumps": bool(verdict.breaking),
        "slower by": None if factor is None else described(factor),
    }


def _outcome(outcome: Outcome, trajectory: Trajectory) -> dict[str, Any]:
    limit, time = outcome.limit, outcome.time(trajectory)
    return {
        "of": limit.words(trajectory.names),
        "limit": [str(limit.high)] if limit.low is None else [str(limit.low), str(limit.high)],
        "kept": outcome.is_kept,
        "worst": outcome.value,
        "time": {"exact": str(time), "decimal": f"{float(time):.12g}"},
    }


def in_words(verdict: Verdict) -> list[str]:
    """A line for each limit, and what follows."""
    trajectory, names = verdict.trajectory, verdict.trajectory.names
    span = f"from t = {_decimal(trajectory.breaks[0])} to {_decimal(trajectory.breaks[-1])}"
    count, axes = len(trajectory.pieces), "1 axis" if len(names) == 1 else f"{len(names)} axes"
    lines = [f"{count} piece{'s' * (count > 1)}, {axes}, {span}"]
    for o in verdict.outcomes:
        state = "kept for all t, largest" if o.is_kept else "EXCEEDED, worst"
        lines.append(f"{o.limit.words(names)}: {state} {o.value:.10g} at t = {float(o.time(trajectory)):.10g}")
    for j in verdict.jumps:
        wrong = "NOT CONTINUOUS, a jump" if j in verdict.breaking else "joins with a difference"
        place = f"({names[j.axis]} at t = {_decimal(j.time)})"
        lines.append(f"{QUANTITIES[j.order]}: {wrong} of at most {_decimal(j.size)} {place}")
    if verdict.is_kept:
        return [*lines, "all limits are kept for all t"] if verdict.outcomes else lines
    if worst := verdict.worst:
        when = f"{float(worst.time(trajectory)):.12g}"
        lines.append(f"refuted: {worst.limit.words(names)} is {worst.value:.10g} at t = {when}")
    if verdict.factor is None:
        return [*lines, "going slower does not repair it"]
    return [*lines, f"{verdict.factor} = {_decimal(verdict.factor)} times as slow, all limits are kept for all t"]


def _decimal(value: Fraction) -> str:
    return f"{float(value):.10g}"
