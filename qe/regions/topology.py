"""Closure and interior as formulas, in any number of variables.

THEOREM (convex). Let p1, ..., pm be convex polynomials and S the set where each is < 0 or <= 0 (an equation is two
conditions p <= 0). If S has a point s, its closure is the set where all are <= 0: on the segment from s to a point of
that set the strict conditions hold, except perhaps at its other end. The interior of S is the set where all are < 0: a
convex polynomial that is 0 at a point inside a ball on which it is <= 0 has a maximum there, and so it is constant
(Rockafellar, Convex Analysis, theorem 32.1).
"""

from __future__ import annotations

from collections.abc import Callable

from qe.convex.optimum import decide
from qe.convex.system import NotConvex, read_system
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, exists, forall, implies, neg
from qe.formula.normal import nnf, rename
from qe.formula.openness import is_closed, is_open
from qe.formula.syntax import FALSE, And, Atom, Atomic, Formula, Relation
from qe.formula.traverse import map_atoms
from qe.io.substitution import over_one_ring
from qe.options import Budget

Operation = Callable[[Formula, tuple[str, ...], Budget], Formula]

_WEAK = {Relation.LT: Relation.LE, Relation.GT: Relation.GE}
_STRICT = {Relation.LE: Relation.LT, Relation.GE: Relation.GT}


def closure(formula: Formula, order: tuple[str, ...], budget: Budget) -> Formula:
    """The closure of the set of a quantifier-free formula, perhaps with quantifiers. Raises ``BudgetExceeded``."""
    if is_closed(formula, range(_size(formula))):
        return formula
    if _is_convex(formula):
        return _related(formula, _WEAK) if decide(formula, budget=budget).values is not None else FALSE
    return near(formula, order)


def interior(formula: Formula, order: tuple[str, ...], budget: Budget) -> Formula:
    """The interior of the set of a quantifier-free formula, perhaps with quantifiers. Raises ``BudgetExceeded``."""
    if is_open(formula, range(_size(formula))):
        return formula
    if _is_convex(formula):
        return _related(formula, _STRICT)
    return neg(near(nnf(formula, negate=True), order))


def boundary(formula: Formula, order: tuple[str, ...], budget: Budget) -> Formula:
    """The closure without the interior, perhaps with quantifiers. Raises ``BudgetExceeded``."""
    return conj(over_one_ring(closure(formula, order, budget), neg(interior(formula, order, budget))))


def near(formula: Formula, order: tuple[str, ...]) -> Formula:
    """The definition: all points of which every box around them meets the set."""
    own = () if formula.ring is None else formula.ring.names
    ring = Ring.of(dict.fromkeys((*order, "half width", *(f"near {v}" for v in order), *own)))
    width = ring.var("half width")
    pairs = [(ring.var(v), ring.var(f"near {v}")) for v in order]
    inside = [atom(side - width, Relation.LT) for x, y in pairs for side in (x - y, y - x)]
    moved = convert(rename(formula, {v: f"near {v}" for v in order if v in own}), ring)
    met = exists([f"near {v}" for v in order], conj((moved, *inside)))
    return forall(("half width",), implies(atom(width, Relation.GT), met))


def _size(formula: Formula) -> int:
    return 0 if formula.ring is None else formula.ring.size


def _is_convex(formula: Formula) -> bool:
    """Whether it is a conjunction of convex quadratic conditions, none of them ``/=``."""
    if not isinstance(formula, And | Atom):
        return False
    try:
        read_system(formula)
    except NotConvex:
        return False
    return True


def _related(formula: Formula, relations: dict[Relation, Relation]) -> Formula:
    """The conditions with other relations; strict ones turn an equation into a contradiction."""

    def change(atomic: Atomic) -> Formula:
        if not isinstance(atomic, Atom) or (relations is _STRICT and atomic.relation is Relation.EQ):
            return FALSE
        return atom(atomic.poly, relations.get(atomic.relation, atomic.relation))

    return map_atoms(formula, change)
