"""``bezier plan``: a path for a planning problem, with its report, data and certificates."""

from __future__ import annotations

from functools import partial

from bezier.cli.options import Json, Memory, NoPlots, Out, ProblemFile, Timeout
from qe.cli.app import check_limits
from qe.cli.shell import limited


def plan(
    problem: ProblemFile,
    out: Out,
    json: Json = False,
    no_plots: NoPlots = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Plan a path; write report.html, region, path and certificate files into a folder, all or none."""
    from bezier.planner.outputs import all_or_none
    from bezier.problem import load_problem

    check_limits(timeout, memory)
    read = load_problem(problem)
    with all_or_none(out) as folder:
        from bezier.planner import command

        request = command.Request(
            problem=read, folder=folder, target=out, plots=not no_plots, json=json, timeout=timeout
        )
        reply = limited(partial(command.plan, request=request), timeout=timeout, memory=memory, plain=json)
    print(reply.text)
    return reply.code
