"""What the commands do inside the worker: plan, draw, write, and say it in words or as JSON."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from bezier.planner import derivations
from bezier.planner.outputs import REPORT, SUMMARY, data_texts, summary, write_texts
from bezier.planner.planning import make_plan
from bezier.planner.table import method_for
from bezier.planner.words import lines
from bezier.plans import Clock, Plan
from bezier.problem import Problem
from qe.processes.channel import Channel

CLEARANCE = "clearance.png"


def write_folder(
    made: Plan, folder: FilePath, target: FilePath, clock: Clock, *, plots: bool
) -> tuple[list[str], dict[str, Any]]:
    """All files into ``folder``, whose place will be ``target``; their names, and what the summary says."""
    method = method_for(made.problem)
    files = write_texts(folder, data_texts(made))
    drawing = None
    if plots:
        with clock.step("pictures"):
            drawing = method.draw(made, folder)
            if made.findings:
                from bezier.pictures import charts

                panels = charts.clearance(made.findings, drawing.picture.obstacles)
                drawn = charts.saved(panels, folder / CLEARANCE)
                drawing = replace(drawing, clearance=drawn, files=(*drawing.files, CLEARANCE))
        files += drawing.files
    with clock.step("report"):
        from bezier.report.page import render

        pages = write_texts(folder, {REPORT: render(made, method, drawing), **derivations.pages(made)})
    files = sorted([*files, *pages, SUMMARY])
    entries = summary(made, [str(target / name) for name in files], time.perf_counter() - clock.start)
    text = json.dumps(entries, indent=1, ensure_ascii=False)
    (folder / SUMMARY).write_text(text + "\n", encoding="utf-8")
    return files, entries


def plan(
    channel: Channel,
    problem: Problem,
    folder: FilePath,
    target: FilePath,
    *,
    plots: bool = True,
    timeout: float | None = None,
) -> tuple[dict[str, Any], list[str], bool]:
    """``bezier plan``: all files into ``folder``, whose place will be ``target``; what to print, as data and as lines,
    and whether there is a path to use."""
    clock = Clock(limit=timeout, listener=channel.event, note=channel.fact)
    made = make_plan(problem, clock, proofs=True)
    files, facts = write_folder(made, folder, target, clock, plots=plots)
    last = f"{len(files)} files in {target} ({facts['seconds']['total']:.2f} s): open {target / REPORT}"
    return facts, [*lines(made), last], made.outcome.is_success
