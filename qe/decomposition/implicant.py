"""The truth of a formula of which some atoms are decided, and which of these decide it."""

from __future__ import annotations

from collections.abc import Mapping

from qe.errors import InternalError
from qe.formula.syntax import And, Atom, Constant, Formula, Or
from qe.truth import Truth, conjunction, disjunction

Decided = Mapping[Atom, bool]


def value(formula: Formula, decided: Decided) -> Truth:
    """The truth of a formula in negation normal form by the atoms decided so far; None while it is open."""
    match formula:
        case Constant(truth):
            return truth
        case Atom():
            return decided.get(formula)
        case And(args):
            return conjunction(value(a, decided) for a in args)
        case Or(args):
            return disjunction(value(a, decided) for a in args)
    raise InternalError(f"not in negation normal form: {type(formula).__name__}")


def decided_by(formula: Formula, decided: Decided, truth: bool) -> frozenset[Atom]:
    """Few atoms, all of this truth value, that give it to a formula that has it: an implicant of it or its negation.

    Of a conjunction that is false one false member is enough, and that of lowest level and degree is taken; dually of a
    disjunction that is true.
    """
    match formula:
        case Constant():
            return frozenset()
        case Atom():
            return frozenset((formula,))
        case And(args) | Or(args) if isinstance(formula, And) is truth:
            return frozenset[Atom]().union(*(decided_by(a, decided, truth) for a in args))
        case And(args) | Or(args):
            enough = (decided_by(a, decided, truth) for a in args if value(a, decided) is truth)
            return min(enough, key=_weight)
    raise InternalError(f"not in negation normal form: {type(formula).__name__}")


def _weight(atoms: frozenset[Atom]) -> tuple[object, ...]:
    levels = max((a.poly.level for a in atoms), default=-1)
    return levels, sum(a.poly.total_degree for a in atoms), len(atoms), sorted(str(a) for a in atoms)
