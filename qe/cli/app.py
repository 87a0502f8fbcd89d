"""The command ``qe``: eliminate, decide, region, solve, minimize, check, export-proof, convert, smt, prompt.

Every command that takes long or has limits works in a process that can be killed. Answers go to stdout and nothing
else does; an error is one line on stderr. Exit status as in ``qe.cli.shell``.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from qe import __version__, arguments
from qe.api.doors import DOORS
from qe.api.settings import Limited
from qe.cli.options import REPORT, Json, checked, command, door
from qe.cli.shell import check_writable, enter, examples, limited, remaining, write_file
from qe.cli.source import ProofFormat, Reply, Request, Source, called, no_file, read_source
from qe.io.formats import READABLE, Format
from qe.options import VERIFY_SECONDS

app = typer.Typer(pretty_exceptions_enable=False, rich_markup_mode=None)

WORK, REGION = "qe.cli.work", "qe.cli.region"
"""Modules that are loaded where the work is done."""

Formula = Annotated[str, typer.Argument(metavar="FORMULA|FILE|-", show_default=False)]
InputFormat = Annotated[
    Format | None,
    typer.Option("--format", metavar=f"[{'|'.join(READABLE)}]", help="Input format; a file's ending is the default."),
]
Output = Annotated[Format, typer.Option("--output", help="Format of the answer.")]
CertificateSource = Annotated[str, typer.Argument(metavar="CERTIFICATE|-", show_default=False)]
PictureFile = Annotated[
    Path | None, typer.Option("--plot", help="Draw the region to this file (.png, .pdf, .svg; .html: turnable).")
]


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"qe {__version__}")
        raise typer.Exit


@app.callback(epilog=examples(*(DOORS[name].examples[0] for name in ("eliminate", "decide", "region", "minimize"))))
def whole(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Exact real quantifier elimination. FORMULA is text ('ex x. x^2 + b*x + c = 0'), a file, or - for stdin."""


@door(app, "eliminate")
def eliminate(formula: Formula, format: InputFormat = None, output: Output = Format.TEXT, **settings: Any) -> int:
    """Print a quantifier-free formula equivalent to FORMULA over the real numbers."""
    return answered(partial(called, WORK, "eliminate", output=output), formula, format, settings)


@door(app, "decide")
def decide(formula: Formula, format: InputFormat = None, **settings: Any) -> int:
    """Print true or false for a sentence, sat or unsat for an SMT-LIB script."""
    return answered(partial(called, WORK, "decide"), formula, format, settings)


@door(app, "find")
def find(
    formula: Formula,
    n: Annotated[int, typer.Option("-n", help="Number of points; fewer if there are no more.")] = 1,
    seed: Annotated[int, typer.Option("--seed", help="Another number gives other points.")] = 0,
    format: InputFormat = None,
    **settings: Any,
) -> int:
    """Print exact points that satisfy FORMULA, one a line; the word none where there is no point."""
    return answered(partial(called, REGION, "find", n=n, seed=seed), formula, format, settings)


@door(app, "region", also=("order",))
def region(formula: Formula, format: InputFormat = None, plot: PictureFile = None, **settings: Any) -> int:
    """Describe the set of real points that satisfy FORMULA, cell by cell."""
    check_writable(plot)
    picture = None if plot is None else plot.suffix or ".png"
    return answered(partial(called, REGION, "region", picture=picture), formula, format, settings, plot=plot)


@door(app, "solve")
def solve(
    formula: Formula,
    variables: Annotated[
        str | None, typer.Option("--variables", help="Variables to solve for, as in x,y; the others are parameters.")
    ] = None,
    format: InputFormat = None,
    **settings: Any,
) -> int:
    """Print all real solutions, one case a line, each variable in terms of those before it."""
    listed = arguments.names(variables, "--variables")
    return answered(partial(called, REGION, "solve", variables=listed), formula, format, settings)


@door(app, "simplify")
def simplify(formula: Formula, format: InputFormat = None, output: Output = Format.TEXT, **settings: Any) -> int:
    """Print a formula equivalent to FORMULA, not longer; quantifiers stay."""
    return answered(partial(called, WORK, "eliminate", output=output, shorter=True), formula, format, settings)


@door(app, "equivalent")
def equivalent(
    formula: Formula,
    other: Annotated[str, typer.Argument(metavar="FORMULA|FILE", show_default=False)],
    format: InputFormat = None,
    **settings: Any,
) -> int:
    """Print true if both formulas have the same solutions in all their free variables, else false."""
    return answered(partial(called, REGION, "equivalent", other=read_source(other, format)), formula, format, settings)


@door(app, "witnesses")
def witnesses(formula: Formula, format: InputFormat = None, **settings: Any) -> int:
    """Print solutions of the outermost block as terms in the free variables, each under its guard."""
    return answered(partial(called, REGION, "witnesses"), formula, format, settings)


Objective = Annotated[str, typer.Argument(metavar="OBJECTIVE", show_default=False)]
Constraints = Annotated[str, typer.Argument(metavar="CONSTRAINTS|FILE|-", show_default=False)]
Parameters = Annotated[str | None, typer.Option("--parameters", help="Variables not optimised over: a, b.")]


def _optimise(name: str, greatest: bool | None) -> None:
    """The command for the least value, for the greatest one, or (None) for both."""

    def optimised(
        objective: Objective,
        constraints: Constraints = "true",
        format: InputFormat = None,
        parameters: Parameters = None,
        **settings: Any,
    ) -> int:
        work = partial(
            called, "qe.cli.optimize", "optimize", objective=objective, maximize=greatest, parameters=parameters
        )
        return answered(work, constraints, format, settings)

    attained = "where they are attained" if greatest is None else "where it is attained"
    optimised.__doc__ = f"Print {DOORS[name].says[0].lower()}{DOORS[name].says[1:-1]}, and {attained}."
    door(app, name)(optimised)


for _name, _greatest in (("minimize", False), ("maximize", True), ("optimum", None)):
    _optimise(_name, _greatest)


@door(app, "verify")
@command(app, Limited, "Another name of verify.", "qe check c.json")
def check(
    certificate: CertificateSource,
    formula: Annotated[
        str | None, typer.Option("--formula", metavar="FORMULA|FILE", help="Accept it only as an answer to this.")
    ] = None,
    assuming: Annotated[str | None, typer.Option("--assuming", help="The assumptions of that question.")] = None,
    core: Annotated[bool, typer.Option("--core", help="Trust the kernel and the listed theorems alone.")] = False,
    plain: Annotated[bool, typer.Option("--plain", help="As --core, and in plain Python, without FLINT.")] = False,
    json: Json = False,
    **settings: Any,
) -> int:
    """Verify a certificate with the independent checker (60 seconds if no --timeout is given); say what it proves.

    Exit status 4 when it is rejected or not about --formula, 3 when the time does not suffice to tell.
    """
    source, limits = _certificate(certificate, settings)
    asked = None if formula is None else read_source(formula, None)
    seconds = remaining(limits["timeout"])
    given: dict[str, Any] = {"source": source, "asked": asked, "assuming": assuming, "core": core, "plainly": plain}
    return deliver(limited(partial(called, WORK, "check", seconds=seconds, as_json=json, **given), **limits), {})


@command(app, Limited, "A certificate as proofs for a proof assistant.")
def export_proof(
    certificate: CertificateSource,
    to: Annotated[ProofFormat, typer.Option("--to", help="The proof assistant.")] = ProofFormat.COQ,
    **settings: Any,
) -> int:
    """Verify a certificate and print it as lemmas with proofs for a proof assistant.

    Exit status 4 when it is rejected, 3 where it is of a kind that cannot be written so.
    """
    source, limits = _certificate(certificate, settings)
    seconds = remaining(limits["timeout"])
    return deliver(limited(partial(called, WORK, "export_proof", source=source, seconds=seconds), **limits), {})


def _certificate(name: str, settings: dict[str, Any]) -> tuple[Source, dict[str, Any]]:
    """A certificate as it is written, and the limits for its verification."""
    limits = checked(settings)
    source = read_source(name, Format.JSON)
    if source.name == "<argument>":
        raise no_file(name)
    return source, {**limits, "timeout": limits["timeout"] or VERIFY_SECONDS, "plain": True}


@command(app, Limited, "FORMULA in another format.", 'qe convert "ex x. x^2 = a" --output smtlib')
def convert(formula: Formula, format: InputFormat = None, output: Output = Format.TEXT, **settings: Any) -> int:
    """Print FORMULA in another format, unchanged in meaning."""
    limits = checked(settings)
    source = read_source(formula, format)
    converted = partial(called, WORK, "convert", source=source, output=output)
    return deliver(limited(converted, plain=True, text=source.text, **limits), {})


@command(app, Limited, "Run an SMT-LIB script as a solver.", "qe smt problem.smt2 --timeout 60")
def smt(
    script: Annotated[str, typer.Argument(metavar="FILE|-", show_default=False)] = "-",
    timeout: Annotated[
        float | None, typer.Option("--timeout", help="Seconds for all checks together; with -i for each of them.")
    ] = None,
    interactive: Annotated[
        bool, typer.Option("--interactive", "-i", help="Then read commands from standard input, as they come.")
    ] = False,
    **settings: Any,
) -> int:
    """Run an SMT-LIB script over the reals as solvers do: one answer for every command.

    Exit status 2 when a command was not understood; all others were answered.
    """
    from qe.cli import smt as cli_smt

    limits = checked({**settings, "timeout": timeout})
    limit = timeout if timeout is None or interactive else remaining(timeout)
    return cli_smt.run(script, timeout=limit, memory=limits["memory"], interactive=interactive)


@app.command(short_help="Ask and answer on the terminal (so does qe alone).")
def prompt() -> int:
    """Read questions and answer them until the input ends; % is the last answer, :help lists what can be asked.

    On a terminal qe without a command does this, too.
    """
    from qe.cli import prompt as cli_prompt

    return cli_prompt.run(None if _is_asked() else lambda shown: input())  # through a pipe nothing is asked


def answered(
    work: Callable[..., Reply], source: str, format: Format | None, given: Mapping[str, Any], **files: Path | None
) -> int:
    """The exit status of a command whose work is done, and its answer printed and written. Options and files are
    checked before anything is read."""
    files["certificate"] = certificate = given.get("certificate")
    settings = checked({name: value for name, value in given.items() if name not in REPORT})
    check_writable(certificate)
    text = replace(read_source(source, format), total_division=settings.pop("total_division", False))
    timeout, memory = settings["timeout"], settings.pop("memory")
    if timeout is not None:  # the checks inside the engine can end the work in order
        settings["timeout"] = remaining(timeout)
    wanted = {"certificate": certificate is not None, "check": given["check"], "json": given["json"]}
    request = Request(source=text, explain=settings.pop("explain", False), settings=settings, **wanted)
    worked = partial(work, request=request)
    shown = {"plain": given["plain"], "lines": given["progress"]}
    reply = limited(worked, timeout=timeout, memory=memory, text=text.text, **shown)
    return deliver(reply, files)


def deliver(reply: Reply, paths: dict[str, Path | None]) -> int:
    """Write the files first, then the answer; the exit status."""
    for key, path in paths.items():
        if path is not None and key in reply.files:  # decided parts may have no certificate: the text says so
            write_file(path, reply.files[key])
    typer.echo(reply.text)
    if reply.verdict:
        typer.echo(reply.verdict, err=True)
    for line in reply.notes:
        typer.echo(line, err=True)
    return reply.code


def main(argv: Sequence[str] | None = None) -> int:
    """The entry point of the command ``qe``; returns the exit status."""
    words = sys.argv[1:] if argv is None else argv
    return enter(app, words or ["prompt" if _is_asked() else "--help"], name="qe")


def _is_asked() -> bool:
    """Whether somebody sits there: questions come from a terminal and answers go to one."""
    return all(stream is not None and stream.isatty() for stream in (sys.stdin, sys.stdout))
