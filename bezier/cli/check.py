"""``bezier check``: the files of a plan verified again."""

from __future__ import annotations

from functools import partial
from json import dumps
from pathlib import Path
from typing import Annotated

import typer

from bezier.cli.options import Json, Memory, Timeout
from qe.cli.app import check_limits
from qe.cli.shell import OK, limited


def check(
    folder: Annotated[Path, typer.Argument(metavar="DIR", show_default=False)],
    json: Json = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Verify the certificates in a folder written by plan, prove its path again, and compare every entry."""
    from bezier.check.recheck import recheck

    check_limits(timeout, memory)
    lines = limited(partial(recheck, folder=folder), timeout=timeout, memory=memory, plain=json)
    print(dumps({"status": "accepted", "checked": lines}, indent=1, ensure_ascii=False) if json else "\n".join(lines))
    return OK
