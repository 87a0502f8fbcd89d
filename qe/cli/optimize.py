"""What ``qe minimize`` does inside the worker."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import qe.api.optimum as api_optimum
from qe.arguments import names
from qe.cli.numbers import exact_and_decimal, shown
from qe.cli.source import Reply, Request, in_json
from qe.convex.optimum import Optimum
from qe.exact.number import point_text
from qe.optimization.global_optimum import GlobalOptimum
from qe.optimization.parametric_optimum import ParametricOptimum
from qe.processes.channel import Channel
from qe.proof.multipliers import OptimumStatus
from qe.spelling import quoted


def optimize(
    channel: Channel, request: Request, objective: str, maximize: bool | None, parameters: str | None
) -> Reply:
    """``qe minimize``, ``qe maximize``: the exact value, the point, and what is active there; with parameters, the
    cases. ``qe optimum`` (``maximize`` is None): both, the least value first."""
    listed = names(parameters, "parameters")
    if maximize is not None:
        return _best(channel, request, objective, maximize, listed)
    low, high = (_best(channel, request, objective, way, listed) for way in (False, True))
    verdict = low.verdict if low.verdict == high.verdict else f"least: {low.verdict}; greatest: {high.verdict}"
    if request.json:
        both = {"least": json.loads(low.text), "greatest": json.loads(high.text)}
        return Reply(in_json(both), verdict=verdict)
    return Reply(f"least\n{low.text}\ngreatest\n{high.text}", verdict=verdict)


def _best(
    channel: Channel, request: Request, objective: str, maximize: bool, parameters: tuple[str, ...] | None
) -> Reply:
    solve = api_optimum.maximize if maximize else api_optimum.minimize
    constraints, keywords, objective = request.read(channel, objective, listed=parameters or ())
    keywords["parameters"] = parameters
    best: Optimum | GlobalOptimum | ParametricOptimum = solve(objective, constraints, **keywords)
    if isinstance(best, ParametricOptimum):
        status = OptimumStatus.OPTIMAL if best.cases else OptimumStatus.INFEASIBLE
        data, lines = {"status": status.value, **best.to_dict()}, str(best).splitlines()
    else:
        data, lines = _data(best), _lines(best, "greatest" if maximize else "least")
    how = f"proved {data['status']}" if best.certificate is not None and not best.reason else "found"
    text = "\n".join([*lines, f"{how} in {request.seconds:.3f} s"])
    return request.reply(best, text, {**data, "seconds": request.seconds})


def _data(best: Optimum | GlobalOptimum) -> dict[str, Any]:
    """One optimum for machines; what only convex problems have is empty for others.

    Where no point meets the constraints there is none to show, and no direction where there is an optimum.
    """
    data: dict[str, Any] = {
        "status": best.status.value,
        "value": None if best.value is None else exact_and_decimal(best.value),
        "point": {} if best.status is OptimumStatus.INFEASIBLE else _exact(best.point),
        "attained": best.attained,
    }
    if not isinstance(best, Optimum):
        points = [_exact(point) for point in best.points] or None
        none: dict[str, Any] = {"active": [], "unique": None, "multipliers": [], "direction": {}}
        return {**data, **none, "minimisers": str(best.minimisers), "points": points}
    if best.bound is not None:
        data["bound"] = exact_and_decimal(best.bound)
    return {
        **data,
        "active": [best.constraints[i] for i in best.active],
        "unique": best.unique,
        "multipliers": [exact_and_decimal(value) for value in best.multipliers],
        "direction": _exact(best.direction) if best.status is OptimumStatus.UNBOUNDED else {},
    }


def _exact(point: Mapping[str, object]) -> dict[str, dict[str, str]]:
    return {name: exact_and_decimal(value) for name, value in point.items()}


def _values(point: Mapping[str, object]) -> list[str]:
    return [f"{quoted(name, point)} = {shown(value)}" for name, value in point.items()]


def _lines(best: Optimum | GlobalOptimum, extreme: str) -> list[str]:
    """One optimum for people; ``extreme``: the least or greatest value was asked for."""
    if best.status is OptimumStatus.INFEASIBLE:
        return ["infeasible: no point meets the constraints"]
    if best.status is OptimumStatus.UNBOUNDED:
        lines = [f"unbounded: there is no {extreme} value"]
        if isinstance(best, Optimum):
            lines.append(f"without an end from {point_text(best.point)} along {point_text(best.direction)}")
        return lines
    lines = [f"value {shown(best.value)}"]
    if isinstance(best, Optimum) and best.value is not None and best.bound is not None:
        beyond = "below" if best.value > best.bound else "above"
        lines.append(f"no point has one {beyond} {shown(best.bound)}; the exact numbers are out of reach")
    several = () if isinstance(best, Optimum) or len(best.points) < 2 else best.points
    lines += [f"at {', '.join(_values(point))}" for point in several] or _values(best.point)
    if isinstance(best, Optimum):
        lines.append(f"active: {', '.join(best.constraints[i] for i in best.active) or 'nothing'}")
    elif best.points:
        lines.append("attained nowhere else")
    elif best.attained:
        lines.append(f"attained where {best.minimisers}")
    if best.attained is False:
        lines.append("not attained: the value is a limit")
    return lines
