"""Whether a cubic is negative somewhere on an interval, by its coefficients there and its discriminant.

THEOREM. Let p = c_0 + … + c_3*x^3, P(X, Y) = c_0*Y^3 + c_1*X*Y^2 + c_2*X^2*Y + c_3*X^3, and I the interval from U/T to
V/W (T, W > 0, U/T < V/W); where it has no upper end, (V, W) = (1, 0), without a lower one (U, T) = (-1, 0). Let
P(s*U + t*V, s*T + t*W) = a*s^3 + b*s^2*t + c*s*t^2 + d*t^3, D the discriminant of p as a polynomial of degree 3. Then
    p >= 0 on I  iff  a >= 0, d >= 0, and b >= 0 and c >= 0, or D <= 0 and (a > 0 or b > 0) and (c > 0 or d > 0)
    p > 0 on I   iff  a > 0, d > 0, and b >= 0 and c >= 0, or D < 0          (for I bounded and closed)
PROOF. Up to positive factors p has on I the values of q(s, t) = P(…) for s, t >= 0, or s, t > 0, and the sign of the
discriminant of q is that of D, as it is multiplied by (U*W - V*T)^6. Where a, b, c, d >= 0, q >= 0 (and > 0 if a, d >
0). Let q >= 0. If D > 0, or D >= 0 and q > 0, q is a product of real linear forms that do not change their signs there,
so that all its coefficients are >= 0. If a = 0, b >= 0; if b = 0, too, c >= 0. The same holds for d and c. Let D <= 0
(a > 0 or b > 0) and (c > 0 or d > 0), a, d >= 0 and q(s, t) < 0: q is positive near both ends, so that it changes its
sign twice; with q = 0 at an end (a = 0 or d = 0), or the third root beside two simple ones, these are three real roots
that are different, and D > 0. If D < 0, q has one real root, and no sign there other than those at the ends.
Such conditions: Schmidt, Hess, Positivity of cubic polynomials on intervals and positive spline interpolation, BIT 28
(1988). By continuity it does not matter whether I has its ends where the question is p < 0.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Leaf

PARAMETERS_FROM = 3
"""With fewer parameters decomposition gives short answers."""

End = tuple[Poly, Poly]
"""Numerator and denominator of an end of the interval."""


def cubic_on_interval(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on a block of one variable over a cubic inequality and one or two bounds."""
    parts = conjuncts(body)
    if StepKind.CUBIC_INTERVAL not in context.enabled or len(variables) != 1 or len(parts) not in (2, 3):
        return None
    if body.ring is None or len(body.free) < 1 + PARAMETERS_FROM:
        return None
    x = body.ring.index[variables[0]]
    cubics = [part for part in parts if isinstance(part, Atom) and part.poly.degree(x) == 3]
    bounds = [part for part in parts if isinstance(part, Atom) and part.poly.degree(x) == 1]
    if len(cubics) != 1 or len(cubics) + len(bounds) != len(parts) or cubics[0].relation not in _BELOW:
        return None
    ends = interval(bounds, x)
    if ends is None:
        return None
    (lower, upper), strict = ends, not cubics[0].relation.is_strict
    if strict and (len(bounds) != 2 or any(part.relation.is_strict for part in bounds)):
        return None
    if context.facts.signs(upper[0] * lower[1] - lower[0] * upper[1]) != {1}:
        return None
    found = without_negative(cubics[0].poly * _BELOW[cubics[0].relation], x, ends, strict=strict)
    return Found(StepKind.CUBIC_INTERVAL, variables[0], Leaf((), nnf(found, negate=True)))


_BELOW = {Relation.LT: 1, Relation.LE: 1, Relation.GT: -1, Relation.GE: -1}
"""The sign of p where the condition is p < 0 or p <= 0."""


def interval(bounds: Sequence[Atom], x: int) -> tuple[End, End] | None:
    """The lower and upper end that bounds k*x + m give; None where they are not one interval, or k is no number."""
    ring = bounds[0].poly.ring
    zero, one = ring.constant(0), ring.constant(1)
    lower, upper = (-one, zero), (one, zero)
    seen: set[bool] = set()
    for bound in bounds:
        m, k = bound.poly.coefficients(x)
        if bound.relation not in _BELOW or not k.is_constant:
            return None
        size = k.constant_value()
        above = (size > 0) == (_BELOW[bound.relation] < 0)
        end = (m * (-1 if size > 0 else 1), ring.constant(abs(size)))
        lower, upper = (end, upper) if above else (lower, end)
        seen.add(above)
    return (lower, upper) if len(seen) == len(bounds) else None


def without_negative(p: Poly, x: int, ends: tuple[End, End], *, strict: bool) -> Formula:
    """p >= 0, or p > 0, on the interval."""
    powers = list(p.coefficients(x))
    a, b, c, d = on_edge(powers, ends)
    level = Relation.GT if strict else Relation.GE
    rounded = conj((atom(b, Relation.GE), atom(c, Relation.GE)))
    few = atom(discriminant(powers), Relation.LT if strict else Relation.LE)
    if not strict:
        few = conj((few, *(disj((atom(p, Relation.GT), atom(q, Relation.GT))) for p, q in ((a, b), (c, d)))))
    return conj((atom(a, level), atom(d, level), disj((rounded, few))))


def on_edge(powers: Sequence[Poly], ends: tuple[End, End]) -> tuple[Poly, ...]:
    """a, b, c, d of the theorem."""
    first, second = (tuple(end[k] for end in ends) for k in (0, 1))
    total = [powers[0].ring.constant(0)] * 4
    for i, coefficient in enumerate(powers):
        product = [coefficient]
        for s, t in [first] * i + [second] * (3 - i):
            product = [u * s + v * t for u, v in zip([*product, total[0] * 0], [total[0] * 0, *product], strict=True)]
        total = [u + v for u, v in zip(total, product, strict=True)]
    return tuple(total)


def discriminant(powers: Sequence[Poly]) -> Poly:
    """That of c_0 + c_1*x + c_2*x^2 + c_3*x^3."""
    a, b, c, d = powers
    return b**2 * c**2 - a * c**3 * 4 - b**3 * d * 4 + a * b * c * d * 18 - a**2 * d**2 * 27
