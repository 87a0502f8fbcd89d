"""The settings of ``qe.api.settings`` as options of commands, with the same names, checks and meanings."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Annotated, Any

import typer

from qe import arguments
from qe.api.settings import Elimination, settings_in
from qe.cli.shell import examples
from qe.options import Method

Command = Callable[..., int]

WRITTEN: Mapping[str, Any] = {"method": Method, "order": str | None, "race": str | None}
"""The types of options that the command line writes in a way of its own."""
METAVARS = {"cluster": "ADDRESS", "race": "METHODS"}
ELSEWHERE = {"format", "progress", "process", "check", "without"}
"""Settings that are no options, or are options of another kind: ``--format``, ``--certificate FILE``."""


def command(
    app: typer.Typer, kind: type, short: str, *shown: str, also: tuple[str, ...] = ()
) -> Callable[[Command], Command]:
    """Add a command that ends in ``**settings``: those of this class, and ``also`` these, that it does not list itself.

    ``shown``: examples for its help.
    """

    def added(function: Command) -> Command:
        signature = inspect.signature(function, eval_str=True)
        listed = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        given = ELSEWHERE | {p.name for p in listed}
        options = [option(name) for name in (*also, *settings_in(kind)) if name not in given]
        function.__signature__ = signature.replace(parameters=[*listed, *options])  # type: ignore[attr-defined]
        app.command(short_help=short, epilog=examples(*shown) if shown else None)(function)
        return function

    return added


def option(name: str) -> inspect.Parameter:
    """The parameter of a command that is this setting."""
    hint, setting = settings_in(Elimination)[name]
    short = setting.says.partition(";")[0]
    info = typer.Option(
        f"--{name.replace('_', '-')}", metavar=METAVARS.get(name), help=f"{short[0].upper()}{short[1:]}."
    )
    return inspect.Parameter(
        name,
        inspect.Parameter.KEYWORD_ONLY,
        default=setting.default or None if name in WRITTEN else setting.default,
        annotation=Annotated[WRITTEN.get(name, hint), info],
    )


def checked(options: Mapping[str, Any]) -> dict[str, Any]:
    """The values of the options. Raises ``InputError``, naming the option, for those that make no sense."""
    values = {}
    for name, value in options.items():
        what = f"--{name.replace('_', '-')}"
        given = (arguments.names(value, what) or ()) if name == "race" else value
        values[name] = settings_in(Elimination)[name][1].check(given, what=what)
    return values
