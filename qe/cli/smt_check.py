"""Whether the assertions of an SMT-LIB script can hold together."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from copy import copy
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from qe.errors import BudgetExceeded, Unable
from qe.io import surface as s
from qe.io.smtlib_parser import Expression
from qe.io.smtlib_script import Script
from qe.options import Budget

if TYPE_CHECKING:
    from qe.cli.smt_values import Number
    from qe.formula.syntax import Formula
    from qe.io.total import Total
    from qe.proof.answer import Answer

MOST_PARTS = 300
"""Parts of a script up to which it is read in this process where no limit must hold."""

Closing: TypeAlias = "Callable[[Iterable[str], Formula], Formula]"
"""Makes a sentence of a formula with these free variables."""


class Result(NamedTuple):
    """The answer of a check: ``reason`` for unknown, ``point`` (by name in formulas) and ``total`` for sat,
    with what ``get-objectives`` says."""

    answer: str
    reason: str = ""
    point: dict[str, Number] | None = None
    total: Total | None = None
    asked: tuple[Expression, ...] = ()
    best: tuple[str, ...] = ()


class Checks:
    """Checks of a script under limits: ``timeout`` seconds for the whole run, or (``each``) for every check."""

    script: Script

    def __init__(self, timeout: float | None, memory: int | None, each: bool) -> None:
        self.timeout, self.memory = timeout, memory
        self.until = None if timeout is None or each else time.monotonic() + timeout
        self.begun = time.monotonic()

    def begin(self) -> None:
        """A command is read from now on."""
        self.begun = time.monotonic()

    @property
    def late(self) -> bool:
        """Whether the time for the whole run is over."""
        return self.until is not None and time.monotonic() > self.until

    def tick(self) -> None:
        """Called while a command is read. Raises ``BudgetExceeded`` where that takes longer than a check may."""
        if self.late or (self.timeout is not None and time.monotonic() > self.begun + self.timeout):
            raise BudgetExceeded("time limit reached while reading")

    def left(self) -> float | None:
        """Seconds that a check may still take."""
        return self.timeout if self.until is None else self.until - time.monotonic()

    def solved(self, nodes: Sequence[s.Node]) -> Result:
        """Whether the nodes can hold together.

        What was not read may have any value: without a solution for any of them there is none, and where there
        is one for each of them, there is one, which is not known. Nothing is loaded for what holds everywhere.
        """
        if not self.late and all(node == s.Truth(True) for node in nodes):
            return Result("sat", point={})
        from qe.formula.build import exists

        result = self.completed(nodes, exists)
        if result.answer != "sat" or not (self.script.fixed or self.script.varying):
            return result
        result = self.completed(nodes, partial(_whatever, sorted(self.script.fixed), sorted(self.script.varying)))
        if result.answer == "sat":
            return result._replace(point=None)
        return Result("unknown", result.reason or "(an assertion was not understood)")

    def completed(self, nodes: Sequence[s.Node], close: Closing) -> Result:
        """The answer for the functions that are not defined everywhere made total."""
        from qe.io.total import Fill, Total

        result = self.attempt(nodes, Total(fill=Fill.ANY), close)
        if result.answer == "sat" and result.total is not None and result.total.weakened:
            for fill in (Fill.CONSTANT, Fill.ARGUMENT):
                other = self.attempt(nodes, Total(fill=fill), close)
                if other.answer == "sat":
                    return other
            return Result("unknown", "incomplete")
        if result.answer == "unsat" and result.total is not None and result.total.unclear:
            return Result("unknown", "incomplete")
        return result

    def attempt(self, nodes: Sequence[s.Node], total: Total, close: Closing) -> Result:
        from qe.formula.build import exists
        from qe.processes.execution import perform
        from qe.processes.limits import Limits

        left = self.left()
        if left is not None and left <= 0:
            return Result("unknown", "timeout")
        limits = Limits(left, self.memory)
        try:
            if self.is_short(nodes, left):
                formula = self.script.formula_of(nodes, total)
                if close is exists and (point := _simple_point(formula)) is not None:
                    return Result("sat", point=point, total=total)
                from qe.api.eliminate import unproved
                from qe.api.limits import performed

                sentence = close(formula.free, formula)
                return _result(performed(partial(unproved, sentence), sentence, limits), formula, total)
            return perform(partial(_attempted, self.sent(), nodes, total, close), limits, at_once=True)
        except Unable as error:
            return Result("unknown", _reason(str(error)))

    def formula(self, nodes: Sequence[s.Node], total: Total, seconds: float | None) -> tuple[Formula, Total]:
        """What the nodes mean together; in a process of its own, which a limit ends, if there is one."""
        from qe.processes.execution import perform
        from qe.processes.limits import Limits

        if self.is_short(nodes, seconds):
            return self.script.formula_of(nodes, total), total
        return perform(partial(_formula, self.sent(), nodes, total), Limits(seconds, self.memory), at_once=True)

    def is_short(self, nodes: Sequence[s.Node], seconds: float | None) -> bool:
        """Whether nodes are read in this process."""
        return seconds is None and self.memory is None and len(self.script.used(nodes)) <= MOST_PARTS

    def sent(self) -> Script:
        """The script as another process has it: what nodes mean, and nothing of how they were read."""
        script = copy(self.script)
        del script.tick  # what watches here holds the streams of this process
        script.assertions, script.objectives, script.levels = [], [], []
        script.globals, script.forms, script.expanded = {}, {}, {}
        return script


def _simple_point(formula: Formula) -> dict[str, Number] | None:
    """Values that are all 0, 1, 2 or -1 and satisfy a formula: they need no engine, which takes longer to load."""
    from qe.formula.evaluate import holds_at

    points = [dict.fromkeys(formula.free, Fraction(value)) for value in (0, 1, 2, -1)]
    found = (point for point in points if formula.is_quantifier_free and holds_at(formula, point))
    return next(found, None)


def _formula(script: Script, nodes: Sequence[s.Node], total: Total, budget: Budget) -> tuple[Formula, Total]:
    script.tick = budget.check
    return script.formula_of(nodes, total), total


def _attempted(script: Script, nodes: Sequence[s.Node], total: Total, close: Closing, budget: Budget) -> Result:
    from qe.api.eliminate import unproved

    formula, total = _formula(script, nodes, total, budget)
    return _result(unproved(close(formula.free, formula), budget), formula, total)


def _whatever(fixed: Sequence[str], varying: Sequence[str], names: Iterable[str], formula: Formula) -> Formula:
    """Whether there is a solution whatever the values are that were not read."""
    from qe.formula.build import exists, forall

    values = [name for name in names if name not in fixed and name not in varying]
    return forall(fixed, exists(values, forall(varying, formula)))


def _result(answer: Answer, formula: Formula, total: Total) -> Result:
    if answer.truth is None:
        return Result("unknown", _reason(answer.reason))
    if not answer.truth:
        return Result("unsat", total=total)
    point = dict(answer.witness) if answer.witness is not None else ({} if not formula.free else None)
    return Result("sat", point=point, total=total)


def _reason(text: str) -> str:
    """Why there is no answer, in the words of SMT-LIB."""
    return "memout" if "memory" in text else "timeout" if "time limit" in text else "incomplete"
