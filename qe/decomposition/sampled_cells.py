"""Walking a cell table: the sample point of every cell, rebuilt from factors and separating rationals."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from qe.exact.algebraic import RealAlgebraic
from qe.exact.fibre_stack import root_between
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.proof.cells import Cell, CellTable

Number = Fraction | RealAlgebraic


@dataclass(frozen=True, slots=True)
class Place:
    """A cell with its way from the root: ``path`` holds the position in every stack, ``signs`` one string per level."""

    cell: Cell
    point: Point
    path: tuple[int, ...]
    signs: tuple[str, ...]
    used: tuple[tuple[int, ...], ...]

    @property
    def depth(self) -> int:
        return len(self.path)

    @property
    def dimension(self) -> int:
        """The number of sectors on the way; undecomposed directions are not counted."""
        return sum(position % 2 == 0 for position in self.path)


def root_place(table: CellTable) -> Place:
    """The root cell."""
    return Place(table.root, Point(Ring.of(table.order)), (), (), ())


def child(table: CellTable, place: Place, position: int) -> Place:
    """The place of one cell of the stack over a decomposed cell."""
    stack = place.cell.stack
    assert stack is not None
    cell = stack.cells[position]
    if position % 2 == 0:
        point = place.point.extend(rational(stack.sectors[position // 2]))
    else:
        section = position // 2
        lo, hi = stack.sectors[section], stack.sectors[section + 1]
        factors = [table.factors[place.depth][j] for j in stack.sections[section]]
        simplest = min(factors, key=lambda f: (f.degree(place.depth), len(f.variables), f.term_count()))
        point = place.point.extend(root_between(place.point, simplest, lo, hi))
    return Place(cell, point, (*place.path, position), (*place.signs, cell.signs), (*place.used, stack.used))


def rational(value: Fraction) -> RealAlgebraic:
    """The rational number as a coordinate."""
    return RealAlgebraic.rational(value)


def leaves(
    table: CellTable, wanted: Callable[[Cell], bool] = lambda cell: True, depth: int | None = None
) -> Iterator[Place]:
    """The undecomposed cells (or those at ``depth``), in order; subtrees without a wanted cell are skipped."""
    limit = len(table.order) if depth is None else depth

    def walk(place: Place) -> Iterator[Place]:
        cell = place.cell
        if cell.stack is None or place.depth == limit:
            if wanted(cell):
                yield place
            return
        for position, below in enumerate(cell.stack.cells):
            if _any(below, wanted, limit - place.depth - 1):
                yield from walk(child(table, place, position))

    yield from walk(root_place(table))


def any_true(cell: Cell) -> bool:
    """Whether some cell over this one is true."""
    return _any(cell, lambda leaf: leaf.truth is True, -1)


def _any(cell: Cell, wanted: Callable[[Cell], bool], limit: int) -> bool:
    """Whether a leaf over this cell, or a cell so many levels above it, is wanted."""
    if cell.stack is None or limit == 0:
        return wanted(cell)
    return any(_any(below, wanted, limit - 1) for below in cell.stack.cells)


def coordinates(table: CellTable, place: Place) -> dict[str, Number]:
    """The sample of a cell by name; variables above its depth get 0 (the formula does not depend on them there)."""
    values: dict[str, Number] = {name: place.point.number(i) for i, name in enumerate(table.order[: place.depth])}
    for name in table.order[place.depth :]:
        values[name] = Fraction(0)
    return values


def deciding_point(table: CellTable, wanted: bool) -> dict[str, Number] | None:
    """Values of the outermost quantified block on a cell where the formula has the truth value ``wanted``.

    For a true existential sentence: a witness; for a false universal one: a counterexample.
    """
    first = table.quantifiers[0]
    size = next((k for k, q in enumerate(table.quantifiers) if q != first), len(table.quantifiers))
    for place in leaves(table, lambda cell: cell.truth is wanted, size):
        values = coordinates(table, place)
        return {name: values[name] for name in table.order[:size]}
    return None


def free_part(table: CellTable) -> CellTable:
    """The table cut off above its free variables: the truth values of the quantified formula on their space."""
    return _first_levels(table, table.free, lambda cell: cell.truth)


def first_shadow(table: CellTable) -> CellTable:
    """The projection onto the first variable of the set of a table without quantifiers: over a cell of its stack
    either all points have one of the set above them, or none."""
    return _first_levels(table, 1, any_true)


def _first_levels(table: CellTable, size: int, truth: Callable[[Cell], bool | None]) -> CellTable:
    """The table cut off above its first variables, where cells have the truth that is read off what is above them."""

    def cut(cell: Cell, depth: int) -> Cell:
        if cell.stack is None:
            return cell
        if depth == size:
            return Cell(cell.signs, truth(cell))
        return replace(cell, stack=replace(cell.stack, cells=tuple(cut(c, depth + 1) for c in cell.stack.cells)))

    ring = Ring.of(table.order[:size])
    factors = tuple(tuple(f.convert(ring) for f in level) for level in table.factors[:size])
    root, constraints = cut(table.root, 0), table.constraints[:size]
    return CellTable(table.order[:size], ("",) * size, table.matrix, table.projection, factors, root, constraints)
