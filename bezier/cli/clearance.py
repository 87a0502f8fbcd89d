"""``bezier clearance``: curves examined against obstacles."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from bezier.cli.options import Json, Memory, Timeout
from qe.cli.app import check_limits
from qe.cli.shell import OK, limited


def clearance(
    source: Annotated[Path, typer.Argument(metavar="DIR|PROBLEM.toml|CURVES.toml", show_default=False)],
    obstacles: Annotated[Path | None, typer.Option("--obstacles", help="A file with [[obstacle]] tables.")] = None,
    certificate: Annotated[Path | None, typer.Option("--certificate", help="Write the certificates here.")] = None,
    json: Json = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Prove each curve clear of each obstacle for all t, or say where it first meets it."""
    from bezier.check.clearance import Request
    from bezier.check.clearance import clearance as examine

    check_limits(timeout, memory)
    request = Request(source=source, obstacles=obstacles, certificate=certificate, json=json, timeout=timeout)
    print(limited(partial(examine, request=request), timeout=timeout, memory=memory, plain=json))
    return OK
