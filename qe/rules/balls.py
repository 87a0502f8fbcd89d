"""Two balls, spheres or outsides of balls have a common point: a closed form in any dimension.

THEOREM. Let x be n >= 2 variables and c, k > 0 numbers, b, l vectors and e, m polynomials without x, and
D = |k*b - c*l|^2, R = k^2*(|b|^2 - 4*c*e), S = c^2*(|l|^2 - 4*k*m), G = D - R - S, H = S - D - R, and let there be
relations after p = c*|x|^2 + b.x + e and q = k*|x|^2 + l.x + m. There is an x with both if and only if
    p <= 0, q <= 0:  R >= 0, S >= 0 and NEAR           p = 0, q = 0:  R >= 0, S >= 0 and G^2 <= 4*R*S
    p = 0, q <= 0:   R >= 0, and H >= 0 or H^2 <= 4*D*R; or: R >= 0, S >= 0, NEAR, and R <= S or FAR
    p <= 0 or p = 0, q >= 0:  R >= 0, and H <= 0 or H^2 <= 4*D*R; or: R >= 0, and S <= R or FAR
with NEAR for G <= 2*sqrt(R*S) and FAR for G >= -2*sqrt(R*S). Where p < 0, R > 0 stands for R >= 0, where q < 0, S > 0;
where one relation is strict, strict ones stand in NEAR, FAR and all that follows "and".
PROOF. Scaled by 2*c*k, p and q compare the distances u, v of x from -k*b and -c*l with r = sqrt(R) and s = sqrt(S). In
dimension 2 and more they take all values with |u - v| <= d <= u + v, where d = sqrt(D). NEAR says d <= r + s, and FAR
d >= |r - s|. For u <= r the values of v are from max(0, d - r) to d + r, for u = r from |d - r| on. So v = s for u = r
says |d - r| <= s <= d + r, that is H^2 <= 4*D*R, and H^2 - 4*D*R = G^2 - 4*R*S; v <= s says |d - r| <= s, that is
H >= -2*d*r, or d <= r + s and (r <= s or d >= r - s); v >= s says s <= d + r, that is H <= 2*d*r, or S <= R (also where
S < 0) or d >= s - r. Strict relations leave the ends out.
G <= 2*sqrt(R*S) is G <= 0 or G^2 <= 4*R*S; where 4*R*S = T^2, it is G <= |T|, and then it is used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import isqrt

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Leaf


@dataclass(frozen=True, slots=True)
class Ball:
    """lead*|x|^2 + linear.x + rest <= 0, < 0 if ``strict``; lead > 0."""

    lead: int
    linear: tuple[Poly, ...]
    rest: Poly
    strict: bool

    @staticmethod
    def of(part: Formula, indices: Sequence[int]) -> Ball | None:
        """The ball that a conjunct describes in these variables, or None."""
        if not isinstance(part, Atom) or part.relation in (Relation.EQ, Relation.NE):
            return None
        poly = part.poly if part.relation in (Relation.LE, Relation.LT) else -part.poly
        squares = {poly.coefficients(i)[2] if poly.degree(i) == 2 else None for i in indices}
        lead = squares.pop()
        if squares or lead is None or not lead.is_constant or lead.constant_value() <= 0:
            return None
        ring, rest, linear = poly.ring, poly, []
        for i in indices:
            rest = rest - lead * ring.gen(i) ** 2
            slope = rest.derivative(i)
            linear.append(slope)
            rest = rest - slope * ring.gen(i)
        if any(p.degree(i) for p in (rest, *linear) for i in indices):
            return None
        return Ball(lead.constant_value(), tuple(linear), rest, part.relation.is_strict)

    def radicand(self, scale: int) -> Poly:
        """(2 * lead * scale * radius)^2."""
        return (_length(self.linear) - 4 * self.lead * self.rest) * scale**2


class Side(Enum):
    """Where the points of a condition are."""

    ON = 0
    INSIDE = 1
    OUTSIDE = 2


def two_balls(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on a block of two conjuncts with parameters, in two variables or more."""
    parts = conjuncts(body)
    if StepKind.BALLS not in context.enabled or len(parts) != 2 or len(variables) < 2 or body.ring is None:
        return None
    if set(body.free) <= set(variables):
        return None
    indices = [body.ring.index[v] for v in variables]
    first, second = (_shape(part, indices) for part in parts)
    if first is None or second is None or first[0] is second[0] is Side.OUTSIDE:
        return None
    after, root, sign = meeting(first, second, context)
    proof = {"root": None if root is None else ("T", root, sign)}
    return Found(StepKind.BALLS, f"in {', '.join(variables)}", Leaf((), after), proof)


def _shape(part: Formula, indices: Sequence[int]) -> tuple[Side, Ball] | None:
    """The ball about which a conjunct speaks, and where."""
    if not isinstance(part, Atom) or part.relation is Relation.NE:
        return None
    poly, strict = part.poly, part.relation.is_strict
    for positive, relation in ((poly, part.relation), (-poly, part.relation.flipped)):
        ball = Ball.of(atom(positive, Relation.LT if strict else Relation.LE), indices)
        if ball is not None:
            below = Side.INSIDE if relation in (Relation.LE, Relation.LT) else Side.OUTSIDE
            return Side.ON if relation is Relation.EQ else below, ball
    return None


def meeting(
    first: tuple[Side, Ball], second: tuple[Side, Ball], context: BlockContext
) -> tuple[Formula, Poly | None, int]:
    """The condition, T where there is one, and the sign of it that was used (0: none)."""
    (side, ball), (other, beside) = sorted((first, second), key=lambda found: found[0].value)
    c, k = ball.lead, beside.lead
    apart = _length([k * b - c * l for b, l in zip(ball.linear, beside.linear, strict=True)])
    one, two = ball.radicand(k), beside.radicand(c)
    least, square = apart - one - two, 4 * one * two
    relation = Relation.LT if ball.strict or beside.strict else Relation.LE
    radii = [
        atom(radicand, Relation.GT if round_.strict else Relation.GE)
        for where, round_, radicand in ((side, ball, one), (other, beside, two))
        if where is not Side.OUTSIDE
    ]
    product = square_root(square)
    signs = frozenset[int]() if product is None else context.facts.signs(product)
    sign = 1 if product is not None and signs <= {0, 1} else -1 if product is not None and signs <= {0, -1} else 0

    def within(gap: Poly) -> Formula:
        """gap <= 2*sqrt(R*S)."""
        if product is None:
            return disj((atom(gap, relation), atom(gap * gap - square, relation)))
        return disj(atom(gap - s * product, relation) for s in (1, -1) if s * sign >= 0)

    near, far, both = within(least), within(-least), atom(least * least - square, relation)
    match side, other:
        case Side.INSIDE, Side.INSIDE:
            condition = near
        case Side.ON, Side.ON:
            condition = conj((near, far)) if sign else both
        case Side.ON, Side.INSIDE if product is None:
            radii = radii[:1]
            condition = disj((atom(one + apart - two, relation), both))
        case Side.ON, Side.INSIDE:
            condition = conj((near, disj((atom(one - two, relation), far))))
        case _ if product is None:
            condition = disj((atom(two - one - apart, relation), both))
        case _:
            condition = disj((atom(two - one, relation), far))
    return conj((*radii, condition)), product, sign


def square_root(poly: Poly) -> Poly | None:
    """A polynomial with this square, or None."""
    if not poly:
        return poly
    unit, factors = poly.factors()
    if unit < 0 or isqrt(unit) ** 2 != unit or any(multiplicity % 2 for _, multiplicity in factors):
        return None
    root = poly.ring.constant(isqrt(unit))
    for factor, multiplicity in factors:
        root = root * factor ** (multiplicity // 2)
    return root


def _length(vector: Sequence[Poly]) -> Poly:
    """|v|^2."""
    return sum((p * p for p in vector[1:]), vector[0] * vector[0])
