"""Whether the truth of an answer can be read off the signs that a cell table knows."""

from __future__ import annotations

from qe.cad.matrix import Node, compile_matrix, mentioned, specialise
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.formula.traverse import has_root_atoms, polynomials
from qe.proof.cells import Cell, CellTable, Stack

_VALUE = {"+": 1, "-": -1, "0": 0}


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
    free = sum(q == "" for q in table.quantifiers)
    places = {f: (k, j) for k, level in enumerate(table.factors) for j, f in enumerate(level)}
    return _agrees(table.root, compile_matrix(convert(answer, Ring.of(table.order)), places), 0, free)


def signs_of(stack: Stack, cell: Cell) -> dict[int, int]:
    """The signs of the level's factors, by their numbers, on a cell of the stack; without those that are open."""
    return {j: _VALUE[c] for j, c in zip(stack.used, cell.signs, strict=True) if c != "?"}


def _agrees(cell: Cell, node: Node, level: int, free: int) -> bool:
    if cell.stack is None or level == free:
        return node is cell.truth
    wanted = mentioned(node, level)
    places = [(p, j) for p, j in enumerate(cell.stack.used) if j in wanted]
    known: dict[str, Node] = {}  # neighbours often have the same signs
    for below in cell.stack.cells:
        spoken = "".join([below.signs[p] for p, _ in places])
        if spoken not in known:
            signs = {j: _VALUE[c] for (_, j), c in zip(places, spoken, strict=True) if c != "?"}
            known[spoken] = specialise(node, level, signs)
        if not _agrees(below, known[spoken], level + 1, free):
            return False
    return True
