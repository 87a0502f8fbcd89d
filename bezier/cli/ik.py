"""``bezier ik``: all joint positions of an arm that reach a point."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from bezier.cli.options import Json, Memory, Timeout
from qe.cli.app import check_limits
from qe.cli.shell import OK, check_writable, limited, write_file

ArmName = Annotated[
    str, typer.Argument(metavar="ARM", help="ev3-112, ev3-120, … or a file ARM.toml.", show_default=False)
]


def coordinate(name: str) -> object:
    """The type of an argument that is a coordinate."""
    return typer.Argument(metavar=name, help='Exact, in mm: 3/4, 0.75, "44*sqrt(2)".', show_default=False)


def ik(
    arm: ArmName,
    x: Annotated[str, coordinate("X")],
    y: Annotated[str, coordinate("Y")],
    z: Annotated[str, coordinate("Z")],
    quaternion: Annotated[
        tuple[str, str, str, str] | None,
        typer.Option(metavar="W X Y Z", help="The orientation, of any length: a pose, for six joints or planar arms."),
    ] = None,
    certificate: Annotated[
        Path | None, typer.Option("--certificate", help="Write the certificate that these are all solutions here.")
    ] = None,
    json: Json = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """All real joint positions that put the end effector of ARM at the point (X, Y, Z)."""
    from bezier.arm.command import inverse
    from bezier.arm.exact_text import read_exact
    from bezier.arm.reader import load_arm

    check_limits(timeout, memory)
    check_writable(certificate)
    model, point = load_arm(arm), tuple(read_exact(text) for text in (x, y, z))
    turned = None if quaternion is None else tuple(read_exact(text) for text in quaternion)
    certified = certificate is not None
    work = partial(inverse, arm=model, point=point, quaternion=turned, json=json, certified=certified)
    text, evidence = limited(work, timeout=timeout, memory=memory, plain=json)
    if certificate is not None:
        write_file(certificate, evidence)
    print(text)
    return OK
