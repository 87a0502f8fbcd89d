"""Common divisors and squarefree parts over an algebraic point, by remainder sequences of polynomial coefficients.

The coefficients of a polynomial over a point are polynomials in the point's coordinates, of small degree however
large the degrees of the coordinates are. So nothing is inverted or reduced: pseudo-division multiplies by leading
coefficients proved not to vanish at the point, which changes no roots; only zero tests are made at the point.
"""

from __future__ import annotations

from collections.abc import Callable

from qe.exact.ring import Poly
from qe.exact.watch import IDLE, Watch, watched_product

Coefficients = tuple[Poly, ...]


def squarefree_coefficients(f: Coefficients, vanishes: Callable[[Poly], bool], watch: Watch = IDLE) -> Coefficients:
    """The coefficients (low to high) of a polynomial with the same roots at the point, all simple.

    ``f``: coefficients of a polynomial of degree at least 1 whose leading one does not vanish at the point. ``watch``
    is asked between products.
    """
    slope = tuple(k * c for k, c in enumerate(f))[1:]
    common = common_coefficients(f, slope, vanishes, watch)
    return f if len(common) == 1 else _primitive(_pseudo_divide(f, common, watch)[0], watch)


def common_coefficients(
    f: Coefficients, g: Coefficients, vanishes: Callable[[Poly], bool], watch: Watch = IDLE
) -> Coefficients:
    """A greatest common divisor at the point (Euclid), with a leading coefficient that does not vanish there.

    ``f`` and ``g``: coefficients low to high, not all vanishing.
    """
    f, g = _trimmed(f, vanishes), _trimmed(g, vanishes)
    if len(f) < len(g):
        f, g = g, f
    while len(g) > 1:
        f, g = g, _primitive(_trimmed(_pseudo_divide(f, g, watch)[1], vanishes), watch)
    return g or f


def _pseudo_divide(f: Coefficients, g: Coefficients, watch: Watch) -> tuple[Coefficients, Coefficients]:
    """(q, r) with lc(g)^k * f = q*g + r and r of lower degree than g."""
    rest, quotient = list(f), [f[0].ring.constant(0)] * max(0, len(f) - len(g) + 1)
    for k in range(len(quotient) - 1, -1, -1):
        lead = rest.pop()
        quotient = [watched_product(c, g[-1], watch) for c in quotient]
        quotient[k] = quotient[k] + lead
        rest = [watched_product(c, g[-1], watch) for c in rest]
        for i, c in enumerate(g[:-1]):
            rest[k + i] = rest[k + i] - watched_product(lead, c, watch)
    return tuple(quotient), tuple(rest)


def _trimmed(f: Coefficients, vanishes: Callable[[Poly], bool]) -> Coefficients:
    """Without the leading coefficients that vanish at the point."""
    while f and vanishes(f[-1]):
        f = f[:-1]
    return f


def _primitive(f: Coefficients, watch: Watch) -> Coefficients:
    """Divided by a common factor of the coefficients; it does not vanish at the point, as the leading one does not."""
    if not f:
        return f
    shared = f[-1]
    for c in f[:-1]:
        watch()
        shared = shared.gcd(c)
    return f if shared.is_constant and abs(shared.constant_value()) == 1 else tuple(c.exact_divide(shared) for c in f)


def divides(f: Poly, g: Poly) -> bool:
    """Whether a polynomial that is no constant divides another."""
    return all(f.degree(i) <= g.degree(i) for i in f.variables) and f.gcd(g).normal()[1] == f.normal()[1]
