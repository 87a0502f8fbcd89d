"""Resultants of polynomials in several variables by subresultants."""

from __future__ import annotations

from qe.plain.terms import MASK, Terms, added, division, times


def resultant(a: Terms, b: Terms, place: int, count: int) -> Terms:
    """The resultant in the variable, one of ``count``, whose exponents begin at bit ``place``.

    By the subresultant sequence (Brown, Traub, J. ACM 18, 1971; Cohen, A Course in Computational Algebraic Number
    Theory, algorithm 3.3.7): all divisions are exact.
    """
    f, g = coefficients_in(a, place), coefficients_in(b, place)
    if not f or not g:
        return {}
    sign = 1
    if len(f) < len(g):
        f, g = g, f
        sign = -1 if (len(f) - 1) * (len(g) - 1) % 2 else 1
    lead: Terms = {0: 1}
    psi: Terms = {0: 1}
    while len(g) > 1:
        m, n = len(f) - 1, len(g) - 1
        if m * n % 2:
            sign = -sign
        scale = times(lead, _power(psi, m - n, count), count)
        rest = [division(c, scale, count)[0] for c in _pseudo_remainder(f, g, count)]
        f, g = g, rest
        if not g:
            return {}
        lead = f[-1]
        psi = _next(psi, lead, m - n, count)
    found = _next(psi, g[0], len(f) - 1, count)
    return found if sign > 0 else {k: -c for k, c in found.items()}


def _next(psi: Terms, lead: Terms, delta: int, count: int) -> Terms:
    """lead^delta / psi^(delta - 1)."""
    if delta <= 1:
        return lead if delta else psi
    return division(_power(lead, delta, count), _power(psi, delta - 1, count), count)[0]


def coefficients_in(a: Terms, place: int) -> list[Terms]:
    """The coefficients in a variable from degree 0 up; the last one is not 0."""
    found: list[Terms] = [{} for _ in range(max((k >> place & MASK for k in a), default=-1) + 1)]
    for k, c in a.items():
        e = k >> place & MASK
        found[e][k - (e << place)] = c
    return found


def _power(a: Terms, exponent: int, count: int) -> Terms:
    total: Terms = {0: 1}
    for _ in range(exponent):
        total = times(total, a, count)
    return total


def _pseudo_remainder(f: list[Terms], g: list[Terms], count: int) -> list[Terms]:
    """lc(g)^(m - n + 1) * f modulo g, without leading zeros."""
    rest, lead, n = list(f), g[-1], len(g) - 1
    for _ in range(len(f) - n):
        top = rest.pop()
        shift = len(rest) - n
        rest = [times(c, lead, count) for c in rest]
        if top:
            for k in range(n):
                rest[shift + k] = added(rest[shift + k], times(top, g[k], count), -1)
    while rest and not rest[-1]:
        rest.pop()
    return rest
