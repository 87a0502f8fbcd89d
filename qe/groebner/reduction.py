"""Polynomials over a segment of parameters: division by elements whose leading coefficients vanish nowhere on it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from qe.exact.block_order import BlockOrder, Exponents, Terms
from qe.exact.groebner import Basis
from qe.exact.ring import Poly, Ring


@dataclass(frozen=True)
class Divisor:
    """A polynomial split into terms, highest first; its leading coefficient vanishes nowhere on the segment."""

    poly: Poly
    block: BlockOrder

    @cached_property
    def terms(self) -> Terms:
        return self.block.terms(self.poly)

    @cached_property
    def lead(self) -> tuple[Exponents, Poly]:
        return next(iter(self.terms.items()))

    @cached_property
    def tail(self) -> list[tuple[Exponents, Poly]]:
        return list(self.terms.items())[1:]


def divides(a: Exponents, b: Exponents) -> bool:
    """Whether the monomial with exponents a divides the one with exponents b."""
    return all(i <= j for i, j in zip(a, b, strict=True))


def monomial(block: BlockOrder, exponents: Sequence[int], poly: Poly) -> Poly:
    """The polynomial times a monomial in the variables."""
    for i, k in zip(block.variables, exponents, strict=True):
        if k:
            poly = poly * poly.ring.gen(i) ** k
    return poly


def joined(terms: Terms, block: BlockOrder, ring: Ring) -> Poly:
    """The polynomial of these terms."""
    return sum((monomial(block, e, c) for e, c in terms.items()), start=ring.constant(0))


def remainder(poly: Poly, divisors: Sequence[Divisor], block: BlockOrder, base: Basis | None) -> tuple[Poly, Poly]:
    """(s, r): s*poly - r is a combination of the divisors where the base vanishes, no monomial of r is a multiple of
    one of their leading monomials, and s is a product of leading coefficients and integers.

    ``base``: a basis of the ideal of the segment, modulo which coefficients are reduced.
    """
    key, ring = block.order.key, poly.ring
    scale, done, rest = ring.constant(1), Terms(), block.terms(poly)
    while rest:
        lead = max(rest, key=key)
        coefficient = rest.pop(lead)
        divisor = next((d for d in divisors if divides(d.lead[0], lead)), None)
        if divisor is None:
            done[lead] = coefficient
            continue
        common = coefficient.gcd(divisor.lead[1])
        own, other = divisor.lead[1].exact_divide(common), coefficient.exact_divide(common)
        if not (own.is_constant and own.constant_value() == 1):
            scale = scale * own
            done, rest = {e: c * own for e, c in done.items()}, {e: c * own for e, c in rest.items()}
        shift = [a - b for a, b in zip(lead, divisor.lead[0], strict=True)]
        for exponents, c in divisor.tail:
            place = tuple(a + b for a, b in zip(exponents, shift, strict=True))
            total = rest[place] - c * other if place in rest else -(c * other)
            if total:
                rest[place] = total
            else:
                del rest[place]
    found = joined(done, block, ring)
    if base is None or not found:
        return scale, found
    s, found = base.reduce(found)
    return scale * s, found


def cleared(poly: Poly, block: BlockOrder) -> Poly:
    """The polynomial over the greatest common divisor of its coefficients, which divides the leading one."""
    common = poly.ring.constant(0)
    for c in block.terms(poly).values():
        common = common.gcd(c)
        if common.is_constant:
            break
    return poly.exact_divide(common).normal()[1] if not common.is_constant else poly.normal()[1]


def reduced_basis(polys: Iterable[Poly], block: BlockOrder, base: Basis | None) -> tuple[Poly, ...]:
    """Every element replaced by its remainder by the others, content divided out; ascending by leading monomial.

    The leading monomials must be minimal, the leading coefficients vanish nowhere on the segment.
    """
    found = sorted(polys, key=lambda p: block.order.key(block.lead(p)[0]))
    divisors = [Divisor(p, block) for p in found]
    for k, divisor in enumerate(divisors):
        head = monomial(block, *divisor.lead)
        scale, tail = remainder(divisor.poly - head, divisors[:k], block, base)
        # the leading coefficient, too, modulo the base; what lies above cannot divide anything here
        whole = head * scale + tail if base is None else base.reduce(head * scale + tail)[1]
        divisors[k] = Divisor(cleared(whole, block), block)
    return tuple(d.poly for d in divisors)
