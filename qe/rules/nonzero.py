"""Blocks that only ask polynomials not to vanish."""

from __future__ import annotations

from collections.abc import Sequence

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts, ring_of


def only_nonzero(variables: Sequence[str], body: Formula) -> Formula | None:
    """A formula equivalent to ``exists variables. body`` if body is a conjunction of p /= 0 as far as they occur in it.

    THEOREM: finitely many polynomials that are not identically zero have a common non-root in R^n. So
    (exists x. p_1 /= 0 and … and p_k /= 0) iff every p_i has a coefficient, as a polynomial in x, that is not 0.
    None if the body has another shape.
    """
    ring = ring_of(body)
    if ring is None:
        return None
    block = {ring.index[v] for v in variables if v in ring.index}
    parts: list[Formula] = []
    for arg in conjuncts(body):
        if not isinstance(arg, Atom):
            return None
        if not block & set(arg.poly.variables):
            parts.append(arg)
        elif arg.relation is not Relation.NE:
            return None
        else:
            parts.append(disj(atom(c, Relation.NE) for c in _coefficients(arg.poly, block)))
    return conj(parts)


def _coefficients(p: Poly, block: set[int]) -> list[Poly]:
    """The nonzero coefficients of p as a polynomial in the block's variables."""
    pending, out = [p], []
    while pending:
        q = pending.pop()
        inside = [i for i in q.variables if i in block]
        if inside:
            pending += [c for c in q.coefficients(inside[0]) if c]
        else:
            out.append(q)
    return out
