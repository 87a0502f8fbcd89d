"""Division of polynomials by several others with quotients (Cox, Little, O'Shea, 2.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import gcd

from qe.errors import InternalError
from qe.exact.groebner import Basis
from qe.exact.ring import Poly, Ring

Terms = dict[tuple[int, ...], int]


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
    divisors = [(lead, _terms(p, places)) for lead, p in zip(basis.leads, basis.polys, strict=True)]
    scale, rest = 1, _terms(poly, places)
    done: Terms = {}
    quotients: list[Terms] = [{} for _ in divisors]
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
        _subtract(rest, divisor, factor, shift)
    return Division(scale, tuple(_joined(q, places, poly.ring) for q in quotients), _joined(done, places, poly.ring))


def _subtract(rest: Terms, divisor: Terms, factor: int, shift: tuple[int, ...]) -> None:
    """``rest`` less ``factor`` times the monomial of exponents ``shift`` times the divisor, in place."""
    for e, c in divisor.items():
        place = tuple(a + b for a, b in zip(e, shift, strict=True))
        value = rest.get(place, 0) - factor * c
        if value:
            rest[place] = value
        else:
            rest.pop(place, None)


def _terms(poly: Poly, places: Sequence[int]) -> Terms:
    """Coefficients by the exponents of the basis' variables alone."""
    return {tuple(e[i] for i in places): c for e, c in poly.terms()}


def _joined(coefficients: Terms, places: Sequence[int], ring: Ring) -> Poly:
    """The polynomial of such coefficients."""
    moved = {}
    for exponents, c in coefficients.items():
        place = [0] * ring.size
        for i, k in zip(places, exponents, strict=True):
            place[i] = k
        moved[tuple(place)] = c
    return ring.from_terms(moved)
