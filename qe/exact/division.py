"""Division of polynomials by several others with quotients (Cox, Little, O'Shea, 2.3)."""

from __future__ import annotations

from dataclasses import dataclass
from math import gcd

from qe.errors import InternalError
from qe.exact.groebner import Basis
from qe.exact.ring import Poly


@dataclass(frozen=True)
class Division:
    """``scale*poly = sum of quotients*divisors + remainder``, an identity of polynomials; ``scale`` is positive."""

    scale: int
    quotients: tuple[Poly, ...]
    remainder: Poly


def divided(poly: Poly, basis: Basis) -> Division:
    """The normal form of a polynomial in the basis' variables with its cofactors by the basis' elements."""
    places = basis.variables
    if not set(poly.variables) <= set(places):
        raise InternalError("a polynomial to be divided has a variable that the basis does not know")
    ring = poly.ring

    def terms(p: Poly) -> dict[tuple[int, ...], int]:
        return {tuple(e[i] for i in places): c for e, c in p.terms()}

    def joined(found: dict[tuple[int, ...], int]) -> Poly:
        moved = {}
        for exponents, c in found.items():
            place = [0] * ring.size
            for i, k in zip(places, exponents, strict=True):
                place[i] = k
            moved[tuple(place)] = c
        return ring.from_terms(moved)

    divisors = list(zip(basis.leads, map(terms, basis.polys), strict=True))
    scale, rest = 1, terms(poly)
    done: dict[tuple[int, ...], int] = {}
    quotients: list[dict[tuple[int, ...], int]] = [{} for _ in divisors]
    while rest:
        top = max(rest, key=basis.rank)
        fitting = (k for k, (lead, _) in enumerate(divisors) if all(a <= b for a, b in zip(lead, top, strict=True)))
        if (chosen := next(fitting, None)) is None:
            done[top] = rest.pop(top)
            continue
        (lead, divisor), quotient = divisors[chosen], quotients[chosen]
        common = gcd(rest[top], divisor[lead])
        own = abs(divisor[lead]) // common
        factor = rest[top] // common * (1 if divisor[lead] > 0 else -1)
        if own != 1:
            scale *= own
            for part in (rest, done, *quotients):
                for e in part:
                    part[e] *= own
        shift = tuple(a - b for a, b in zip(top, lead, strict=True))
        quotient[shift] = quotient.get(shift, 0) + factor
        for e, c in divisor.items():
            place = tuple(a + b for a, b in zip(e, shift, strict=True))
            value = rest.get(place, 0) - factor * c
            if value:
                rest[place] = value
            else:
                rest.pop(place, None)
    return Division(scale, tuple(map(joined, quotients)), joined(done))
