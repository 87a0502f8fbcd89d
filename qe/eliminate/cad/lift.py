"""Lifting: from factor lists to a (partial) decomposition with truth values (Collins and Hong 1991).

A cell is decomposed only while the formula is undecided there; a quantified stack stops at the first cell
that decides it; at the last level only the factors that the formula still depends on are isolated.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from flint import fmpq

from qe.eliminate.cad.matrix import Node, mentioned, specialise
from qe.eliminate.cad.projection import Levels
from qe.errors import NotWellOriented
from qe.evidence.cells import Cell, Stack
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.sample import Point
from qe.options import Budget, Projection

_CHARACTER = {1: "+", -1: "-", 0: "0"}


@dataclass(slots=True)
class Lifter:
    """One lifting run. ``deciders`` records the sample that decided the outermost quantified block, if any."""

    levels: Levels
    quantifiers: tuple[str, ...]
    projection: Projection
    budget: Budget
    cells: int = 0
    stacks: int = 0
    _shared: dict[tuple[int, int, tuple[int, ...], str], Node] = field(default_factory=dict)
    _alive: list[Node] = field(default_factory=list)

    def run(self, point: Point, node: Node) -> Cell:
        """The root cell, decomposed as far as needed."""
        return self._cell(point, node, "", 0)

    def _cell(self, point: Point, node: Node, signs: str, dimension: int) -> Cell:
        """The cell whose sample is ``point`` (``dimension`` of its coordinates are sectors)."""
        if isinstance(node, bool):
            return Cell(signs, node)
        level = point.depth
        used = self._used(node, level)
        isolation = isolate_over(point, tuple(self.levels[level][j] for j in used), lazard=self.projection is Projection.LAZARD)
        self._check_orientation(isolation, level, dimension)
        self.stacks += 1
        count = 2 * len(isolation.sections) + 1
        self.cells += count
        self.budget.used_cells += count
        self.budget.check("lift", self.cells)
        return self._stack(point, node, signs, dimension, used, isolation)

    def _used(self, node: Node, level: int) -> tuple[int, ...]:
        if level < len(self.levels) - 1:
            return tuple(range(len(self.levels[level])))
        return tuple(sorted(mentioned(node, level)))

    def _check_orientation(self, isolation: Isolation, level: int, dimension: int) -> None:
        """Brown 2001 needs factors that are not nullified, except over single points on the last level."""
        if isolation.nullified and self.projection is not Projection.LAZARD:
            if dimension > 0 or level < len(self.levels) - 1:
                raise NotWellOriented(f"a factor of level {level} is nullified over a cell of dimension {dimension}")

    def _stack(
        self, point: Point, node: Node, signs: str, dimension: int, used: tuple[int, ...], isolation: Isolation
    ) -> Cell:
        level = point.depth
        quantifier = self.quantifiers[level]
        size = 2 * len(isolation.sections) + 1
        texts = [_sign_text(isolation, position) for position in range(size)]
        cells: list[Cell | None] = [None] * size
        truth: bool | None = None
        if quantifier:
            stop = quantifier == "E"
            truth = not stop
            for position in _visiting_order(size):
                cell = self._child(point, node, used, isolation, position, texts[position], dimension)
                cells[position] = cell
                if cell.truth is stop:
                    truth = stop
                    break
        else:
            for position in range(size):
                cells[position] = self._child(point, node, used, isolation, position, texts[position], dimension)
        complete = tuple(Cell(texts[p], None) if c is None else c for p, c in enumerate(cells))
        sectors = tuple(Fraction(int(q.p), int(q.q)) for q in isolation.sectors)
        sections = tuple(tuple(sorted(used[j] for j in s.members)) for s in isolation.sections)
        return Cell(signs, truth, Stack(used, sectors, sections, complete))

    def _child(
        self, point: Point, node: Node, used: tuple[int, ...], isolation: Isolation, position: int, text: str, dimension: int
    ) -> Cell:
        child = self._specialised(node, point.depth, used, text)
        if isinstance(child, bool):
            return Cell(text, child)
        if position % 2:
            value = isolation.sections[position // 2].value
        else:
            value = isolation.sectors[position // 2]
        return self._cell(point.extend(value), child, text, dimension + (position % 2 == 0))

    def _specialised(self, node: Node, level: int, used: tuple[int, ...], text: str) -> Node:
        key = (id(node), level, used, text)
        stored = self._shared.get(key)
        if stored is None:
            signs = {j: 1 if c == "+" else -1 if c == "-" else 0 for j, c in zip(used, text, strict=True)}
            stored = specialise(node, level, signs)
            self._alive.append(node)  # ids stay unique while the node lives
            self._shared[key] = stored
        return stored


def _sign_text(isolation: Isolation, position: int) -> str:
    sector = position // 2
    if position % 2 == 0:
        return "".join(_CHARACTER[row[sector]] for row in isolation.signs)
    members = isolation.sections[sector].members
    return "".join("0" if j in members else _CHARACTER[row[sector]] for j, row in enumerate(isolation.signs))


def _visiting_order(size: int) -> list[int]:
    """Sectors first (rational samples are cheap), middle ones first, then sections likewise."""
    middle = size // 2
    return sorted(range(size), key=lambda p: (p % 2, abs(p - middle)))


def sample_value(isolation: Isolation, position: int) -> fmpq:
    """The sample of a sector position."""
    return isolation.sectors[position // 2]
