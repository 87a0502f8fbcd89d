"""The command ``bezier``: plan, check, clearance, compare.

Exit status: 0 answered, 2 bad input, 3 unable or no solution, 4 certificate rejected, 1 a bug. An error is one
line on stderr.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from qe.cli import check_limits
from qe.cli_shell import OK, enter, limited

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Certified paths of Bézier curves, planned by exact quantifier elimination.",
)

ProblemFile = Annotated[Path, typer.Argument(metavar="PROBLEM.toml", help="The planning problem.", show_default=False)]
Out = Annotated[Path, typer.Option("--out", help="Folder for the report and all other files.")]
Json = Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")]
NoPlots = Annotated[bool, typer.Option("--no-plots", help="No pictures.")]
Timeout = Annotated[float | None, typer.Option("--timeout", help="Seconds; enforced.")]
Memory = Annotated[int | None, typer.Option("--memory", help="MiB of address space; enforced.")]


@app.command()
def plan(
    problem: ProblemFile,
    out: Out,
    json: Json = False,
    no_plots: NoPlots = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Plan a path; write report.html, region, path and certificate files into a folder, all or none."""
    from bezier.outputs import all_or_none
    from bezier.problem import load_problem

    check_limits(timeout, memory)
    read = load_problem(problem)
    with all_or_none(out) as folder:
        from bezier import command

        request = command.Request(
            problem=read, folder=folder, target=out, plots=not no_plots, json=json, timeout=timeout
        )
        reply = limited(partial(command.plan, request=request), timeout=timeout, memory=memory, plain=json)
    print(reply.text)
    return reply.code


@app.command()
def check(
    folder: Annotated[Path, typer.Argument(metavar="DIR", show_default=False)],
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Verify the certificates in a folder written by plan, prove its path again, and compare every entry."""
    from bezier.recheck import recheck

    check_limits(timeout, memory)
    for line in limited(partial(recheck, folder=folder), timeout=timeout, memory=memory, plain=False):
        print(line)
    return OK


@app.command()
def clearance(
    source: Annotated[Path, typer.Argument(metavar="DIR|PROBLEM.toml|CURVES.toml", show_default=False)],
    obstacles: Annotated[Path | None, typer.Option("--obstacles", help="A file with [[obstacle]] tables.")] = None,
    certificate: Annotated[Path | None, typer.Option("--certificate", help="Write the certificates here.")] = None,
    json: Json = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Prove each curve clear of each obstacle for all t, or say where it first meets it."""
    from bezier.obstacles.command import Request
    from bezier.obstacles.command import clearance as examine

    check_limits(timeout, memory)
    request = Request(source=source, obstacles=obstacles, certificate=certificate, json=json, timeout=timeout)
    print(limited(partial(examine, request=request), timeout=timeout, memory=memory, plain=json))
    return OK


@app.command()
def compare(
    problem: ProblemFile,
    out: Annotated[Path | None, typer.Option("--out", help="Folder for the page, the pictures and the data.")] = None,
    json: Json = False,
    no_plots: NoPlots = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Quadratic and cubic curves on one problem, side by side."""
    from bezier.outputs import all_or_none
    from bezier.problem import load_problem

    check_limits(timeout, memory)
    read = load_problem(problem)
    with nullcontext() if out is None else all_or_none(out) as folder:
        from bezier.compare import command as compare_command

        request = compare_command.Request(
            problem=read, folder=folder, target=out, plots=not no_plots, json=json, timeout=timeout
        )
        reply = limited(partial(compare_command.run, request=request), timeout=timeout, memory=memory, plain=json)
    print(reply.text)
    return reply.code


def main(argv: Sequence[str] | None = None) -> int:
    """The entry point of the console script."""
    return enter(app, argv, name="bezier")
