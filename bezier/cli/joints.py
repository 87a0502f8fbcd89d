"""``bezier joints``: the joint sequence of an arm for a path."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from bezier.cli.ik import ArmName
from bezier.cli.options import Json, Memory, Out, Timeout
from bezier.curves.scalar import rational
from bezier.motion.timelaw import Law, TimeLaw
from qe.cli.app import check_limits
from qe.cli.shell import limited
from qe.errors import InputError


def joints(
    arm: ArmName,
    path: Annotated[Path, typer.Argument(metavar="PATH.toml", help="[[curve]] tables.", show_default=False)],
    out: Out,
    duration: Annotated[str, typer.Option("--duration", help="Seconds, exactly.")] = "50",
    law: Annotated[Law, typer.Option("--law", help="How the path is run through.")] = Law.QUINTIC,
    samples: Annotated[int, typer.Option("--samples", help="Rows of the sequence.")] = 200,
    json: Json = False,
    timeout: Timeout = None,
    memory: Memory = None,
) -> int:
    """Find the joint sequence of least change, prove joint velocities and accelerations; write data and a moving
    page."""
    from bezier.arm.exact_text import read_exact
    from bezier.arm.reader import load_arm, load_route
    from bezier.planner.outputs import all_or_none

    check_limits(timeout, memory)
    seconds = rational(read_exact(duration))
    if seconds is None or seconds <= 0:
        raise InputError(f"--duration: a rational number above 0 expected, {duration} found")
    model, curves = load_arm(arm), load_route(path)
    with all_or_none(out) as folder:
        from bezier.planner import joints as work

        request = work.Request(
            arm=model,
            curves=curves,
            file=path.name,
            folder=folder,
            target=out,
            law=TimeLaw.of(law),
            duration=seconds,
            samples=samples,
            json=json,
        )
        text, code = limited(partial(work.joints, request=request), timeout=timeout, memory=memory, plain=json)
    print(text)
    return code
