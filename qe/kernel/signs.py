"""Sign variables: sets of signs, and the lemmas that cut them down.

A set of signs is a number with the bits ``NEGATIVE``, ``ZERO``, ``POSITIVE``; there is one for every polynomial.

LEMMA (identity). sum_j c_j * prod q^e = 0, multiplied out. So no term is alone in being positive, or negative.
LEMMA (line). Polynomials q in one variable, and ascending rational samples. If each q has as many sign changes along
the samples as it has real roots (Sturm), and no two change between the same neighbours, then the sign vectors on the
line are those of the samples, and between two neighbours the one where the polynomial that changes is 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Protocol

from qe.exact.ring import Poly, Ring
from qe.kernel.arithmetic.sturm import count_real_roots
from qe.kernel.limits import check_power, check_value
from qe.proof.entry import Entry, polynomial_from_json

NEGATIVE, ZERO, POSITIVE = 1, 2, 4
ANY = NEGATIVE | ZERO | POSITIVE
MOST_TERMS = 20_000
"""Terms of a product that is multiplied out, at most."""

Domains = list[int]


def _times(a: int, b: int) -> int:
    found = ZERO if a & ZERO or b & ZERO else 0
    if (a & POSITIVE and b & POSITIVE) or (a & NEGATIVE and b & NEGATIVE):
        found |= POSITIVE
    if (a & POSITIVE and b & NEGATIVE) or (a & NEGATIVE and b & POSITIVE):
        found |= NEGATIVE
    return found


PRODUCT = tuple(tuple(_times(a, b) for b in range(8)) for a in range(8))
SQUARE = tuple((a & ZERO) | (POSITIVE if a & (NEGATIVE | POSITIVE) else 0) for a in range(8))
OPPOSITE = tuple(PRODUCT[a][NEGATIVE] for a in range(8))


def sign_bit(value: Fraction | int) -> int:
    """The set with the sign of a number."""
    return POSITIVE if value > 0 else NEGATIVE if value < 0 else ZERO


class Lemma(Protocol):
    """``cut`` takes impossible signs away and tells whether there were any; an empty set is a contradiction."""

    @property
    def polynomials(self) -> tuple[int, ...]: ...

    def cut(self, domains: Domains) -> bool: ...


@dataclass(frozen=True, slots=True)
class Identity:
    """The terms, each the sign of its coefficient and (polynomial, whether its exponent is odd); their sum is 0."""

    terms: tuple[tuple[int, tuple[tuple[int, bool], ...]], ...]

    @property
    def polynomials(self) -> tuple[int, ...]:
        return tuple(dict.fromkeys(i for _, powers in self.terms for i, _ in powers))

    def cut(self, domains: Domains) -> bool:
        found = [_product(unit, powers, domains) for unit, powers in self.terms]
        changed = False
        for k, (unit, powers) in enumerate(self.terms):
            allowed = OPPOSITE[_sum(found[:k] + found[k + 1 :])]
            if found[k] & ~allowed:
                changed |= _cut_factors(unit, powers, allowed, domains)
        return changed


def _product(unit: int, powers: Sequence[tuple[int, bool]], domains: Domains) -> int:
    for i, odd in powers:
        unit = PRODUCT[unit][domains[i] if odd else SQUARE[domains[i]]]
    return unit


def _sum(parts: Sequence[int]) -> int:
    """The signs that a sum can have."""
    if not all(parts):
        return 0
    whole = 0
    for part in parts:
        whole |= part
    if whole & NEGATIVE and whole & POSITIVE:
        return ANY
    strict = any(not part & ZERO for part in parts)
    return whole & ~ZERO if strict else whole | ZERO


def _cut_factors(unit: int, powers: Sequence[tuple[int, bool]], allowed: int, domains: Domains) -> bool:
    """Take from every factor the signs with which the term cannot have an allowed sign."""
    changed = False
    if not powers:  # a constant of a sign that the others exclude
        for i in range(len(domains)):
            domains[i] = 0
        return True
    for k, (i, odd) in enumerate(powers):
        rest = _product(unit, (*powers[:k], *powers[k + 1 :]), domains)
        kept = 0
        for sign in (NEGATIVE, ZERO, POSITIVE):
            if domains[i] & sign and PRODUCT[rest][sign if odd else SQUARE[sign]] & allowed:
                kept |= sign
        if kept != domains[i]:
            domains[i], changed = kept, True
    return changed


@dataclass(frozen=True, slots=True)
class Line:
    """The sign vectors of polynomials in one variable."""

    polynomials: tuple[int, ...]
    cells: tuple[tuple[int, ...], ...]

    def cut(self, domains: Domains) -> bool:
        left = [cell for cell in self.cells if all(s & domains[i] for i, s in zip(self.polynomials, cell, strict=True))]
        changed = False
        for k, i in enumerate(self.polynomials):
            possible = 0
            for cell in left:
                possible |= cell[k]
            if domains[i] & ~possible:
                domains[i], changed = domains[i] & possible, True
        return changed


def read_lemma(entry: Entry, polys: Sequence[Poly], ring: Ring) -> Lemma:
    """A lemma about listed polynomials, proved here."""
    if isinstance(entry.value, dict) and "identity" in entry.value:
        return _read_identity(entry.fields("identity")[0], polys, ring)
    return _read_line(entry, polys)


def read_polynomials(entry: Entry, ring: Ring) -> tuple[Poly, ...]:
    """Primitive polynomials with positive leading coefficients, each once."""
    polys = tuple(polynomial_from_json(e, ring) for e in entry.items())
    if len(set(polys)) < len(polys):
        raise entry.fail("a polynomial is listed twice")
    return polys


def _read_identity(entry: Entry, polys: Sequence[Poly], ring: Ring) -> Identity:
    total = ring.constant(0)
    terms: list[tuple[int, tuple[tuple[int, bool], ...]]] = []
    for term in entry.items():
        number, factors = term.row("coefficient", "[[polynomial, exponent], ...]")
        coefficient = number.rational()
        if not coefficient or coefficient.denominator != 1:
            raise number.fail("expected an integer that is not 0")
        powers = tuple(_power(power, len(polys)) for power in factors.items())
        if len({i for i, _ in powers}) < len(powers):
            raise factors.fail("a polynomial stands twice in a product")
        product = ring.constant(int(coefficient))
        for i, exponent in powers:
            check_power(polys[i], exponent)
            factor = polys[i] ** exponent
            if factor.term_count() * product.term_count() > MOST_TERMS:
                raise factors.fail("a product of too many terms")
            product = product * factor
        total = total + product
        terms.append((sign_bit(coefficient), tuple((i, e % 2 == 1) for i, e in powers)))
    if total or not terms:
        raise entry.fail("the terms do not add up to 0")
    return Identity(tuple(terms))


def _power(entry: Entry, count: int) -> tuple[int, int]:
    number, exponent = entry.row("polynomial", "exponent")
    if number.integer() >= count:
        raise number.fail("there is no such polynomial")
    return number.integer(), exponent.integer(1)


def _read_line(entry: Entry, polys: Sequence[Poly]) -> Line:
    listed, samples = entry.fields("line", "samples")
    members = [e.integer() for e in listed.items()]
    values = [e.rational() for e in samples.items()]
    if not members or max(members) >= len(polys) or len(set(members)) < len(members):
        raise listed.fail("expected numbers of listed polynomials, each once")
    variables = {i for m in members for i in polys[m].variables}
    if len(variables) != 1 or not values or any(a >= b for a, b in pairwise(values)):
        raise entry.fail("expected polynomials in one variable, and ascending samples")
    x = variables.pop()
    columns = [_signs_at(polys[m], x, values, samples) for m in members]
    for place, column, m in zip(listed.items(), columns, members, strict=True):
        changes = sum(a != b for a, b in pairwise(column))
        if changes != count_real_roots(polys[m].to_univariate(x)):
            raise place.fail("the sign does not change at every real root")
    open_cells = list(zip(*columns, strict=True))
    cells = [open_cells[0]]
    for before, after in pairwise(open_cells):
        changing = [k for k, (a, b) in enumerate(zip(before, after, strict=True)) if a != b]
        if len(changing) > 1:
            raise samples.fail("two polynomials change sign between two neighbours")
        cells += [tuple(ZERO if k in changing else s for k, s in enumerate(before)), after]
    return Line(tuple(members), tuple(dict.fromkeys(cells)))


def _signs_at(poly: Poly, x: int, values: Sequence[Fraction], entry: Entry) -> list[int]:
    found = []
    for value in values:
        check_value(poly, x, value)
        sign = poly.at_rational(x, value).constant_value()
        if not sign:
            raise entry.fail("a sample is a root")
        found.append(sign_bit(sign))
    return found
