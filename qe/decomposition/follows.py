"""Whether the truth of an answer can be read off the signs that a cell table knows."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import reduce
from operator import and_, or_

from qe.decomposition.matrix import Node, Test, compile_matrix, mentioned, specialise
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.formula.traverse import has_root_atoms, polynomials
from qe.proof.cells import SIGN_OF, Cell, CellTable, Stack

_ZERO = str.maketrans("+-0", "001")
_NEGATIVE = str.maketrans("+-0", "010")


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
    return {j: SIGN_OF[c] for j, c in zip(stack.used, cell.signs, strict=True) if c != "?"}


def _agrees(cell: Cell, node: Node, level: int, free: int) -> bool:
    if cell.stack is None or level == free:
        return node is cell.truth
    wanted = mentioned(node, level)
    places = [(p, j) for p, j in enumerate(cell.stack.used) if j in wanted]
    spoken = ["".join([below.signs[p] for p, _ in places]) for below in cell.stack.cells]
    if level == free - 1 and not isinstance(node, bool):
        columns = _columns(spoken, [j for _, j in places])
        if columns is not None and _is_only_of(node, level, columns.keys()):
            true = int("".join(["01"[below.truth is True] for below in cell.stack.cells]), 2)
            known = all(below.truth is not None for below in cell.stack.cells)
            return known and _where_true(node, columns, (1 << len(spoken)) - 1) == true
    known_nodes: dict[str, Node] = {}  # neighbours often have the same signs
    for below, text in zip(cell.stack.cells, spoken, strict=True):
        if text not in known_nodes:
            signs = {j: SIGN_OF[c] for (_, j), c in zip(places, text, strict=True) if c != "?"}
            known_nodes[text] = specialise(node, level, signs)
        if not _agrees(below, known_nodes[text], level + 1, free):
            return False
    return True


Columns = Mapping[int, tuple[int, int]]
"""For every factor of a level the cells of a stack, as bits, on which it is zero, and those on which it is negative."""


def _columns(rows: Sequence[str], indices: Sequence[int]) -> Columns | None:
    """The columns of the signs of these factors; None where a sign is not known."""
    text, width = "".join(rows), len(indices)
    if "?" in text:
        return None
    return {
        j: (int(text[p::width].translate(_ZERO), 2), int(text[p::width].translate(_NEGATIVE), 2))
        for p, j in enumerate(indices)
    }


def _is_only_of(node: Node, level: int, known: Collection[int]) -> bool:
    """Whether a node depends on these factors of the level only."""
    if isinstance(node, Test):
        return all(at == level and j in known for at, j, _ in node.parts)
    return isinstance(node, bool) or all(_is_only_of(arg, level, known) for arg in node.args)


def _where_true(node: Node, columns: Columns, everywhere: int) -> int:
    """The cells, as bits, on which a node that depends on the columns only is true: all cells of a stack at once."""
    if isinstance(node, bool):
        return everywhere if node else 0
    if isinstance(node, Test):
        zero = negative = 0
        for _, j, odd in node.parts:
            own_zero, own_negative = columns[j]
            zero |= own_zero
            negative ^= own_negative if odd else 0
        signs = {0: zero, -1: negative & ~zero, 1: everywhere & ~(zero | negative)}
        return reduce(or_, (signs[sign] for sign in node.allowed), 0)
    parts = (_where_true(arg, columns, everywhere) for arg in node.args)
    return reduce(and_, parts, everywhere) if node.is_and else reduce(or_, parts, 0)
