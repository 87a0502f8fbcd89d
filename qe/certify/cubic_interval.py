"""Rule "cubic on an interval": bounds of a variable x and one condition p < 0 or p <= 0 of degree 3 in it.

THEOREM. Let P be the cubic form with p(x) = P(x, 1), u and v plane vectors with second coordinates >= 0 such that the
interval is made of the quotients of the coordinates of s*u + t*v (s, t >= 0 not both 0), without infinity, and let
a, b, c, d be the coefficients of q(s, t) = P(s*u + t*v): a = P(u), b = v.grad P(u), c = u.grad P(v), d = P(v). The
discriminant of q is that of P times det(u, v)^6; let D be that of P. q is nowhere negative for s, t >= 0 iff
    a >= 0, d >= 0, and b, c >= 0 or (D <= 0 and (a > 0 or b > 0) and (c > 0 or d > 0)).
If D > 0, q has three different real roots; if it is not negative none of them is between the ends, q is a product of
three linear forms with coefficients of one sign each, and b, c >= 0. Otherwise, a = 0 leaves the factor
b*s^2 + c*s*t + d*t^2, which is not negative, so that b >= 0, and b = 0 leaves c >= 0; the same at the other end. The
other way round, let D <= 0, q be positive near both ends by a > 0 or b > 0, and d > 0 or c > 0, and negative between:
it changes its sign twice, at simple roots, and the third root is another real one (at an end, or as no root there has
even order), so that D > 0. And q > 0 for all such s, t iff
    a > 0, d > 0, and b, c >= 0 or D < 0:
if q > 0 and D >= 0, all roots are real, and b, c >= 0 as above; if D < 0 there is one real root, and a sign that
changes between the ends would change back there. p < 0 somewhere on the closed interval iff somewhere inside, and iff
q < 0 somewhere, also where v is at infinity.

Evidence: ``theory``, by which the ends are in order.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.certify.block import existential
from qe.certify.boolean import ByLemmas, Goal, equivalence
from qe.certify.negation import negation
from qe.certify.step import Claim, Context, only, outside
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import And, Atom, Exists, Formula, Relation

Vector = tuple[Poly, Poly]


def cubic_interval_goals(claim: Claim, context: Context) -> list[Goal]:
    """The ends are in order, and what stands after denies that the cubic is not negative (positive) on the interval."""
    only(claim, "theory")
    before, after = existential(claim)
    if not isinstance(before, Exists) or len(before.variables) != 1 or not isinstance(before.body, And):
        raise claim.fail("a block of one variable over several conditions expected")
    x = claim.ring.index[before.variables[0]]
    parts = [part for part in before.body.args if isinstance(part, Atom) and part.relation in _TURNED]
    cubics = [part for part in parts if part.poly.degree(x) == 3]
    bounds = [part for part in parts if part.poly.degree(x) == 1]
    if len(cubics) != 1 or 1 + len(bounds) != len(before.body.args):
        raise claim.fail("one inequality of degree 3 and bounds expected")
    u, v = _ends(bounds, x, claim)
    weak = cubics[0].relation in (Relation.LE, Relation.GE)
    if weak and (len(bounds) < 2 or any(part.relation in (Relation.LT, Relation.GT) for part in bounds)):
        raise claim.fail("a closed and bounded interval expected")
    found = _not_negative(cubics[0].poly * _TURNED[cubics[0].relation], x, (u, v), positive=weak)
    inside = outside(context, before.variables)
    ordered = atom(v[0] * u[1] - u[0] * v[1], Relation.LE)
    return [(*inside, ordered), *equivalence(negation(found), after, inside)]


check_cubic_interval = ByLemmas(cubic_interval_goals)

_TURNED = {Relation.LT: 1, Relation.LE: 1, Relation.GT: -1, Relation.GE: -1}


def _ends(bounds: Sequence[Atom], x: int, claim: Claim) -> tuple[Vector, Vector]:
    """The vectors u, v of the lower and the upper end; those of infinity where there is none."""
    zero, one = claim.ring.constant(0), claim.ring.constant(1)
    lower: list[Vector] = []
    upper: list[Vector] = []
    for bound in bounds:
        p = bound.poly * _TURNED[bound.relation]  # p <= 0
        slope = p.derivative(x)
        if not slope.is_constant:
            raise claim.fail("bounds with a number as coefficient expected")
        rest = p - slope * claim.ring.gen(x)
        if slope.constant_value() > 0:
            upper.append((-rest, slope))
        else:
            lower.append((rest, -slope))
    if len(lower) > 1 or len(upper) > 1 or not bounds:
        raise claim.fail("one bound on a side expected")
    return (lower or [(-one, zero)])[0], (upper or [(one, zero)])[0]


def _not_negative(p: Poly, x: int, ends: tuple[Vector, Vector], *, positive: bool) -> Formula:
    """p >= 0, or p > 0, on the interval."""
    form = p.coefficients(x)
    (a, b), (d, c) = _value_and_slope(form, *ends), _value_and_slope(form, ends[1], ends[0])
    negative = atom(_discriminant(form), Relation.LT if positive else Relation.LE)
    at_least = Relation.GT if positive else Relation.GE
    other = [negative]
    if not positive:
        other += [disj((atom(f, Relation.GT), atom(g, Relation.GT))) for f, g in ((a, b), (c, d))]
    either = disj((conj((atom(b, Relation.GE), atom(c, Relation.GE))), conj(other)))
    return conj((atom(a, at_least), atom(d, at_least), either))


def _value_and_slope(form: Sequence[Poly], at: Vector, along: Vector) -> tuple[Poly, Poly]:
    """P(at), and the derivative of P there along a vector."""
    (x, y), (g, h) = at, along
    e, f, k, m = form
    value = e * y**3 + f * x * y**2 + k * x**2 * y + m * x**3
    by_x = f * y**2 + k * x * y * 2 + m * x**2 * 3
    by_y = e * y**2 * 3 + f * x * y * 2 + k * x**2
    return value, g * by_x + h * by_y


def _discriminant(form: Sequence[Poly]) -> Poly:
    """By the Hessian (f^2 - 3*e*k, f*k - 9*e*m, k^2 - 3*f*m), whose discriminant is -3 times that of the cubic."""
    e, f, k, m = form
    middle = f * k - e * m * 9
    return ((f * f - e * k * 3) * (k * k - f * m * 3) * 4 - middle * middle).exact_divide(e.ring.constant(3))
