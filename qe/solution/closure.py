"""Whether a closed formula describes a closed convex set that it was read from on open cells only."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from qe.evidence.cells import Cell, CellTable
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import nearby, rational_values
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.evaluate import truth_under
from qe.solution.walk import child, root_place

Holds = Callable[[tuple[Fraction, ...]], bool]


def describes_closure(table: CellTable, holds: Holds, *, bounded: bool) -> bool:
    """Whether the true cells of a table in one or two variables are exactly a closed convex set T with interior.

    Known: the true cells form a closed set that holds T and agrees with it on a dense open set, so the boundary of T
    lies in the zeros of the matrix' polynomials; ``holds`` is membership in T at rational points; ``bounded`` says
    that T is. THEOREM. True cells of full dimension and true sections beside them belong to T. Over a value a of the
    first variable T has an interval whose ends are sections (limits of the ends over values near a), so it is the run
    of true cells from one section to another if the outermost sectors of that run belong to T. This is decided at a
    rational point of them, or, where T reaches a from both sides (then its ends are continuous at a), at one in a
    neighbourhood without zeros of polynomials in the second variable. A single true section over a belongs to T if T
    is bounded and reaches a from one side. False also where this test does not tell.
    """
    root = root_place(table)
    stack = root.cell.stack
    if stack is None:
        return True
    cells = stack.cells
    for position, cell in enumerate(cells):
        if not _somewhere_true(cell):
            continue
        if len(table.order) == 1 or position % 2 == 0:
            inside = _alone(cells, position) if len(table.order) == 1 else _over_sector(cell)
            if inside:
                return False
        else:
            sides = sum(_somewhere_true(cells[position + step]) for step in (-1, 1))
            if not _over_section(table, child(table, root, position).point, holds, sides, bounded):
                return False
    return True


def _somewhere_true(cell: Cell) -> bool:
    return cell.truth is True if cell.stack is None else any(map(_somewhere_true, cell.stack.cells))


def _alone(cells: tuple[Cell, ...], position: int) -> bool:
    """Whether a section is true and no sector beside it is."""
    if position % 2 == 0 or cells[position].truth is not True:
        return False
    return cells[position - 1].truth is not True and cells[position + 1].truth is not True


def _over_sector(cell: Cell) -> bool:
    """Whether some section over an open interval stands alone."""
    return cell.stack is not None and any(_alone(cell.stack.cells, p) for p in range(len(cell.stack.cells)))


def _over_section(table: CellTable, point: Point, holds: Holds, sides: int, bounded: bool) -> bool:
    factors = table.factors[1]
    isolation = isolate_over(point, factors)
    below = {f: point.sign(f) for f in table.factors[0]}
    true = [
        position
        for position, text in enumerate(isolation.sign_texts())
        if truth_under(table.matrix, _signs(below | {f: _VALUE[c] for f, c in zip(factors, text, strict=True)}))
    ]
    first, last = true[0], true[-1]
    if first % 2 == 0 or last % 2 == 0 or len(true) != last - first + 1:
        return False
    if first == last:
        return bounded and sides > 0
    ends = [point.extend(isolation.sectors[p // 2]) for p in {first + 1, last - 1}]
    if not point.algebraic:
        return all(holds(rational_values(end)) for end in ends)
    return sides == 2 and all(holds(nearby(end, factors, frozenset(), None)) for end in ends)


_VALUE = {"+": 1, "-": -1, "0": 0}


def _signs(known: dict[Poly, int]) -> Callable[[Poly], int | None]:
    """The sign of a product of factors with known signs."""

    def sign(poly: Poly) -> int | None:
        unit, parts = poly.factors()
        total = 1 if unit > 0 else -1
        for f, multiplicity in parts:
            total *= known[f] ** multiplicity
        return total

    return sign
