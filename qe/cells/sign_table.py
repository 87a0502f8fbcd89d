"""Sign tables of the free cells: which literals hold on which cells, as bit masks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.syntax import Relation
from qe.proof.cells import Cell, CellTable, FreeCell

_VALUE = {"+": 1, "-": -1, "0": 0}
_CHARACTER = {1: "+", -1: "-", 0: "0", None: "?"}
_WEAK_FIRST = (Relation.LE, Relation.GE, Relation.NE, Relation.EQ, Relation.LT, Relation.GT)


def free_cells(table: CellTable) -> Iterator[FreeCell]:
    """All cells over the free variables at which the truth value is known."""
    free = sum(q == "" for q in table.quantifiers)
    met: dict[tuple[tuple[int, ...], str], dict[int, int]] = {}  # equal signs of a level are one object

    def walk(cell: Cell, path: tuple[int, ...], signs: tuple[dict[int, int], ...]) -> Iterator[FreeCell]:
        if cell.stack is None or len(path) == free:
            assert cell.truth is not None
            yield FreeCell(path, signs, cell.truth)
            return
        for position, below in enumerate(cell.stack.cells):
            key = cell.stack.used, below.signs
            own = met.get(key)
            if own is None:
                own = met[key] = {j: _VALUE[c] for j, c in zip(*key, strict=True) if c != "?"}
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
    """Bit masks over the true cells and over the false cells, one bit for all that have the same signs."""

    def __init__(self, factors: Sequence[Sequence[Poly]], cells: Iterable[FreeCell]) -> None:
        listing = list({(c.truth, *map(id, c.signs)): c for c in reversed(list(cells))}.values())[::-1]
        self.true = [c for c in listing if c.truth]
        self.false = [c for c in listing if not c.truth]
        self.literals: list[Literal] = []
        for level, polys in enumerate(factors):
            for j, factor in enumerate(polys):
                self._add(level, j, factor)

    def _add(self, level: int, j: int, factor: Poly) -> None:
        holds, unknown_true = self._masks(self.true, level, j)
        keeps, unknown_false = self._masks(self.false, level, j)
        del unknown_true  # a literal whose sign varies over a true cell does not cover it
        cost = factor.total_degree + factor.term_count()
        everything = (1 << len(self.false)) - 1
        for relation in _WEAK_FIRST:
            covered = sum(holds[s] for s in relation.signs)
            kept = sum(keeps[s] for s in relation.signs) | unknown_false
            if covered and kept != everything:
                self.literals.append(Literal(factor, relation, covered, kept, cost))

    @staticmethod
    def _masks(cells: list[FreeCell], level: int, j: int) -> tuple[dict[int | None, int], int]:
        text = "".join(_CHARACTER[c.signs[level].get(j) if level < len(c.signs) else None] for c in reversed(cells))
        masks = {
            sign: int("0" + text.translate({ord(c): "01"[c == own] for c in "+-0?"}), 2)
            for sign, own in _CHARACTER.items()
        }
        unknown = masks.pop(None)
        return masks, unknown
