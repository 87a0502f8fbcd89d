"""Equational constraints (McCallum 1999): a conjoined equation restricts the first projection.

THEOREM (McCallum 1999, Theorem 2.2). Let f, g have positive degree in x_n and a resultant R != 0 with respect to
x_n. Over a connected set S on which f is delineable and R is order-invariant, g is sign-invariant in every
section of f. So where the matrix implies f = 0, the first projection needs leading coefficients and discriminants only
of the irreducible factors e of f, their resultants with each other, and the resultants of each e with each other
factor; between the sections of f the matrix is false. It is used under Brown–McCallum projection, whose lower levels
give the order-invariance; lifting checks that no factor of f is nullified over a cell of positive dimension.
"""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Formula, Relation


def constraint_factors(matrix: Formula, level: int) -> frozenset[Poly] | None:
    """The irreducible factors of the cheapest equation that the matrix implies, or None.

    Only an equation whose factors all have main variable ``level`` will do: a factor of lower level could make it
    true between the sections of the others.
    """
    best: tuple[tuple[int, int, int], frozenset[Poly]] | None = None
    for arg in matrix.args if isinstance(matrix, And) else (matrix,):
        if not isinstance(arg, Atom) or arg.relation is not Relation.EQ:
            continue
        factors = frozenset(f for f, _ in arg.poly.factors()[1])
        if all(f.level == level for f in factors):
            degree = sum(f.degree(level) for f in factors)
            cost = (degree, sum(f.total_degree for f in factors), sum(f.term_count() for f in factors))
            if best is None or cost < best[0]:
                best = cost, factors
    return None if best is None else best[1]
