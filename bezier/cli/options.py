"""Arguments and options that several commands have."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

ProblemFile = Annotated[Path, typer.Argument(metavar="PROBLEM.toml", help="The planning problem.", show_default=False)]
Out = Annotated[Path, typer.Option("--out", help="Folder for the report and all other files.")]
Json = Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")]
NoPlots = Annotated[bool, typer.Option("--no-plots", help="No pictures.")]
Timeout = Annotated[float | None, typer.Option("--timeout", help="Seconds; enforced.")]
Memory = Annotated[int | None, typer.Option("--memory", help="MiB of address space; enforced.")]
