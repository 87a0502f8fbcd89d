"""A segment of parameter space with the Groebner basis that is valid all over it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from qe.exact.block_order import BlockOrder, Exponents
from qe.exact.groebner import Basis, groebner_basis
from qe.exact.ideals import LIMITS
from qe.exact.quotient import independent_sets
from qe.exact.ring import Poly
from qe.groebner.reduction import Divisor, remainder


@dataclass(frozen=True)
class Segment:
    """V(E) without V(N), and a basis: for all parameters there it specialises to a Groebner basis of the specialised
    ideal, and its leading monomials stay what they are.

    ``equal``: E, all of them vanish. ``nonzero``: none of them vanishes. ``some``: not all of them vanish (() asks
    nothing). ``basis``: ascending by leading monomial, minimal, reduced as far as denominators allow, () for the zero
    ideal, (1,) for the unit ideal. ``elements``: what the basis was reduced from, in the ideal of the given polynomials
    and E. ``faithful``, where asked for: elements of the ideal of the given polynomials alone with the same values on
    the segment as ``elements``, so that they, too, specialise to Groebner bases.
    """

    block: BlockOrder
    equal: tuple[Poly, ...]
    nonzero: tuple[Poly, ...]
    some: tuple[Poly, ...]
    basis: tuple[Poly, ...]
    elements: tuple[Poly, ...] = ()
    faithful: tuple[Poly, ...] | None = None

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        """Without what is only remembered."""
        return Segment, (self.block, self.equal, self.nonzero, self.some, self.basis, self.elements, self.faithful)

    @cached_property
    def leads(self) -> tuple[Exponents, ...]:
        """The exponents of the leading monomials, each in the order of the variables."""
        return tuple(self.block.lead(p)[0] for p in self.basis)

    @property
    def is_unit(self) -> bool:
        """Whether there is no complex solution over any parameters of the segment."""
        return len(self.basis) == 1 and self.basis[0].is_constant

    @cached_property
    def dimension(self) -> int:
        """The dimension of the solutions over every point of the segment; -1 where there are none."""
        found = next(independent_sets(self.leads, len(self.block.variables)), None)
        return -1 if found is None else len(found)

    @cached_property
    def base(self) -> Basis | None:
        """A basis of the ideal of E."""
        if not self.equal:
            return None
        return groebner_basis(self.equal, variables=(*self.block.variables, *self.block.parameters), limits=LIMITS)

    def reduce(self, poly: Poly) -> tuple[Poly, Poly]:
        """(s, r): s vanishes nowhere on the segment, s*poly - r is in the ideal at all its points, r is reduced.

        So poly is in the ideal at a point iff all coefficients of r vanish there.
        """
        return remainder(poly, [Divisor(p, self.block) for p in self.basis], self.block, self.base)


def monomial_names(exponents: Sequence[int], names: Sequence[str]) -> str:
    """Text such as ``x^2*y``."""
    parts = [name if k == 1 else f"{name}^{k}" for name, k in zip(names, exponents, strict=True) if k]
    return "*".join(parts) or "1"
