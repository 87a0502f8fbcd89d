"""A parametric polynomial system, and its comprehensive Groebner system."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from qe.exact.algebraic import RealAlgebraic
from qe.exact.block_order import BlockOrder
from qe.exact.ring import Poly, Ring
from qe.exact.univariate import from_univariate
from qe.groebner.faithful import with_faithful
from qe.groebner.kapur_sun_wang import segments
from qe.groebner.system import ComprehensiveGroebnerSystem
from qe.options import Budget


@dataclass(frozen=True)
class ParametricSystem:
    """``polys`` in the variables and parameters of ``block``; only parameters with all of ``equal`` zero and none of
    ``nonzero`` are asked about. ``constants``: parameters that stand for one number each.
    """

    ring: Ring
    block: BlockOrder
    polys: tuple[Poly, ...]
    constants: Mapping[str, RealAlgebraic]
    equal: tuple[Poly, ...] = ()
    nonzero: tuple[Poly, ...] = ()

    @property
    def moduli(self) -> tuple[Poly, ...]:
        """The minimal polynomials of the constants."""
        return tuple(from_univariate(self.ring, self.ring.index[n], v.poly) for n, v in self.constants.items())

    def solved(self, budget: Budget, *, faithful: bool = False) -> ComprehensiveGroebnerSystem:
        """Its comprehensive Groebner system. Raises ``Unable`` at a limit, ``BudgetExceeded``."""
        given = self.polys or (self.ring.constant(0),)
        found = segments(given, self.block, budget, equal=(*self.equal, *self.moduli), nonzero=self.nonzero)
        parts = tuple(found)
        if faithful:
            parts = with_faithful(parts, self.polys, self.moduli, budget)
        return ComprehensiveGroebnerSystem(given, self.block, dict(self.constants), parts)
