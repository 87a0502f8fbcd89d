"""The condition on the parameters under which something is said: where certain cells of them are, as a text.

It is read off the signs of the factors (``formula_of_cells``), of more polynomials where those do not tell the cells
apart, or says the pieces of the parameters in their order. A text comes with whether it is a disjunction.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial

from qe.decomposition.formulas import Undistinguished, formula_of_cells
from qe.decomposition.pieces import merge
from qe.decomposition.sampled_cells import Place, leaves
from qe.decomposition.sign_table import Columns, placed_signs
from qe.elimination.protocol import Context
from qe.engine.redundant import without_redundant_parts
from qe.engine.run import outcome_for
from qe.exact.ring import Poly
from qe.formula.syntax import TRUE, And, Formula, Or
from qe.formula.traverse import polynomials
from qe.options import Budget, Options
from qe.proof.cells import CHARACTER_OF, Cell, CellTable, FreeCell
from qe.proof.run_log import RunLog
from qe.simplifier.presented import presented
from qe.simplifier.simplify import simplify

Factors = Sequence[Sequence[Poly]]
Columned = dict[Poly, dict[tuple[int, ...], str]]
"""Polynomials with their signs on cells."""
Signs = Callable[[Place], Iterable[str]]
Terms = tuple[str, ...]
"""What each of the last variables is."""


def cells_outside(table: CellTable, bases: list[Place], known: Formula) -> frozenset[int]:
    """Those cells of the parameters on which an assumption does not hold."""
    depth = max((base.depth for base in bases), default=0)
    cells = [FreeCell(base.path, tuple(map(placed_signs, base.used, base.signs)), True) for base in bases]
    listed = {factor for level in table.factors[:depth] for factor in level}
    if not all(factor in listed for poly in polynomials(known) for factor, _ in poly.factors()[1]):
        return frozenset()
    false = Columns(cells, table.factors[:depth]).where(known)[1]
    return frozenset(i for i in range(len(bases)) if false >> i & 1)


def condition(
    table: CellTable,
    bases: list[Place],
    chosen: frozenset[int],
    open_: frozenset[int],
    columns: Callable[[], Iterator[tuple[Factors, Signs]]],
    solved: bool,
    budget: Budget,
    defined: Formula | None = None,
) -> tuple[str, bool]:
    """The condition on the parameters that says which cells: the ``chosen`` ones, and perhaps some of those that are
    open; and whether it is a disjunction. It is a formula in the signs of the first ``columns`` that tell them, or what
    pieces say whose ends are numbers and polynomials, if that is shorter, or not much longer and gives values of
    variables that are to be ``solved`` for. ``defined``: one formula that says the same."""
    places = [(base, i in chosen) for i, base in enumerate(bases) if i not in open_]
    said = None
    for factors, signs in columns():
        cells = [FreeCell(base.path, tuple(signs(base)), true) for base, true in places]
        try:
            formula = _shortened(simplify(formula_of_cells(factors, cells)), budget)
        except Undistinguished:
            continue
        if formula == TRUE:
            return "", False
        natural = formula if defined is None else presented(simplify(defined))
        said = min(((str(one), isinstance(one, Or)) for one in (natural, formula)), key=lambda one: len(one[0]))
        if defined is not None and len(natural.free) > 1 and said[0] == str(natural):
            return said
        break
    pieces = merge(only(table, frozenset(bases[i].path for i in chosen), True), budget=budget)
    ends = [end for piece in pieces for r in piece.ranges for end in (r.lower, r.upper) if end and end.value is None]
    parts = parts_of([tuple(str(r) for r in piece.ranges if r.is_bounded) for piece in pieces])
    shown = " or ".join(parts), len(parts) > 1
    if said is None:
        over = _over_cells(table, bases, chosen, open_, budget)
        return over if len(over[0]) < len(shown[0]) else shown
    if all(end.written and end.written[1] is None and end.written[2].is_constant for end in ends):
        has_values = solved and any(r.is_point for piece in pieces for r in piece.ranges)
        if len(shown[0]) < len(said[0]) * (3 if has_values else 1):
            return shown
    return said


def _shortened(formula: Formula, budget: Budget) -> Formula:
    """The formula as people write it, without parts that make no difference, which signs of factors do not tell."""
    if isinstance(formula, And) and any(isinstance(part, Or) for part in formula.args):
        formula = without_redundant_parts(formula, Context(Options(), budget, RunLog(), outcome_for))
    return presented(formula)


def _over_cells(
    table: CellTable, bases: list[Place], chosen: frozenset[int], open_: frozenset[int], budget: Budget
) -> tuple[str, bool]:
    """As ``condition``, where signs do not tell: what has to hold of the last parameter is said over each cell of the
    others, by signs if they tell there, and once for all cells over which the same is said."""
    depth = max(base.depth for base in bases)
    before = list(leaves(table, depth=depth - 1))
    over: list[list[int]] = [[] for _ in before]
    position = {base.path: k for k, base in enumerate(before)}
    for i, base in enumerate(bases):
        over[position[base.path[: depth - 1]]].append(i)
    said: dict[tuple[str, bool], set[int]] = {}
    for k, inner in enumerate(over):
        if not chosen.isdisjoint(inner):
            said.setdefault(_over_cell(table, [(bases[i], i in chosen) for i in inner if i not in open_]), set()).add(k)
    undecided = frozenset(k for k, inner in enumerate(over) if open_.issuperset(inner))
    parts = []
    columns = partial(columns_of, table.factors[: depth - 1], dict, before)
    for what, cells in said.items():
        where = condition(table, before, frozenset(cells), undecided, columns, False, budget)
        parts.append(both(where, what))
    return " or ".join(parts), len(parts) > 1


def _over_cell(table: CellTable, places: list[tuple[Place, bool]]) -> tuple[str, bool]:
    """What has to hold of the last parameter over a cell of those before it; "" where nothing has to."""
    level = max(place.depth for place, _ in places) - 1
    if all(true for _, true in places):
        return "", False
    cells = [FreeCell(p.path, (placed_signs(p.used[level], p.signs[level]),), true) for p, true in places]
    try:
        formula = simplify(formula_of_cells(table.factors[level : level + 1], cells))
    except Undistinguished:
        pieces = merge(only(table, frozenset(place.path for place, true in places if true), True))
        return " or ".join(str(piece.ranges[level]) for piece in pieces), len(pieces) > 1
    return str(formula), isinstance(formula, Or)


def columns_of(
    factors: Factors, counted: Callable[[], Columned], bases: Sequence[Place]
) -> Iterator[tuple[Factors, Signs]]:
    """Polynomials by levels, with their signs on cells: the factors, then what is ``counted``, then derivatives."""
    more = Columned()
    for listed in (dict, counted, partial(_derivatives, factors, bases)):
        new = {poly: signs for poly, signs in listed().items() if poly not in more and poly not in factors[poly.level]}
        if not (new or listed is dict):
            continue
        more |= new
        levels = [[poly for poly in more if poly.level == level] for level in range(len(factors))]

        def signs(base: Place, levels: Factors = levels, more: Columned = more) -> Iterator[str]:
            for polys, used, known, added in zip(factors, base.used, base.signs, levels, strict=False):
                yield placed_signs(used, known).ljust(len(polys), "?") + "".join(
                    more[poly].get(base.path, "?") for poly in added
                )

        yield [[*polys, *added] for polys, added in zip(factors, levels, strict=True)], signs


def _derivatives(factors: Factors, bases: Sequence[Place]) -> Columned:
    """Derivatives of the factors, each in its variable. Over a cell a root of a factor has one multiplicity: where it
    vanishes, so do its derivatives below that, and the next one has the same sign everywhere."""
    listed: Columned = {}
    for base in bases:
        for polys, used, signs in zip(factors, base.used, base.signs, strict=False):  # of fewer levels, perhaps
            for poly, character in zip(polys, placed_signs(used, signs)):
                for _ in range(1, poly.degree(poly.level)):
                    poly = poly.derivative(poly.level)
                    known = listed.setdefault(poly, {})
                    if character == "0":
                        known[base.path] = character = CHARACTER_OF[base.point.sign(poly)]
    return listed


def only(table: CellTable, kept: frozenset[tuple[int, ...]], truth: bool | None = None) -> CellTable:
    """The table with what is over these cells alone; with ``truth`` they are cut off there and have that."""

    ways = {path[:k] for path in kept for k in range(len(path))}

    def cut(cell: Cell, path: tuple[int, ...]) -> Cell:
        if path in kept:
            return cell if truth is None else Cell(cell.signs, truth)
        if cell.stack is None or path not in ways:
            return Cell(cell.signs, False)
        below = tuple(cut(inner, (*path, k)) for k, inner in enumerate(cell.stack.cells))
        return replace(cell, stack=replace(cell.stack, cells=below))

    return replace(table, root=cut(table.root, ()))


def both(*parts: tuple[str, bool]) -> str:
    """What both texts say, each perhaps a disjunction; one that is empty says nothing."""
    said = [part for part in parts if part[0]]
    return " and ".join(f"({text})" if is_or and len(said) > 1 else text for text, is_or in said)


def parts_of(said: list[Terms]) -> list[str]:
    """The solutions as texts; what several say of the first variable is said once."""
    firsts: dict[str, list[Terms]] = {}
    for terms in said:
        if terms:
            firsts.setdefault(terms[0], []).append(terms[1:])
    parts = []
    for first, rest in firsts.items():
        inner = parts_of(rest)
        then = f"({' or '.join(inner)})" if len(inner) > 1 else "".join(inner)
        parts.append(f"{first} and {then}" if then else first)
    return parts
