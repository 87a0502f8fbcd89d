"""What the commands do inside the worker: plan, draw, write, and say it in words or as JSON."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass, replace
from pathlib import Path as FilePath
from typing import TYPE_CHECKING

from bezier.curves.scalar import brief
from bezier.motion import motion
from bezier.paths import heights
from bezier.planner import avoid
from bezier.planner.outputs import REPORT, SUMMARY, summary, write_data
from bezier.planner.planning import make_plan
from bezier.planner.table import method_of
from bezier.plans import Clock, Outcome, Plan
from bezier.problem import Problem
from qe.cli.shell import OK, UNABLE
from qe.worker import Channel

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing

CLEARANCE = "clearance.png"


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
    method = method_of(made.problem.method)
    files = write_data(made, request.folder)
    drawing = None
    if request.plots:
        with clock.step("pictures"):
            drawing = method.draw(made, request.folder)
            if made.findings:
                drawing = _with_clearances(drawing, made, request.folder)
        files += drawing.files
    with clock.step("report"):
        from bezier.report.page import render

        page = render(made, method, drawing)
        (request.folder / REPORT).write_text(page, encoding="utf-8")
    files = sorted([*files, REPORT, SUMMARY])
    total = time.perf_counter() - clock.start
    told = summary(made, [str(request.target / name) for name in files], total)
    text = json.dumps(told, indent=1, ensure_ascii=False)
    (request.folder / SUMMARY).write_text(text + "\n", encoding="utf-8")
    code = OK if made.outcome is Outcome.SOLVED else UNABLE
    return Reply(text if request.json else in_words(made, request.target, files, total), code)


def _with_clearances(drawing: Drawing, made: Plan, folder: FilePath) -> Drawing:
    """The drawing with the chart of heights and distances to the obstacles."""
    from bezier.pictures.plot_clearance import save_chart

    chart = save_chart(made.findings, drawing.picture.obstacles, folder / CLEARANCE)
    return replace(drawing, clearance=chart, files=(*drawing.files, CLEARANCE))


def in_words(made: Plan, target: FilePath, files: list[str], seconds: float) -> str:
    """The short summary for people."""
    problem, method = made.problem, method_of(made.problem.method)
    lines = [f"radius r = {problem.workspace.radius_text}, {problem.workspace.kind.value}"]
    lines += [f"note: {note}" for note in (*problem.notes, *made.remarks)]
    if made.outcome is Outcome.INFEASIBLE:
        lines.append(method.reason(made))
    lines += method.summary_lines(made)
    if made.objective is not None:
        lines.append(f"objective {brief(made.objective)}, active: {', '.join(made.active) or 'nothing'}")
    if made.path is not None:
        inside = "proved to lie in the workspace" if made.path.is_inside else "which LEAVES the workspace"
        joins = f"{made.path.smoothness.name} at both joins, " if made.path.joins else ""
        lines.append(f"path: {joins}{inside}")
    if made.heights is not None:
        lines += heights.summary_lines(made.heights)
    lines += motion.summary_lines(made.quality)
    lines += avoid.summary_lines(made)
    accepted = all(verdict.accepted for verdict in made.checks.values())
    lines.append(f"certificates: {'accepted' if accepted else 'REJECTED'}")
    lines.append(f"{len(files)} files in {target} ({seconds:.2f} s): open {target / REPORT}")
    return "\n".join(lines)
