"""Rewriting atoms inside a formula, leaving alone what a quantifier would capture."""

from __future__ import annotations

from collections.abc import Callable, Collection

from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Not, Or


def rewrite(formula: Formula, change: Callable[[Atom], Formula], names: Collection[str]) -> Formula:
    """Every atom changed, except under quantifiers that bind one of ``names`` and inside root atoms."""
    match formula:
        case Atom():
            return change(formula)
        case And(args):
            return conj(rewrite(a, change, names) for a in args)
        case Or(args):
            return disj(rewrite(a, change, names) for a in args)
        case Not(arg):
            return neg(rewrite(arg, change, names))
        case Exists(variables, body) | ForAll(variables, body):
            if not set(variables).isdisjoint(names):
                return formula
            inner = rewrite(body, change, names)
            return exists(variables, inner) if isinstance(formula, Exists) else forall(variables, inner)
    return formula
