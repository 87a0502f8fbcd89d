"""Sign tables of the free cells: which literals hold on which cells, as bit masks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from qe.exact.ring import Poly
from qe.formula.syntax import Relation
from qe.proof.cells import CHARACTER_OF, Cell, CellTable, FreeCell

_BITS = {own: {ord(c): "01"[c == own] for c in "+-0?"} for own in "+-0?"}
_WEAK_FIRST = (Relation.LE, Relation.GE, Relation.NE, Relation.EQ, Relation.LT, Relation.GT)


def free_cells(table: CellTable) -> Iterator[FreeCell]:
    """All cells over the free variables at which the truth value is known."""
    free = sum(q == "" for q in table.quantifiers)

    def walk(cell: Cell, path: tuple[int, ...], signs: tuple[str, ...]) -> Iterator[FreeCell]:
        if cell.stack is None or len(path) == free:
            assert cell.truth is not None
            yield FreeCell(path, signs, cell.truth)
            return
        used = cell.stack.used
        all_used = used == tuple(range(len(used)))
        for position, below in enumerate(cell.stack.cells):
            own = (below.signs if all_used else _placed(used, below.signs)).rstrip("?")
            yield from walk(below, (*path, position), (*signs, own))

    return walk(table.root, (), ())


def _placed(used: tuple[int, ...], signs: str) -> str:
    """The signs of some factors of a level among those of all."""
    known = dict(zip(used, signs, strict=True))
    return "".join([known.get(j, "?") for j in range(max(used, default=-1) + 1)])


Masks = Mapping[int | None, int]


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
        listing = list({(c.truth, *c.signs): c for c in reversed(list(cells))}.values())[::-1]
        self.true = [c for c in listing if c.truth]
        self.false = [c for c in listing if not c.truth]
        polys = [factor for level in factors for factor in level]
        self._columns = tuple(zip(polys, _columns(self.true, factors), _columns(self.false, factors), strict=True))

    def flipped(self) -> SignTable:
        """The table with true and false exchanged."""
        other = SignTable((), ())
        other.true, other.false = self.false, self.true
        other._columns = tuple((poly, false, true) for poly, true, false in self._columns)
        return other

    @cached_property
    def literals(self) -> list[Literal]:
        """What covers a true cell and excludes a false one; a sign that is not known on a cell covers nothing there."""
        found: list[Literal] = []
        everything = (1 << len(self.false)) - 1
        for factor, holds, keeps in self._columns:
            cost = factor.total_degree + factor.term_count()
            for relation in _WEAK_FIRST:
                covered = sum(holds[s] for s in relation.signs)
                kept = sum(keeps[s] for s in relation.signs) | keeps[None]
                if covered and kept != everything:
                    found.append(Literal(factor, relation, covered, kept, cost))
        return found


def _columns(cells: Sequence[FreeCell], factors: Sequence[Sequence[Poly]]) -> Iterator[Masks]:
    """For every factor and every sign, None for one that is not known, the cells that have it."""
    for level, polys in enumerate(factors):
        width = len(polys)
        rows = [c.signs[level] if level < len(c.signs) else "" for c in reversed(cells)]
        text = "".join([row.ljust(width, "?") for row in rows])
        for j in range(width):
            column = text[j::width]
            yield {sign: int("0" + column.translate(_BITS[own]), 2) for sign, own in CHARACTER_OF.items()}
