"""The command ``qe``: eliminate, decide, region, solve, minimize, check, export-proof, convert, smt, prompt.

Every command works in a child process under hard limits. Answers go to stdout and nothing else does;
an error is one line on stderr. Exit status as in ``qe.cli.shell``.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from qe import __version__, arguments
from qe.cli.shell import check_writable, enter, examples, limited, remaining, write_file
from qe.cli.source import ProofFormat, no_file, read_source
from qe.cli.work import Reply, Request
from qe.io.formats import READABLE, Format
from qe.options import Method

app = typer.Typer(
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Exact real quantifier elimination. FORMULA is text ('ex x. x^2 + b*x + c = 0'), a file, or - for stdin.",
)

Formula = Annotated[str, typer.Argument(metavar="FORMULA|FILE|-", show_default=False)]
InputFormat = Annotated[
    Format | None,
    typer.Option("--format", metavar=f"[{'|'.join(READABLE)}]", help="Input format; a file's ending is the default."),
]
Output = Annotated[Format, typer.Option("--output", help="Format of the answer.")]
MethodOption = Annotated[Method, typer.Option("--method", help="Elimination method.")]
Order = Annotated[str | None, typer.Option("--order", help="Variable order, as in x,y,z.")]
Timeout = Annotated[float | None, typer.Option("--timeout", help="Seconds; enforced.")]
Memory = Annotated[int | None, typer.Option("--memory", help="MiB of address space; enforced.")]
Workers = Annotated[int, typer.Option("--workers", help="Processes on this machine for long decompositions.")]
ClusterAddress = Annotated[
    str | None, typer.Option("--cluster", metavar="ADDRESS", help="Dask scheduler whose workers take part.")
]
Race = Annotated[
    str | None,
    typer.Option("--race", metavar="METHODS", help="Methods side by side, as in auto,cad."),
]
CertificateFile = Annotated[Path | None, typer.Option("--certificate", help="Write the certificate to this file.")]
PictureFile = Annotated[
    Path | None, typer.Option("--plot", help="Draw the region to this file (.png, .pdf, .svg; .html: turnable).")
]
Plain = Annotated[bool, typer.Option("--plain", help="No progress display and no notes.")]
Json = Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")]
Explain = Annotated[bool, typer.Option("--explain", help="Tell on stderr how the answer was found.")]
TotalDivision = Annotated[
    bool, typer.Option("--total-division", help="x/0 is some number, as in SMT-LIB, instead of nothing.")
]
Anytime = Annotated[
    bool, typer.Option("--anytime", help="At the time limit, print where it is true, where false, what is open.")
]
RootAtoms = Annotated[bool, typer.Option("--root-atoms", help="Allow x < root(k, p) in the answer.")]


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"qe {__version__}")
        raise typer.Exit


@app.callback(
    epilog=examples(
        'qe eliminate "ex x. x^2 + b*x + c = 0"',
        'qe decide "all x. ex y. y^3 = x"',
        'qe region "x^2 + y^2 <= 4 and y >= x" --plot region.png',
        'qe minimize "x + y" "x^2 + y^2 <= 1"',
    )
)
def whole(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Exact real quantifier elimination. FORMULA is text ('ex x. x^2 + b*x + c = 0'), a file, or - for stdin."""


@app.command(
    short_help="A quantifier-free formula equivalent to FORMULA.",
    epilog=examples('qe eliminate "ex x. x^2 + b*x + c = 0"', 'qe eliminate "all x. x^2 >= a*x" --explain'),
)
def eliminate(
    formula: Formula,
    format: InputFormat = None,
    output: Output = Format.TEXT,
    method: MethodOption = Method.AUTO,
    order: Order = None,
    timeout: Timeout = None,
    memory: Memory = None,
    certificate: CertificateFile = None,
    root_atoms: RootAtoms = False,
    total_division: TotalDivision = False,
    workers: Workers = 0,
    cluster: ClusterAddress = None,
    race: Race = None,
    anytime: Anytime = False,
    explain: Explain = False,
    json: Json = False,
    plain: Plain = False,
) -> int:
    """Print a quantifier-free formula equivalent to FORMULA over the real numbers."""
    from qe.cli import work as cli_work

    asked = request(formula, format, timeout, memory, certificate, json, total_division)
    asked = replace(asked, method=method.value, order=names(order), root_atoms=root_atoms)
    asked = replace(asked, workers=workers, cluster=cluster, race=names(race, "--race") or (), anytime=anytime)
    work = partial(cli_work.eliminate, request=asked, output=output)
    reply = limited(work, timeout=timeout, memory=memory, plain=plain)
    return deliver(reply, {"certificate": certificate}, explain=explain)


@app.command(
    short_help="Whether a sentence is true, a script satisfiable.",
    epilog=examples('qe decide "all x. ex y. y^3 = x"'),
)
def decide(
    formula: Formula,
    format: InputFormat = None,
    method: MethodOption = Method.AUTO,
    timeout: Timeout = None,
    memory: Memory = None,
    certificate: CertificateFile = None,
    total_division: TotalDivision = False,
    workers: Workers = 0,
    cluster: ClusterAddress = None,
    race: Race = None,
    explain: Explain = False,
    json: Json = False,
    plain: Plain = False,
) -> int:
    """Print true or false for a sentence, sat or unsat for an SMT-LIB script."""
    from qe.cli import work as cli_work

    asked = request(formula, format, timeout, memory, certificate, json, total_division)
    asked = replace(asked, method=method.value, workers=workers, cluster=cluster, race=names(race, "--race") or ())
    reply = limited(partial(cli_work.decide, request=asked), timeout=timeout, memory=memory, plain=plain)
    return deliver(reply, {"certificate": certificate}, explain=explain)


@app.command(
    short_help="The set of points that satisfy FORMULA.",
    epilog=examples('qe region "x^2 + y^2 <= 4 and y >= x" --plot region.png'),
)
def region(
    formula: Formula,
    format: InputFormat = None,
    order: Order = None,
    plot: PictureFile = None,
    timeout: Timeout = None,
    memory: Memory = None,
    certificate: CertificateFile = None,
    total_division: TotalDivision = False,
    json: Json = False,
    plain: Plain = False,
) -> int:
    """Describe the set of real points that satisfy FORMULA, cell by cell."""
    from qe.cli import region as cli_region

    check_writable(plot)
    asked = replace(request(formula, format, timeout, memory, certificate, json, total_division), order=names(order))
    work = partial(cli_region.region, request=asked, picture=None if plot is None else plot.suffix or ".png")
    reply = limited(work, timeout=timeout, memory=memory, plain=plain)
    return deliver(reply, {"certificate": certificate, "plot": plot})


@app.command(
    short_help="All solutions of FORMULA, case by case.",
    epilog=examples('qe solve "x^2 + y^2 = 1 and x >= y" --variables x,y'),
)
def solve(
    formula: Formula,
    variables: Annotated[
        str | None, typer.Option("--variables", help="Those to solve for, as in x,y; the others come before them.")
    ] = None,
    format: InputFormat = None,
    timeout: Timeout = None,
    memory: Memory = None,
    certificate: CertificateFile = None,
    total_division: TotalDivision = False,
    json: Json = False,
    plain: Plain = False,
) -> int:
    """Print all real solutions, one case a line, each variable in terms of those before it."""
    from qe.cli import region as cli_region

    asked = request(formula, format, timeout, memory, certificate, json, total_division)
    asked = replace(asked, order=names(variables, "--variables"))
    reply = limited(partial(cli_region.solve, request=asked), timeout=timeout, memory=memory, plain=plain)
    return deliver(reply, {"certificate": certificate})


@app.command(
    short_help="The exact least value under CONSTRAINTS.",
    epilog=examples('qe minimize "x + y" "x^2 + y^2 <= 1"'),
)
def minimize(
    objective: Annotated[str, typer.Argument(metavar="OBJECTIVE", show_default=False)],
    constraints: Annotated[str, typer.Argument(metavar="CONSTRAINTS|FILE|-", show_default=False)] = "true",
    format: InputFormat = None,
    maximize: Annotated[bool, typer.Option("--maximize", help="Find the greatest value instead.")] = False,
    parameters: Annotated[str | None, typer.Option("--parameters", help="Variables not optimised over: a, b.")] = None,
    timeout: Timeout = None,
    memory: Memory = None,
    certificate: CertificateFile = None,
    json: Json = False,
    plain: Plain = False,
) -> int:
    """Print the exact least value of a polynomial under CONSTRAINTS, and where it is attained."""
    from qe.cli import optimize as cli_optimize

    asked = request(constraints, format, timeout, memory, certificate, json)
    goal = cli_optimize.Goal(objective, maximize, parameters)
    work = partial(cli_optimize.optimize, request=asked, goal=goal)
    reply = limited(work, timeout=timeout, memory=memory, plain=plain)
    return deliver(reply, {"certificate": certificate})


@app.command(
    short_help="Verify a certificate.",
    epilog=examples('qe eliminate "ex x. x^2 = a" --certificate c.json', "qe check c.json"),
)
def check(
    certificate: Annotated[str, typer.Argument(metavar="CERTIFICATE|-", show_default=False)],
    formula: Annotated[
        str | None, typer.Option("--formula", metavar="FORMULA|FILE", help="The question that it has to be about.")
    ] = None,
    core: Annotated[bool, typer.Option("--core", help="Believe the kernel and the listed theorems alone.")] = False,
    timeout: Timeout = None,
    memory: Memory = None,
    json: Json = False,
) -> int:
    """Verify a certificate with the independent checker (60 seconds if no --timeout is given); say what it proves.

    Exit status 4 when it is rejected or not about --formula, 3 when the time does not suffice to tell.
    """
    from qe.cli import work as cli_work
    from qe.options import VERIFY_SECONDS

    check_limits(timeout, memory)
    source = read_source(certificate, Format.JSON)
    if source.name == "<argument>":
        raise no_file(certificate)
    seconds = VERIFY_SECONDS if timeout is None else timeout
    asked = None if formula is None else read_source(formula, None)
    work = partial(cli_work.check, text=source.text, asked=asked, seconds=remaining(seconds), as_json=json, core=core)
    return deliver(limited(work, timeout=seconds, memory=memory, plain=True), {})


@app.command("export-proof", short_help="A certificate as proofs for a proof assistant.")
def export_proof(
    certificate: Annotated[str, typer.Argument(metavar="CERTIFICATE|-", show_default=False)],
    to: Annotated[ProofFormat, typer.Option("--to", help="The proof assistant.")] = ProofFormat.COQ,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Verify a certificate and print it as lemmas with proofs for a proof assistant.

    Exit status 4 when it is rejected, 3 where it is of a kind that cannot be written so.
    """
    from qe.cli import work as cli_work
    from qe.options import VERIFY_SECONDS

    check_limits(timeout, memory)
    source = read_source(certificate, Format.JSON)
    if source.name == "<argument>":
        raise no_file(certificate)
    seconds = VERIFY_SECONDS if timeout is None else timeout
    work = partial(cli_work.export_proof, text=source.text, seconds=remaining(seconds))
    return deliver(limited(work, timeout=seconds, memory=memory, plain=True), {})


@app.command(
    short_help="FORMULA in another format.",
    epilog=examples('qe convert "ex x. x^2 = a" --output smtlib'),
)
def convert(
    formula: Formula,
    format: InputFormat = None,
    output: Output = Format.TEXT,
    timeout: Timeout = None,
) -> int:
    """Print FORMULA in another format, unchanged in meaning."""
    from qe.cli import work as cli_work

    check_limits(timeout, None)
    work = partial(cli_work.convert, source=read_source(formula, format), output=output)
    return deliver(limited(work, timeout=timeout, memory=None, plain=True), {})


@app.command(
    short_help="Run an SMT-LIB script as a solver.",
    epilog=examples("qe smt problem.smt2 --timeout 60"),
)
def smt(
    script: Annotated[str, typer.Argument(metavar="FILE|-", show_default=False)] = "-",
    timeout: Annotated[
        float | None, typer.Option("--timeout", help="Seconds for all checks together; with -i for each of them.")
    ] = None,
    memory: Memory = None,
    interactive: Annotated[
        bool, typer.Option("--interactive", "-i", help="Then read commands from standard input, as they come.")
    ] = False,
) -> int:
    """Run an SMT-LIB script over the reals as solvers do: one answer for every command.

    Exit status 2 when a command was not understood; all others were answered.
    """
    from qe.cli import smt as cli_smt

    check_limits(timeout, memory)
    source = None if script == "-" else read_source(script, Format.SMTLIB)
    if source is not None and source.name == "<argument>":
        raise no_file(script)
    text, name = (None, "<stdin>") if source is None else (source.text, source.name)
    limit = timeout if timeout is None or interactive else remaining(timeout)
    return cli_smt.run(text, name, timeout=limit, memory=memory, interactive=interactive)


@app.command(short_help="Ask and answer on the terminal (so does qe alone).")
def prompt() -> int:
    """Read questions and answer them until the input ends; % is the last answer, :help lists what can be asked.

    On a terminal qe without a command does this, too.
    """
    from qe.cli import prompt as cli_prompt

    return cli_prompt.run(None if cli_prompt.is_wanted() else cli_prompt.plain_reader())


def request(
    source: str,
    format: Format | None,
    timeout: float | None,
    memory: int | None,
    certificate: Path | None,
    json: bool,
    total_division: bool = False,
) -> Request:
    """What all answering commands are asked; limits and files are checked before anything is read."""
    check_limits(timeout, memory)
    check_writable(certificate)
    given = replace(read_source(source, format), total_division=total_division)
    return Request(source=given, timeout=soft(timeout), certificate=certificate is not None, json=json)


def names(order: str | None, option: str = "--order") -> tuple[str, ...] | None:
    """The variables of an option."""
    return arguments.names(order, option)


def check_limits(timeout: float | None, memory: int | None) -> None:
    """Raise ``InputError`` for limits that make no sense."""
    arguments.seconds(timeout, "--timeout")
    arguments.mebibytes(memory, "--memory")


def soft(timeout: float | None) -> float | None:
    """The limit for the checks inside the engine, which can end the work in order."""
    return None if timeout is None else remaining(timeout)


def deliver(reply: Reply, paths: dict[str, Path | None], *, explain: bool = False) -> int:
    """Write the files first, then the answer; the exit status."""
    for key, path in paths.items():
        if path is not None and key in reply.files:  # decided parts may have no certificate: the text says so
            write_file(path, reply.files[key])
    typer.echo(reply.text)
    if explain:
        for line in reply.notes:
            typer.echo(line, err=True)
    return reply.code


def main(argv: Sequence[str] | None = None) -> int:
    """The entry point of the command ``qe``; returns the exit status."""
    words = sys.argv[1:] if argv is None else argv
    if not words and all(stream is not None and stream.isatty() for stream in (sys.stdin, sys.stdout)):
        words = ["prompt"]
    return enter(app, words or ["--help"], name="qe")
