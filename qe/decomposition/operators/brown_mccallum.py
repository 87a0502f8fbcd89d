"""The Brown–McCallum projection: leading coefficients, discriminants and resultants, where nothing is nullified.

THEOREM (Brown 2001, Theorem 3.1, after McCallum 1998, Theorem 2). Let the leading coefficients, discriminants and
resultants of irreducible polynomials be order-invariant on a cell on which none of the polynomials is nullified at any
point. Then they are delineable over the cell and order-invariant in its sections.
"""

from __future__ import annotations

from collections.abc import Iterator

from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.operators.operator import Operator, multiple_roots
from qe.exact.ring import Poly
from qe.options import Projection


def of_one(f: Poly, variable: int) -> Iterator[Poly]:
    """Leading coefficient and discriminant; all coefficients where they could vanish together at isolated points."""
    coefficients = f.coefficients(variable)
    yield coefficients[-1]
    if variable >= 2 and not any(c.is_constant and c for c in coefficients):
        # The coefficients may vanish together at a point inside a cell whose sample does not show it (x*z+y-1 over
        # x = 0); with all of them in the list, a factor nullified anywhere on a cell is so at its sample.
        yield from coefficients[:-1]
    yield from multiple_roots(f, variable)


BROWN_MCCALLUM = Operator(
    name=Projection.BROWN_MCCALLUM,
    source="Brown 2001, Theorem 3.1, after McCallum 1998",
    of_one=of_one,
    restricted=True,
    otherwise=LAZARD,
    proof=Projection.BROWN_MCCALLUM,
)
