"""Which atoms of a formula decide it where the signs of some polynomials are known."""

from __future__ import annotations

from collections.abc import Mapping

from qe.errors import InternalError
from qe.exact.ring import Poly
from qe.formula.evaluate import truth_under
from qe.formula.syntax import And, Atom, Constant, Formula, Or

Signs = Mapping[Poly, int]


def implicant(formula: Formula, signs: Signs, truth: bool) -> frozenset[Atom]:
    """Few atoms, all of this truth value, that give it to a formula that has it: an implicant of it or its negation.

    The formula is in negation normal form. Of a conjunction that is false one false member is enough, and that of
    lowest level and degree is taken; dually of a disjunction that is true.
    """
    match formula:
        case Constant():
            return frozenset()
        case Atom():
            return frozenset((formula,))
        case And(args) | Or(args) if isinstance(formula, And) is truth:
            return frozenset[Atom]().union(*(implicant(a, signs, truth) for a in args))
        case And(args) | Or(args):
            enough = (implicant(a, signs, truth) for a in args if truth_under(a, signs.get) is truth)
            return min(enough, key=_weight)
    raise InternalError(f"not in negation normal form: {type(formula).__name__}")


def _weight(atoms: frozenset[Atom]) -> tuple[object, ...]:
    levels = max((a.poly.level for a in atoms), default=-1)
    return levels, sum(a.poly.total_degree for a in atoms), len(atoms), sorted(str(a) for a in atoms)
