"""Extended Tarski formulas: the merged cylindrical pieces, written with root atoms (Brown 1999, chapter 7)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from qe.decomposition.decompose import decompose
from qe.decomposition.pieces import Range, RootFunction, merge
from qe.decomposition.sampled_cells import free_part
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, root_atom
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import map_atoms
from qe.options import Budget
from qe.proof.cells import Cell, CellTable


def extended_formula(table: CellTable) -> Formula:
    """A formula over the free variables that is true exactly on the true cells: one conjunction per piece.

    Inside a piece all roots that its bounds name exist, and outside no conjunction holds, because each bound is
    stated over the ranges of the earlier variables.
    """
    pieces = merge(free_part(table), distinct=True)
    return disj(conj(part for r in piece.ranges for part in _range(r)) for piece in pieces)


def true_everywhere(formula: Formula, order: tuple[str, ...], budget: Budget) -> CellTable:
    """A table that says that a formula, perhaps with root atoms, is true at every point; whether it is, checkers see.

    Signs of the polynomials of root atoms take their places for the decomposition, which isolates the roots that they
    count wherever those signs are needed.
    """
    matrix = nnf(convert(formula, Ring.of(order)))
    signs = map_atoms(matrix, lambda a: a if isinstance(a, Atom) else atom(a.poly, a.relation))
    table = decompose(signs, order, ("",) * len(order), budget=budget).table
    return replace(table, matrix=matrix, quantifiers=("A",) * len(order), root=_true(table.root))


def _true(cell: Cell) -> Cell:
    stack = cell.stack
    return replace(cell, truth=True, stack=stack and replace(stack, cells=tuple(map(_true, stack.cells))))


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
