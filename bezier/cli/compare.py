"""``bezier compare``: formulas (8) and (7) on one problem."""

from __future__ import annotations

from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from bezier.cli.options import Json, Memory, NoPlots, ProblemFile, Timeout
from qe.cli.app import check_limits
from qe.cli.shell import limited


def compare(
    problem: ProblemFile,
    out: Annotated[Path | None, typer.Option("--out", help="Folder for the page, the pictures and the data.")] = None,
    json: Json = False,
    no_plots: NoPlots = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Quadratic and cubic curves on one problem, side by side."""
    from bezier.planner.outputs import all_or_none
    from bezier.problem import load_problem

    check_limits(timeout, memory)
    read = load_problem(problem)
    with nullcontext() if out is None else all_or_none(out) as folder:
        from bezier.compare import command as compare_command

        request = compare_command.Request(
            problem=read, folder=folder, target=out, plots=not no_plots, json=json, timeout=timeout
        )
        work = partial(compare_command.run, request=request)
        reply = limited(work, timeout=timeout, memory=memory, plain=json, lines=True)
    print(reply.text)
    return reply.code
