"""The command ``bezier``: its commands by name, each from a file of its own.

Exit status: 0 answered, 2 bad input, 3 unable or no solution, 4 certificate rejected, 1 a bug. An error is one
line on stderr.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import typer

from bezier.cli.certify_path import certify_path
from bezier.cli.check import check
from bezier.cli.clearance import clearance
from bezier.cli.compare import compare
from bezier.cli.ik import ik
from bezier.cli.joints import joints
from bezier.cli.plan import plan
from qe.cli.shell import enter

COMMANDS: Mapping[str, Callable[..., int]] = {
    "plan": plan,
    "check": check,
    "clearance": clearance,
    "compare": compare,
    "ik": ik,
    "certify-path": certify_path,
    "joints": joints,
}
"""In the order in which the help lists them. A command reads its input here and leaves the work to a worker."""

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Certified paths of Bézier curves, planned by exact quantifier elimination.",
)
for _name, _command in COMMANDS.items():
    app.command(_name)(_command)


def main(argv: Sequence[str] | None = None) -> int:
    """The entry point of the console script."""
    return enter(app, argv, name="bezier")
