"""Random points of sets given by equations and inequations, and ideals specialised there, in exact arithmetic."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from random import Random

from qe.exact.block_order import BlockOrder, parametric_basis
from qe.exact.field import FieldElement, NumberField
from qe.exact.groebner import groebner_basis
from qe.exact.polynomial_system import LIMITS, solve_system
from qe.exact.quotient import PositiveDimensional, independent_sets
from qe.exact.ring import Poly, Ring
from qe.exact.univariate import from_univariate

Values = Mapping[int, FieldElement]


@dataclass(frozen=True)
class Place:
    """A point of parameter space over one real number field."""

    field: NumberField
    values: Values

    def value(self, poly: Poly) -> FieldElement:
        """A polynomial in the parameters, there."""
        total = self.field.rational(0)
        for exponents, c in poly.terms():
            term = self.field.rational(c)
            for i, k in enumerate(exponents):
                if k:
                    term = term * self.values[i] ** k
            total = total + term
        return total

    def satisfies(self, equal: Sequence[Poly], nonzero: Sequence[Poly], some: Sequence[Poly] = ()) -> bool:
        """Whether all of the first vanish, none of the second, not all of the third."""
        zero = all(not self.value(p) for p in equal) and all(self.value(p) for p in nonzero)
        return zero and (not some or any(self.value(p) for p in some))

    def ideal(self, polys: Sequence[Poly], block: BlockOrder) -> tuple[Poly, ...]:
        """The reduced Groebner basis of the specialised ideal, over Q[t]/(minimal polynomial of the field)."""
        names = polys[0].ring.names
        ring = Ring.of(("t of the field", *(names[i] for i in sorted(block.variables))))
        moved = {i: ring.index[names[i]] for i in block.variables}
        inside = BlockOrder(tuple(moved[i] for i in block.variables), (0,), block.order)
        special = [self._moved(p, block, ring, moved) for p in polys]
        return parametric_basis([*special, from_univariate(ring, 0, self.field.theta.poly)], inside)

    def leads(self, polys: Sequence[Poly], block: BlockOrder) -> set[tuple[int, ...]]:
        """The leading monomials of the reduced basis."""
        found = self.ideal(polys, block)
        if not found:
            return set()
        ring = found[0].ring
        inside = BlockOrder(tuple(ring.index[polys[0].ring.names[i]] for i in block.variables), (0,), block.order)
        return {inside.lead(p)[0] for p in found if p.is_constant or not inside.is_free(p)}

    def _moved(self, poly: Poly, block: BlockOrder, ring: Ring, moved: Mapping[int, int]) -> Poly:
        terms: dict[tuple[int, ...], Fraction] = {}
        for exponents, coefficient in block.terms(poly).items():
            for power, c in enumerate(self.value(coefficient).coefficients):
                place = [0] * ring.size
                place[0] = power
                for i, k in zip(block.variables, exponents, strict=True):
                    place[moved[i]] = k
                terms[tuple(place)] = c
        scale = lcm(*(c.denominator for c in terms.values())) if terms else 1
        return ring.from_terms({e: int(c * scale) for e, c in terms.items() if c})


def places(
    equal: Sequence[Poly], nonzero: Sequence[Poly], some: Sequence[Poly], parameters: Sequence[int], random: Random
) -> list[Place]:
    """Some real points of the set, where a few trials find any."""
    for _ in range(4):
        found = [p for p in _zeros(equal, parameters, random) if p.satisfies(equal, nonzero, some)]
        if found:
            return found
    return []


def _zeros(equal: Sequence[Poly], parameters: Sequence[int], random: Random) -> list[Place]:
    rationals = NumberField.rationals()
    if not any(equal):
        return [Place(rationals, {i: rationals.rational(random.randint(-9, 9)) for i in parameters})]
    basis = groebner_basis(equal, variables=parameters, limits=LIMITS)
    assert basis is not None
    free = next(independent_sets(basis.leads, len(parameters)))
    chosen = {parameters[k]: random.randint(-9, 9) for k in free}
    fixed = list(basis.polys)
    for i, value in chosen.items():
        fixed = [p.at_rational(i, value) for p in fixed]
    rest = [i for i in parameters if i not in chosen]
    if not rest:
        return [Place(rationals, {i: rationals.rational(v) for i, v in chosen.items()})]
    found = []
    names = basis.ring.names
    if not any(fixed):
        return []
    try:
        zeros = solve_system(fixed, variables=rest)
    except PositiveDimensional:  # the numbers chosen were special
        return []
    for zero in zeros:
        field = zero.values[names[rest[0]]].field
        values = {i: field.rational(v) for i, v in chosen.items()}
        found.append(Place(field, {**values, **{i: zero.values[names[i]] for i in rest}}))
    return found
