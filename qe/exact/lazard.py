"""Lazard evaluation (Lazard 1994; McCallum, Parusiński, Păunescu, JSC 2019, arXiv 1607.00264, Def. 4).

For f of level k and a point (a_0, …, a_{k-1}): for i = 0, 1, …, divide f by the highest power v_i of
(x_i - a_i) that divides it and put x_i = a_i. Up to the nonzero factor 1/v_i! the quotient at a_i is the
v_i-th partial derivative there, where v_i is the least order for which that derivative, restricted to the
coordinates so far, is not identically zero in the later variables.
"""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.exact.sample import Point


def lazard_evaluation(point: Point, f: Poly) -> Poly:
    """A polynomial whose substitution at the point is a nonzero multiple of the Lazard evaluation of f.

    Variables 0..depth-1 that are rational are substituted; algebraic ones stay, to be evaluated.
    """
    return point.reduce(lazard_derivative(point, f))


def lazard_derivative(point: Point, f: Poly) -> Poly:
    """The partial derivative of f whose value at the point is a nonzero multiple of the Lazard evaluation of f."""
    for i in range(point.depth):
        prefix = point.ancestor(i + 1)
        while _identically_zero(prefix, f):
            f = f.derivative(i)
    return f


def _identically_zero(prefix: Point, f: Poly) -> bool:
    """Whether f, restricted to the prefix, is the zero polynomial in the later variables."""
    g = prefix.reduce(f)
    if not g:
        return True
    if not prefix.algebraic:
        return False
    return all(prefix.vanishes(c) for c in g.coefficients_in(range(prefix.depth, g.ring.size)))
