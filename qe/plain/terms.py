"""Polynomials over the integers as dictionaries from monomials to coefficients: products, divisions, common divisors.

A monomial is one integer with ``WIDTH`` bits for each exponent, the first variable in the highest ones: products of
monomials are sums, and the lexicographic order is that of the integers. The highest bit of each exponent is 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, reduce
from heapq import heapify, heappop, heappush
from math import gcd
from operator import or_

WIDTH = 32
MASK = (1 << WIDTH) - 1
Terms = dict[int, int]


@cache
def guard(count: int) -> int:
    """The highest bits of so many exponents: a difference of monomials has one of them where one is negative."""
    return sum(1 << (WIDTH * k + WIDTH - 1) for k in range(count))


def content(a: Terms) -> int:
    """The greatest common divisor of the coefficients."""
    return gcd(*a.values())


def divided(a: Terms, number: int) -> Terms:
    """The terms over an integer that divides all coefficients."""
    return a if number == 1 else {k: c // number for k, c in a.items()}


def added(a: Terms, b: Terms, factor: int = 1) -> Terms:
    """a + factor*b."""
    total = dict(a)
    for k, c in b.items():
        value = total.get(k, 0) + factor * c
        if value:
            total[k] = value
        else:
            del total[k]
    return total


def times(a: Terms, b: Terms, count: int) -> Terms:
    """The product of polynomials in ``count`` variables."""
    if len(a) > len(b):
        a, b = b, a
    total: Terms = {}
    get = total.get
    for k, c in a.items():
        for l, d in b.items():
            m = k + l
            total[m] = get(m, 0) + c * d
    if reduce(or_, total, 0) & guard(count):
        raise OverflowError("an exponent is too large")
    return {k: c for k, c in total.items() if c}


def division(a: Terms, b: Terms, count: int) -> tuple[Terms, Terms]:
    """(q, r) with a = q*b + r, in the lexicographic order of ``count`` variables: in r no monomial is divisible by the
    leading one of b, or its coefficient is smaller.
    """
    lead, bits = max(b), guard(count)
    top = b[lead]
    if len(b) == 1 and all(c % top == 0 and k >= lead and not (k - lead) & bits for k, c in a.items()):
        return {k - lead: c // top for k, c in a.items()}, {}
    rest = [(k, c) for k, c in b.items() if k != lead]
    quotient: Terms = {}
    remainder: Terms = {}
    pending = dict(a)
    order = [-k for k in pending]
    heapify(order)
    while pending:
        m = -heappop(order)
        c = pending.pop(m, 0)
        shift = m - lead
        factor = 0 if shift < 0 or shift & bits else c // top if (c < 0) == (top < 0) else -(-c // top)
        if c != factor * top:
            remainder[m] = c - factor * top
        if factor:
            quotient[shift] = factor
            for l, d in rest:
                k = l + shift
                value = pending.get(k)
                if value is None:
                    heappush(order, -k)
                    pending[k] = -factor * d
                elif value == factor * d:
                    del pending[k]
                else:
                    pending[k] = value - factor * d
    return quotient, remainder


def at_fraction(a: Terms, place: int, p: int, q: int = 1, degree: int = 0) -> Terms:
    """q^degree times the value at p/q of the variable whose exponents begin at bit ``place``."""
    total: Terms = {}
    powers: dict[int, int] = {}
    for k, c in a.items():
        e = k >> place & MASK
        if e not in powers:
            powers[e] = p**e if q == 1 else p**e * q ** (degree - e)
        k -= e << place
        total[k] = total.get(k, 0) + c * powers[e]
    return {k: c for k, c in total.items() if c}


def common_divisor(a: Terms, b: Terms, places: Sequence[int]) -> Terms:
    """The greatest common divisor, with a positive leading coefficient, of polynomials in the variables at ``places``.

    THEOREM (Char, Geddes, Gonnet, J. Symbolic Comput. 7, 1989). Let a and b be primitive, x an integer above 2*min(|a|,
    |b|) + 1, for the largest coefficients, and h the gcd of a and b with x for a variable. If the primitive part of the
    polynomial whose value at x is h, with coefficients of absolute value at most x/2, divides a and b, it is their gcd.
    Where it does not, a larger x is tried; from some x on it does.
    """
    if not a or not b:
        c = a or b
        return {k: -d for k, d in c.items()} if c and c[max(c)] < 0 else c
    number, count = gcd(content(a), content(b)), max(places, default=0) // WIDTH + 1
    places = [p for p in places if any(k >> p & MASK for k in a) or any(k >> p & MASK for k in b)]
    if not places or len(a) == len(b) == 1:
        return {sum(min(*(k >> p & MASK for k in (*a, *b))) << p for p in places): number}
    a, b = divided(a, content(a)), divided(b, content(b))
    place, x = places[0], 2 * min(max(map(abs, a.values())), max(map(abs, b.values()))) + 29
    while True:
        low, high = at_fraction(a, place, x), at_fraction(b, place, x)
        if low and high:
            found = _with_digits(common_divisor(low, high, places[1:]), place, x)
            found = divided(found, content(found) if found[max(found)] > 0 else -content(found))
            if not division(a, found, count)[1] and not division(b, found, count)[1]:
                return {k: number * c for k, c in found.items()}
        x = x * 73794 // 27011


def _with_digits(a: Terms, place: int, x: int) -> Terms:
    """The polynomial whose value at x is a, with coefficients of absolute value at most x/2."""
    found: Terms = {}
    for k, c in a.items():
        while c:
            digit = c % x
            digit -= x if 2 * digit > x else 0
            if digit:
                found[k] = digit
            c, k = (c - digit) // x, k + (1 << place)
    return found
