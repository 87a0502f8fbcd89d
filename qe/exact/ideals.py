"""Common complex zeros of polynomials that are no zeros of others."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

from qe.errors import Unable
from qe.exact.groebner import Limits, groebner_basis
from qe.exact.ring import Poly, Ring

LIMITS = Limits(elements=600, terms=20_000, bits=40_000, modular=True)


def has_zeros(equations: Sequence[Poly], nonzero: Sequence[Poly] = ()) -> bool:
    """Whether some complex point is a zero of all equations and of none of ``nonzero``.

    There is none iff 1 is a combination of the equations and of 1 - y*(product of nonzero) for a new variable y
    (Rabinowitsch 1929). Raises ``Unable`` at a limit.
    """
    others = [p for p in nonzero if not p.is_constant]
    if not all(nonzero):
        return False
    given = [p for p in equations if p]
    if not given:
        return True
    if any(p.is_constant for p in given):
        return False
    if not others:
        return not _is_unit(given)
    ring = given[0].ring
    wider = Ring.of((*ring.names, fresh(ring)))
    product = prod((p.convert(wider) for p in others), start=wider.constant(1))
    return not _is_unit([*(p.convert(wider) for p in given), wider.gen(ring.size) * product - 1])


def fresh(ring: Ring) -> str:
    """A name that the ring does not have."""
    name = "y"
    while name in ring.index:
        name += "_"
    return name


def _is_unit(polys: Sequence[Poly]) -> bool:
    basis = groebner_basis(polys, limits=LIMITS)
    if basis is None:
        raise Unable("a Gröbner basis grows past its limits")
    return basis.is_unit
