"""Lifting: from factor lists to a (partial) decomposition with truth values (Collins and Hong 1991).

A cell is decomposed only while the formula is undecided there; a quantified stack stops at the first cell
that decides it; at the last level only the factors that the formula still depends on are isolated.
"""

from __future__ import annotations

import pickle
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import cast

from qe.decomposition.matrix import Node, mentioned, specialise
from qe.decomposition.operators.operator import Operator
from qe.decomposition.projection import Levels
from qe.decomposition.stack import SampledStack, is_nullified, restricted_stack, stack_over
from qe.errors import BudgetExceeded, InternalError
from qe.exact.lazard import lazard_derivative
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.openness import is_closed, is_open
from qe.formula.syntax import Formula
from qe.options import Budget, Call, Helpers
from qe.proof.cells import SIGN_OF, Cell, Stack

SPREAD_FROM = 200
"""Cells after which helpers take part: what is smaller is done before they have the first cell."""

SPREAD_LEVELS = 3
"""Cells of the first so many levels are handed to helpers; there are enough of them, and each is a piece of work."""

SPREAD_WIDTH = 4
"""A stack is handed out once it has so many cells for each helper; else the stacks above its cells are."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What lifting is to do. From level ``sectors_from`` on, sections need not be visited (see ``sector_levels``).

    ``constraints``: indices of the factors of equational constraints by level (see ``equational``). Without
    ``partial`` cells are decomposed also where the formula is decided, and every cell of a stack is visited. With
    ``whole_free`` that holds for the levels of free variables: every free cell then has the signs of all factors.
    ``thom_levels``: see ``Lifter.lacking``. ``direction``: the formula stays true where the last free variable grows
    (1) or falls (-1), or that is not known (0); see ``qe.formula.monotone``.
    """

    levels: Levels
    quantifiers: tuple[str, ...]
    operator: Operator
    sectors_from: int
    constraints: Mapping[int, frozenset[int]] = field(default_factory=dict)
    partial: bool = True
    whole_free: bool = False
    thom_levels: frozenset[int] = frozenset()
    direction: int = 0

    def bisects(self, level: int) -> bool:
        """Whether in a stack of this level, that of the last free variable, the truth changes once at most."""
        if not self.direction or not self.partial or level + 1 >= len(self.quantifiers):
            return False
        return not self.quantifiers[level] and bool(self.quantifiers[level + 1])


@dataclass(frozen=True, slots=True)
class _StackOver:
    """A stack whose cells are asked for. ``node``: what is left of the matrix over the sample ``point``; ``dimension``:
    how many of its coordinates are sectors; ``used``: the factors of the stack."""

    point: Point
    node: Node
    dimension: int
    used: tuple[int, ...]
    stack: SampledStack

    def dimension_at(self, position: int) -> int:
        """How many coordinates of the sample at a position are sectors."""
        return self.dimension + (position % 2 == 0)


@dataclass(slots=True)
class Lifter:
    """One lifting run.

    ``lacking``: where a factor of a level in ``Plan.thom_levels`` is nullified, its signs and derivatives do not tell
    the sections of its Lazard evaluation apart; partial derivatives that do are collected here, where truth depends on
    it. Where the budget has helpers, the cells of one stack are lifted side by side; the table is the same.
    ``anytime``: where the budget ends, the cells of the free variables that are decided are kept, and the others have
    no truth value; sectors come first.
    """

    plan: Plan
    budget: Budget
    lacking: dict[Poly, None] = field(default_factory=dict)
    cells: int = 0
    stacks: int = 0
    anytime: bool = False
    _ended: bool = False
    _shared: dict[tuple[int, int, str], Node] = field(default_factory=dict)
    _relevant: dict[tuple[int, int], tuple[int, ...]] = field(default_factory=dict)
    _interned: dict[Node, Node] = field(default_factory=dict)
    _alive: list[Node] = field(default_factory=list)
    _leaves_of: dict[int, dict[str, Cell]] = field(default_factory=dict)

    def run(self, point: Point, node: Node) -> Cell:
        """The root cell, decomposed as far as needed."""
        return self.cell(point, node, "", 0)

    def cell(self, point: Point, node: Node, signs: str, dimension: int) -> Cell:
        """The cell whose sample is ``point`` (``dimension`` of its coordinates are sectors)."""
        level = point.depth
        if isinstance(node, bool) and self._leaves(level):
            return Cell(signs, node)
        used = self._used(node, level)
        stack = self._stack_over(point, used, dimension)
        self.stacks += 1
        count = len(stack.texts)
        self.cells += count
        self.budget.spend(count)
        self.budget.check("lift", self.cells)
        return self._stack(_StackOver(point, node, dimension, used, stack), signs)

    def _leaves(self, level: int) -> bool:
        """Whether cells with ``level`` coordinates are left as they are when their truth is known."""
        if level == len(self.plan.levels):
            return True
        return self.plan.partial and not (self.plan.whole_free and not self.plan.quantifiers[level])

    def _used(self, node: Node, level: int) -> tuple[int, ...]:
        """The factors that a stack decomposes by: all of the level, or the ones mentioned on the last level."""
        if level < len(self.plan.levels) - 1 or not self._leaves(level):
            return tuple(range(len(self.plan.levels[level])))
        return self._mentioned(node, level)

    def _stack_over(self, point: Point, used: tuple[int, ...], dimension: int) -> SampledStack:
        """The stack over a cell, by the sections of the level's constraint alone if it has one."""
        level = point.depth
        factors, constraint = self.plan.levels[level], self.plan.constraints.get(level)
        last, operator = level == len(self.plan.levels) - 1, self.plan.operator
        if constraint is not None:
            stack = restricted_stack(point, factors, used, constraint)
            # A nullified factor of the constraint makes it true on the whole line: its sections then say nothing.
            nullified = stack.nullified
            # The other factors must be delineable as well where something is lifted above their signs (McCallum 2001);
            # on the last level their signs on the sections are enough (McCallum 1999).
            if not last:
                nullified += tuple(j for j in used if j not in constraint and is_nullified(point, factors[j]))
            if not nullified:
                return stack
        # No constraint, or one that does not apply over this cell: the sections of all factors.
        stack = stack_over(point, factors, used, lazard=operator.evaluates)
        if stack.nullified:
            operator.check_nullified(level, dimension, is_needed=not last or dimension > 0)
        return stack

    def _stack(self, over: _StackOver, signs: str) -> Cell:
        level, stack = over.point.depth, over.stack
        quantifier = self.plan.quantifiers[level]
        size = len(stack.texts)
        cells: list[Cell | None] = [None] * size
        stop = quantifier == "E"
        truth = not stop if quantifier else None
        ordered = bool(quantifier) or self.anytime
        last = level == len(self.plan.levels) - 1
        positions = _visiting_order(size, level >= self.plan.sectors_from) if ordered else range(size)
        try:
            cells_in = self._leaf_cells if last else self._bisected if self.plan.bisects(level) else self._cells
            for position, cell in cells_in(over, positions):
                cells[position] = cell
                if (quantifier and cell.truth is stop and self.plan.partial) or self._ended:
                    break
        except BudgetExceeded:
            if not self.anytime or quantifier:
                raise
            self._ended = True
        if quantifier and any(cell is not None and cell.truth is stop for cell in cells):
            truth = stop
        complete = tuple(Cell(stack.texts[p], None) if c is None else c for p, c in enumerate(cells))
        if stack.nullified and level in self.plan.thom_levels and _ambiguous(complete):
            self._collect_lacking(over.point, level, stack.nullified)
        return Cell(signs, truth, Stack(over.used, stack.sectors, stack.sections, complete))

    def _leaf_cells(self, over: _StackOver, positions: Sequence[int]) -> Iterator[tuple[int, Cell]]:
        """As ``_cells`` on the last level: one cell for all places where the signs decide the same node."""
        leaves, texts = self._leaves_of.setdefault(id(over.node), {}), over.stack.texts
        for position in positions:
            cell = leaves.get(texts[position])
            if cell is None:
                cell = self._known(over, position, self._child(over, position))
                assert cell is not None
                leaves[texts[position]] = cell
            yield position, cell

    def _cells(self, over: _StackOver, positions: Sequence[int]) -> Iterator[tuple[int, Cell]]:
        """The cells at these positions of a stack, one after the other."""
        helpers, stack = self.budget.helpers, over.stack
        for place, position in enumerate(positions):
            if helpers is not None and self._spreads(over.point.depth, len(positions) - place, helpers):
                yield from self._spread(over, positions[place:])
                return
            child = self._child(over, position)
            known = self._known(over, position, child)
            if known is None:
                known = self.cell(stack.sample(position), child, stack.texts[position], over.dimension_at(position))
            yield position, known

    def _bisected(self, over: _StackOver, positions: Sequence[int]) -> Iterator[tuple[int, Cell]]:
        """As ``_cells`` for all positions, by bisection: what follows from the direction is not decomposed."""
        low, high = -1, len(positions)
        while high - low > 1:
            middle = (low + high) // 2
            if middle % 2 and high - low > 2:  # rational samples are cheap
                middle += 1 if middle + 1 < high else -1
            ((_, cell),) = self._cells(over, [middle])
            yield middle, cell
            rises = (cell.truth is True) == (self.plan.direction > 0)
            known = range(middle + 1, high) if rises else range(low + 1, middle)
            low, high = (low, middle) if rises else (middle, high)
            for position in known:
                yield position, Cell(over.stack.texts[position], cell.truth)

    def _child(self, over: _StackOver, position: int) -> Node:
        """What is left of the matrix at a position of the stack."""
        return self._specialised(over.node, over.point.depth, over.used, over.stack.texts[position])

    def _known(self, over: _StackOver, position: int, child: Node) -> Cell | None:
        """The cell at a position where it is not decomposed any further."""
        off_constraint = over.stack.restricted and position % 2 == 0
        if isinstance(child, bool) and (off_constraint or self._leaves(over.point.depth + 1)):
            return Cell(over.stack.texts[position], child)
        if off_constraint:
            raise InternalError("the matrix is undecided off an equational constraint")
        return None

    # --- side by side ------------------------------------------------------------------------------
    def _spreads(self, level: int, count: int, helpers: Helpers) -> bool:
        """Whether helpers lift the ``count`` cells left in a stack of this level."""
        if self.cells < SPREAD_FROM or level >= min(SPREAD_LEVELS, len(self.plan.levels) - 1) or not helpers.ready():
            return False
        return count >= SPREAD_WIDTH * helpers.width or level == SPREAD_LEVELS - 1

    def _spread(self, over: _StackOver, positions: Sequence[int]) -> Iterator[tuple[int, Cell]]:
        """As ``_cells``, by the helpers of the budget. What they do beyond the last cell that is taken is lost."""
        helpers = self.budget.helpers
        assert helpers is not None
        waiting: deque[tuple[int, Cell | None]] = deque()
        plan = pickle.dumps(self.plan)

        def calls() -> Iterator[Call[Lifted]]:
            for position in positions:
                text, child = over.stack.texts[position], self._child(over, position)
                known = self._known(over, position, child)
                waiting.append((position, known))
                if known is None:
                    sample, inner = over.stack.sample(position), over.dimension_at(position)
                    yield partial(lifted, plan, sample, child, text, inner, self.budget.remaining(), self.budget.left())

        for found in helpers.results(calls(), lambda: self.budget.check("lift", self.cells)):
            while waiting[0][1] is not None:
                yield cast(tuple[int, Cell], waiting.popleft())
            self.cells, self.stacks = self.cells + found.cells, self.stacks + found.stacks
            self.lacking.update(dict.fromkeys(found.lacking))
            self.budget.spend(found.cells)
            self.budget.check("lift", self.cells)
            yield waiting.popleft()[0], found.cell
        yield from cast(Iterable[tuple[int, Cell]], waiting)

    def _collect_lacking(self, point: Point, level: int, nullified: tuple[int, ...]) -> None:
        factors = self.plan.levels[level]
        for j in nullified:
            derivative = lazard_derivative(point, factors[j])
            if any(f.level == level and f not in factors for f, _ in derivative.factors()[1]):
                self.lacking[derivative] = None

    def _mentioned(self, node: Node, level: int) -> tuple[int, ...]:
        """The factors of the level that a node still depends on."""
        relevant = self._relevant.get((id(node), level))
        if relevant is None:
            self._alive.append(node)  # ids stay unique while the node lives
            relevant = self._relevant[id(node), level] = tuple(sorted(mentioned(node, level)))
        return relevant

    def _specialised(self, node: Node, level: int, used: tuple[int, ...], text: str) -> Node:
        """``specialise`` by the signs in ``text``; equal nodes are one object, and equal questions are asked once."""
        relevant = self._mentioned(node, level)
        # the used factors are either the relevant ones or all of the level, so that j is the place of factor j
        spoken = text if len(relevant) == len(used) else "".join([text[j] for j in relevant])
        key = (id(node), level, spoken)
        stored = self._shared.get(key)
        if stored is None:
            signs = {j: SIGN_OF[c] for j, c in zip(relevant, spoken, strict=True) if c != "?"}
            found = specialise(node, level, signs)
            stored = self._shared[key] = self._interned.setdefault(found, found)
        return stored


def _ambiguous(cells: tuple[Cell, ...]) -> bool:
    """Whether two cells of a stack have the same signs and are not known to have the same truth value."""
    met: dict[str, Cell] = {}
    for cell in cells:
        other = met.setdefault(cell.signs, cell)
        if other is not cell and (cell.truth is None or other.truth is not cell.truth):
            return True
    return False


@dataclass(frozen=True, slots=True)
class Lifted:
    """A cell that a helper decomposed, with what it counted."""

    cell: Cell
    cells: int
    stacks: int
    lacking: tuple[Poly, ...]


def lifted(
    plan: bytes, point: Point, node: Node, signs: str, dimension: int, seconds: float | None, work: int | None
) -> Lifted:
    """The cell whose sample is ``point``, decomposed by itself: what a helper is asked for.

    Raises ``NotWellOriented``, ``BudgetExceeded``.
    """
    lifter = Lifter(_plan(plan), Budget(seconds, work))
    point.watch.ask, point.watch.spend = lifter.budget.check, lifter.budget.spend
    cell = lifter.cell(point, node, signs, dimension)
    return Lifted(cell, lifter.cells, lifter.stacks, tuple(lifter.lacking))


@lru_cache(maxsize=4)
def _plan(written: bytes) -> Plan:
    plan = pickle.loads(written)
    assert isinstance(plan, Plan)
    return plan


@lru_cache(maxsize=256)
def _visiting_order(size: int, sectors_only: bool) -> Sequence[int]:
    """Sectors first (rational samples are cheap), middle ones first, then sections likewise."""
    middle = size // 2
    positions = range(0, size, 2) if sectors_only else range(size)
    return tuple(sorted(positions, key=lambda p: (p % 2, abs(p - middle))))


def sector_levels(matrix: Formula, quantifiers: tuple[str, ...]) -> int:
    """The first level from which on quantified stacks are decided by their sectors alone.

    THEOREM. Where the matrix is open (``qe.formula.openness``) and there are only existential quantifiers from a level
    on, the values of its variable that can be completed to a solution over any point form an open set, the projection
    of one; it meets a sector if it is not empty. Dually for a closed matrix and universal quantifiers.
    """
    last = quantifiers[-1] if quantifiers else ""
    everything = range(len(quantifiers))  # also the levels below: the checker of the cell tables wants no less
    if not ((last == "E" and is_open(matrix, everything)) or (last == "A" and is_closed(matrix, everything))):
        return len(quantifiers)
    level = len(quantifiers)
    while level and quantifiers[level - 1] == last:
        level -= 1
    return level
