"""Brute-force semantics over a small finite universe: an oracle for laws of first-order logic and for formats."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from fractions import Fraction

from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Exists, ForAll, Formula, Not, Or
from qe.io.names import names_in

UNIVERSE = (Fraction(-1), Fraction(0), Fraction(3, 2))


def holds(formula: Formula, point: Mapping[str, Fraction]) -> bool:
    """Truth with quantifiers that range over ``UNIVERSE`` instead of the reals."""
    match formula:
        case Exists(variables, body) | ForAll(variables, body):
            join = any if isinstance(formula, Exists) else all
            choices = itertools.product(UNIVERSE, repeat=len(variables))
            return join(holds(body, {**point, **dict(zip(variables, c, strict=True))}) for c in choices)
        case And(args):
            return all(holds(arg, point) for arg in args)
        case Or(args):
            return any(holds(arg, point) for arg in args)
        case Not(arg):
            return not holds(arg, point)
    return holds_at(formula, point)


def same(left: Formula, right: Formula) -> bool:
    """Equality of the trees over one ring, whatever order the two met their variables in."""
    ring = Ring.of(sorted({*names_in(left), *names_in(right)}))
    return convert(left, ring) == convert(right, ring)
