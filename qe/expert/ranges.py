"""Rule "ranges that exclude each other": a conjunction is false because bounds of its variables follow one after the
other from its conditions, and one condition cannot hold within them.

THEOREM. Let p <= 0, c*x^k a term of p, and let the other terms together be at least -m for all values within the
bounds so far. Then c*x^k <= m. So for odd k and c > 0, x <= b if b^k >= m/c; for odd k and c < 0, x >= b if b^k <= m/c;
for even k and c > 0, |x| <= |b| if b^k >= m/c. If the terms of p together are at least s within the bounds, p <= 0
fails for s > 0, and p < 0 for s >= 0.

Evidence: ``bounds``, each [condition, variable, k, side, b] with side 1 for an upper bound and -1 for a lower one; and
which condition ``fails``.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import inf

from qe.exact.ring import Poly
from qe.formula.syntax import FALSE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.limits import check_value
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Entry

Number = Fraction | float
"""A rational number, or an infinity."""

Ends = tuple[Number, Number]
"""Lower and upper end."""

EVERYTHING: Ends = (-inf, inf)


def check_ranges(claim: Claim, context: Context, limits: Limits) -> None:
    """Every bound follows from those before it, and the condition named last fails."""
    listed, last = only(claim, "bounds", "fails")
    before, after = existential(claim)
    if after != FALSE or not isinstance(before, Exists):
        raise claim.fail("a block that is replaced by FALSE expected")
    parts, ranges = conjuncts(before.body), dict[int, Ends]()
    for entry in listed.items():
        limits.tick()
        condition, name, power, side, value = entry.row("condition", "variable", "power", "side", "value")
        i, upper = claim.ring.index.get(name.text()), side.integer(-1) == 1
        if i is None or side.integer(-1) not in (-1, 1):
            raise entry.fail("a variable and a side (1 or -1) expected")
        number = value.rational()
        _follows(claim, _part(claim, parts, condition), i, power.integer(1), upper, number, ranges)
        low, high = ranges.get(i, EVERYTHING)
        ranges[i] = (low, number) if upper else (number, high)
    failing = _part(claim, parts, last)
    for poly, strict in _at_most_zero(failing):
        least = _least(poly.terms(), ranges, poly)
        if least is not None and (least > 0 or (strict and least == 0)):
            return
    raise claim.fail("the last condition may hold within the bounds")


def _part(claim: Claim, parts: tuple[Formula, ...], entry: Entry) -> Atom:
    k = entry.integer()
    found = parts[k] if k < len(parts) else None
    if not isinstance(found, Atom):
        raise claim.fail("a comparison expected")
    return found


def _at_most_zero(found: Atom) -> Iterator[tuple[Poly, bool]]:
    """Polynomials that are at most 0, and whether they are less."""
    strict = found.relation in (Relation.LT, Relation.GT)
    if found.relation in (Relation.LT, Relation.LE, Relation.EQ):
        yield found.poly, strict
    if found.relation in (Relation.GT, Relation.GE, Relation.EQ):
        yield -found.poly, strict


def _follows(
    claim: Claim, found: Atom, i: int, power: int, upper: bool, value: Fraction, ranges: dict[int, Ends]
) -> None:
    """Raise unless the bound follows from the condition."""
    if power > found.poly.degree(i):
        raise claim.fail("there is no such term")
    check_value(found.poly, i, value)
    alone = tuple(power if j == i else 0 for j in range(claim.ring.size))
    for poly, _ in _at_most_zero(found):
        terms = dict(poly.terms())
        c = terms.pop(alone, 0)
        rest = _least(list(terms.items()), ranges, poly)
        if not c or rest is None:
            continue
        most = -rest / c
        if power % 2 and (c > 0) is upper and (value**power >= most if upper else value**power <= most):
            return
        outside = value >= 0 if upper else value <= 0
        if power % 2 == 0 and c > 0 and outside and value**power >= most:
            return
    raise claim.fail("a bound does not follow")


def _least(terms: list[tuple[tuple[int, ...], int]], ranges: dict[int, Ends], poly: Poly) -> Fraction | None:
    """A number that terms of a polynomial together are never below; None where none is known."""
    for i in poly.variables:
        for end in ranges.get(i, ()):
            check_value(poly, i, end if isinstance(end, Fraction) else Fraction(0))
    total = Fraction(0)
    for exponents, c in terms:
        ends: Ends = (Fraction(1), Fraction(1))
        for i, k in enumerate(exponents):
            if k:
                ends = _product(ends, _powers(ranges.get(i, EVERYTHING), k))
        lowest = ends[0] if c > 0 else ends[1]
        if isinstance(lowest, float):
            return None
        total += c * lowest
    return total


def _powers(ends: Ends, k: int) -> Ends:
    """The range of x^k."""
    low, high = (_raised(end, k) for end in ends)
    if k % 2:
        return low, high
    sizes: list[Number] = [max(low, -low), max(high, -high)]
    return (Fraction(0) if ends[0] <= 0 <= ends[1] else min(sizes)), max(sizes)


def _raised(end: Number, k: int) -> Number:
    """The power of an end; infinities stay what they are."""
    return end**k if isinstance(end, Fraction) else end


def _product(a: Ends, b: Ends) -> Ends:
    """The range of a product."""
    found = [_times(u, v) for u in a for v in b]
    return min(found), max(found)


def _times(u: Number, v: Number) -> Number:
    if u == 0 or v == 0:
        return Fraction(0)  # the other factor is some real number, however large
    if isinstance(u, Fraction) and isinstance(v, Fraction):
        return u * v
    return inf if (u > 0) == (v > 0) else -inf
