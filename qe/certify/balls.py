"""Rule "two balls": whether two balls, spheres or outsides of balls have a common point, in closed form.

THEOREM. c*|x|^2 + b.x + e (c > 0) compares the distance u of x from -b/(2c) with a radius whose square is
(|b|^2 - 4ce)/(4c^2): <= 0 says u <= r, = 0 says u = r, >= 0 says u >= r (always true where the square is negative; the
others never are; < and > likewise, u < r never where r = 0). Multiplied by 4*c^2*k^2 the squares of r, of the other
radius s and of the distance d of the centres are R, S, D below. In dimension 2 and more the distances u, v of a point
from two centres are all numbers >= 0 with |u - v| <= d <= u + v. So there is a common point iff
    u <= r, v <= s:  d <= r + s          u = r, v = s:  |r - s| <= d <= r + s
    u = r, v <= s:   |d - r| <= s, that is D + R - S <= 2*d*r; or: d <= r + s and (r <= s or d >= r - s)
    u <= r or u = r, v >= s:  s <= d + r, that is S - D - R <= 2*d*r; or: S <= R or d >= s - r (s^2 may be negative)
and where one is strict, with strict inequalities. d <= r + s iff D - R - S <= 2*sqrt(R*S); |r - s| <= d iff
D - R - S >= -2*sqrt(R*S); both iff (D - R - S)^2 <= 4*R*S. By expansion (S - D - R)^2 - 4*D*R is (D - R - S)^2 - 4*R*S.

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

_ON, _IN, _OUT = _ORDER = ("on", "inside", "outside")
_SIDE = {
    Relation.EQ: _ON,
    Relation.LE: _IN,
    Relation.LT: _IN,
    Relation.GE: _OUT,
    Relation.GT: _OUT,
}
_FALSE_SIGN = {1: Relation.LT, -1: Relation.GT}


def balls_goals(claim: Claim, context: Context) -> list[Goal]:
    """The block is one over two balls, and the condition is that of the theorem."""
    root, _ = only(claim, "root", "theory")
    before = claim.before
    if not isinstance(before, Exists) or not isinstance(before.body, And) or len(before.body.args) != 2:
        raise claim.fail("a block over two conditions expected")
    indices = [claim.ring.index[v] for v in before.variables]
    shapes = [_shape(part, indices, claim) for part in before.body.args]
    (on, c, b, e, open_b), (where, k, l, m, open_l) = sorted(shapes, key=lambda shape: _ORDER.index(shape[0]))
    if (on, where) != (_IN, _IN) and len(indices) < 2:
        raise claim.fail("two variables or more expected")
    distance = _squares(k * p - c * q for p, q in zip(b, l, strict=True))
    first, second = k * k * (_squares(b) - 4 * c * e), c * c * (_squares(l) - 4 * k * m)
    relation = Relation.LT if open_b or open_l else Relation.LE
    radii = [atom(first, Relation.GT if open_b else Relation.GE)]
    if where == _ON or (where == _IN and (on == _IN or root.value is not None)):
        radii.append(atom(second, Relation.GT if open_l else Relation.GE))
    goals: list[Goal] = []
    t, used = None, 0
    if root.value is not None:
        t, used = _read_root(root, 4 * first * second, claim)
        goals = [(*outside(context, before.variables), atom(t, _FALSE_SIGN[used]))] if used else []
    meet = _meeting(on, where, (distance, first, second), relation, t, used)
    if on == _OUT or claim.after != conj((*radii, meet)):
        raise claim.fail("not the condition that there is a common point")
    return goals


check_balls = ByLemmas(balls_goals)


def _meeting(
    on: str, where: str, squares: tuple[Poly, Poly, Poly], relation: Relation, t: Poly | None, used: int
) -> Formula:
    """The theorem's condition on the squares D, R, S; ``t`` is +-sqrt(4*R*S), its sign ``used`` if that is known."""
    distance, first, second = squares
    gap, product = distance - first - second, 4 * first * second

    def at_most(p: Poly) -> Formula:
        """p <= 2*sqrt(R*S)."""
        if t is None:
            return disj((atom(p, relation), atom(p * p - product, relation)))
        return disj(atom(p - s * t, relation) for s in (1, -1) if s * used >= 0)

    both = atom(gap * gap - product, relation)
    if on == where == _IN:
        return at_most(gap)
    if on == where == _ON:
        return conj((at_most(gap), at_most(-gap))) if used else both
    if t is None:
        side = second - distance - first
        return disj((atom(side if where == _OUT else -side, relation), both))
    if where == _OUT:
        return disj((atom(second - first, relation), at_most(-gap)))
    return conj((at_most(gap), disj((atom(first - second, relation), at_most(-gap)))))


def _shape(part: Formula, indices: list[int], claim: Claim) -> tuple[str, int, list[Poly], Poly, bool]:
    """On which side of which ball the points of a condition are: lead > 0, the linear part, the rest, strictness."""
    if not isinstance(part, Atom) or part.relation not in _SIDE:
        raise claim.fail("a ball, a sphere or the outside of a ball expected")
    zero = part.poly.ring.constant(0)
    lead, linear, rest = dict.fromkeys(indices, zero), dict.fromkeys(indices, zero), zero
    for exponents, poly in part.poly.collected(indices).items():
        powers = {i: p for i, p in zip(indices, exponents, strict=True) if p}
        match list(powers.items()):
            case []:
                rest = poly
            case [(i, 1)]:
                linear[i] = poly
            case [(i, 2)]:
                lead[i] = poly
            case _:
                raise claim.fail("a ball expected")
    first = lead[indices[0]]
    if any(p != first for p in lead.values()) or not first.is_constant or not first:
        raise claim.fail("a ball expected")
    sign = 1 if first.constant_value() > 0 else -1
    side = _SIDE[part.relation if sign > 0 else part.relation.flipped]
    return side, abs(first.constant_value()), [p * sign for p in linear.values()], rest * sign, part.relation.is_strict


def _squares(polys: Iterable[Poly]) -> Poly:
    parts = [p * p for p in polys]
    return sum(parts[1:], parts[0])


def _read_root(root: Entry, square: Poly, claim: Claim) -> tuple[Poly, int]:
    """T and the sign of t that is said to be known, 0 where none is."""
    letter, t, sign = root.row("T", "polynomial", "sign")
    if letter.text() != "T" or (used := sign.integer(-1)) > 1:
        raise root.fail("expected T, a polynomial and a sign")
    return _root(t.polynomial(claim.ring), square, root), used


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
