"""Projections of polyhedra, one variable after the other (Fourier 1826, Motzkin 1936), in steps of the kernel.

What each lower bound of x and each upper one say together follows from the two, and joins them; where all of it holds,
the largest lower bound is a value for x (for strict ones: next to it). Conditions that follow from others are left
out, each by a sum of them (Farkas 1902). Nothing here is trusted: the kernel checks what comes out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import lcm

from qe.convex.linear_rows import LinearRows, linear_atoms
from qe.convex.polyhedron import HalfSpace, Polyhedron, Sums
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_points import Tried
from qe.kernel.elimination_set import start
from qe.kernel.negation import negation
from qe.kernel.step import only
from qe.kernel.virtual_substitution import TestPoint
from qe.proof.entry import Json
from qe.proving.elimination_points import point_entry
from qe.proving.lemma_list import Term, identities
from qe.proving.made import Made, quantified, solved
from qe.proving.primitive_names import SIGNS
from qe.proving.vertices import by_vertices, some_best
from qe.rules.linear import put_in

MOST_PAIRS, MOST_POINTS = 1000, 30
"""Pairs of bounds, and bounds of one kind among which the largest is looked for, at most: such a step of a certificate
has half a million characters, and takes seconds."""


def projected(made: Made, after: Formula) -> None:
    """A block over linear equations and inequalities, or with one other condition, linear in its variables."""
    only(made.claim)
    block = made.current
    if not isinstance(block, Exists):
        raise made.claim.fail("expected a block")
    if not (atoms := linear_atoms(block.body)):
        by_vertices(made, block)
        return
    system = LinearRows.of(atoms)
    shadow = _Shadow(made, system.names)
    now = shadow.reduced(Polyhedron.of(system))
    unknowns = {j for j, name in enumerate(system.names) if name in block.variables}
    while unknowns and now is not None:
        pivot = next(((e, j) for e in now.equations for j, _ in e.normal if j in unknowns), None)
        j = min(unknowns, key=now.growth) if pivot is None else pivot[1]
        now = shadow.combined(now, j) if pivot is None else shadow.solved(now, *pivot)
        unknowns.discard(j)
    made.simplified(made.current, after)


@dataclass(slots=True)
class _Shadow:
    """The steps so far; ``sums``: why half-spaces follow from others, ``names``: those of the columns."""

    made: Made
    names: tuple[str, ...]
    sums: Sums = field(default_factory=dict)

    def reduced(self, polyhedron: Polyhedron) -> Polyhedron | None:
        """Without half-spaces that follow from the others; None where there is no point, which is a step, too."""
        kept = polyhedron.irredundant(self.made.limits.tick, self.sums)
        if kept is None:
            self._empty()
        else:
            self._left_out(polyhedron.halves, kept)
        return kept

    def solved(self, polyhedron: Polyhedron, equation: HalfSpace, j: int) -> Polyhedron | None:
        """Without a column, by an equation that has it."""
        block, name, ring = self.made.current, self.names[j], self.made.ring
        given = equation.condition(self.names, ring, Relation.EQ)
        assert isinstance(block, Exists) and isinstance(given, Atom)
        image = put_in(block.body, ring.index[name], given.poly)
        assert image is not None  # the terms of linear conditions are few
        after = quantified([v for v in block.variables if v != name], image)
        self.made.step("linear equation solved", block, after, solved(given, name))
        return None if image == FALSE else self.reduced(polyhedron.substituted(equation, j))

    def combined(self, polyhedron: Polyhedron, j: int) -> Polyhedron | None:
        """Without a column, by all pairs of bounds, as far as they do not follow from others."""
        made, bounds = self.made, [row for row in polyhedron.halves if row.at(j)]
        if not bounds:
            return polyhedron
        self.sums.clear()
        lower, upper = ([row for row in bounds if row.at(j) * sign > 0] for sign in (-1, 1))
        if len(lower) * len(upper) > MOST_PAIRS or min(len(lower), len(upper)) > MOST_POINTS:
            raise made.claim.fail("too many pairs of bounds")
        kept = polyhedron.combined(j, self.sums).irredundant(made.limits.tick, self.sums)
        if kept is None:
            self._empty()
            return None
        side, points, opposite = (1, lower, upper) if len(lower) <= len(upper) else (-1, upper, lower)
        pairs = [p.plus(q, abs(q.at(j)), abs(p.at(j))) for p in points for q in opposite]
        ends, stay = self._said(bounds), [row for row in polyhedron.halves if row not in bounds]
        if len(points) > 1:
            new = [row for row in kept.halves if row not in polyhedron.halves]
            made.signs(ends, conj((ends, self._said(new))), identities(map(self._sum, new), made.ring))
        block = made.current
        assert isinstance(block, Exists)
        inner = Exists((self.names[j],), ends)
        others = conj(a for a in conjuncts(block.body) if a not in conjuncts(ends))
        made.moved(block, quantified([v for v in block.variables if v != self.names[j]], conj((others, inner))))
        self._witnessed(inner, side, points, pairs)
        self._left_out([*stay, *(pairs if len(points) == 1 else ())], kept)
        return kept

    def _witnessed(self, inner: Exists, side: int, points: Sequence[HalfSpace], pairs: Sequence[HalfSpace]) -> None:
        """One of the bounds of a kind, the best, is a value for a variable (or one far out, where there are none).

        Where there is only one, what it and the others say stands in place of the block.
        """
        name, ring = inner.variables[0], self.made.ring
        x = ring.index[name]
        ends = [(row, self._poly(row).normal()[1]) for row in points]
        places = [TestPoint((), 0, -side), *(TestPoint(p.coefficients(x), 0, side * row.strict) for row, p in ends)]
        tried = [Tried(place, TRUE, inner.body, frozenset()) for place in places]
        cases = disj(start(t, x, name, inner.variables, ring) for t in tried)
        listed: list[Json] = [point_entry(t, inner.body) for t in tried]
        evidence: Json = {
            "variable": name,
            "side": side,
            "quadratics": [],
            "points": listed,
            "parts": [[] for _ in listed],
        }
        self.made.step("elimination set", inner, cases, evidence)
        if len(points) > 1:
            lemmas, used = self._because(pairs)
            bounds = [
                (rest, abs(lead.constant_value()), row.strict)
                for row in points
                for rest, lead in (self._poly(row).coefficients(x),)
            ]
            theory = some_best(bounds, lemmas, [(), (*used, TRUE, negation(cases))], ring, self.made.limits)
            self.made.step(SIGNS, cases, TRUE, {"theory": theory}, used)

    def _left_out(self, halves: Iterable[HalfSpace], kept: Polyhedron) -> None:
        """Those that are not kept follow from what is."""
        gone = [row for row in dict.fromkeys(halves) if row not in kept.halves and row.normal]
        if gone:
            lemmas, used = self._because(gone, gone)
            self.made.signs(self._said(gone), TRUE, identities(lemmas, self.made.ring), used)

    def _empty(self) -> None:
        """There is no point."""
        lemmas, _ = self._because([None])
        self.made.signs(self.made.current, FALSE, identities(lemmas, self.made.ring))

    def _because(
        self, rows: Iterable[HalfSpace | None], gone: Sequence[HalfSpace] = ()
    ) -> tuple[list[list[Term]], tuple[Formula, ...]]:
        """Why these hold, and the conditions on which that rests in the end, ``gone`` not among them."""
        body = self.made.current.body if isinstance(self.made.current, Exists) else self.made.current
        there = {*conjuncts(body)} - {self._condition(row) for row in gone}
        lemmas, used = list[list[Term]](), dict[Formula, None]()
        waiting, seen = [*rows], set[HalfSpace | None]()
        while waiting:
            row = waiting.pop()
            if row in seen or (row and not row.normal):
                continue
            seen.add(row)
            said = () if row is None else (self._condition(row), row.condition(self.names, self.made.ring, Relation.EQ))
            fact = next((f for f in said if f in there), None)
            if fact is None:
                lemmas.append(self._sum(row))
                waiting += [other for other, _ in self.sums[row]]
            else:
                used[fact] = None
        return lemmas, tuple(used)

    def _sum(self, row: HalfSpace | None) -> list[Term]:
        """The sum from which it follows: that, a multiple of it and a number add up to 0."""
        parts = [(other, w / other.constant.denominator) for other, w in self.sums[row]]
        if row is not None:
            j, c = row.normal[0]
            total = sum(w * other.constant.denominator * other.at(j) for other, w in parts)
            parts.append((row, -Fraction(total) / (c * row.constant.denominator)))
        whole = lcm(*(w.denominator for _, w in parts))
        terms: list[Term] = [(int(w * whole), ((self._poly(other), 1),)) for other, w in parts]
        return [*terms, (-sum(int(w * whole) * other.constant.numerator for other, w in parts), ())]

    def _poly(self, row: HalfSpace) -> Poly:
        return row.poly(self.names, self.made.ring)

    def _condition(self, row: HalfSpace) -> Formula:
        return row.condition(self.names, self.made.ring)

    def _said(self, rows: Iterable[HalfSpace]) -> Formula:
        return conj(map(self._condition, rows))
