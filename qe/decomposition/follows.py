"""Whether the truth of an answer can be read off the signs that a cell table knows."""

from __future__ import annotations

from qe.decomposition.sign_table import Columns, free_cells
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.formula.traverse import has_root_atoms, polynomials
from qe.proof.cells import CellTable


def is_listed(answer: Formula, table: CellTable) -> bool:
    """Whether the answer's polynomials are products of the table's factors."""
    factors = {f for level in table.factors for f in level}
    ring = Ring.of(table.order)
    return all(f in factors for p in polynomials(answer) for f, _ in p.convert(ring).factors()[1])


def follows(answer: Formula, table: CellTable) -> bool:
    """Whether on every free cell the answer has the truth value of the cell by the signs known there (as checked).

    Equivalent answers may differ in this: a cell that is left undecomposed, or lies between the sections of an
    equational constraint, lacks signs, and simplifying may bring in one of those. Of answers with root atoms only
    the polynomials are looked at.
    """
    if not is_listed(answer, table):
        return False
    if has_root_atoms(answer):
        return True
    claim, cells = convert(answer, Ring.of(table.order)), free_cells(table)
    for truth in (True, False):
        columns = Columns([c for c in cells if c.truth is truth], table.factors[: table.free])
        if columns.where(claim)[not truth] != columns.everything:
            return False
    return True
