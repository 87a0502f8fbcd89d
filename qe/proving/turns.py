"""Rotations of the axes, in steps of the kernel: a length that exists, and a change of variables by quotients of it.

With r >= 0 and r^2 = u^2 + v^2, and r > 0, every pair (x, y) that turns along with (u, v) becomes
(u*x + v*y, u*y - v*x)/r, so that (u, v) becomes (r, 0). A polynomial p that looks at lengths and angles only is then
r^m*p modulo r^2 - u^2 - v^2, for some m; two that are the coordinates of a vector become those of the vector turned.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import Exists, Formula, Relation
from qe.formula.traverse import conjuncts, polynomials
from qe.kernel.step import Claim, only
from qe.kernel.terms import Quotient, at_terms
from qe.proof.entry import Entry
from qe.proving.lemma_list import EMPTY, Term, identities
from qe.proving.made import Made

MOST = 24
"""Powers of the length that are tried."""


def turned(made: Made, after: Formula) -> None:
    """One turn after the other, for a block without quantifiers inside, whose variables turn with one speed."""
    before = made.current
    if not isinstance(before, Exists) or not before.body.is_quantifier_free:
        raise made.claim.fail("a block without quantifiers inside expected")
    turns = [_read(entry, made.claim) for entry in only(made.claim, "turns")[0].items()]
    for k, turn in enumerate(turns):
        block = made.current
        if not isinstance(block, Exists):
            raise made.claim.fail("nothing is left to be turned")
        halved = turn.halved(made, block)
        if any(turn.u in {i for pair in later.pairs for i in pair} for later in turns[k + 1 :]):
            turn.unhalved(made, halved)


def _read(entry: Entry, claim: Claim) -> _Turn:
    zero, half, plane = entry.fields("zero", "half", "plane")
    u, v = (claim.ring.index[member.text()] for member in (half, zero))
    pairs = []
    for row in plane.items():
        first, second, speed = row.row("variable", "variable", "rational number")
        i, j = claim.ring.index[first.text()], claim.ring.index[second.text()]
        if abs(speed.rational()) != 1:
            raise row.fail("no other speeds than that of the plane")
        pairs.append((i, j) if speed.rational() == 1 else (j, i))
    if (v, u) in pairs:
        pairs = [(j, i) for i, j in pairs]
    if (u, v) not in pairs:
        raise plane.fail("these two are not turned into each other")
    return _Turn(u, v, tuple(pair for pair in pairs if pair != (u, v)))


@dataclass(frozen=True, slots=True)
class _Turn:
    """Each pair turns from its first to its second variable, as u to v."""

    u: int
    v: int
    pairs: tuple[tuple[int, int], ...]

    def halved(self, made: Made, block: Exists) -> Exists:
        """Steps to the block with v = 0 and u >= 0."""
        ring = made.ring
        name, u, v = made.fresh(), ring.gen(self.u), ring.gen(self.v)
        r, names = ring.var(name), (*block.variables, name)
        length = atom(r * r - u * u - v * v, Relation.EQ)
        inner = Exists((name,), conj((atom(r, Relation.GE), length)))
        middle = Exists(block.variables, conj((block.body, inner)))
        there = Made(made.claim, made.limits, middle)
        there.root(inner, ring.constant(0))
        made.back(block, middle, there)
        whole = exists(names, conj((atom(r, Relation.GE), length, block.body)))
        made.moved(middle, whole)
        cases = [exists(names, conj((atom(r, rel), length, block.body))) for rel in (Relation.GT, Relation.EQ)]
        made.signs(whole, disj(cases))
        flat, rest = made.put(block.body, {ring.names[self.v]: ring.constant(0)}), self.rest(block, made)
        sides = [exists(rest, conj((atom(u, rel), flat))) for rel in (Relation.GT, Relation.EQ)]
        one, zero = ring.constant(1), ring.constant(0)
        origin, v_name = {ring.names[self.v]: (zero, one)}, ring.names[self.v]
        turn = {self.u: (r, one)}
        for i, j in self.pairs:
            x, y = ring.gen(i), ring.gen(j)
            turn |= {i: (u * x + v * y, r), j: (u * y - v * x, r)}
        lemmas = identities(self.around(block.body, turn, r, made), ring)
        back = {ring.names[i]: quotient for i, quotient in turn.items() if ring.names[i] in rest}
        made.terms(cases[0], sides[0], {v_name: (zero, one), name: (u, one)}, back, lemmas)
        lemmas = identities(self.at_centre(block.body, r, ring.gen(self.u), v), ring)
        made.terms(cases[1], sides[1], {**origin, name: (zero, one)}, {}, lemmas)
        half = exists(rest, conj((atom(u, Relation.GE), flat)))
        splitting = Made(made.claim, made.limits, half)
        splitting.signs(half, disj(sides))
        made.back(disj(sides), half, splitting)
        assert isinstance(half, Exists)
        return half

    def rest(self, block: Exists, made: Made) -> list[str]:
        return [name for name in block.variables if name != made.ring.names[self.v]]

    def around(self, body: Formula, turn: dict[int, Quotient], r: Poly, made: Made) -> Iterator[list[Term]]:
        """What the polynomials are once turned: themselves, or those of a vector."""
        ring = made.ring
        u, v, moved = ring.gen(self.u), ring.gen(self.v), {self.u, self.v, *turn}
        length = r * r - u * u - v * v
        yield [(1, ((length, 1),)), (-1, ((r, 2),)), (1, ((u, 2),)), (1, ((v, 2),))]
        for p in dict.fromkeys(polynomials(body)):
            if not moved & {*p.variables}:
                continue
            slope = self.along(p)
            parts = [(p, u), (slope, v)] if slope else [(p, ring.constant(1))]
            images = [(at_terms(q.at_rational(self.v, Fraction(0)), turn), factor) for q, factor in parts]
            found = next(self.fitting(p, images, r, length), None)
            if found is None:
                raise made.claim.fail(f"{p} is not seen to turn")
            yield found

    def fitting(self, p: Poly, images: Sequence[tuple[Poly, Poly]], r: Poly, length: Poly) -> Iterator[list[Term]]:
        """That r^m*p is a combination of images modulo the length."""
        for m in range(MOST):
            for sign in (1, -1):
                signs = [1, sign][: len(images)]
                total = sum((i * f * s for (i, f), s in zip(images, signs, strict=True)), p * 0)
                left = r**m * p - total
                if not left or left.gcd(length) in (length, -length):
                    terms: list[Term] = [(1, ((r, m), (p, 1)) if m else ((p, 1),))]
                    terms += [(-s, ((i, 1), (f, 1))) for (i, f), s in zip(images, signs, strict=True)]
                    yield [*terms, (-1, ((length, 1), (left.exact_divide(length), 1)))]

    def along(self, p: Poly) -> Poly:
        """How fast it changes along the turn."""
        ring, total = p.ring, p * 0
        for i, j in ((self.u, self.v), *self.pairs):
            total = total + ring.gen(i) * p.derivative(j) - ring.gen(j) * p.derivative(i)
        return total

    def at_centre(self, body: Formula, r: Poly, u: Poly, v: Poly) -> Iterator[list[Term]]:
        """Where r = 0, u and v are, and polynomials are what they are at v = 0."""
        yield [(1, ((r * r - u * u - v * v, 1),)), (-1, ((r, 2),)), (1, ((u, 2),)), (1, ((v, 2),))]
        yield [(1, ((u * u, 1),)), (-1, ((u, 2),))]
        for p in dict.fromkeys(polynomials(body)):
            flat = p.at_rational(self.v, Fraction(0))
            if p != flat:
                yield [(1, ((p, 1),)), (-1, ((v, 1), ((p - flat).exact_divide(v), 1))), (-1, ((flat, 1),))]

    def unhalved(self, made: Made, half: Exists) -> None:
        """Steps to the block without u >= 0, which half a turn around 0 makes of itself."""
        ring = made.ring
        u = ring.gen(self.u)
        flat = conj(part for part in conjuncts(half.body) if part != atom(u, Relation.GE))
        whole, mirror = exists(half.variables, flat), exists(half.variables, conj((atom(u, Relation.LE), flat)))
        splitting = Made(made.claim, made.limits, whole)
        splitting.signs(whole, disj((half, mirror)))
        turn = {ring.names[i]: (-ring.gen(i), ring.constant(1)) for i in (self.u, *(k for p in self.pairs for k in p))}
        splitting.terms(mirror, half, turn, turn, EMPTY)
        made.back(half, whole, splitting)
