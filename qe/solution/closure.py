"""Where a closed formula may hold outside the closed convex set that it was read from on open cells only."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from qe.evidence.cells import Cell, CellTable
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import nearby, rational_values
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.evaluate import truth_under
from qe.solution.fibres import any_true
from qe.solution.walk import child, root_place

Holds = Callable[[tuple[Fraction, ...]], bool]


def strangers(table: CellTable, holds: Holds, *, bounded: bool) -> list[Point]:
    """True points of a table in one or two variables that are not seen to belong to a closed convex set T with
    interior; if there are none, the true cells are exactly T.

    Known: the true cells form a closed set that holds T and agrees with it on a dense open set, so the boundary of T
    lies in the zeros of the matrix' polynomials; ``holds`` is membership in T at rational points; ``bounded`` says
    that T is. THEOREM. True cells of full dimension and true sections beside them belong to T. Over a value a of the
    first variable T has an interval whose ends are sections (limits of the ends over values near a), so it is the run
    of true cells from one section to another if the outermost sectors of that run belong to T. This is decided at a
    rational point of them, or beside them on the way to an interior point of T. A single true section over a belongs to
    T if T is bounded and reaches a from one side.
    """
    root = root_place(table)
    stack = root.cell.stack
    if stack is None:
        return []
    cells = stack.cells
    if len(table.order) == 1:
        return [child(table, root, p).point for p in range(len(cells)) if _alone(cells, p)]
    found: list[Point] = []
    for position, cell in enumerate(cells):
        if not any_true(cell):
            continue
        place = child(table, root, position)
        if position % 2:
            sides = sum(any_true(cells[position + step]) for step in (-1, 1))
            found += _over_section(table, place.point, holds, sides, bounded)
        elif cell.stack is not None:
            above = cell.stack.cells
            found += [child(table, place, p).point for p in range(len(above)) if _alone(above, p)]
    return found


def _alone(cells: tuple[Cell, ...], position: int) -> bool:
    """Whether a section is true and no sector beside it is."""
    if position % 2 == 0 or cells[position].truth is not True:
        return False
    return cells[position - 1].truth is not True and cells[position + 1].truth is not True


def _over_section(table: CellTable, point: Point, holds: Holds, sides: int, bounded: bool) -> list[Point]:
    """Over a section of the first variable: samples of the true cells that the theorem does not place in T."""
    factors = table.factors[1]
    isolation = isolate_over(point, factors)
    below = {f: point.sign(f) for f in table.factors[0]}
    true = [
        position
        for position, text in enumerate(isolation.sign_texts())
        if truth_under(table.matrix, _signs(below | {f: _VALUE[c] for f, c in zip(factors, text, strict=True)}))
    ]

    def sample(position: int) -> Point:
        half = position // 2
        return point.extend(isolation.sections[half].value if position % 2 else isolation.sectors[half])

    alone = [p for p in true if p - 1 not in true and p + 1 not in true]
    if alone and (sides != 1 or len(true) > 1):
        return [sample(p) for p in alone]
    first, last = true[0], true[-1]
    if first == last:
        return [] if bounded else [sample(first)]
    if first % 2 == 0 or last % 2 == 0 or len(true) != last - first + 1:
        return [sample(p) for p in true]
    ends = [sample(p) for p in {first + 1, last - 1}]
    if not point.algebraic:
        return [end for end in ends if not holds(rational_values(end))]
    if sides == 2:  # the ends are continuous at a, so T does not change beside a where no polynomial in y vanishes
        return [end for end in ends if not holds(nearby(end, factors, frozenset(), None))]
    centre, polys = _centre(table), [f for f, sign in below.items() if sign == 0]
    if centre is None:
        return ends
    return [end for end in ends if not holds(nearby(end, [*polys, *factors], frozenset(polys), centre))]


def _centre(table: CellTable) -> tuple[Fraction, Fraction] | None:
    """The rational sample of a true cell of full dimension in the plane."""
    stack = table.root.stack
    assert stack is not None
    for x, cell in zip(stack.sectors, stack.cells[::2], strict=True):
        if cell.stack is None:
            if cell.truth:
                return x, Fraction(0)
            continue
        for y, above in zip(cell.stack.sectors, cell.stack.cells[::2], strict=True):
            if above.truth:
                return x, y
    return None


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
