"""The settings of ``qe.api.settings`` as options of commands, with the same names, checks and meanings."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from qe import arguments
from qe.api.doors import DOORS, Door
from qe.api.settings import Elimination, settings_in
from qe.cli.shell import examples
from qe.options import Method, Projection

Command = Callable[..., int]


def _parameter(name: str, default: object, annotation: Any) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


WRITTEN: Mapping[str, Any] = {
    "method": Method,
    "projection": Projection,
    **dict.fromkeys(("order", "race", "assuming"), str | None),
}
"""The types of options that the command line writes in a way of its own."""
METAVARS = {"cluster": "ADDRESS", "race": "METHODS", "assuming": "CONDITIONS"}
ELSEWHERE = {"format", "progress", "process", "check", "without"}
"""Settings that are no options, or are options of another kind: ``--format``, ``--certificate FILE``."""


Json = Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")]
_CERTIFICATE = typer.Option("--certificate", help="Write the certificate to this file.")
_CHECK = typer.Option("--check", help="Prove the answer, verify the proof, and say so.")
_PROGRESS = typer.Option("--progress", help="Lines of progress on stderr, also through a pipe.")
REPORT = {
    "check": _parameter("check", False, Annotated[bool, _CHECK]),
    "certificate": _parameter("certificate", None, Annotated[Path | None, _CERTIFICATE]),
    "json": _parameter("json", False, Json),
    "progress": _parameter("progress", False, Annotated[bool, _PROGRESS]),
    "plain": _parameter(
        "plain", False, Annotated[bool, typer.Option("--plain", help="No progress display and no notes.")]
    ),
}
"""What all commands take that answer a question: how the answer is written."""


def command(
    app: typer.Typer, kind: type, short: str, *shown: str, also: tuple[str, ...] = (), row: Door | None = None
) -> Callable[[Command], Command]:
    """Add a command that ends in ``**settings``: those of this class, ``also`` these, and what is in ``REPORT`` if it
    may have a certificate. ``shown``: examples for its help; ``row``: its door."""

    def added(function: Command) -> Command:
        signature = inspect.signature(function, eval_str=True)
        listed = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        given = ELSEWHERE | {p.name for p in listed}
        names = [name for name in (*also, *settings_in(kind)) if name not in given]
        report = [option for key, option in REPORT.items() if key != "certificate" or row is None or row.certified]
        options = [*(report if "check" in settings_in(kind) else ()), *map(option, names)]
        function.__signature__ = signature.replace(parameters=[*listed, *options])  # type: ignore[attr-defined]
        app.command(row.name if row else None, short_help=short, epilog=examples(*shown) if shown else None)(function)
        return function

    return added


def door(app: typer.Typer, name: str, *, also: tuple[str, ...] = ()) -> Callable[[Command], Command]:
    """Add the command of a row of ``qe.api.doors``."""
    listed = DOORS[name]
    return command(app, listed.settings, listed.says, *listed.examples, also=also, row=listed)


@functools.cache
def option(name: str) -> inspect.Parameter:
    """The parameter of a command that is this setting."""
    hint, setting = settings_in(Elimination)[name]
    short = setting.says.partition(";")[0]
    info = typer.Option(
        f"--{name.replace('_', '-')}", metavar=METAVARS.get(name), help=f"{short[0].upper()}{short[1:]}."
    )
    default = setting.default or None if name in WRITTEN else setting.default
    return _parameter(name, default, Annotated[WRITTEN.get(name, hint), info])


def checked(options: Mapping[str, Any], mark: str = "--") -> dict[str, Any]:
    """The values of the options. Raises ``InputError``, naming the option, for those that make no sense."""
    values = {}
    for name, value in options.items():
        what = mark + name.replace("_", "-")
        given = (arguments.names(value, what) or ()) if name == "race" else value
        values[name] = settings_in(Elimination)[name][1].check(given, what=what)
    return values
