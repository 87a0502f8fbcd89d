"""``minimize`` and ``maximize`` in SMT-LIB scripts: in their order, each where those before it are optimal, or with
the option ``:opt.priority box`` each by itself."""

from __future__ import annotations

from collections.abc import Iterable

from qe.api import solver
from qe.api.solver import Objective
from qe.cli.smt_check import Result
from qe.cli.smt_values import Number, written
from qe.errors import Unable
from qe.exact.field import FieldElement
from qe.exact.number import simplest
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.smtlib_parser import show
from qe.io.smtlib_script import Script
from qe.io.total import Fill, Total
from qe.proof.multipliers import OptimumStatus

VALUE = "objective value"
"""The beginning of the names of the terms that are optimised, which no symbol of a script has."""


def optimised(
    script: Script, result: Result, nodes: Iterable[s.Node], limit: float | None, memory: int | None, *, box: bool
) -> Result:
    """The result of a check that was sat with the optima, and with a point that has them where one does."""
    named = list(enumerate(script.objectives))
    names = [f"{VALUE} {k}" for k, _ in named]
    graphs = [s.Comparison([s.Name(names[k], -1), one.term], [Relation.EQ], -1) for k, one in named]
    total = Total(fill=Fill.ANY)
    whole = total.checked(script.lowered([*nodes, *graphs], total, [*script.names, *names], script.shared))
    goals = [Objective(f"`{names[k]}`", one.least) for k, one in named]
    try:
        point = solver.optimised(goals, whole, {"timeout": limit, "memory": memory}, box=box)
        lines = tuple(f"({show(one.written)}{_value(goals[k])})" for k, one in named)
    except Unable as error:
        return Result("unknown", f"(no optimum: {error})")
    taken = {name: _plain(value) for name, value in point.items() if name not in names}
    return result._replace(best=lines, point=taken or result.point)


def _value(goal: Objective) -> str:
    """The optimum as ``get-objectives`` writes it, behind a space; nothing where it was not looked for."""
    best = goal.optimum
    if best is None:
        return ""
    if best.status is OptimumStatus.UNBOUNDED:
        return " (* (- 1) oo)" if goal.least else " oo"
    if best.value is None:
        raise Unable("an objective has no optimum")
    value = written(_plain(best.value))
    return f" {value}" if best.attained else f" (+ {value} {'epsilon' if goal.least else '(* (- 1) epsilon)'})"


def _plain(number: Number) -> Number:
    """A number as ``qe.cli.smt_values`` takes it."""
    return simplest(number.to_algebraic() if isinstance(number, FieldElement) else number)
