"""Sets of signs, and the lemmas that cut them down.

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

from qe.exact.ring import Poly, Ring
from qe.kernel.arithmetic.sturm import count_real_roots
from qe.kernel.limits import check_power, check_value
from qe.proof.entry import Entry, polynomial_from_json

NEGATIVE, ZERO, POSITIVE = 1, 2, 4
ANY = NEGATIVE | ZERO | POSITIVE
MOST_TERMS = 20_000
"""Terms of a product that is multiplied out, at most."""

Domains = list[int]
Term = tuple[int, tuple[tuple[int, bool], ...]]
"""The sign of a coefficient, and polynomials with whether their exponents are odd."""


def sign_bit(value: Fraction | int) -> int:
    """The set with the sign of a number."""
    return POSITIVE if value > 0 else NEGATIVE if value < 0 else ZERO


def _times(a: int, b: int) -> int:
    signs = {NEGATIVE: -1, ZERO: 0, POSITIVE: 1}
    return sum({sign_bit(signs[s] * signs[t]) for s in signs for t in signs if a & s and b & t})


PRODUCT = tuple(tuple(_times(a, b) for b in range(8)) for a in range(8))
SQUARE = tuple(sum({_times(s, s) for s in (NEGATIVE, ZERO, POSITIVE) if a & s}) for a in range(8))


@dataclass(frozen=True, slots=True, eq=False)
class Identity:
    """The sum of the terms is 0."""

    terms: tuple[Term, ...]

    @property
    def polynomials(self) -> tuple[int, ...]:
        """Those about whose signs it says something."""
        return tuple(dict.fromkeys(i for _, powers in self.terms for i, _ in powers))

    def cut(self, domains: Domains) -> list[int]:
        """The polynomials from which impossible signs were taken away; one without signs is a contradiction.

        A term may be positive where another may be negative, and conversely; it may be 0 where two others may cancel
        each other, or all others vanish.
        """
        values = [_product(unit, powers, domains) for unit, powers in self.terms]
        positive, negative = len([v for v in values if v & POSITIVE]), len([v for v in values if v & NEGATIVE])
        active, strict = len(values) - values.count(ZERO), len([v for v in values if not v & ZERO])
        changed = list[int]()
        if positive > 1 and negative > 1 and active > 2:
            return changed
        for (unit, powers), value in zip(self.terms, values, strict=True):
            up, down = positive > bool(value & POSITIVE), negative > bool(value & NEGATIVE)
            cancelling = up and down and active - (value != ZERO) > 1
            allowed = POSITIVE * down | NEGATIVE * up | ZERO * (cancelling or strict <= (not value & ZERO))
            if not value & ~allowed:
                continue
            for k, (i, odd) in enumerate(powers):
                rest = _product(unit, (*powers[:k], *powers[k + 1 :]), domains)
                of = {s: PRODUCT[rest][s if odd else SQUARE[s]] for s in (NEGATIVE, ZERO, POSITIVE) if domains[i] & s}
                kept = sum(s for s, signs in of.items() if signs & allowed)
                if kept != domains[i]:
                    domains[i] = kept
                    changed.append(i)
            if not powers:  # a number, of a sign that the others exclude
                domains[0] = 0
                return [*changed, 0]
        return changed


def _product(unit: int, powers: Sequence[tuple[int, bool]], domains: Domains) -> int:
    for i, odd in powers:
        unit = PRODUCT[unit][domains[i] if odd else SQUARE[domains[i]]]
    return unit


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """The sign vectors of polynomials in one variable."""

    polynomials: tuple[int, ...]
    cells: tuple[tuple[int, ...], ...]

    def cut(self, domains: Domains) -> list[int]:
        """As ``Identity.cut``."""
        before = [domains[i] for i in self.polynomials]
        cells = [cell for cell in self.cells if all(s & d for s, d in zip(cell, before, strict=True))]
        changed = []
        for k, i in enumerate(self.polynomials):
            domains[i] = sum({cell[k] for cell in cells})
            if domains[i] != before[k]:
                changed.append(i)
        return changed


Lemma = Identity | Line


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
    total, terms = ring.constant(0), list[Term]()
    for term in entry.items():
        number, factors = term.row("coefficient", "[[polynomial, exponent], ...]")
        coefficient = number.rational()
        if not coefficient or coefficient.denominator != 1:
            raise number.fail("expected an integer that is not 0")
        product, powers = ring.constant(int(coefficient)), dict[int, bool]()
        for power in factors.items():
            listed, exponent = (e.integer() for e in power.row("polynomial", "exponent"))
            if listed >= len(polys) or listed in powers or not exponent:
                raise power.fail("expected a listed polynomial, once in a product, and a positive exponent")
            check_power(polys[listed], exponent)
            factor = polys[listed] ** exponent
            if factor.term_count() * product.term_count() > MOST_TERMS:
                raise factors.fail("a product of too many terms")
            product, powers[listed] = product * factor, exponent % 2 == 1
        total = total + product
        terms.append((sign_bit(coefficient), tuple(powers.items())))
    if total or not terms:
        raise entry.fail("the terms do not add up to 0")
    return Identity(tuple(terms))


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
    rows = list(zip(*columns, strict=True))
    cells = [rows[0]]
    for before, after in pairwise(rows):
        between = tuple(a if a == b else ZERO for a, b in zip(before, after, strict=True))
        if sum(a != b for a, b in zip(before, after, strict=True)) > 1:
            raise samples.fail("two polynomials change sign between two neighbours")
        cells += [between, after]
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
