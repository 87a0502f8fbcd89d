"""How far a session is: a bar on a terminal that draws one, plain lines otherwise."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Note = Callable[[str], None]
Advance = Callable[[int], None]


@contextmanager
def progress(what: str, total: int) -> Iterator[tuple[Note, Advance]]:
    """(print a line, count n things as done); the bar goes to the terminal that stdout is, if it is one."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    from qe.cli.shell import is_live

    console = Console(file=sys.stdout, soft_wrap=True, highlight=False, markup=False)
    columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    with Progress(*columns, console=console, disable=not is_live(sys.stdout), transient=True) as display:
        task = display.add_task(what, total=total)
        yield console.print, lambda count: display.advance(task, count)
