"""Membership in an ideal and in its radical."""

from collections.abc import Sequence

from qe.errors import Unable
from qe.exact.groebner import groebner_basis
from qe.exact.ideals import LIMITS, has_zeros
from qe.exact.ring import Poly


def in_ideal(poly: Poly, generators: Sequence[Poly]) -> bool:
    """Whether the polynomial is a combination of the generators. Raises ``Unable`` at a limit."""
    given = [g for g in generators if g]
    if not given:
        return not poly
    variables = sorted({i for g in (poly, *given) for i in g.variables}, reverse=True)
    basis = groebner_basis(given, variables=variables, limits=LIMITS)
    if basis is None:
        raise Unable("a Gröbner basis grows past its limits")
    return basis.contains(poly)


def in_radical(poly: Poly, generators: Sequence[Poly]) -> bool:
    """Whether the polynomial vanishes at all common complex zeros of the generators (Hilbert's Nullstellensatz)."""
    return not has_zeros(generators, [poly])
