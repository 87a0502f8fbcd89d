"""Rule "rotation of the axes": a block that only looks at lengths and angles, in a plane of its variables.

THEOREM. Let S be a skew-symmetric matrix over bound variables, each pair that it joins bound by one quantifier, and X
= sum of S_ij * (x_i * d/dx_j - x_j * d/dx_i). Let X p = 0 for every polynomial p in f; of equations of a conjunction
(inequations of a disjunction) it is enough that X is 0 on the sum of their squares. Then f has the same truth at x and
at exp(t*S) x, the variables of quantifiers inside left out: the derivative of p along that curve is X p, the equations
say that the sum of their squares is 0, and exp(t*S) maps the values of an inner block onto themselves. If S joins u and
v to each other and to nothing else, some t makes v = 0 and u >= 0: ex u, v, y f iff ex u, y (u >= 0 and f[v = 0]).
With several turns one after the other, f[v = 0] alone, under the block, is equivalent too (it is f at v = 0, and
follows); a point of it that has some of the earlier signs u' >= 0 keeps those of the variables that S does not move.
A universal block is the negation of an existential one. No name is bound twice, or both free and bound.

Evidence: ``turns``, each with ``zero`` v, ``half`` u, ``plane``: [[x_i, x_j, S_ij], ...].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import And, Atom, Atomic, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import children, subformulas
from qe.kernel.block import existential
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import mapped
from qe.proof.entry import Entry

Skew = dict[tuple[int, int], Fraction]


def check_rotation(claim: Claim, context: Context, limits: Limits) -> None:
    """Every turn leaves the truth alone; the zeros are put in and the result is compared."""
    turns, ring = only(claim, "turns")[0], claim.ring
    before, after = existential(claim)
    if not isinstance(before, Exists):
        raise claim.fail("expected a block")
    names, body, halves = list(before.variables), before.body, set[str]()
    for turn in turns.items():
        zero, half, plane = turn.fields("zero", "half", "plane")
        if not isinstance(block := exists(names, body), Exists):
            raise turn.fail("nothing is left to be turned")
        skew = _skew(plane, _blocks(block, claim), claim)
        u, v = half.text(), zero.text()
        if not {u, v} <= set(names) or not _is_plane(skew, {ring.index[u], ring.index[v]}):
            raise turn.fail("these variables of the block are not turned into each other alone")
        for derivative in _derivatives(body, skew):
            limits.tick()
            if derivative:
                raise plane.fail("a polynomial is not constant along this rotation")
        halves = halves - {ring.names[i] for pair in skew for i in pair} | {u}
        names.remove(v)
        body = _without(body, ring.index[v], claim)
    signs = [atom(ring.var(u), Relation.GE) for u in sorted(halves) if u in body.free]
    if after != exists(names, conj((*signs, body))):
        raise claim.fail("not the block with 0 for these variables")


def _without(body: Formula, v: int, claim: Claim) -> Formula:
    """The formula at v = 0."""
    return mapped(body, lambda a: atom(a.poly.at_rational(v, Fraction(0)), a.relation), (claim.ring.gen(v),), claim)


def _blocks(block: Exists, claim: Claim) -> list[tuple[str, ...]]:
    """The variables of every quantifier."""
    blocks = [f.variables for f in subformulas(block) if isinstance(f, Exists | ForAll)]
    names = [name for variables in blocks for name in variables]
    if len(set(names)) < len(names) or set(names) & set(block.free):
        raise claim.fail("a name is bound twice, or free and bound")
    return blocks


def _skew(plane: Entry, blocks: Sequence[Sequence[str]], claim: Claim) -> Skew:
    """The matrix, by its entries for pairs of variables that one quantifier binds."""
    skew: Skew = {}
    for entry in plane.items():
        first, second, number = entry.row("variable", "variable", "rational number")
        left, right, value = first.text(), second.text(), number.rational()
        if left == right or not any({left, right} <= set(block) for block in blocks):
            raise entry.fail("expected two variables that one quantifier binds")
        i, j = claim.ring.index[left], claim.ring.index[right]
        if (i, j) in skew or (j, i) in skew or not value:
            raise entry.fail("expected each pair once, with a number that is not 0")
        skew[i, j] = value
    return skew


def _is_plane(skew: Skew, plane: set[int]) -> bool:
    """Whether the two are joined to each other and to nothing else; by the number 1, as multiples of S are as good."""
    return len(plane) == 2 and [(set(pair), s == 1) for pair, s in skew.items() if plane & set(pair)] == [(plane, True)]


def _derivatives(formula: Formula, skew: Skew) -> Iterator[Poly]:
    """Polynomials that vanish only if the truth of the formula is the same along the curves of the theorem."""
    if isinstance(formula, Atom):
        yield _along(formula.poly, skew)
    elif isinstance(formula, Atomic):
        yield formula.poly  # never 0: nothing is known of it
    elif isinstance(formula, And | Or):
        relation = Relation.EQ if isinstance(formula, And) else Relation.NE
        together = [a.poly for a in formula.args if isinstance(a, Atom) and a.relation is relation]
        moving = [(p, slope) for p in together if (slope := _along(p, skew))]
        if moving:
            yield sum((p * slope for p, slope in moving[1:]), moving[0][0] * moving[0][1])
        for part in formula.args:
            if not isinstance(part, Atom) or part.relation is not relation:
                yield from _derivatives(part, skew)
    else:
        for part in children(formula):
            yield from _derivatives(part, skew)


def _along(poly: Poly, skew: Skew) -> Poly:
    """A positive multiple of X p."""
    ring, scale = poly.ring, 1
    for value in skew.values():
        scale *= value.denominator
    total = ring.constant(0)
    for (i, j), value in skew.items():
        turned = ring.gen(i) * poly.derivative(j) - ring.gen(j) * poly.derivative(i)
        total = total + turned * int(value * scale)
    return total
