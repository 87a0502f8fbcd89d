"""Shadows of polyhedra: an existential block over linear conditions with numbers as coefficients, and its dual."""

from __future__ import annotations

from qe.convex.linear_rows import LinearRows, linear_atoms
from qe.convex.polyhedron import Polyhedron
from qe.convex.shadow import shadow
from qe.elimination.protocol import Context, Outcome
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import conj
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, Formula, Relation
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
        if not (atoms := linear_atoms(problem.positive)):
            return None

        def check() -> None:
            context.budget.spend(_STEP)
            context.budget.check("projection")

        system = LinearRows.of(atoms)
        bound = [j for j, name in enumerate(system.names) if name in problem.variables]
        projected = shadow(Polyhedron.of(system), bound, check)
        positive = FALSE if projected is None else _formula(projected, system.names, problem.free)
        after = nnf(positive, negate=problem.universal)
        return Outcome(context.log.step("projection", problem.formula, after), shortest=True)


def _formula(projected: Polyhedron, names: tuple[str, ...], free: tuple[str, ...]) -> Formula:
    """The conditions; two half-spaces that touch are an equation."""
    ring = Ring.of(free)
    known = {(row.normal, row.constant) for row in projected.halves if not row.strict}
    parts = [row.condition(names, ring, Relation.EQ) for row in projected.equations]
    for row in projected.halves:
        opposite = tuple((j, -c) for j, c in row.normal), -row.constant
        flat = not row.strict and opposite in known
        parts.append(row.condition(names, ring, Relation.EQ if flat else None))
    return conj(dict.fromkeys(parts))
