"""Lazard's projection: leading and trailing coefficients, discriminants and resultants; valid for every input.

THEOREM (Lazard 1994; McCallum, Parusiński, Păunescu 2019, Theorem 5.1). Let the leading and trailing coefficients, the
discriminants and the resultants of irreducible polynomials be valuation-invariant on a cell. Then their Lazard
evaluations are delineable over it, and the polynomials are valuation-invariant on its sections and sectors.
"""

from __future__ import annotations

from collections.abc import Iterator

from qe.decomposition.operators.operator import Operator, multiple_roots
from qe.exact.ring import Poly
from qe.options import Projection


def of_one(f: Poly, variable: int) -> Iterator[Poly]:
    """Leading and trailing coefficient and discriminant."""
    coefficients = f.coefficients(variable)
    yield coefficients[-1]
    yield coefficients[0]
    yield from multiple_roots(f, variable)


LAZARD = Operator(
    name=Projection.LAZARD,
    source="Lazard 1994; McCallum, Parusiński, Păunescu 2019, Theorem 5.1",
    of_one=of_one,
    evaluates=True,
    proof=Projection.LAZARD,
)
