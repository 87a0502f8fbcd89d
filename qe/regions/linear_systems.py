"""As many linear equations with parameters as unknowns: one solution where the determinant is not zero, by Cramer's
rule, and what is left where it is."""

from __future__ import annotations

from collections.abc import Sequence

from qe.decomposition.radicals import quotient_text
from qe.elimination.critical.boundary import determinant
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.spelling import quoted


def regular_case(formula: Formula, unknowns: Sequence[str]) -> tuple[str, Formula] | None:
    """The case of a determinant that is not zero as a text, and the formula where it is; None for another formula, or
    where the determinant is a number."""
    equations = [f for f in conjuncts(formula) if not {*unknowns}.isdisjoint(f.free)]
    polys = [f.poly for f in equations if isinstance(f, Atom) and f.relation is Relation.EQ]
    if not len(polys) == len(equations) == len(unknowns) > 1:
        return None
    ring = polys[0].ring
    columns = [ring.names.index(name) for name in unknowns]
    rows = [[poly.derivative(i) for i in columns] for poly in polys]
    if any(entry.degree(i) for row in rows for entry in row for i in columns):
        return None
    det = determinant(rows)
    if det.is_constant:
        return None
    right = [-poly.at_rationals(dict.fromkeys(columns, 0)) for poly in polys]
    values = []
    for k, name in enumerate(unknowns):
        top = determinant([[*row[:k], right[i], *row[k + 1 :]] for i, row in enumerate(rows)])
        common = top.gcd(det) if top else det
        values.append(f"{quoted(name)} = {quotient_text(top.exact_divide(common), None, det.exact_divide(common), 1)}")
    given = conj((*(part for part in conjuncts(formula) if part not in equations), atom(det, Relation.NE)))
    return " and ".join((str(given), *values)), conj((formula, atom(det, Relation.EQ)))
