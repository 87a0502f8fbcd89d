"""Formulas whose truth changes only once along a variable."""

from __future__ import annotations

from collections.abc import Iterator

from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation

_SENSE = {Relation.GT: 1, Relation.GE: 1, Relation.LT: -1, Relation.LE: -1}


def direction(formula: Formula, x: int) -> int:
    """1 if the formula, in negation normal form, stays true where variable x grows, -1 where it falls; else 0.

    THEOREM. Let every comparison of a polynomial that x occurs in be p > 0 or p >= 0 with dp/dx >= 0 everywhere, or
    p < 0 or p <= 0 with dp/dx <= 0. Then each stays true where x grows alone, so do conjunctions and disjunctions of
    them, and so do statements with quantifiers over other variables. That dp/dx has no other sign is seen from terms
    with even exponents and coefficients of one sign.
    """
    directions = set(_directions(formula, x))
    return directions.pop() if len(directions) == 1 else 0


def _directions(formula: Formula, x: int) -> Iterator[int]:
    match formula:
        case Constant():
            return
        case Atom(poly, relation):
            if poly.degree(x):
                yield _SENSE.get(relation, 0) * _sign(poly.derivative(x))
        case And(args) | Or(args):
            for part in args:
                yield from _directions(part, x)
        case _:
            yield 0


def _sign(poly: Poly) -> int:
    """The sign that the polynomial has wherever it is not zero, or 0 where that is not seen."""
    signs = {0 if any(e % 2 for e in exponents) else (1 if c > 0 else -1) for exponents, c in poly.terms()}
    return signs.pop() if len(signs) == 1 else 0
