"""The least value as a function of parameters: piecewise, over cylindrical cells of parameter space."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import groupby

from qe.cad.decompose import decompose
from qe.cells.pieces import Range, RootFunction, merge
from qe.exact.ring import Poly
from qe.formula.syntax import Formula
from qe.optimization.values import Goal
from qe.options import Budget
from qe.proof.answer import Answer, Guarantee
from qe.proof.certificate import Certificate


@dataclass(frozen=True, slots=True, repr=False)
class Case:
    """Where the parameters lie in ``ranges``, the optimum is ``value`` (None: unbounded), taken or only approached.

    ``value`` is a root function of the parameters: the k-th root of a polynomial in them and in the value.
    """

    ranges: tuple[Range, ...]
    value: RootFunction | None
    attained: bool

    def __repr__(self) -> str:
        return f"<{self}>"

    def __str__(self) -> str:
        where = ", ".join(str(r) for r in self.ranges)
        what = "unbounded" if self.value is None else f"{self.value}{'' if self.attained else ' (not attained)'}"
        return f"{what} if {where}" if where else what


@dataclass(frozen=True, slots=True, repr=False)
class ParametricOptimum:
    """The minimum or maximum as a function of the parameters: ``cases`` with disjoint conditions.

    Where no case applies, no point meets the constraints. ``values``: the values that are taken, a formula of
    ``variable`` and the parameters. ``certificate``: of the elimination and of the cells; None where it had none.
    ``answer``: how the values were found. ``guarantee``, ``reason``: with ``check``, as in ``GlobalOptimum``.
    """

    cases: tuple[Case, ...]
    parameters: tuple[str, ...]
    values: Formula
    variable: str
    answer: Answer = field(repr=False)
    certificate: Certificate | None = None
    guarantee: Guarantee = Guarantee.DERIVED
    reason: str = ""

    def __iter__(self) -> Iterator[Case]:
        return iter(self.cases)

    def __repr__(self) -> str:
        count = len(self.cases)
        return f"ParametricOptimum({', '.join(self.parameters)}: {count} case{'s' if count != 1 else ''})"

    def __str__(self) -> str:
        return "\n".join(map(str, self.cases)) or "no point meets the constraints"


def optimum_of(
    sign: int,
    objective: Poly,
    constraints: Formula,
    parameters: tuple[str, ...],
    *,
    scale: Fraction | int = 1,
    budget: Budget | None = None,
    check: bool = False,
) -> ParametricOptimum:
    """The minimum (``sign`` 1) or maximum (-1) for all values of the parameters at once.

    Raises ``Unable`` (``BudgetExceeded`` at a limit) where elimination does.
    """
    limits = budget or Budget()
    goal = Goal.of(objective, Fraction(scale), constraints, parameters)
    taken, answer = goal.values(limits, check=check)
    order = (*goal.parameters, goal.value)
    table = decompose(taken, order, ("",) * len(order), budget=limits).table
    cases = []
    for ranges, stack in groupby(merge(table, budget=limits), key=lambda piece: piece.ranges[:-1]):
        values = [piece.ranges[-1] for piece in stack]
        end = values[0] if sign > 0 else values[-1]
        found, closed = (end.lower, end.lower_closed) if sign > 0 else (end.upper, end.upper_closed)
        cases.append(Case(ranges, found, found is not None and closed))
    proof = answer.certificate
    members = [] if proof is None else [("values", proof), ("cases", Certificate.cells(table))]
    certificate = Certificate.bundle(members) if members else None
    return ParametricOptimum(tuple(cases), goal.parameters, taken, goal.value, answer, certificate)
