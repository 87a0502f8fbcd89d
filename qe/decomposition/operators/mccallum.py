"""McCallum's projection: all coefficients, discriminants and resultants, where nothing is nullified.

THEOREM (McCallum 1998, Theorem 1). Let all coefficients, the discriminants and the resultants of irreducible
polynomials be order-invariant on a cell. Then each polynomial is nullified on all of the cell or delineable over it and
order-invariant in its sections.

It needs no argument about single points, at the price of coefficients that Brown's reduction leaves out. As it derives
all that Brown–McCallum's does, its tables are proved by the latter's theorem.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.operator import multiple_roots
from qe.exact.ring import Poly
from qe.options import Projection


def of_one(f: Poly, variable: int) -> Iterator[Poly]:
    """All coefficients and the discriminant."""
    yield from f.coefficients(variable)
    yield from multiple_roots(f, variable)


MCCALLUM = replace(BROWN_MCCALLUM, name=Projection.MCCALLUM, source="McCallum 1998, Theorem 1", of_one=of_one)
