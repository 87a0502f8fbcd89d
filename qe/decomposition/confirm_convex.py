"""Whether a formula describes the closed convex set that it was read from on open cells only."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial

from qe.decomposition.sampled_cells import Place, any_true, child, root_place
from qe.decomposition.stack import sign_by_factors
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import nearby, rational_values
from qe.exact.sample import Point
from qe.formula.evaluate import truth_under
from qe.proof.cells import CellTable

Holds = Callable[[tuple[Fraction, ...]], bool]


def strangers(table: CellTable, holds: Holds, *, bounded: bool) -> list[Point] | None:
    """True points of a table in one or two variables outside a closed convex set T with interior points; if there are
    none, the true cells are exactly T. None where none is found but that cannot be decided, or points of T are missing.

    Known: the true cells agree with T on a dense open set, and the boundary of T lies in the zeros of the matrix'
    polynomials; ``holds`` is membership in T at rational points; ``bounded`` says that T is. THEOREM. Over an open
    interval the sections of T are those next to its sectors. Over a value a of the first variable T has an interval
    whose ends are sections (limits of the ends over values near a), so it is the run of true cells from one section to
    another if the outermost sectors of the run belong to T and the sectors next to it do not. This is decided at a
    rational point of them, or next to them on the way to an interior point of T. A single section is T over a
    if no sector is, T is bounded and reaches a from one side.
    """
    root = root_place(table)
    stack = root.cell.stack
    if stack is None:
        return []
    if len(table.order) == 1:
        return _beside_sectors(table, root)
    found: list[Point] = []
    unknown = False
    for position, cell in enumerate(stack.cells):
        if position % 2 == 0:
            part = _beside_sectors(table, child(table, root, position)) if any_true(cell) else []
        else:
            sides = sum(any_true(stack.cells[position + step]) for step in (-1, 1))
            known = sides or any_true(cell)
            part = _over_section(table, child(table, root, position).point, holds, sides, bounded) if known else []
        unknown = unknown or part is None
        found += part or []
    return found or (None if unknown else [])


def _beside_sectors(table: CellTable, place: Place) -> list[Point] | None:
    """The true sections with no true sector next to them; None if a false one has one."""
    stack = place.cell.stack
    if stack is None:
        return []
    found = []
    for position in range(1, len(stack.cells), 2):
        inside = any_true(stack.cells[position - 1]) or any_true(stack.cells[position + 1])
        if inside and not any_true(stack.cells[position]):
            return None
        if not inside and any_true(stack.cells[position]):
            found.append(child(table, place, position).point)
    return found


def _over_section(table: CellTable, point: Point, holds: Holds, sides: int, bounded: bool) -> list[Point] | None:
    """The same over a section of the first variable, which T reaches from ``sides`` sides."""
    factors = table.factors[1]
    isolation = isolate_over(point, factors)
    below = {f: point.sign(f) for f in table.factors[0]}
    signs = [(below | known).__getitem__ for known in isolation.sign_maps()]
    true = [p for p, sign in enumerate(signs) if truth_under(table.matrix, partial(sign_by_factors, sign=sign))]
    sample = isolation.sample
    if not sides:
        return [sample(p) for p in true]
    run = [p for p in true if p % 2 == 0 or p - 1 in true or p + 1 in true] or true
    isolated = [sample(p) for p in true if p not in run]
    if isolated or not run:
        return isolated or None
    first, last = run[0], run[-1]
    single = first == last
    if first % 2 == 0 or last % 2 == 0 or len(run) != last - first + 1 or (single and (sides == 2 or not bounded)):
        return None
    vanishing = [f for f, sign in below.items() if sign == 0]
    centre = _centre(table)

    def belongs(position: int) -> bool | None:
        """Whether a sector does."""
        if not point.algebraic:
            return holds(rational_values(sample(position)))
        if sides == 2:  # the ends are continuous at a, so T does not change next to a where no polynomial in y vanishes
            return holds(nearby(sample(position), factors, frozenset(), None))
        if centre is None:
            return None
        return holds(nearby(sample(position), [*vanishing, *factors], frozenset(vanishing), centre))

    inside = set[int]() if single else {first + 1, last - 1}
    outside = [p for p in (first - 1, last + 1) if belongs(p) is not False]
    return None if outside else [sample(p) for p in inside if not belongs(p)]


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
