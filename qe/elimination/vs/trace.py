"""How virtual substitution found an answer: what every subproblem was replaced by, and why. Plain data."""

from __future__ import annotations

from dataclasses import dataclass

from qe.elimination.vs.plan import Plan
from qe.elimination.vs.points import SymbolicPoint
from qe.exact.number import Number
from qe.formula.build import conj, disj
from qe.formula.syntax import TRUE, And, Atom, Formula, Or


@dataclass(frozen=True, slots=True)
class Unchanged:
    """The subproblem stays as it is (its variables do not occur any more, or have too high a degree)."""


@dataclass(frozen=True, slots=True)
class Decided:
    """A formula in one variable alone: a solution, or None if there is none."""

    solution: Number | None


@dataclass(frozen=True, slots=True)
class Alternatives:
    """A disjunction, solved disjunct by disjunct as far as needed."""

    disjuncts: tuple[Formula, ...]
    parts: Traces


@dataclass(frozen=True, slots=True)
class Split:
    """A product that is zero: ``cases``, each simplified and solved as far as needed."""

    cases: tuple[Formula, ...]
    simple: tuple[Formula, ...]
    parts: Traces


@dataclass(frozen=True, slots=True)
class Part:
    """``body``, solved together with its context: the answer before the context was taken out of it."""

    body: Formula
    answer: Formula
    trace: Trace


@dataclass(frozen=True, slots=True)
class Apart:
    """A conjunction of ``context``, without the variables, and parts without common ones, as far as needed."""

    context: tuple[Formula, ...]
    parts: tuple[Part, ...]


@dataclass(frozen=True, slots=True)
class Attempt:
    """``formula`` was tried at ``point`` (None: left as it is); ``result`` came of it, ``simple`` of that."""

    point: SymbolicPoint | None
    guard: Formula
    formula: Formula
    settled: frozenset[Atom]
    result: Formula
    simple: Formula


@dataclass(frozen=True, slots=True)
class Substituted:
    """The points of a plan for ``formula``, tried as far as needed, and how what they gave was solved."""

    plan: Plan
    formula: Formula
    block: frozenset[int]
    attempts: tuple[Attempt, ...]
    parts: Traces


Trace = Unchanged | Decided | Alternatives | Split | Apart | Substituted
Traces = tuple[tuple[Formula, Trace], ...]
"""The answers of alternatives, and how they were found."""


@dataclass(frozen=True, slots=True)
class Eliminated:
    """The simplified matrix of a block, and the answer before it was simplified."""

    matrix: Formula
    answer: Formula
    trace: Trace


def shifts_degrees(trace: Trace) -> bool:
    """Whether points were looked for in place of a power of a variable."""
    match trace:
        case Substituted(plan=plan, parts=parts):
            return plan.exponent > 1 or any(shifts_degrees(inner) for _, inner in parts)
        case Alternatives(parts=parts) | Split(parts=parts):
            return any(shifts_degrees(inner) for _, inner in parts)
        case Apart(parts=listed):
            return any(shifts_degrees(part.trace) for part in listed)
    return False


def without(formula: Formula, context: tuple[Formula, ...]) -> Formula:
    """The formula with TRUE for every occurrence of a context member (under And and Or, so this is sound)."""
    if not context:
        return formula
    if formula in context:
        return TRUE
    if isinstance(formula, And):
        return conj(without(a, context) for a in formula.args)
    if isinstance(formula, Or):
        return disj(without(a, context) for a in formula.args)
    return formula
