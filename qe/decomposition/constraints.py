"""Equational constraints: equations that the matrix implies restrict projection and lifting, level by level.

THEOREM (McCallum 1999, Theorem 2.2). Let f, g have positive degree in x_n and a resultant R != 0 with respect to
x_n. Over a connected set S on which f is delineable and R is order-invariant, g is sign-invariant in every
section of f. So where the matrix implies f = 0, the first projection needs leading coefficients and discriminants only
of the irreducible factors e of f, their resultants with each other, and the resultants of each e with each other
factor; between the sections of f the matrix is false.

THEOREM (McCallum 2001, section 3). If moreover the leading coefficient and the discriminant of g are order-invariant
on S and g is nullified nowhere on it, g is order-invariant in every section of f: leading coefficient and discriminant
of f*g are then order-invariant on S, so f*g is delineable with order-invariant sections (McCallum 1998, Theorem 2;
Brown 2001, Theorem 3.1). Lower projections need order-invariance, so at their levels leading coefficients and
discriminants of all factors stay, and only the resultants between two factors that are both none of f's are left out.

A constraint is propagated: f = 0 and g = 0 with the same main variable imply that their resultant is zero. All this
holds for any quantifiers and for free variables: a cell off the sections of a constraint has the truth value false
whatever stands above it, so nothing above it is asked. Dually, where the negated matrix implies f = 0, it is true.
The theorems are used under the operators of which they speak (``Operator.restricted``); lifting checks that nothing is
nullified that must not be.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts, disjuncts


@dataclass(frozen=True, slots=True)
class Constraints:
    """``factors[k]``: irreducible factors of level k, one of which is zero wherever the matrix holds (for a
    disjunction: wherever it fails). ``implied``: the resultants that were propagated.
    """

    factors: Mapping[int, frozenset[Poly]] = field(default_factory=dict)
    implied: tuple[Poly, ...] = ()


def equational_constraints(matrix: Formula, size: int) -> Constraints:
    """The cheapest constraint of each level, from the top level down.

    Only an equation whose factors all have the same main variable will do: a factor of lower level could make it
    true between the sections of the others.
    """
    dual = isinstance(matrix, Or) or (isinstance(matrix, Atom) and matrix.relation is Relation.NE)
    relation = Relation.NE if dual else Relation.EQ
    parts = disjuncts(matrix) if dual else conjuncts(matrix)
    equations = [a.poly for a in parts if isinstance(a, Atom) and a.relation is relation]
    chosen: dict[int, frozenset[Poly]] = {}
    implied: list[Poly] = []
    for level in range(size - 1, -1, -1):
        here = {f: own for f in equations if (own := _factors(f, level)) is not None}
        if here:
            best = min(here, key=lambda f: _cost(here[f]))
            chosen[level] = here[best]
            propagated = [r for g in here if g != best and not (r := best.resultant(g, level)).is_constant]
            implied += propagated
            equations += propagated
        else:
            nested = [own for a in parts if (own := _forced(a, level, relation)) is not None]
            if nested:
                chosen[level] = min(nested, key=_cost)
    return Constraints(chosen, tuple(implied))


def _factors(f: Poly, level: int) -> frozenset[Poly] | None:
    """The irreducible factors, if all have this level."""
    factors = frozenset(e for e, _ in f.factors()[1])
    return factors if factors and all(e.level == level for e in factors) else None


def _forced(formula: Formula, level: int, relation: Relation) -> frozenset[Poly] | None:
    """Factors of which one is zero wherever the formula holds (for ``NE``: fails), from its Boolean structure."""
    match formula:
        case Atom(poly, found):
            return _factors(poly, level) if found is relation else None
        case And(args) | Or(args):
            each = [_forced(a, level, relation) for a in args]
            known = [own for own in each if own is not None]
            if isinstance(formula, And) == (relation is Relation.EQ):
                return min(known, key=_cost) if known else None
            return frozenset().union(*known) if len(known) == len(each) else None
    return None


def _cost(factors: Iterable[Poly]) -> tuple[int, int, int]:
    each = [(f.degree(f.level), f.total_degree, f.term_count()) for f in factors]
    return sum(d for d, _, _ in each), sum(t for _, t, _ in each), sum(n for _, _, n in each)
