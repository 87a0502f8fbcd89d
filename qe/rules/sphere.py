"""A sphere, or a ball, that is looked at along one direction only: a segment in its place.

THEOREM. Let v be n variables, c > 0 a number, b and l vectors of polynomials and e a polynomial without v, and
R = |b|^2 - 4*c*e. The values of l.v on the sphere c*|v|^2 + b.v + e = 0, n >= 2, or on the ball (<= 0), n >= 1, are the
t with (2*c*t + l.b)^2 <= |l|^2*R, if R >= 0; there are none if R < 0. On the open ball (< 0) they are those with < if
R > 0 and l is not 0. So if everything else in f sees v by t = l.v alone, ex v, x (c*|v|^2 + b.v + e = 0 and f(l.v, x))
iff ex t, x (R >= 0 and (2*c*t + l.b)^2 <= |l|^2*R and f(t, x)). Where |l|^2 is a positive number, R >= 0 follows.
PROOF. With w = 2*c*v + b the sphere is |w|^2 = R. There l.w takes all values between -|l|*sqrt(R) and |l|*sqrt(R), by
Cauchy's inequality and since a sphere of dimension 1 and more is connected; so does it on the ball, which is convex.

On the sphere, polynomials that contain |v|^2 are linear in v after a multiple of its equation has been subtracted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from math import prod

from qe.exact.ring import Poly, format_poly
from qe.formula.build import atom, conj
from qe.formula.features import is_short
from qe.formula.syntax import TRUE, Atom, Atomic, Formula, Relation
from qe.formula.traverse import atoms, conjuncts, map_atoms
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Pending

_PARTS, _VARIABLES, _TERMS = 12, 6, 300
"""Conjuncts of a block that is looked at, its variables in a sphere, terms of all atoms."""


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

    @property
    def radicand(self) -> Poly:
        """(2 * lead * radius)^2."""
        return sum((p * p for p in self.linear), -4 * self.lead * self.rest)


def sphere_along_form(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the first sphere or ball in two variables of the block or more, where there are parameters."""
    if len(variables) < 2 or set(body.free) <= set(variables):
        return None
    parts = conjuncts(body)
    if len(parts) > _PARTS or not body.is_quantifier_free or not is_short(body, _TERMS):
        return None
    for part in parts:
        rest = [p for p in parts if p != part]
        for names in _candidates(part, variables):
            context.budget.check("prepare")
            ball = None if _is_solved(names, rest) else _ball(part, names)
            found = None if ball is None else _along(ball, names, rest)
            if found is not None:
                form, after = found
                kept = tuple(v for v in variables if v not in names[1:])
                proof = {"sphere": part, "variables": list(names), "form": form}
                detail = f"{format_poly(form)} for {', '.join(names)}"
                return Found(StepKind.SPHERE, detail, Pending(kept, after), proof)
    return None


def _candidates(part: Formula, variables: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Variables of the block in which the conjunct may be a sphere or ball, many first."""
    if isinstance(part, Atom) and part.relation is not Relation.NE:
        ring = part.poly.ring
        square = [v for v in variables if v in part.free and part.poly.degree(ring.index[v]) == 2]
        for size in range(min(len(square), _VARIABLES), 1, -1):
            yield from combinations(square, size)


def _is_solved(names: Sequence[str], rest: Sequence[Formula]) -> bool:
    """Whether an equation gives one of the variables without a denominator: then it is for the rule on those."""
    lines = (p.poly for p in rest if isinstance(p, Atom) and p.relation is Relation.EQ)
    return any(
        p.degree(i) == 1 and p.leading(i).is_constant for p in lines for i in map(p.ring.index.__getitem__, names)
    )


def _ball(part: Formula, names: Sequence[str]) -> tuple[Ball, Poly | None] | None:
    """What a conjunct is in these variables; with the polynomial of the equation (leading coefficients positive) where
    it is a sphere."""
    if not isinstance(part, Atom):
        return None
    ring = part.poly.ring
    indices = [ring.index[v] for v in names]
    if part.relation is not Relation.EQ:
        ball = Ball.of(part, indices)
        return None if ball is None else (ball, None)
    for poly, relation in ((part.poly, Relation.LE), (-part.poly, Relation.GE)):
        ball = Ball.of(Atom(part.poly, relation), indices)
        if ball is not None:
            return ball, poly
    return None


def _along(
    given: tuple[Ball, Poly | None], names: Sequence[str], rest: Sequence[Formula]
) -> tuple[Poly, Formula] | None:
    """The form, and the block's body with its value under the first of the names; None where the others see more."""
    (ball, equation), ring = given, given[0].rest.ring
    indices = [ring.index[v] for v in names]
    factors = dict.fromkeys(f for p in rest for a in atoms(p) for f, _ in a.poly.factors()[1])
    linear = {f: _reduced(f, ball.lead, equation, indices) for f in factors if set(indices) & set(f.variables)}
    form = next((_form(p, indices) for p in linear.values() if any(p.degree(i) for i in indices)), None)
    if form is None:
        return None
    direction = [form.derivative(i) for i in indices]
    length = sum((p * p for p in direction), ring.constant(0))
    each = {f: _image(linear[f], form, indices) if f in linear else f for f in factors}
    images = {f: image for f, image in each.items() if image is not None}
    if len(images) < len(each) or (ball.strict and not length.is_constant):
        return None

    def change(each: Atomic) -> Formula:
        unit, parts = each.poly.factors()
        return atom(prod((images[f] ** k for f, k in parts), start=ring.constant(unit)), each.relation)

    offset = sum((p * q for p, q in zip(direction, ball.linear, strict=True)), ring.constant(0))
    bound = (ring.gen(indices[0]) * (2 * ball.lead) + offset) ** 2 - length * ball.radicand
    radius = TRUE if length.is_constant else atom(ball.radicand, Relation.GE)
    values = atom(bound, Relation.LT if ball.strict else Relation.LE)
    return form, conj((radius, values, *(map_atoms(p, change) for p in rest)))


def _reduced(poly: Poly, lead: int, equation: Poly | None, indices: Sequence[int]) -> Poly:
    """A positive multiple of the polynomial on the sphere, without squares where it had |v|^2."""
    square = poly.coefficients(indices[0])[2:]
    return poly if equation is None or len(square) != 1 else poly * lead - square[0] * equation


def _form(poly: Poly, indices: Sequence[int]) -> Poly | None:
    """l.v for a polynomial that is linear in v."""
    slopes = [poly.derivative(i) for i in indices]
    if any(p.degree(i) for p in slopes for i in indices):
        return None
    common = reduce(lambda p, q: p.gcd(q), slopes)
    ring = poly.ring
    form = sum((p.exact_divide(common) * ring.gen(i) for p, i in zip(slopes, indices, strict=True)), ring.constant(0))
    return form.normal()[1]


def _image(poly: Poly, form: Poly, indices: Sequence[int]) -> Poly | None:
    """The polynomial with t, under the first of the names, for l.v; None where it is not one in l.v."""
    x = next(i for i in indices if form.degree(i))
    slope, unit = poly.derivative(x), form.derivative(x)
    if any(slope.degree(i) for i in indices) or slope.gcd(unit) not in (unit, -unit):
        return None
    scale = slope.exact_divide(unit)
    offset = poly - scale * form
    return None if any(offset.degree(i) for i in indices) else offset + scale * poly.ring.gen(indices[0])
