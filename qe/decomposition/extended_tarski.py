"""Extended Tarski formulas: the merged cylindrical pieces, written with root atoms (Brown 1999, chapter 7)."""

from __future__ import annotations

from collections.abc import Iterator

from qe.decomposition.pieces import Range, RootFunction, merge
from qe.decomposition.sampled_cells import free_part
from qe.formula.build import atom, conj, disj, root_atom
from qe.formula.syntax import Formula, Relation
from qe.proof.cells import CellTable


def extended_formula(table: CellTable) -> Formula:
    """A formula over the free variables that is true exactly on the true cells: one conjunction per piece.

    Inside a piece all roots that its bounds name exist, and outside no conjunction holds, because each bound is
    stated over the ranges of the earlier variables.
    """
    pieces = merge(free_part(table), distinct=True)
    return disj(conj(part for r in piece.ranges for part in _range(r)) for piece in pieces)


def _range(r: Range) -> Iterator[Formula]:
    if r.lower is not None and r.lower == r.upper:
        yield _bound(r.variable, Relation.EQ, r.lower)
        return
    if r.lower is not None:
        yield _bound(r.variable, Relation.GE if r.lower_closed else Relation.GT, r.lower)
    if r.upper is not None:
        yield _bound(r.variable, Relation.LE if r.upper_closed else Relation.LT, r.upper)


def _bound(variable: str, relation: Relation, root: RootFunction) -> Formula:
    coefficients = root.poly.coefficients(root.poly.level)
    if len(coefficients) == 2 and coefficients[1].is_constant:
        return atom(root.poly, relation if coefficients[1].constant_value() > 0 else relation.flipped)
    return root_atom(variable, relation, root.poly, root.k)
