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


def false_by(formula: Formula, decided: Decided) -> frozenset[Atom]:
    """Few atoms, all of them false, that make a false formula false: an implicant of its negation.

    Of a conjunction one false member is enough, and that of lowest level and degree is taken.
    """
    match formula:
        case Constant():
            return frozenset()
        case Atom():
            return frozenset((formula,))
        case Or(args):
            return frozenset[Atom]().union(*(false_by(a, decided) for a in args))
        case And(args):
            return min((false_by(a, decided) for a in args if value(a, decided) is False), key=_weight)
    raise InternalError(f"not in negation normal form: {type(formula).__name__}")


def _weight(atoms: frozenset[Atom]) -> tuple[object, ...]:
    levels = max((a.poly.level for a in atoms), default=-1)
    return levels, sum(a.poly.total_degree for a in atoms), len(atoms), sorted(str(a) for a in atoms)
