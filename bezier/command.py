"""What the commands do inside the worker: plan, draw, write, and say it in words or as JSON."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

from bezier import quadratic
from bezier.outputs import reason, summary, write_data
from bezier.plan import Clock, Outcome, Plan, make_plan
from bezier.problem import Problem
from bezier.scalar import decimal_text, exact_text
from bezier.workspace import Condition, WorkspaceKind
from qe.cli_shell import OK, UNABLE
from qe.worker import Channel

REPORT, SUMMARY = "report.html", "summary.json"


@dataclass(frozen=True, slots=True)
class Reply:
    """``text`` for stdout and the exit status."""

    text: str
    code: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What the command line asked for; ``folder`` is where the files are written first."""

    problem: Problem
    folder: FilePath
    target: FilePath
    plots: bool = True
    json: bool = False
    timeout: float | None = None


def plan(channel: Channel, request: Request) -> Reply:
    """``bezier plan``: all files into ``request.folder``, and what to print."""
    clock = Clock(limit=request.timeout, listener=channel.event, note=channel.fact)
    made = make_plan(request.problem, clock)
    files = write_data(made, request.folder)
    picture, views = None, ""
    if request.plots:
        with clock.step("pictures"):
            picture, views, drawn = draw(made, request.folder)
        files += drawn
    with clock.step("report"):
        from bezier.report import render

        page = render(made, picture=picture, views=views, seconds=time.perf_counter() - clock.start)
        (request.folder / REPORT).write_text(page, encoding="utf-8")
    files = sorted([*files, REPORT, SUMMARY])
    total = time.perf_counter() - clock.start
    told = summary(made, [str(request.target / name) for name in files], total)
    text = json.dumps(told, indent=1, ensure_ascii=False)
    (request.folder / SUMMARY).write_text(text + "\n", encoding="utf-8")
    code = OK if made.outcome is Outcome.SOLVED else UNABLE
    return Reply(text if request.json else in_words(made, request.target, files, total), code)


def draw(made: Plan, folder: FilePath) -> tuple[Any, str, list[str]]:
    """The pictures: PNG files in ``folder``, and what the report shows."""
    from bezier import plot
    from bezier.picture import PathPicture, curve_pictures, numbers, region_picture
    from bezier.recognise import as_conditions

    named: list[Condition] = [item.condition for item in quadratic.as_conditions_on_q1(made.problem)]
    chosen = made.path.points["Q1"] if made.path else None
    conditions = as_conditions(made.answer.formula, quadratic.FREE)
    region = None if made.region.is_empty or conditions is None else region_picture(conditions, named, chosen)
    extra = {}
    if made.gap.region is not None and not made.gap.region.is_empty:
        both = [item.condition for item in quadratic.as_conditions_on_q1(_hemisphere(made.problem))]
        printed = region_picture(both[:3], both, None, level=3)
        corrected = region_picture(both, both, None, level=3)
        if printed is not None and corrected is not None:
            extra = {"printed": printed, "corrected": corrected}
    points = made.path.points if made.path else _given(made.problem)
    marks = {name: numbers([point])[0] for name, point in points.items() if name not in ("P2", "Q2")}
    picture = PathPicture(
        radius=float(made.problem.workspace.radius_squared) ** 0.5,
        has_floor=made.problem.workspace.kind is WorkspaceKind.HEMISPHERE,
        curves=curve_pictures(made.path.curves) if made.path else (),
        marks=marks,
        region=region,
        extra=extra,
    )
    plot.save_region(picture, folder / "region.png")
    plot.save_path(picture, folder / "path.png")
    return picture, plot.views_svg(picture), ["region.png", "path.png"]


def _given(problem: Problem) -> dict[str, Any]:
    return {"P0": problem.start, "Q0": problem.via[0], "R0": problem.via[1], "R2": problem.goal}


def _hemisphere(problem: Problem) -> Problem:
    from dataclasses import replace

    return replace(problem, workspace=replace(problem.workspace, kind=WorkspaceKind.HEMISPHERE))


def in_words(made: Plan, target: FilePath, files: list[str], seconds: float) -> str:
    """The short summary for people."""
    problem = made.problem
    lines = [f"radius r = {problem.workspace.radius_text}, {problem.workspace.kind.value}"]
    lines += [f"note: {note}" for note in problem.notes]
    if made.outcome is Outcome.INFEASIBLE or made.path is None or made.optimum is None:
        lines += [reason(made), 'try method = "cubic"']
    else:
        cells = len(made.region.cells)
        lines.append(f"region of Q1: dimension {made.region.dimension}, {cells} cell{'s' if cells != 1 else ''}")
        lines.append(f"best Q1 = ({', '.join(map(exact_text, made.path.points['Q1']))})")
        value = made.optimum.value
        about = "" if exact_text(value) == decimal_text(value, 8) else f" (about {decimal_text(value, 8)})"
        lines.append(f"objective {exact_text(value)}{about}, active: {_listed(made.active)}")
        lines.append(f"path: {made.path.smoothness.name} at both joins, {_inside(made)}")
    lines.append(_table(made))
    accepted = all(verdict.accepted for verdict in made.checks.values())
    lines.append(f"certificates: {'accepted' if accepted else 'REJECTED'}")
    lines.append(f"{len(files)} files in {target} ({seconds:.2f} s): open {target / REPORT}")
    return "\n".join(lines)


def _listed(labels: tuple[str, ...]) -> str:
    return ", ".join(labels) if labels else "nothing"


def _inside(made: Plan) -> str:
    if made.path is not None and made.path.is_inside:
        return "proved to lie in the workspace"
    return "which LEAVES the workspace"


def _table(made: Plan) -> str:
    if not made.gap.can_leave:
        return "the printed formula allows no control point below the table z = 0 here"
    return "the printed formula allows control points below the table z = 0 here (example in the report)"
