"""From true and false cells to a short quantifier-free formula (after Brown 1999, "solution formula construction").

A table is projection-definable when no true and false cell share the signs of all factors. Then implicants
(conjunctions of literals satisfied by no false cell) that cover the true cells give a formula. Where it is not,
derivatives of the factors of the level at which such cells part are added: by Thom's lemma the signs of a
polynomial and its derivatives separate its roots, so this ends.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from qe.decomposition.sign_table import Literal, SignTable, free_cells
from qe.errors import InternalError
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, neg
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.proof.cells import CellTable, FreeCell

WORTH_PRODUCTS = 9
"""From this size of a formula on (two literals in variables have less) products of variables are worth a look."""

Factors = Sequence[Sequence[Poly]]
Refine = Callable[[frozenset[int]], CellTable]


class Undistinguished(InternalError):
    """A true and a false cell, at the ends of these ways, differ in no sign that is known on both. ``level``: where
    the ways part."""

    def __init__(self, one: FreeCell, other: FreeCell) -> None:
        super().__init__("a true cell cannot be distinguished from a false one")
        self.ways = one.path, other.path
        self.level = next(k for k, (a, b) in enumerate(zip(one.path, other.path, strict=False)) if a != b)


def construct(table: CellTable, refine: Refine, levels: frozenset[int] = frozenset()) -> tuple[Formula, CellTable]:
    """A formula over the free variables that is true exactly on the true cells, and the table it was read from.

    ``refine(levels)`` makes a new table whose factor lists of these levels are closed under differentiation; those of
    ``levels`` are in this one.
    """
    while True:
        try:
            return formula_of_cells(table.factors[: table.free], free_cells(table)), table
        except Undistinguished as pair:
            if pair.level in levels:
                raise InternalError("derivatives do not separate the cells, against Thom's lemma") from pair
            levels |= {pair.level}
        table = refine(levels)


def formula_of_cells(factors: Factors, cells: list[FreeCell], *, products: bool = True) -> Formula:
    """The shortest of disjunctions for the true cells and negations of ones for the false cells, which together are
    everything. On every cell its truth follows from the signs that are known there. Raises ``Undistinguished``."""
    if all(c.truth for c in cells):
        return TRUE
    if not any(c.truth for c in cells):
        return FALSE
    signs = SignTable(factors, cells)
    sides = signs, signs.flipped()
    covers = [_cover(side, side.literals) for side in sides]
    if products and min(map(_size, covers)) >= WORTH_PRODUCTS:
        covers += [_cover(side, side.with_products) for side in sides]
    best = min(range(len(covers)), key=lambda k: _size(covers[k]))
    return nnf(neg(_formula(covers[best]))) if best % 2 else _formula(covers[best])


Implicant = tuple[Literal, ...]


def _formula(cover: list[Implicant]) -> Formula:
    return disj(conj(atom(x.poly, x.relation) for x in implicant) for implicant in cover)


def _size(cover: list[Implicant]) -> int:
    return sum(x.cost + 2 for implicant in cover for x in implicant)


def _cover(signs: SignTable, literals: list[Literal]) -> list[Implicant]:
    """Implicants that together hold on every true cell, none of them superfluous."""
    uncovered = signs.on_true.everything
    chosen: list[tuple[Implicant, int]] = []
    while uncovered:
        implicant, holds = _implicant(signs, literals, uncovered)
        chosen.append((implicant, holds))
        uncovered &= ~holds
    chosen.sort(key=lambda pair: -sum(x.cost for x in pair[0]))
    for pair in list(chosen):  # dearest first: drop what the others cover
        rest = 0
        for other in chosen:
            if other is not pair:
                rest |= other[1]
        if pair[1] & ~rest == 0:
            chosen.remove(pair)
    return [implicant for implicant, _ in reversed(chosen)]


def _implicant(signs: SignTable, literals: list[Literal], uncovered: int) -> tuple[Implicant, int]:
    """A short implicant that holds on the first uncovered true cell and on as many more as it can."""
    seed = uncovered & -uncovered
    usable = [x for x in literals if x.holds & seed]
    remaining, covered = signs.on_false.everything, signs.on_true.everything
    picked: list[Literal] = []
    while remaining:
        best, remaining = _best(usable, remaining, covered & uncovered)
        if best is None:
            raise Undistinguished(signs.true[_lowest(seed)], signs.false[_lowest(remaining)])
        picked.append(best)
        covered &= best.holds
    return _pruned(signs, usable, picked)


def _lowest(bits: int) -> int:
    return (bits & -bits).bit_length() - 1


def _best(usable: list[Literal], remaining: int, covered: int) -> tuple[Literal | None, int]:
    """The literal that excludes and covers most for its cost, with the false cells it leaves; None if none excludes."""
    total, wanted = remaining.bit_count(), max(1, covered.bit_count())
    best: Literal | None = None
    most, left = (0.0, 0), remaining
    for x in usable:
        kept = x.keeps & remaining
        if kept == remaining:
            continue
        share = (x.holds & covered).bit_count() / wanted
        gain = (total - kept.bit_count()) / total + 1.5 * share - 0.004 * x.cost, -x.cost
        if best is None or gain > most:
            best, most, left = x, gain, kept
    return best, left


def _pruned(signs: SignTable, usable: list[Literal], picked: list[Literal]) -> tuple[Implicant, int]:
    """Drop literals that are not needed (dearest first), then weaken strict ones while no false cell enters."""
    for x in sorted(picked, key=lambda x: -x.cost):
        others = [y for y in picked if y is not x]
        if _kept(signs, others) == 0:
            picked = others
    for i, x in enumerate(picked):
        for y in usable:
            wider = y.poly == x.poly and x.relation.signs < y.relation.signs
            if wider and _kept(signs, [*picked[:i], y, *picked[i + 1 :]]) == 0:
                picked[i] = y
                break
    holds = signs.on_true.everything
    for x in picked:
        holds &= x.holds
    return tuple(picked), holds


def _kept(signs: SignTable, literals: list[Literal]) -> int:
    mask = signs.on_false.everything
    for x in literals:
        mask &= x.keeps
    return mask
