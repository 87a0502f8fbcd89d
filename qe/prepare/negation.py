"""Positive form: negation signs pushed into the atoms."""

from __future__ import annotations

from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, RootAtom


def positive(formula: Formula, negated: bool = False) -> Formula:
    """An equivalent formula (of ``not formula`` if ``negated``) where Not stands only before root atoms."""
    match formula:
        case Constant() | Atom() | RootAtom():
            return neg(formula) if negated else formula
        case Not(arg):
            return positive(arg, not negated)
        case And(args) | Or(args):
            parts = [positive(a, negated) for a in args]
            return conj(parts) if isinstance(formula, And) != negated else disj(parts)
        case Exists(variables, body) | ForAll(variables, body):
            inner = positive(body, negated)
            return exists(variables, inner) if isinstance(formula, Exists) != negated else forall(variables, inner)
    return formula
