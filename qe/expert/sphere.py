"""Rule "sphere seen along a form": the values of a linear form in place of the points of a sphere or ball.

THEOREM. Let c > 0 be a number, b and l vectors of polynomials and e a polynomial without the variables v, and R = |b|^2
- 4*c*e. With w = 2*c*v + b, the sphere c*|v|^2 + b.v + e = 0 is |w|^2 = R, which is empty if R < 0. Where v are two
variables or more, it is connected or one point, so by Cauchy's inequality l.w takes exactly the values between
-|l|*sqrt(R) and |l|*sqrt(R) on it; on the ball <= 0 likewise, on the open ball < 0 those strictly between, if R > 0 and
l is not 0. As 2*c*(l.v) + l.b = l.w, the sphere and every condition in v may be replaced by R >= 0, (2*c*t + l.b)^2 <=
|l|^2*R and conditions in t, where these are the given ones with t = l.v. On a sphere a condition may be multiplied by
c, and a multiple of the equation subtracted from it; a product is compared factor by factor.

Evidence: ``sphere``, a conjunct of the block; ``variables`` v, the first of which is t afterwards; ``form`` l.v.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import mapped
from qe.proof.entry import formula_from_json


def check_sphere(claim: Claim, context: Context, limits: Limits) -> None:
    """The conditions are worked out again from the sphere and the form."""
    given, listed, entry = only(claim, "sphere", "variables", "form")
    before, names, part = claim.before, listed.names(), formula_from_json(given, claim.ring)
    if not isinstance(before, Exists) or len(names) < 2 or not set(names) <= set(before.variables):
        raise listed.fail("two variables of the block or more expected")
    if not isinstance(part, Atom) or part not in conjuncts(before.body):
        raise given.fail("a conjunct of the block expected")
    indices = [claim.ring.index[v] for v in names]
    sphere, form = _sphere(part, indices, claim), entry.polynomial(claim.ring)
    slopes = _linear(form, indices)
    if slopes is None or not any(slopes) or form - _dot(slopes, indices, claim):
        raise entry.fail("a linear form in these variables expected")
    length = _sum([p * p for p in slopes], claim)
    if sphere.relation is Relation.LT and not length.is_constant:
        raise entry.fail("the form may vanish, where nothing of the open ball is seen")

    def change(found: Atom) -> Formula:
        limits.tick()
        unit, factors = found.poly.factors()
        image = claim.ring.constant(unit)
        for factor, times in factors:
            image = image * _image(factor, sphere, form, slopes, indices, claim) ** times
        return atom(image, found.relation)

    rest = [mapped(p, change, (sphere.poly, form), claim) for p in conjuncts(before.body) if p != part]
    radicand = _sum([p * p for p in sphere.linear], claim) - 4 * sphere.lead * sphere.rest
    offset = _sum([p * q for p, q in zip(slopes, sphere.linear, strict=True)], claim)
    bound = (claim.ring.gen(indices[0]) * (2 * sphere.lead) + offset) ** 2 - length * radicand
    radius = TRUE if length.is_constant else atom(radicand, Relation.GE)  # it follows from the other where |l|^2 > 0
    values = atom(bound, Relation.LT if sphere.relation is Relation.LT else Relation.LE)
    left = [v for v in before.variables if v not in names[1:]]
    if claim.after != exists(left, conj((radius, values, *rest))):
        raise claim.fail("not what the values of the form on the sphere give")


@dataclass(frozen=True, slots=True)
class _Sphere:
    """poly = lead*|v|^2 + linear.v + rest; ``relation`` is =, <= or <."""

    poly: Poly
    lead: int
    linear: list[Poly]
    rest: Poly
    relation: Relation


def _sphere(part: Atom, indices: Sequence[int], claim: Claim) -> _Sphere:
    lead = part.poly.derivative(indices[0]).derivative(indices[0])
    if not lead.is_constant or not lead.constant_value():
        raise claim.fail("a sphere or ball expected")
    sign = 1 if lead.constant_value() > 0 else -1
    poly, half, relation = part.poly * sign, abs(lead.constant_value()) // 2, part.relation
    relation = relation if sign > 0 else relation.flipped
    linear = _linear(poly - _sum([claim.ring.gen(i) ** 2 * half for i in indices], claim), indices)
    if linear is None or relation not in (Relation.EQ, Relation.LE, Relation.LT):
        raise claim.fail("a sphere or ball expected")
    rest = poly - _sum([claim.ring.gen(i) ** 2 * half for i in indices], claim) - _dot(linear, indices, claim)
    return _Sphere(poly, half, linear, rest, relation)


def _linear(poly: Poly, indices: Sequence[int]) -> list[Poly] | None:
    """The coefficients of a polynomial that is linear in the variables, None for others."""
    slopes = [poly.derivative(i) for i in indices]
    return None if any(p.degree(i) for p in slopes for i in indices) else slopes


def _image(
    poly: Poly, sphere: _Sphere, form: Poly, slopes: Sequence[Poly], indices: Sequence[int], claim: Claim
) -> Poly:
    """A positive multiple of the polynomial where the sphere is, with t in place of the form."""
    if not any(poly.degree(i) for i in indices):
        return poly
    squares = poly.coefficients(indices[0])[2:]
    if sphere.relation is Relation.EQ and len(squares) == 1:
        poly = poly * sphere.lead - squares[0] * sphere.poly
    own = _linear(poly, indices)
    k = next(k for k, p in enumerate(slopes) if p)
    if own is None or (own[k] and own[k].gcd(slopes[k]) not in (slopes[k], -slopes[k])):
        raise claim.fail("a condition sees more of the sphere than the form")
    scale = own[k].exact_divide(slopes[k])
    left = poly - scale * form
    if any(left.degree(i) for i in indices):
        raise claim.fail("a condition sees more of the sphere than the form")
    return left + scale * claim.ring.gen(indices[0])


def _dot(vector: Sequence[Poly], indices: Sequence[int], claim: Claim) -> Poly:
    return _sum([p * claim.ring.gen(i) for p, i in zip(vector, indices, strict=True)], claim)


def _sum(polys: Sequence[Poly], claim: Claim) -> Poly:
    return sum(polys, claim.ring.constant(0))
