"""Lifting: from factor lists to a (partial) decomposition with truth values (Collins and Hong 1991).

A cell is decomposed only while the formula is undecided there; a quantified stack stops at the first cell
that decides it; at the last level only the factors that the formula still depends on are isolated.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from qe.eliminate.cad.matrix import Node, mentioned, specialise
from qe.eliminate.cad.projection import Levels
from qe.errors import NotWellOriented
from qe.evidence.cells import Cell, Stack
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.sample import Point
from qe.formula.syntax import Atom, Formula, Not
from qe.formula.traverse import atoms, children
from qe.options import Budget, Projection

_CHARACTER = {1: "+", -1: "-", 0: "0"}
_VALUE = {"+": 1, "-": -1, "0": 0}


@dataclass(slots=True)
class Lifter:
    """One lifting run. From level ``sectors_from`` on, sections need not be visited (see ``sector_levels``)."""

    levels: Levels
    quantifiers: tuple[str, ...]
    projection: Projection
    budget: Budget
    sectors_from: int
    cells: int = 0
    stacks: int = 0
    _shared: dict[tuple[int, int, str], Node] = field(default_factory=dict)
    _relevant: dict[tuple[int, int], tuple[int, ...]] = field(default_factory=dict)
    _interned: dict[Node, Node] = field(default_factory=dict)
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
        isolation = isolate_over(
            point, tuple(self.levels[level][j] for j in used), lazard=self.projection is Projection.LAZARD
        )
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
        harmless = dimension == 0 and level == len(self.levels) - 1
        if isolation.nullified and self.projection is not Projection.LAZARD and not harmless:
            raise NotWellOriented(f"a factor of level {level} is nullified over a cell of dimension {dimension}")

    def _stack(
        self, point: Point, node: Node, signs: str, dimension: int, used: tuple[int, ...], isolation: Isolation
    ) -> Cell:
        level = point.depth
        quantifier = self.quantifiers[level]
        size = 2 * len(isolation.sections) + 1
        texts = _sign_texts(isolation)
        cells: list[Cell | None] = [None] * size
        truth: bool | None = None
        if quantifier:
            stop = quantifier == "E"
            truth = not stop
            for position in _visiting_order(size, sectors_only=level >= self.sectors_from):
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
        self,
        point: Point,
        node: Node,
        used: tuple[int, ...],
        isolation: Isolation,
        position: int,
        text: str,
        dimension: int,
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
        """``specialise`` by the signs in ``text``; equal nodes are one object, and equal questions are asked once."""
        relevant = self._relevant.get((id(node), level))
        if relevant is None:
            self._alive.append(node)  # ids stay unique while the node lives
            relevant = self._relevant[id(node), level] = tuple(sorted(mentioned(node, level)))
        spoken = text if len(relevant) == len(used) else "".join([text[j] for j in relevant])
        key = (id(node), level, spoken)
        stored = self._shared.get(key)
        if stored is None:
            signs = {j: _VALUE[c] for j, c in zip(relevant, spoken, strict=True)}
            found = specialise(node, level, signs)
            stored = self._shared[key] = self._interned.setdefault(found, found)
        return stored


def _sign_texts(isolation: Isolation) -> list[str]:
    """The signs of the used factors on every cell of the stack, one character per factor."""
    rows = [[_CHARACTER[sign] for sign in row] for row in isolation.signs]
    columns = list(zip(*rows, strict=True)) if rows else [()] * len(isolation.sectors)
    texts: list[str] = []
    for sector, column in enumerate(columns):
        texts.append("".join(column))
        if sector < len(isolation.sections):
            own = list(column)
            for j in isolation.sections[sector].members:
                own[j] = "0"
            texts.append("".join(own))
    return texts


def _visiting_order(size: int, *, sectors_only: bool) -> list[int]:
    """Sectors first (rational samples are cheap), middle ones first, then sections likewise."""
    middle = size // 2
    positions = range(0, size, 2) if sectors_only else range(size)
    return sorted(positions, key=lambda p: (p % 2, abs(p - middle)))


def sector_levels(matrix: Formula, quantifiers: tuple[str, ...]) -> int:
    """The first level from which on quantified stacks are decided by their sectors alone.

    THEOREM. With only strict atoms (<, >, /=, no negation) and only existential quantifiers from a level on, the values
    of its variable that can be completed to a solution over any point form an open set, which meets a
    sector if it is not empty. Dually for weak atoms (<=, >=, =) and universal quantifiers.
    """
    last = quantifiers[-1]
    relations = {a.relation for a in atoms(matrix)}
    plain = all(isinstance(a, Atom) for a in atoms(matrix)) and not _has_negation(matrix)
    strict = all(r.is_strict for r in relations)
    weak = not any(r.is_strict for r in relations)
    if not plain or not ((last == "E" and strict) or (last == "A" and weak)):
        return len(quantifiers)
    level = len(quantifiers)
    while level and quantifiers[level - 1] == last:
        level -= 1
    return level


def _has_negation(formula: Formula) -> bool:
    return isinstance(formula, Not) or any(_has_negation(c) for c in children(formula))
