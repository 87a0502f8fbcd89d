"""What the commands do inside the worker: plan, draw, write, and say it in words or as JSON."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path as FilePath

from bezier.planner.folder import write_folder
from bezier.planner.outputs import REPORT
from bezier.planner.planning import make_plan
from bezier.planner.words import lines
from bezier.plans import Clock, Plan
from bezier.problem import Problem
from qe.cli.shell import OK, UNABLE
from qe.processes.channel import Channel


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
    made = make_plan(request.problem, clock, proofs=True)
    files, told = write_folder(made, request.folder, request.target, clock, plots=request.plots)
    text = json.dumps(told, indent=1, ensure_ascii=False)
    code = OK if made.outcome.is_success else UNABLE
    return Reply(text if request.json else in_words(made, request.target, files, told["seconds"]["total"]), code)


def in_words(made: Plan, target: FilePath, files: list[str], seconds: float) -> str:
    """The short summary for people."""
    return "\n".join([*lines(made), f"{len(files)} files in {target} ({seconds:.2f} s): open {target / REPORT}"])
