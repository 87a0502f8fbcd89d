"""Rule "two balls": whether two balls have a common point, in closed form.

THEOREM. c*|x|^2 + b.x + e <= 0 (c > 0) is the ball about -b/(2c) whose squared radius is (|b|^2 - 4ce)/(4c^2), empty
where that is negative; with < the open ball, empty where it is not positive. Two balls that are not empty, with radii
r, s and centres at distance d, have a common point iff d <= r + s, where one is open iff d < r + s. Multiplied by
4*c^2*k^2 the squares of d, r, s are D, R, S below, and d <= r + s iff D - R - S <= 2*sqrt(R*S).

Evidence: ``root``, null, or ["T", polynomial t, sign] where 4*R*S = T^2 for a positive multiple T of t; the sign of t
(1, -1; 0 where it is not used) is proved by ``theory``.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import isqrt

from qe.certify.boolean import ByLemmas, Goal
from qe.certify.step import Claim, Context, only, outside
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import And, Atom, Exists, Formula, Relation
from qe.proof.entry import Entry

_LESS = {Relation.LE: 1, Relation.LT: 1, Relation.GE: -1, Relation.GT: -1}
_FALSE_SIGN = {1: Relation.LT, -1: Relation.GT}


def balls_goals(claim: Claim, context: Context) -> list[Goal]:
    """The block is one over two balls, and the condition is that of the theorem."""
    root, _ = only(claim, "root", "theory")
    before = claim.before
    if not isinstance(before, Exists) or not isinstance(before.body, And) or len(before.body.args) != 2:
        raise claim.fail("a block over two conditions expected")
    indices = [claim.ring.index[v] for v in before.variables]
    (c, b, e, open_b), (k, l, m, open_l) = (_ball(part, indices, claim) for part in before.body.args)
    distance = _squares(k * p - c * q for p, q in zip(b, l, strict=True))
    first, second = k * k * (_squares(b) - 4 * c * e), c * c * (_squares(l) - 4 * k * m)
    gap, relation = distance - first - second, Relation.LT if open_b or open_l else Relation.LE
    radii = atom(first, Relation.GT if open_b else Relation.GE), atom(second, Relation.GT if open_l else Relation.GE)
    goals: list[Goal] = []
    if root.value is None:
        near = disj((atom(gap, relation), atom(gap * gap - 4 * first * second, relation)))
    else:
        letter, product, sign = root.row("T", "polynomial", "sign")
        if letter.text() != "T" or (used := sign.integer(-1)) > 1:
            raise root.fail("expected T, a polynomial and a sign")
        t = _root(product.polynomial(claim.ring), 4 * first * second, root)
        near = disj(atom(gap - s * t, relation) for s in (1, -1) if s * used >= 0)
        goals = [(*outside(context, before.variables), atom(t, _FALSE_SIGN[used]))] if used else []
    if claim.after != conj((*radii, near)):
        raise claim.fail("not the condition that the balls meet")
    return goals


check_balls = ByLemmas(balls_goals)


def _ball(part: Formula, indices: list[int], claim: Claim) -> tuple[int, list[Poly], Poly, bool]:
    if not isinstance(part, Atom) or part.relation not in _LESS:
        raise claim.fail("an inequality expected")
    zero = part.poly.ring.constant(0)
    lead, linear, rest = dict.fromkeys(indices, zero), dict.fromkeys(indices, zero), zero
    for exponents, poly in part.poly.collected(indices).items():
        powers = {i: p for i, p in zip(indices, exponents, strict=True) if p}
        coefficient = poly * _LESS[part.relation]
        match list(powers.items()):
            case []:
                rest = coefficient
            case [(i, 1)]:
                linear[i] = coefficient
            case [(i, 2)]:
                lead[i] = coefficient
            case _:
                raise claim.fail("a ball expected")
    first = lead[indices[0]]
    if any(p != first for p in lead.values()) or not first.is_constant or first.constant_value() <= 0:
        raise claim.fail("a ball expected")
    return first.constant_value(), list(linear.values()), rest, part.relation.is_strict


def _squares(polys: Iterable[Poly]) -> Poly:
    parts = [p * p for p in polys]
    return sum(parts[1:], parts[0])


def _root(t: Poly, square: Poly, entry: Entry) -> Poly:
    """The positive multiple of t whose square this is."""
    if not square:
        return square
    own = t * t
    if own:
        scale = Fraction(square.terms()[0][1], own.terms()[0][1])
        if scale.denominator == 1 and scale > 0 and isqrt(scale.numerator) ** 2 == scale:
            found = t * isqrt(scale.numerator)
            if found * found == square:
                return found
    raise entry.fail("not a square root")
