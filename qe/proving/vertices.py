"""Answers by vertices and directions of polyhedra, in steps of the kernel.

On each of the simplices of a triangulation a linear form is the sum of its values at the generators times nonnegative
linear functions; a point lies in the simplex whose function of the triangulation (``qe.convex.vertices``) is largest
there. Where the condition holds at a vertex or along a direction, there is a point of the polyhedron at which it does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from math import lcm

from qe.convex.cone import Cone, Vector, dot
from qe.convex.vertices import MOST_PIECES, Generated, LinearForm, on_polyhedra
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Relation
from qe.formula.traverse import conjuncts, disjuncts
from qe.kernel.block import block_goals
from qe.kernel.boolean import Goal, Search, Theory
from qe.kernel.signs import read_polynomials
from qe.kernel.step import Limits
from qe.kernel.terms import Quotient, at_terms
from qe.proof.entry import Entry, Json
from qe.proving.lemma_list import EMPTY, Term, identities
from qe.proving.made import Made, quantified
from qe.proving.primitive_names import SIGNS

Bound = tuple[Poly, int, bool]
"""A polynomial over a positive number, and whether it is strict."""


def by_vertices(made: Made, block: Exists) -> None:
    """A block over linear conditions with numbers and one with parameters, one polyhedron after the other."""
    parts = on_polyhedra(Block(block.variables, block.body))
    if parts is None:
        raise made.claim.fail("expected linear conditions with numbers as coefficients, and one other")
    current, joined = parts
    rest, names = [f for f in conjuncts(block.body) if f != current], list(block.variables)
    for own, conditions in joined:
        rest, names = [f for f in rest if f not in conditions], [v for v in names if v not in own]
        inner = quantified(own, conj((*conditions, current)))
        made.moved(made.current, quantified(names, conj((*rest, inner))))
        polyhedron = Generated.of(own, conditions, made.limits.tick)
        if polyhedron is None or current == FALSE:
            made.simplified(made.current, FALSE)
            break
        cases = {case: quantified(own, conj((*conditions, case))) for case in disjuncts(current)}
        made.signs(inner, disj(cases.values()))
        current = disj(_ended(made, polyhedron, *case) for case in cases.items())


def _ended(made: Made, polyhedron: Generated, given: Formula, block: Formula) -> Formula:
    """The block over one condition: the condition at the generators in its place."""
    if not isinstance(block, Exists):
        return block
    form = LinearForm.of(given, polyhedron.names)
    if form is None and given != TRUE:
        raise made.claim.fail("expected a linear inequality on a polyhedron")
    ends = polyhedron.ends(form) if form is not None else {polyhedron.inner: TRUE}
    if ends is None or (form is not None and form.relation not in (Relation.GT, Relation.GE)):
        raise made.claim.fail("expected a linear inequality on a polyhedron")
    if TRUE in ends.values():
        ends = {next(v for v, end in ends.items() if end == TRUE): TRUE}
    generators = {end: v for v, end in ends.items() if end != FALSE}
    cases = {end: quantified(block.variables, conj((end, block.body))) for end in generators}
    if form is not None and (after := disj(cases.values())) != block:
        _covered(made, polyhedron, form, block, after)
    for end, case in cases.items():
        _reached(made, polyhedron, form, generators[end], case, end)
    return disj(cases)


def _covered(made: Made, polyhedron: Generated, form: LinearForm, block: Exists, after: Formula) -> None:
    """Where no generator has the condition no point of the polyhedron has it."""
    pieces = polyhedron.pieces()
    if not 0 < len(pieces) <= MOST_PIECES:
        raise made.claim.fail("no triangulation, or a large one")
    ring = made.ring
    point = [*map(ring.var, polyhedron.names), ring.constant(1)]
    lemmas = list[list[Term]]()
    for _, spanning in pieces:
        basis, dual = [*spanning, *polyhedron.cone.lines], Cone(len(point))
        for v in basis:
            dual.cut(tuple(-c for c in v))
        parts = [next((_at(f, point), v, value) for f in dual.rays if (value := dot(f, v))) for v in basis]
        whole = lcm(*(value for *_, value in parts))
        terms: list[Term] = [(whole // value, ((f, 1), (form.at(v), 1))) for f, v, value in parts]
        lemmas.append([*terms, (-whole, ((form.poly, 1),))])
        lemmas.append([*((v[-1] * whole // value, ((f, 1),)) for f, v, value in parts), (-whole, ())])
    step = replace(made.claim, rule=SIGNS, before=block, after=after, evidence=Entry({"theory": EMPTY}, "theory"))
    bounds = [(_at(function, point), function[-1], False) for function, _ in pieces]
    theory = some_best(bounds, lemmas, block_goals(step, ())[:1], ring, made.limits)
    made.step(SIGNS, block, after, {"theory": theory})


def _at(function: Vector, point: Sequence[Poly]) -> Poly:
    """A linear function at a point."""
    return sum((p * c for c, p in zip(function, point)), point[0] * 0)


def _reached(
    made: Made, polyhedron: Generated, form: LinearForm | None, v: Vector, case: Formula, end: Formula
) -> None:
    """Where a generator has the condition a point has it: a vertex itself; else, with f for the form at the generator
    and q for it at the inner point, (q^2 + 1)*v + f*inner, where the form is f*(q^2 + q + 1)."""
    ring, inner, lemmas = made.ring, polyhedron.inner, list[list[Term]]()
    *tops, bottom = map(ring.constant, v)
    if form is not None and not (v[-1] and polyhedron.is_closed):
        f, q = (form.at(generator).convert(ring) for generator in (v, inner))
        middle, square = q * q + q + 1, q * q + 1
        *tops, bottom = (square * a + f * b for a, b in zip(v, inner, strict=True))
        lemmas.append([(4, ((middle, 1),)), (-1, ((2 * q + 1, 2),)), (-3, ())])
        lemmas.append([(1, ((bottom, 1),)), (-v[-1], ((q, 2),)), (-v[-1], ()), (-inner[-1], ((f, 1),))])
    there: dict[str, Quotient] = {name: (top, bottom) for name, top in zip(polyhedron.names, tops, strict=True)}
    rows = [row for a in polyhedron.conditions if (row := LinearForm.of(a, polyhedron.names)) is not None]
    for row in (form, *rows) if form is not None and lemmas else ():
        a, b = (row.at(generator).convert(ring) for generator in (v, inner))
        top = square * a + f * b
        value = at_terms(row.poly.convert(ring), {ring.index[name]: term for name, term in there.items()})
        lemmas.append(
            [(1, ((top, 1),)), (-1, ((f, 1), (middle, 1)))]
            if row is form
            else [(1, ((top, 1),)), (-1, ((a, 1), (q, 2))), (-1, ((a, 1),)), (-1, ((b, 1), (f, 1)))]
        )
        for one, other in ((value, top), (top, value)):
            if one == other * bottom:
                lemmas.append([(1, ((one, 1),)), (-1, ((other, 1), (bottom, 1)))])
    made.terms(case, end, there, {}, identities(lemmas, ring))


def some_best(
    bounds: Sequence[Bound], lemmas: Sequence[Sequence[Term]], goals: Sequence[Goal], ring: Ring, limits: Limits
) -> Json:
    """Evidence for the last goal: the best of bounds of a kind would have what it excludes.

    As long as none is the best, each of the first r has a better one among them. For r that is less by one, this
    follows: a better one than the last is better than those that the last is better than. Of three bounds the
    differences, times positive numbers, add up to 0.
    """
    numbers = range(len(bounds))

    def over(k: int, i: int) -> Poly:
        (r, c, _), (s, d, _) = bounds[k], bounds[i]
        return d * r - c * s

    order: list[list[Term]] = [
        [(bounds[k][1], ((over(i, j), 1),)) for i, j, k in ((a, b, c), (b, c, a), (c, a, b))]
        for a, b, c in combinations(numbers, 3)
    ]
    theory = identities([*lemmas, *order], ring)
    assert isinstance(theory, dict)
    polys = read_polynomials(Entry(theory["polynomials"], "theory"), ring)
    search = Search(Theory(polys, (), limits), goals[-1])

    def said(formula: Formula) -> int:
        number, signs = search.literal(formula)
        return 8 * number + signs

    def better(k: int, i: int) -> int:
        return said(atom(over(k, i), Relation.GE if bounds[k][2] and not bounds[i][2] else Relation.GT))

    def worse(k: int, i: int) -> int:
        """As the kernel says it next to a root."""
        return said(disj(atom(over(k, i), relation) for relation in (Relation.LT, Relation.EQ)))

    cases: list[Json] = [[worse(k, i), better(k, i)] for i in numbers if bounds[i][2] for k in numbers if k != i]
    cases += [[better(k, i) for k in range(r) if k != i] for r in range(len(bounds), 1, -1) for i in range(r)]
    return {**theory, "cases": [[len(goals) - 1, clause] for clause in cases]}
