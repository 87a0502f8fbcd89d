"""Rule "negation normal form", and "duality": negations go inside, down to the atoms.

THEOREM (De Morgan). not (A and B) iff (not A or not B), not ex x A iff all x not A, and dually; not (p < 0) iff p >= 0,
and so on. So two formulas with one negation normal form are equivalent. Root atoms keep a negation in front.
"""

from __future__ import annotations

from functools import lru_cache

from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.syntax import And, Exists, ForAll, Formula, Not, Or


def normal(formula: Formula) -> Formula:
    """The formula with its negations in the atoms."""
    return _pushed(formula, False)


def negation(formula: Formula) -> Formula:
    """The negation, with negations in the atoms."""
    return _pushed(formula, True)


@lru_cache(maxsize=8192)  # a checker asks for the parts of one formula again and again
def _pushed(formula: Formula, negative: bool) -> Formula:
    match formula:
        case Not(arg):
            return _pushed(arg, not negative)
        case And(args) | Or(args):
            join = conj if isinstance(formula, And) is not negative else disj
            return join(_pushed(a, negative) for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            quantify = exists if isinstance(formula, Exists) is not negative else forall
            return quantify(variables, _pushed(body, negative))
    return neg(formula) if negative else formula
