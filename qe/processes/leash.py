"""What the processes of a local cluster load before anything else: they end when the process that started them is gone.

That process may be killed at a limit or by Ctrl-C and cannot always end them itself. Dask calls ``dask_setup`` of a
module that it is told to preload; a worker ends with its nanny.
"""

from __future__ import annotations

import os
import threading
import time

import click

LOOK = 0.5
"""Seconds between two looks at the parent."""


@click.command()
@click.argument("parent", type=int)
def dask_setup(server: object, parent: int) -> None:
    """Begin to watch the parent, which started this process and has this number."""
    threading.Thread(target=watch, args=(parent,), name="leash", daemon=True).start()


def watch(parent: int) -> None:
    """End this process, as it is, when its parent is another one: the old one is gone."""
    while os.getppid() == parent:
        time.sleep(LOOK)
    os._exit(1)
