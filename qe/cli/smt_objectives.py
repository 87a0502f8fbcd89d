"""``minimize`` and ``maximize`` in SMT-LIB scripts: in their order, each where those before it are optimal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import qe.api.optimum as api
from qe.cli.smt_check import Result
from qe.cli.smt_values import Number, written
from qe.errors import Unable
from qe.exact.field import FieldElement
from qe.exact.number import simplest
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, exists
from qe.formula.syntax import Formula, Relation
from qe.io import surface as s
from qe.io.smtlib_parser import show
from qe.io.smtlib_script import Objective, Script
from qe.io.total import Fill, Total
from qe.optimization.global_optimum import number_conditions
from qe.proof.multipliers import OptimumStatus

VALUE = "objective value"
"""The name of the term that is optimised, which no symbol of a script has."""


def optimised(
    script: Script, result: Result, nodes: Iterable[s.Node], limit: float | None, memory: int | None
) -> Result:
    """The result of a check that was sat with the optima, and with a point that has them where one does."""
    try:
        lines, point = _best(script, list(nodes), limit, memory)
    except Unable as error:
        return Result("unknown", f"(no optimum: {error})")
    return result._replace(best=lines, point=point or result.point)


def _best(
    script: Script, nodes: Sequence[s.Node], limit: float | None, memory: int | None
) -> tuple[tuple[str, ...], dict[str, Number] | None]:
    """The optima as ``get-objectives`` writes them; the point, where all are taken."""
    lines, point, fixed = list[str](), dict[str, Number](), list[tuple[s.Node, Number]]()
    for objective in script.objectives:
        formula = _formula(script, objective, nodes, fixed)
        solve = api.minimize if objective.least else api.maximize
        optimum = solve(f"`{VALUE}`", formula, timeout=limit, memory=memory)
        if optimum.status is OptimumStatus.UNBOUNDED:
            value = "(* (- 1) oo)" if objective.least else "oo"
        elif optimum.value is None:
            raise Unable("an objective has no optimum")
        else:
            number = _plain(optimum.value)
            value = written(number)
            if optimum.attained is False:
                value = f"(+ {value} {'epsilon' if objective.least else '(* (- 1) epsilon)'})"
        lines.append(f"({show(objective.written)} {value})")
        if optimum.attained is not True or optimum.value is None:
            return (*lines, *(f"({show(o.written)})" for o in script.objectives[len(lines) :])), None
        point = {name: _plain(given) for name, given in optimum.point.items() if name != VALUE}
        fixed.append((_graph(objective, f"{VALUE} {len(fixed)}"), number))
    return tuple(lines), point


def _plain(number: Number) -> Number:
    """A number as ``qe.cli.smt_values`` takes it."""
    return simplest(number.to_algebraic() if isinstance(number, FieldElement) else number)


def _graph(objective: Objective, name: str) -> s.Node:
    return s.Comparison([s.Name(name, -1), objective.term], [Relation.EQ], -1)


def _formula(
    script: Script, objective: Objective, nodes: Sequence[s.Node], fixed: Sequence[tuple[s.Node, Number]]
) -> Formula:
    """The assertions with the value of the term by name, where the terms before it have their values."""
    names = [VALUE, *(f"{VALUE} {k}" for k in range(len(fixed)))]
    total = Total(fill=Fill.ANY)
    whole = [*nodes, _graph(objective, VALUE), *(node for node, _ in fixed)]
    formula = total.checked(script.lowered(whole, total, [*script.names, *names], script.shared))
    ring = formula.ring or Ring.of(names)
    conditions = [c for k, (_, value) in enumerate(fixed) for c in number_conditions(ring, names[k + 1], value)]
    return exists(names[1:], conj((formula, *(convert(c, ring) for c in conditions))))
