"""A point of a set given by linear conditions, or why there is none, by the general simplex method: no best point."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from qe.convex.system import NotConvex, atoms_of
from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Poly
from qe.formula.syntax import Formula, Relation
from qe.options import Budget
from qe.proof.entry import Json, poly_to_text


@dataclass(frozen=True, slots=True)
class LinearContradiction:
    """sum weights_i polys_i is the number ``total``, where conditions on the polynomials exclude that (Farkas 1902)."""

    terms: tuple[tuple[int, Poly], ...]
    total: int

    def evidence(self) -> dict[str, Json]:
        """The evidence for the primitive "signs": the identity sum weights_i polys_i - total = 0."""
        sums: dict[Poly, int] = {}
        for weight, poly in self.terms:
            content, primitive = poly.normal()
            sums[primitive] = sums.get(primitive, 0) + weight * int(content)
        kept = {p: c for p, c in sums.items() if c and not p.is_constant}
        identity: list[Json] = [[str(c), [[k, 1]]] for k, c in enumerate(kept.values())]
        if self.total:
            identity.append([str(-self.total), []])
        listed: list[Json] = [poly_to_text(p) for p in kept]
        lemmas: list[Json] = [{"identity": identity}] if kept else []
        return {"theory": {"polynomials": listed, "lemmas": lemmas, "cases": []}}


def linear_point(conditions: Formula, *, budget: Budget) -> dict[str, Fraction] | LinearContradiction | None:
    """Values of the variables that meet all conditions, or how these contradict each other; None where they are no
    conjunction of linear atoms without /=.
    """
    try:
        atoms = atoms_of(conditions)
    except NotConvex:
        return None
    if not atoms or any(a.poly.total_degree > 1 or a.relation is Relation.NE for a in atoms):
        return None
    bounds, columns, scales = LinearBounds(), dict[str, int](), list[Fraction]()

    def contradiction(parts: Iterable[tuple[Hashable, Fraction]]) -> LinearContradiction:
        known = [(k, c / scales[k]) for k, c in parts if isinstance(k, int)]
        whole = lcm(*(c.denominator for _, c in known))
        terms = tuple((int(c * whole), atoms[k].poly) for k, c in known)
        return LinearContradiction(terms, sum(c * int(_constant(p)) for c, p in terms))

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
        scales.append(scale)
        x, bound = next(iter(terms)) if len(terms) == 1 else bounds.form(terms), -constant / scale
        relation = given.relation if scale > 0 else given.relation.flipped
        conflict = None
        if relation in (Relation.GT, Relation.GE, Relation.EQ):
            conflict = bounds.at_least(x, bound, strict=relation.is_strict, reason=number)
        if relation in (Relation.LT, Relation.LE, Relation.EQ) and conflict is None:
            conflict = bounds.at_most(x, bound, strict=relation.is_strict, reason=number)
        if conflict is not None:
            (other,) = conflict - {number} or {number}
            return contradiction([(number, Fraction(1)), (other, Fraction(-1))])
    if bounds.conflict(lambda: budget.check("linear conditions")) is not None:
        return contradiction(bounds.contradiction())
    values = bounds.point()
    return {name: values[x] for name, x in columns.items()}


def _constant(poly: Poly) -> Fraction:
    return next((Fraction(c) for powers, c in poly.sparse_terms() if not powers), Fraction(0))
