"""Shadows of polyhedra: an existential block over linear conditions with numbers as coefficients, and its dual.

Where such conditions have no parameters, and one more, linear in the variables, has parameters in its coefficients, the
answer is read off the polyhedron's vertices and directions (``qe.convex.vertices``).
"""

from __future__ import annotations

from qe.convex.linear_rows import LinearRows, linear_atoms
from qe.convex.polyhedron import Check, Polyhedron
from qe.convex.shadow import shadow
from qe.convex.vertices import MOST_PIECES, Generated, LinearForm, on_polyhedra
from qe.elimination.protocol import Context, Outcome
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import conj, disj
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, Atom, Constant, Formula, Relation
from qe.formula.traverse import disjuncts
from qe.options import Options

_STEP = 10
"""Units of work of one look at a row."""


class Projection:
    """Conjunctions of linear conditions: the answer has no condition that the others imply."""

    name = "projection"

    def suits(self, problem: Block, options: Options) -> str | None:
        """One block with parameters."""
        return f"{len(problem.variables)} variables" if problem.is_flat and problem.free else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The shadow; None where the body is no conjunction of linear equations and inequalities."""

        def check() -> None:
            context.budget.spend(_STEP)
            context.budget.check("projection")

        if not (atoms := linear_atoms(problem.positive)):
            positive = _by_generators(problem, check, context.options.certify)
            if positive is None:
                return None
            after = nnf(positive, negate=problem.universal)
            atoms = linear_atoms(nnf(positive, negate=True))
            polyhedron = Polyhedron.of(LinearRows.of(atoms))
            kept = polyhedron.irredundant(check)
            shortest = kept is not None and 0 < len(kept.halves) == len(polyhedron.halves) == len(atoms)
            return Outcome(context.log.step("projection", problem.formula, after), shortest=shortest)
        system = LinearRows.of(atoms)
        bound = [j for j, name in enumerate(system.names) if name in problem.variables]
        projected = shadow(Polyhedron.of(system), bound, check)
        positive = FALSE if projected is None else _formula(projected, system.names, atoms[0].poly.ring)
        after = nnf(positive, negate=problem.universal)
        return Outcome(context.log.step("projection", problem.formula, after), shortest=True)


def _formula(projected: Polyhedron, names: tuple[str, ...], ring: Ring) -> Formula:
    """The conditions; two half-spaces that touch are an equation."""
    known = {(row.normal, row.constant) for row in projected.halves if not row.strict}
    parts = [row.condition(names, ring, Relation.EQ) for row in projected.equations]
    for row in projected.halves:
        opposite = tuple((j, -c) for j, c in row.normal), -row.constant
        flat = not row.strict and opposite in known
        parts.append(row.condition(names, ring, Relation.EQ if flat else None))
    return conj(dict.fromkeys(parts))


def _by_generators(problem: Block, check: Check, provable: bool = False) -> Formula | None:
    """The positive answer by vertices and directions, for variables that conditions join at a time; None where the body
    is not of its kind, or there is no proof that is looked for."""
    if (parts := on_polyhedra(problem)) is None:
        return None
    current, joined = parts
    forms = [LinearForm.of(f, problem.variables) for f in disjuncts(current)]
    if all(form is not None and all(c.is_constant for c in form.coefficients[:-1]) for form in forms):
        return None  # substitution answers that, with evidence
    for names, conditions in joined:
        if (polyhedron := Generated.of(names, conditions, check)) is None:
            return FALSE
        if provable and not 0 < len(polyhedron.pieces()) <= MOST_PIECES:
            return None
        images = [_image(f, polyhedron, provable) for f in disjuncts(current)]
        if None in images:
            return None
        current = disj(image for image in images if image is not None)
    return current


def _image(given: Formula, polyhedron: Generated, provable: bool) -> Formula | None:
    """That a condition that is linear in variables holds at a point of their polyhedron; None of any other."""
    if isinstance(given, Constant):
        return given
    if isinstance(given, Atom) and given.relation is Relation.EQ and not provable:
        sides = [_image(Atom(given.poly, side), polyhedron, False) for side in (Relation.GE, Relation.LE)]
        return conj(side for side in sides if side is not None) if None not in sides else None
    form = LinearForm.of(given, polyhedron.names)
    if form is None or (provable and form.relation not in (Relation.GT, Relation.GE)):
        return None
    ends = polyhedron.ends(form)
    return None if ends is None else disj(ends.values())
