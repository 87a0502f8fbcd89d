"""The command ``bezier``: its commands by name, each from a file of its own.

Exit status: 0 answered, 2 bad input, 3 unable or no solution, 4 certificate rejected, 1 a bug. An error is one
line on stderr.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from typing import Annotated

import typer

from bezier.cli.certify_path import certify_path
from bezier.cli.check import check
from bezier.cli.clearance import clearance
from bezier.cli.compare import compare
from bezier.cli.ik import ik
from bezier.cli.joints import joints
from bezier.cli.plan import plan
from qe.cli.shell import enter, examples

Command = tuple[str, Callable[..., int], str, str]

COMMANDS: tuple[Command, ...] = (
    ("plan", plan, "Plan a path, with its page and proofs.", "examples/three_balls.toml --out out"),
    ("check", check, "Verify the folder of a plan.", "out"),
    ("clearance", clearance, "Curves clear of obstacles, for all t.", "examples/obstacle_curves.toml"),
    ("compare", compare, "Quadratic and cubic curves side by side.", "examples/cubic_joins.toml --out out"),
    ("ik", ik, "All joint positions of an arm at a point.", "ev3-120 599/66 824/33 323/10"),
    ("certify-path", certify_path, "Whether an arm can follow a path.", "ev3-120 examples/arm_curve.toml"),
    ("joints", joints, "The joint sequence of an arm on a path.", "ev3-120 examples/arm_curve.toml --out arm"),
)
"""In the order in which the help lists them, each with its line there and an example. A command reads its input here
and leaves the work to a worker."""

app = typer.Typer(pretty_exceptions_enable=False, rich_markup_mode=None)
for _name, _command, _short, _example in COMMANDS:
    app.command(_name, short_help=_short, epilog=examples(f"bezier {_name} {_example}"))(_command)


def _version(wanted: bool) -> None:
    if wanted:
        from bezier.report.html import package_version

        typer.echo(f"bezier {package_version()}")
        raise typer.Exit


@app.callback(epilog=examples(*(f"bezier {name} {example}" for name, _, _, example in COMMANDS)))
def whole(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Certified paths of Bézier curves, planned by exact quantifier elimination."""


def main(argv: Sequence[str] | None = None) -> int:
    """The entry point of the console script; without words it shows the help."""
    return enter(app, (sys.argv[1:] if argv is None else argv) or ["--help"], name="bezier")
