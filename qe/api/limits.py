"""The limits that callers of public functions set, and work under them."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import TypeVar

from qe.api.input import AnyFormula, note_doubts, read_formula
from qe.api.settings import Limited
from qe.formula.syntax import Formula
from qe.formula.weight import may_block, text_may_block
from qe.io.sharing import refuse_shared
from qe.options import Budget
from qe.processes.execution import Work, perform
from qe.processes.limits import Limits

Result = TypeVar("Result")
Reader = Callable[[AnyFormula, str, bool], Formula]

LIMITED_POWER = 12
"""The greatest exponent in what is read here although a limit is to hold: higher powers of sums are long."""

MOSTLY_NEEDED = ("qe.engine.run", "qe.rules.block", "qe.elimination.vs.block", "qe.elimination.vs.witness")
"""The parts of the engine that nearly every problem with a quantifier needs."""


def performed(work: Work[Result], formula: Formula, limits: Limits, *, at_once: bool = False) -> Result:
    """The work on a formula, in another process from the start (``at_once``) also where a limit must hold."""
    at_once = at_once or limits.timeout is not None or may_block(formula)
    if at_once:
        for part in MOSTLY_NEEDED:  # what is loaded here is loaded by workers before their time begins to run
            import_module(part)
    return perform(work, limits, at_once=at_once)


def limits_of(settings: Limited) -> Limits:
    """The limits that a caller sets, of a call that begins now."""
    return Limits(
        settings["timeout"], settings["memory"], settings["progress"], settings["process"], start=time.monotonic()
    )


def reading(
    formula: AnyFormula,
    format: str,
    limits: Limits,
    total_division: bool = False,
    *,
    reader: Reader = read_formula,
    solved: Sequence[str] = (),
) -> Formula:
    """The formula, to be ``solved`` for these, read under the limits where reading may take long.

    Raises ``BudgetExceeded`` at one, ``Unable`` for a formula whose parts are shared so much that no method, all of
    which write it out, comes to an end.
    """
    result = read_under(limits, partial(reader, formula, format, total_division), formula)
    refuse_shared(result)
    note_doubts(formula, result, format, solved)
    return result


def read_under(limits: Limits, read: Callable[[], Result], *given: object) -> Result:
    """What ``read``, which can be pickled, makes of what was given, under the limits where that may take long."""
    limited = limits.timeout is not None or limits.memory is not None
    if any(_may_take_long(part, limited) for part in given):
        return perform(partial(_unbudgeted, read), limits, at_once=True)
    return read()


def _unbudgeted(read: Callable[[], Result], budget: Budget) -> Result:
    return read()


def _may_take_long(given: object, limited: bool) -> bool:
    if isinstance(given, str):
        if limited:
            return text_may_block(given, LIMITED_POWER) or "let" in given
        return text_may_block(given)
    if isinstance(given, list | tuple | Mapping):
        return any(_may_take_long(part, limited) for part in (given.values() if isinstance(given, Mapping) else given))
    if not limited or not hasattr(given, "free_symbols"):  # SymPy's objects have these
        return False
    try:
        return text_may_block(str(given), LIMITED_POWER)
    except ValueError:  # a number that Python does not write
        return True
