"""Planning with Method 1: problem (4) as printed, what it leaves open, and Method 1* where that matters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

import qe
from bezier.curves.containment import Inside, Leaves, containment, examine_closely
from bezier.curves.curve import Bezier
from bezier.curves.workspace import HalfSpace
from bezier.input.task import Task, Values
from bezier.methods.control.optimal_path import answered, verified
from bezier.methods.single import formula as single_formula
from bezier.methods.single.closed import NoCurve, ProvedCurve, close
from bezier.methods.single.formula import Symbol
from bezier.methods.single.program import Chosen, Dip, choose, curve, dips, lowest
from bezier.paths.path import Path, Proof, assemble, prove
from bezier.plans import Begun, Clock, Outcome, Plan
from bezier.problem import Problem
from qe.errors import InternalError
from qe.formula.syntax import Formula

NAME = "P"
CLOSED = "Method 1*"
SUMS, CLOSED_SUMS = "the sums of (4)", "the sums of Method 1*"
"""What the engine is asked."""
PIECEWISE_DEGREE = 8
"""Up to this degree the plan tells the least sum for every height."""
ELIMINATION_DEGREE = 4
"""Up to this degree t is eliminated exactly where one axis alone is raised."""


@dataclass(frozen=True, slots=True)
class Printed:
    """The curve that (4) as printed gives: ``dips`` below a height in (t_a, t_b), ``leaving`` the workspace."""

    values: Mapping[str, Values]
    curve: Bezier
    dips: tuple[Dip, ...]
    leaving: tuple[Proof, ...]
    lowest: Bezier
    """Of the curves that (4) allows just as well, with the same least sums, the one that is lowest halfway between
    t_a and t_b, ``lower`` its coordinates by axis."""
    lower: Mapping[str, Values]
    allowed: tuple[Dip, ...]
    """Where that one dips."""

    @property
    def holds(self) -> bool:
        """Whether it is above all heights between a and b and in the workspace, for all t."""
        return not self.dips and not self.leaving


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class SinglePlan(Plan):
    """``chosen``: (4) for each raised axis; ``printed``: its curve, None when an axis has no solution.

    ``closed``: what Method 1* found, None when the printed curve holds or (4) has no solution. ``pieces``: the least
    sum with the height as a symbol, by axis. ``attainable``: the sums of Method 1* as a formula in v, by exact
    elimination of t, where that is done. ``above``: the proofs that the path keeps its heights, by axis.
    """

    task: Task
    chosen: tuple[Chosen, ...]
    printed: Printed | None
    closed: ProvedCurve | NoCurve | None
    pieces: Mapping[str, str]
    attainable: str
    above: Mapping[str, Inside]

    @property
    def unit(self) -> str:
        """The unit of the sum."""
        return "mm"

    @property
    def least_sums(self) -> dict[str, Fraction]:
        """The least sum of (4) by axis, where there is one."""
        return {c.axis.name: c.outcome.value for c in self.chosen if c.outcome.optimal}

    @property
    def gap(self) -> Fraction:
        """How much the sum may exceed the least possible one."""
        return self.closed.value - self.closed.bound if isinstance(self.closed, ProvedCurve) else Fraction(0)

    @property
    def not_certified(self) -> tuple[str, ...]:
        """Also how ties were broken, the least sum for every height, and how Method 1* came to its cuts."""
        result = (*super(SinglePlan, self).not_certified, "tie_break", "piecewise")
        return (*result, "closed.rounds", "closed.attainable") if isinstance(self.closed, ProvedCurve) else result


def begin(problem: Problem, clock: Clock) -> Begun:
    """The whole plan: each of its parts decides which path it has."""
    plan = _made(problem, clock)
    return Begun(problem=problem, outcome=plan.outcome, path=plan.path, found=plan, seconds=clock.seconds)


def finish(given: Begun, clock: Clock) -> SinglePlan:
    """The plan with Method 1."""
    plan: SinglePlan = given.found
    return plan


def _made(problem: Problem, clock: Clock) -> SinglePlan:
    """Plan with Method 1, and with Method 1* where the curve of (4) dips or leaves."""
    given = task_of(problem)
    question = single_formula.attainable(given, given.raised[0])
    with clock.step("identities"):
        if not single_formula.identities_hold(given.degree):
            raise InternalError("identity (2) or (3) was refuted")
    with clock.step("elimination"):
        answer = answered(qe.eliminate(question.formula, timeout=clock.remaining()))
    clock.learn(f"attainable sums of {given.raised[0].name}", str(answer.formula))
    with clock.step("linear problem (4)"):
        chosen = tuple(choose(given, axis) for axis in given.raised)
        printed = _printed(problem, given, chosen)
    clock.learn("curve of (4)", "holds" if printed and printed.holds else "does not hold" if printed else "none")
    with clock.step(CLOSED):
        needed = printed is not None and not printed.holds
        closed = close(given, problem.workspace, check=clock.remaining) if needed else None
        attainable = None
        if needed and _is_eliminated(given):
            sums = single_formula.closed(given, problem.workspace).formula
            attainable = single_formula.answered(sums, clock.remaining())
    with clock.step("curves and proofs"):
        fields = known(problem, chosen, printed, closed)
    return SinglePlan(
        **verified(fields, labelled(fields), clock),
        answer=answer,
        pieces=Pieces(given),
        attainable="" if attainable is None else str(attainable.formula),
        eliminations={
            SUMS: answer,
            **single_formula.proved_identities(given.degree),
            **({} if attainable is None else {CLOSED_SUMS: attainable}),
        },
    )


def known(
    problem: Problem, chosen: tuple[Chosen, ...], printed: Printed | None, closed: ProvedCurve | NoCurve | None
) -> dict[str, Any]:
    """The fields of the plan that follow from the answers to the linear programs: the path, what is proved of it."""
    given, values = task_of(problem), closed.values if isinstance(closed, ProvedCurve) else None
    if printed is not None and printed.holds:
        values = dict(printed.values)
    path = None if values is None else path_of(problem, given, values)
    return {
        "problem": problem,
        "outcome": Outcome.SOLVED if path else Outcome.INFEASIBLE,
        "formula": str(single_formula.attainable(given, given.raised[0])),
        "objective": None if values is None else sum_of(given, values),
        "path": path,
        "active": () if values is None else active(given, values),
        "task": given,
        "chosen": chosen,
        "printed": printed,
        "closed": closed,
        "above": {} if path is None else heights_proved(given, path.curves[NAME]),
    }


def questions(problem: Problem) -> dict[str, Formula]:
    """What may be asked of the engine about a problem."""
    given = task_of(problem)
    statements = {SUMS: single_formula.attainable(given, given.raised[0]), **single_formula.identities(given.degree)}
    if _is_eliminated(given):
        statements[CLOSED_SUMS] = single_formula.closed(given, problem.workspace)
    return {name: statement.formula for name, statement in statements.items()}


def task_of(problem: Problem) -> Task:
    """The task of a problem with this method."""
    if problem.single is None:
        raise InternalError("a problem of Method 1 without its task")
    return problem.single.task


@dataclass(frozen=True, slots=True)
class Pieces(Mapping[str, str]):
    """The least sum for every height as a formula, by axis; eliminated when asked for: the path does not need it."""

    task: Task

    def __getitem__(self, name: str) -> str:
        return _least_sums(self.task)[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_least_sums(self.task))

    def __len__(self) -> int:
        return len(self.task.raised) if self.task.degree <= PIECEWISE_DEGREE else 0


@lru_cache(maxsize=8)
def _least_sums(given: Task) -> dict[str, str]:
    if given.degree > PIECEWISE_DEGREE:
        return {}
    return {axis.name: str(single_formula.eliminate(given, axis, {Symbol.HEIGHT}).least) for axis in given.raised}


def _is_eliminated(given: Task) -> bool:
    """Whether t is eliminated from Method 1*."""
    return len(given.raised) == 1 and given.degree <= ELIMINATION_DEGREE


def _printed(problem: Problem, given: Task, chosen: tuple[Chosen, ...]) -> Printed | None:
    """The curve that (4) gives, and the lowest one of those that it allows as well; None without solutions."""
    if not all(item.outcome.optimal for item in chosen):
        return None
    halfway = sum(given.times, Fraction(0)) / 2
    lower = {axis.name: row for axis in given.raised if (row := lowest(given, axis, halfway)) is not None}
    return printed_of(problem, given, chosen, lower)


def printed_of(
    problem: Problem, given: Task, chosen: tuple[Chosen, ...], lower: Mapping[str, Values]
) -> Printed | None:
    """What is found out about the curve of (4) and about another one, ``lower``, with the same least sums."""
    values = {item.axis.name: item.values for item in chosen if item.values is not None}
    if len(values) < len(chosen):
        return None
    drawn = curve(given, values)
    proofs = prove({NAME: drawn}, problem.workspace.conditions)
    leaving = tuple(proof for proof in proofs if isinstance(proof.outcome, Leaves))
    other = curve(given, lower)
    return Printed(values, drawn, dips(given, drawn), leaving, other, lower, dips(given, other))


def path_of(problem: Problem, given: Task, values: Mapping[str, Values]) -> Path:
    """The path of one curve with its proofs."""
    drawn = curve(given, values)
    points = {f"{NAME}{i}": point for i, point in enumerate(drawn.points)}
    return assemble({NAME: drawn}, points, problem.workspace)


def heights_proved(given: Task, drawn: Bezier) -> dict[str, Inside]:
    """The proofs that the curve is not below the heights for t in [t_a, t_b], by axis, for that part of the curve."""
    result = {}
    part = drawn.segment(*given.times)
    for axis in given.raised:
        normal = tuple(Fraction(int(name == axis.name)) for name in "xyz")
        outcome = examine_closely(part, HalfSpace(normal, -Fraction(axis.height or 0), f"{axis.name} >= h"))
        if not isinstance(outcome, Inside):
            raise InternalError(f"the chosen curve dips below the height of {axis.name}")
        result[axis.name] = outcome
    return result


def sum_of(given: Task, values: Mapping[str, Values]) -> Fraction:
    """The sum of (4) over all raised axes."""
    return sum((values[axis.name][i] for axis in given.raised for i in given.middle), Fraction(0))


def active(given: Task, values: Mapping[str, Values]) -> tuple[str, ...]:
    """The lower bounds of (4) that hold with equality: ``P3.y``."""
    return tuple(
        f"{NAME}{i}.{axis.name}"
        for axis in given.raised
        for i in range(1, given.degree)
        if values[axis.name][i] == given.lower_bound(axis, i)
    )


def of_axis(name: str) -> str:
    """The label of the certificate of (4) for an axis."""
    return f"problem (4) for {name}"


def above_label(name: str) -> str:
    """The label of the certificate that the path keeps the height of an axis."""
    return f"{NAME} for t_a <= t <= t_b in {name} >= h"


def lowest_label(name: str) -> str:
    """The label of the certificate that another curve has the same least sum of (4) on an axis."""
    return f"{of_axis(name)}, another curve"


def labelled(fields: Mapping[str, Any]) -> list[tuple[str, qe.Certificate]]:
    """(4) solved or contradicted on each axis, the other curve that it allows, the bound or the contradiction of
    Method 1*, and the heights of the path; ``fields``: what is ``known``."""
    given, chosen, printed, closed, path, above = map(
        fields.__getitem__, ("task", "chosen", "printed", "closed", "path", "above")
    )
    result = [(of_axis(item.axis.name), item.outcome.certificate) for item in chosen]
    for item in chosen if printed is not None else ():
        if printed is not None and item.outcome.optimal:
            other = replace(item.outcome, point=printed.lower[item.axis.name][1:-1])
            result.append((lowest_label(item.axis.name), other.certificate))
    if closed is not None:
        result.append((CLOSED, closed.certificate))
    if path is not None:
        part = path.curves[NAME].segment(*given.times)
        for name, inside in above.items():
            proved = containment(part, inside)
            if proved is not None:
                result.append((above_label(name), proved))
    return result
