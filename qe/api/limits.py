"""The limits that callers of public functions set, and work under them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import Any, TypeVar

from qe.api.input import AnyFormula, Read, note_doubts, of_one_problem, read_assumptions, read_posed, warned
from qe.api.settings import Limited
from qe.errors import InputError
from qe.formula.assumed import Posed
from qe.formula.build import conj
from qe.formula.features import may_block, text_may_block
from qe.formula.numbers import bounds_of_numbers
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import bound_variables, conjuncts
from qe.io.formats import Format
from qe.io.names import refuse_numbers
from qe.io.sharing import refuse_shared
from qe.io.substitution import over_one_ring
from qe.options import Budget, Options
from qe.processes.execution import Work, perform
from qe.processes.limits import Limits

Result = TypeVar("Result")
Reader = Callable[[AnyFormula, str, bool], Read]

LIMITED_POWER = 12
"""The greatest exponent in what is read here although a limit is to hold: higher powers of sums are long."""

MOSTLY_NEEDED = ("qe.engine.run", "qe.rules.block", "qe.elimination.vs.block")
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


def posed(
    formula: AnyFormula,
    settings: Mapping[str, Any],
    limits: Limits,
    *,
    reader: Reader = read_posed,
    solved: Sequence[str] = (),
    numbers: bool = False,
) -> Posed:
    """The formula, to be ``solved`` for these, and what is assumed, read under the limits where that may take long.

    ``numbers``: whether numbers that are not algebraic (``qe.formula.numbers``) may occur. Raises ``BudgetExceeded``,
    ``InputError`` for what cannot be assumed, ``Unable`` where shared parts, written out, are much too long. Warns of
    assumptions that contradict each other or are about something else.
    """
    format, division = settings.get("format", "text"), settings.get("total_division", False)
    assuming = settings.get("assuming")
    if format in ("text", Format.TEXT):
        formula, assuming = of_one_problem(formula, assuming, listed=(*solved, *(settings.get("order") or ())))
    result, inner = read_under(limits, partial(reader, formula, format, division), formula)
    refuse_shared(result)
    note_doubts(formula, result, format, solved)
    return under(result, inner, assuming, limits, numbers=numbers)


def under(
    formula: Formula,
    inner: Formula,
    assuming: AnyFormula,
    limits: Limits,
    others: Iterable[str] = (),
    *,
    numbers: bool = False,
) -> Posed:
    """A formula that was read, under what it assumes itself, what the caller does, and what is known of ``numbers``;
    ``others``: names of what else is in question."""
    outer = TRUE if assuming is None else read_under(limits, partial(read_assumptions, assuming), assuming)
    bounds = bounds_of_numbers(formula, inner, outer)
    if inner == outer == bounds == TRUE:
        return Posed(formula)
    if not numbers:
        refuse_numbers(bounds.free)
    refuse_shared(outer)
    note_doubts(assuming, outer)
    formula, *known, bounds = over_one_ring(formula, inner, outer, bounds)
    if conj(known) == TRUE:
        return Posed(formula, bounds)
    both, bound = conj((*known, bounds)), {*bound_variables(formula)} - {*formula.free}
    if hidden := [name for name in both.free if name in bound]:
        raise InputError(f"assuming: free variables expected, {', '.join(hidden)} is bound in the formula")
    seen = {*formula.free, *others}
    idle = [part for part in conjuncts(outer) if part.free and not seen & {*part.free}]
    from qe.engine.assuming import can_hold

    if both == FALSE or not performed(partial(can_hold, both, Options()), both, limits):
        warned(["assuming: nothing meets these conditions, so every answer is right"])
    elif idle:
        warned([f"assuming: {part} says nothing of the free variables of the formula" for part in idle])
    return Posed(formula, both)


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
