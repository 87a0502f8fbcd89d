"""A point of a set given by linear conditions, by the general simplex method: no multipliers, no best point."""

from __future__ import annotations

from fractions import Fraction

from qe.convex.system import NotConvex, atoms_of
from qe.exact.linear_bounds import LinearBounds
from qe.formula.syntax import Formula, Relation
from qe.options import Budget


def linear_point(conditions: Formula, *, budget: Budget) -> dict[str, Fraction] | None:
    """Values of the variables that meet all conditions; None where there are none, or where the conditions are no
    conjunction of linear atoms without /=.
    """
    try:
        atoms = atoms_of(conditions)
    except NotConvex:
        return None
    if not atoms or any(a.poly.total_degree > 1 or a.relation is Relation.NE for a in atoms):
        return None
    bounds, columns = LinearBounds(), dict[str, int]()
    for number, given in enumerate(atoms):
        names, terms, constant = given.poly.ring.names, dict[int, Fraction](), Fraction(0)
        for powers, c in given.poly.sparse_terms():
            if not powers:
                constant = Fraction(c)
                continue
            name = names[powers[0][0]]
            if name not in columns:
                columns[name] = bounds.variable()
            terms[columns[name]] = Fraction(c)
        scale = next(iter(terms.values())) if len(terms) == 1 else Fraction(1)
        x, bound = next(iter(terms)) if len(terms) == 1 else bounds.form(terms), -constant / scale
        relation = given.relation if scale > 0 else given.relation.flipped
        conflict = None
        if relation in (Relation.GT, Relation.GE, Relation.EQ):
            conflict = bounds.at_least(x, bound, strict=relation.is_strict, reason=number)
        if relation in (Relation.LT, Relation.LE, Relation.EQ) and conflict is None:
            conflict = bounds.at_most(x, bound, strict=relation.is_strict, reason=number)
        if conflict is not None:
            return None
    if bounds.conflict(lambda: budget.check("linear conditions")) is not None:
        return None
    values = bounds.point()
    return {name: values[x] for name, x in columns.items()}
