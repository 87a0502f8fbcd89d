"""``bezier certify-path``: whether an arm can follow a whole path."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from bezier.cli.ik import ArmName
from bezier.cli.options import Json, Memory, Timeout
from qe.cli.app import check_limits
from qe.cli.shell import OK, check_writable, limited, write_file
from qe.errors import Unable


def certify_path(
    arm: ArmName,
    path: Annotated[Path, typer.Argument(metavar="PATH.toml", help="[[curve]] tables.", show_default=False)],
    certificate: Annotated[Path | None, typer.Option("--certificate", help="Write the certificates here.")] = None,
    json: Json = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Prove that ARM can follow the path for all s in [0, 1], or say exactly where it stops; follow all branches."""
    from bezier.arm.command import certify
    from bezier.arm.reader import load_arm, load_route

    check_limits(timeout, memory)
    check_writable(certificate)
    work = partial(certify, arm=load_arm(arm), curves=load_route(path), json=json)
    text, evidence = limited(work, timeout=timeout, memory=memory, plain=json)
    print(text)
    if certificate is not None:
        if not evidence:
            raise Unable("there is no joint motion along a part of the path, so there is no certificate")
        write_file(certificate, evidence)
    return OK
