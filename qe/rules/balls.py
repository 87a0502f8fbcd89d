"""Two balls have a common point: a closed form in any dimension.

THEOREM. Let x be n >= 1 variables and c, k > 0 numbers, b, l vectors and e, m polynomials without x, and
D = |k*b - c*l|^2, R = k^2*(|b|^2 - 4*c*e), S = c^2*(|l|^2 - 4*k*m). Then
    ex x (c*|x|^2 + b.x + e <= 0 and k*|x|^2 + l.x + m <= 0)  iff  R >= 0 and S >= 0 and D - R - S <= 2*sqrt(R*S);
where the first condition is strict, R > 0 instead, where the second is, S > 0, and with either < instead of the last.
PROOF. Scaled by 2*c*k, the conditions say that x is at most sqrt(R) from -k*b and at most sqrt(S) from -c*l, whose
distance is sqrt(D). If a ball is empty, its radicand says so; otherwise the point of the first ball nearest to the
second centre is at distance max(0, sqrt(D) - sqrt(R)), and D <= (sqrt(R) + sqrt(S))^2 is the same as the above. If
one ball is open, so is what it has in common with a small ball about a point of it: the inequality is strict.
D - R - S <= 2*sqrt(R*S) is D - R - S <= 0 or (D - R - S)^2 <= 4*R*S; where 4*R*S = T^2, it is D - R - S <= |T|.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
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


def two_balls(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on a block of two conjuncts with parameters, in two variables or more."""
    parts = conjuncts(body)
    if StepKind.BALLS not in context.enabled or len(parts) != 2 or len(variables) < 2 or body.ring is None:
        return None
    if set(body.free) <= set(variables):
        return None
    indices = [body.ring.index[v] for v in variables]
    first, second = (Ball.of(part, indices) for part in parts)
    if first is None or second is None:
        return None
    after, root, sign = meeting(first, second, context)
    proof = {"root": None if root is None else ("T", root, sign)}
    return Found(StepKind.BALLS, f"in {', '.join(variables)}", Leaf((), after), proof)


def meeting(first: Ball, second: Ball, context: BlockContext) -> tuple[Formula, Poly | None, int]:
    """The condition, T where there is one, and the sign of it that was used (0: none)."""
    c, k = first.lead, second.lead
    apart = _length([k * b - c * l for b, l in zip(first.linear, second.linear, strict=True)])
    one, two = first.radicand(k), second.radicand(c)
    least = apart - one - two
    relation = Relation.LT if first.strict or second.strict else Relation.LE
    conditions = [
        atom(radicand, Relation.GT if ball.strict else Relation.GE) for ball, radicand in ((first, one), (second, two))
    ]
    product = square_root(4 * one * two)
    if product is None:
        near, sign = disj((atom(least, relation), atom(least * least - 4 * one * two, relation))), 0
    else:
        signs = context.facts.signs(product)
        sign = 1 if signs <= {0, 1} else -1 if signs <= {0, -1} else 0
        near = disj(atom(least - s * product, relation) for s in (1, -1) if s * sign >= 0)
    return conj((*conditions, near)), product, sign


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
