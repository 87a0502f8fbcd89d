"""Sign tables of the free cells: which literals hold on which cells, as bit masks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.syntax import Relation
from qe.proof.cells import Cell, CellTable, FreeCell

_VALUE = {"+": 1, "-": -1, "0": 0}
_WEAK_FIRST = (Relation.LE, Relation.GE, Relation.NE, Relation.EQ, Relation.LT, Relation.GT)


def free_cells(table: CellTable) -> Iterator[FreeCell]:
    """All cells over the free variables at which the truth value is known."""
    free = sum(q == "" for q in table.quantifiers)

    def walk(cell: Cell, path: tuple[int, ...], signs: tuple[dict[int, int], ...]) -> Iterator[FreeCell]:
        if cell.stack is None or len(path) == free:
            assert cell.truth is not None
            yield FreeCell(path, signs, cell.truth)
            return
        for position, below in enumerate(cell.stack.cells):
            own = {j: _VALUE[c] for j, c in zip(cell.stack.used, below.signs, strict=True) if c != "?"}
            yield from walk(below, (*path, position), (*signs, own))

    return walk(table.root, (), ())


@dataclass(frozen=True, slots=True)
class Literal:
    """``poly relation 0`` with the cells it holds on (``true`` cells) and the false cells it does not exclude."""

    poly: Poly
    relation: Relation
    holds: int
    keeps: int
    cost: int


class SignTable:
    """Bit masks over the true cells and over the false cells, one bit each."""

    def __init__(self, factors: Sequence[Sequence[Poly]], cells: Iterable[FreeCell]) -> None:
        listing = list(cells)
        self.true = [c for c in listing if c.truth]
        self.false = [c for c in listing if not c.truth]
        self.literals: list[Literal] = []
        for level, polys in enumerate(factors):
            for j, factor in enumerate(polys):
                self._add(level, j, factor)

    def _add(self, level: int, j: int, factor: Poly) -> None:
        holds, _ = self._masks(self.true, level, j)  # a literal whose sign varies over a true cell does not cover it
        keeps, unknown_false = self._masks(self.false, level, j)
        cost = factor.total_degree + factor.term_count()
        everything = (1 << len(self.false)) - 1
        for relation in _WEAK_FIRST:
            covered = sum(holds[s] for s in relation.signs)
            kept = sum(keeps[s] for s in relation.signs) | unknown_false
            if covered and kept != everything:
                self.literals.append(Literal(factor, relation, covered, kept, cost))

    @staticmethod
    def _masks(cells: list[FreeCell], level: int, j: int) -> tuple[dict[int, int], int]:
        masks, unknown = {-1: 0, 0: 0, 1: 0}, 0
        for bit, cell in enumerate(cells):
            sign = cell.signs[level].get(j) if level < len(cell.signs) else None
            if sign is None:
                unknown |= 1 << bit
            else:
                masks[sign] |= 1 << bit
        return masks, unknown
