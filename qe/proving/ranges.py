"""Bounds that follow one after the other, as lemmas about signs of polynomials.

A condition p <= 0 is a term c*x^k and others, each of which is at least a number within the bounds so far: p is the sum
of c*x^k + m and of differences that are not negative. What that says of x is a matter of one line. The difference of
a product P*X and its least value is one of products of differences for P and X.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import permutations
from math import inf, lcm, prod

from qe.exact.ring import Poly
from qe.formula.syntax import FALSE, Atom, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.limits import check_value
from qe.kernel.step import Claim, only
from qe.proof.entry import Entry, Json
from qe.proving.lemma_list import Lemmas, Term
from qe.proving.made import Made
from qe.rules.ranges import Number, at_most_zero, power_range, times
from qe.simplifier.facts import factor_list

Ends = tuple[Number, Number]
Powers = tuple[tuple[Poly, int], ...]
EVERYTHING: Ends = (-inf, inf)


def by_ranges(made: Made, after: Formula) -> None:
    """A conjunction that fails within bounds that follow from it."""
    claim, before = made.claim, made.current
    listed, last = only(claim, "bounds", "fails")
    if after != FALSE or not isinstance(before, Exists):
        raise claim.fail("a block that is replaced by FALSE expected")
    ranges, parts = _Ranges(claim), conjuncts(before.body)
    for entry in listed.items():
        made.limits.tick()
        condition, name, power, side, value = entry.row("condition", "variable", "power", "side", "value")
        i = claim.ring.index.get(name.text())
        if i is None or side.integer(-1) not in (1, -1):
            raise entry.fail("a variable and a side expected")
        for poly in _at_most_zero(parts, condition):
            ranges.follow(poly, i, power.integer(1))
        low, high = ranges.ends.get(i, EVERYTHING)
        ranges.ends[i] = (low, value.rational()) if side.integer(-1) == 1 else (value.rational(), high)
        ranges.about(claim.ring.gen(i) * value.rational().denominator - value.rational().numerator)
    for poly in _at_most_zero(parts, last):
        ranges.follow(poly, None, 0)
    made.signs(before, after, ranges.evidence(), made.known)


def _at_most_zero(parts: tuple[object, ...], entry: Entry) -> Iterator[Poly]:
    """Polynomials that are at most 0."""
    k = entry.integer()
    part = parts[k] if k < len(parts) else None
    if not isinstance(part, Atom):
        raise entry.fail("a comparison expected")
    yield from at_most_zero(part)


@dataclass(slots=True)
class _Ranges:
    """``ends`` of variables so far; ``lines``: irreducible polynomials of one variable each, by variable."""

    claim: Claim
    ends: dict[int, Ends] = field(default_factory=dict)
    lemmas: Lemmas = field(init=False)
    lines: dict[int, dict[Poly, None]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.lemmas = Lemmas(self.claim.ring)

    def evidence(self) -> Json:
        for i, polys in self.lines.items():
            self.lemmas.line(list(polys), i)
        return self.lemmas.only(range(len(self.lemmas.lemmas)))

    def about(self, poly: Poly) -> None:
        """The signs of a polynomial of one variable are looked at on its line."""
        if len(poly.variables) != 1:
            return
        factors = [(f, e) for f, e in factor_list(poly.normal()[1]) if not f.is_constant]
        self.lines.setdefault(poly.variables[0], {}).update(dict.fromkeys(f for f, _ in factors))
        if sum(e for _, e in factors) > 1:
            whole = prod((f**e for f, e in factors), start=poly.ring.constant(1))
            self.lemmas.identity([(1, ((whole, 1),)), (-1, tuple(factors))])
            linear = [f for f, e in factors if e == 1 and f.total_degree == 1]
            for f, g in permutations(linear, 2) if len(factors) == 2 == len(linear) else ():
                a, b = (q.leading(q.variables[0]).constant_value() for q in (f, g))
                distance = (g * a - f * b).constant_value()  # a*f*g = b*f^2 + distance*f: no case has to be looked at
                self.lemmas.identity([(a, ((whole, 1),)), (-b, ((f, 2),)), (-distance, ((f, 1),))])

    def follow(self, poly: Poly, alone: int | None, power: int) -> None:
        """p is the sum of what one term and a number make, and of differences that are not negative."""
        number, kept, rest = Fraction(0), poly.ring.constant(0), list[tuple[int, Powers, Fraction]]()
        for powers, c in poly.sparse_terms():
            if powers == ((alone, power),):
                kept = poly.ring.gen(powers[0][0]) ** power * c
                continue
            least = self.ends_of(powers)[0 if c > 0 else 1]
            if not isinstance(least, Fraction):
                return
            number += c * least
            if powers:
                rest.append((c, tuple((poly.ring.gen(i), e) for i, e in powers), least))
        scale = lcm(number.denominator, *(least.denominator for _, _, least in rest))
        left = kept * scale + int(number * scale)
        self.about(left)
        terms: list[Term] = [(scale, ((poly, 1),)), (-1, ((left, 1),))]
        terms += [(-c * scale // least.denominator, ((_less(p, least)[0], 1),)) for c, p, least in rest]
        self.lemmas.identity(terms)

    def ends_of(self, powers: tuple[tuple[int, int], ...]) -> Ends:
        """The range of a product of powers, with lemmas for it."""
        ring, product = self.claim.ring, tuple[tuple[Poly, int], ...]()
        total: Ends = Fraction(1), Fraction(1)
        for i, e in powers:
            for end in self.ends.get(i, ()):
                check_value(ring.gen(i) ** e, i, end if isinstance(end, Fraction) else Fraction(0))
            one = ((ring.gen(i), e),)
            ends = power_range(*self.ends.get(i, EVERYTHING), e)
            self.about(ring.gen(i))
            for end in ends:
                if isinstance(end, Fraction):
                    self.about(_less(one, end)[0])
            total = self.joined(product, total, one, ends) if product else ends
            product = (*product, *one)
        return total

    def joined(self, p: Powers, of_p: Ends, x: Powers, of_x: Ends) -> Ends:
        """The range of a product."""
        values = [times(u, v) for u in of_p for v in of_x]
        for end, side in ((min(values), 1), (max(values), -1)):
            if isinstance(end, Fraction):
                self._least(p, of_p, x, of_x, end, side)
        return min(values), max(values)

    def _least(self, p: Powers, of_p: Ends, x: Powers, of_x: Ends, end: Fraction, side: int) -> None:
        """side*(P*X - end) as a sum of products that are not negative."""
        for (one, ends), (other, others) in (((p, of_p), (x, of_x)), ((x, of_x), (p, of_p))):
            if others[0] >= 0 or others[1] <= 0:  # the other factor has one sign: this one at an end, then that one
                first = ends[0] if (others[0] >= 0) == (side > 0) else ends[1]
                if not isinstance(first, Fraction):
                    continue
                second = others[0] if (first >= 0) == (side > 0) else others[1]
                products: list[Product] = [(Fraction(1), [_less(one, first)], other)]
                if first and isinstance(second, Fraction):
                    products.append((first, [_less(other, second)], ()))
                return self._sum((*p, *x), end, products)
        (a, b), (c, d) = of_p, of_x
        a, b, c, d = (Fraction(end) for end in (a, b, c, d))  # a finite end says that all are
        weight = 1 / ((b - a) * (d - c))
        corners = [(a, b, c, d, 1), (a, b, d, c, -1), (b, a, c, d, -1), (b, a, d, c, 1)]
        return self._sum(
            (*p, *x),
            end,
            [((u * v - end) * weight * sign, [_less(p, s), _less(x, t)], ()) for u, s, v, t, sign in corners],
        )

    def _sum(self, whole: Powers, end: Fraction, products: list[Product]) -> None:
        """The whole less its end is the sum of the products."""
        listed = [(Fraction(-1), [_less(whole, end)], ()), *(entry for entry in products if entry[0])]
        weights = [w / prod(denominator for _, denominator in factors) for w, factors, _ in listed]
        scale = lcm(*(w.denominator for w in weights))
        self.lemmas.identity(
            (int(w * scale), (*((poly, 1) for poly, _ in factors), *powers))
            for w, (_, factors, powers) in zip(weights, listed, strict=True)
        )


Product = tuple[Fraction, list[tuple[Poly, int]], Powers]
"""A number, differences over their denominators, and powers."""


def _less(powers: Powers, end: Fraction) -> tuple[Poly, int]:
    """The product of powers less a number, times the denominator of that, and the denominator."""
    whole = prod((poly**e for poly, e in powers), start=powers[0][0].ring.constant(1))
    return whole * end.denominator - end.numerator, end.denominator
