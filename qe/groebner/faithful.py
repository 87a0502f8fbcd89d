"""Faithful bases: elements of the given ideal itself with the values of a segment's basis on the segment.

For F the given polynomials, E the equations of a segment and a new variable t, consider the ideal J of t*F and (1 -
t)*E. If g = f + e with f in <F>, e in <E>, then t*g - e = t*f + (t - 1)*e lies in J, so the normal form of t*g for an
order with t before everything else is free of t; and for every r free of t with t*g - r in J, t = 1 gives g - r in <F>
and t = 0 gives r in <E>. So g - r is faithful. (The idea of Suzuki and Sato 2006; used for the same purpose by Kapur,
Sun, Wang 2013.)
"""

from __future__ import annotations

from dataclasses import replace

from qe.errors import InternalError, Unable
from qe.exact.groebner import Basis, groebner_basis
from qe.exact.ideals import LIMITS, fresh
from qe.exact.ring import Poly, Ring
from qe.groebner.segment import Segment
from qe.options import Budget


def with_faithful(segment: Segment, polys: tuple[Poly, ...], budget: Budget) -> Segment:
    """The segment with faithful elements. Raises ``Unable`` at a limit, ``BudgetExceeded``."""
    given = [p for p in polys if p]
    if not given or not segment.equal:  # without equations the elements are in the ideal themselves
        return replace(segment, faithful=segment.elements)
    budget.check("faithful bases")
    ring = polys[0].ring
    wide = Ring.of((*ring.names, fresh(ring)))
    joined = _joined(given, segment, wide)
    return replace(segment, faithful=tuple(_faithful(g, joined, wide) for g in segment.elements))


def _faithful(g: Poly, joined: Basis, wide: Ring) -> Poly:
    t = wide.size - 1
    scale, rest = joined.reduce(wide.gen(t) * g.convert(wide))
    if rest.degree(t):
        raise InternalError("an element of a segment is in no way congruent to the ideal")
    return (scale * g.convert(wide) - rest).convert(g.ring).normal()[1]


def _joined(polys: list[Poly], segment: Segment, wide: Ring) -> Basis:
    t = wide.gen(wide.size - 1)
    given = [*(t * p.convert(wide) for p in polys), *((1 - t) * p.convert(wide) for p in segment.equal)]
    variables = (wide.size - 1, *segment.block.variables, *segment.block.parameters)
    basis = groebner_basis(given, variables=variables, heavy=1, limits=LIMITS)
    if basis is None:
        raise Unable("the Gröbner basis for faithful elements grows past its limits")
    return basis
