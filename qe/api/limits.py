"""The limits that callers of public functions set, and work under them."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from typing import TypeVar

from qe import arguments
from qe.api.input import AnyFormula, read_formula
from qe.errors import InputError
from qe.formula.syntax import Formula
from qe.formula.weight import may_block, text_may_block
from qe.io.sharing import refuse_shared
from qe.options import Cluster
from qe.processes.execution import Budgets, Limits, perform
from qe.progress import Event

Result = TypeVar("Result")
Progress = Callable[[Event], None]
Reader = Callable[[AnyFormula, str, bool], Formula]

MOST_WORKERS = 256
"""Processes that one call starts at most."""

_ADDRESS = re.compile(r"(?:[a-z]+://)?[^\s:/]+:[0-9]{1,5}")

MOSTLY_NEEDED = ("qe.engine.run", "qe.rules.block", "qe.elimination.vs.block", "qe.elimination.vs.witness")
"""The parts of the engine that nearly every problem with a quantifier needs."""


def performed(work: Callable[[Budgets], Result], formula: Formula, limits: Limits, *, at_once: bool = False) -> Result:
    """The work on a formula, in a process of its own from the start (``at_once``) also where a limit must hold."""
    at_once = at_once or limits.timeout is not None or may_block(formula)
    if at_once:
        for part in MOSTLY_NEEDED:  # loaded here once, and not again and again in every worker
            import_module(part)
    return perform(work, limits, at_once=at_once)


def limits_of(timeout: float | None, memory: int | None, progress: Progress, process: bool) -> Limits:
    """The limits that a caller sets, checked."""
    return Limits(
        arguments.seconds(timeout),
        arguments.mebibytes(memory),
        arguments.listener(progress),
        arguments.flag(process, "process"),
    )


def cluster_of(workers: int, address: str | None) -> Cluster | None:
    """The cluster that a caller names, checked; None where there is none."""
    count = arguments.whole(workers, "workers", MOST_WORKERS)
    if address is not None and count:
        raise InputError("workers, cluster: one of them expected, both found")
    if address is None and not count:
        return None
    if address is not None and not _ADDRESS.fullmatch(arguments.text(address, "cluster")):
        raise arguments.wrong("cluster", "an address such as tcp://host:8786", address)
    return Cluster(count, address)


def reading(
    formula: AnyFormula, format: str, limits: Limits, total_division: bool = False, *, reader: Reader = read_formula
) -> Formula:
    """The formula, read under the limits where reading may take long. Raises ``BudgetExceeded`` at one, ``Unable`` for
    a formula whose parts are shared so much that no method, all of which write it out, comes to an end."""
    total = arguments.flag(total_division, "total_division")
    limited = limits.timeout is not None or limits.memory is not None
    if isinstance(formula, str) and (text_may_block(formula) or (limited and "let" in formula)):
        found = perform(lambda budgets: reader(formula, format, total), limits, at_once=True)
    else:
        found = reader(formula, format, total)
    refuse_shared(found)
    return found
