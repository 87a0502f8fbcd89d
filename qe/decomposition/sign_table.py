"""Sign tables of the free cells: which literals, and which formulas, hold on which cells, as bit masks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, reduce
from itertools import combinations
from operator import and_, or_

from qe.errors import InternalError
from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or, Relation
from qe.proof.cells import SIGN_OF, Cell, CellTable, FreeCell

_MAY_BE = {sign: {ord(c): "01"[c in (character, "?")] for c in "+-0?"} for character, sign in SIGN_OF.items()}
_WEAK_FIRST = (Relation.LE, Relation.GE, Relation.NE, Relation.EQ, Relation.LT, Relation.GT)


def free_cells(table: CellTable) -> list[FreeCell]:
    """All cells over the free variables at which the truth value is known."""
    free, placed, cells = table.free, cache(placed_signs), list[FreeCell]()

    def walk(cell: Cell, path: tuple[int, ...], signs: tuple[str, ...]) -> None:
        if cell.stack is None or len(path) == free:
            assert cell.truth is not None
            cells.append(FreeCell(path, signs, cell.truth))
            return
        for position, below in enumerate(cell.stack.cells):
            walk(below, (*path, position), (*signs, placed(cell.stack.used, below.signs)))

    walk(table.root, (), ())
    return cells


def placed_signs(used: tuple[int, ...], signs: str) -> str:
    """The signs of some factors of a level among those of all, without open ones at the end."""
    if used == tuple(range(len(used))):
        return signs.rstrip("?")
    known = dict(zip(used, signs, strict=True))
    return "".join([known.get(j, "?") for j in range(max(used, default=-1) + 1)]).rstrip("?")


Masks = Mapping[int, int]
"""For every sign the cells, as bits, that may have it: one where it is known, all three where it is not."""


def where(formula: Formula, masks: Callable[[Poly], Masks], cells: int) -> tuple[int, int]:
    """Those of some cells (bits) on which a quantifier-free Tarski formula is true, and those on which it is false, by
    what is known of the signs of its polynomials (Kleene's strong logic, on all cells at once)."""
    match formula:
        case Atom(poly, relation):
            return _atom_where(relation, masks(poly), cells)
        case And(args) | Or(args):
            true, false = zip(*(where(arg, masks, cells) for arg in args), strict=True)
            if isinstance(formula, And):
                return reduce(and_, true), reduce(or_, false)
            return reduce(or_, true), reduce(and_, false)
        case Not(arg):
            return where(arg, masks, cells)[::-1]
        case Constant(value):
            return (cells, 0) if value else (0, cells)
    raise InternalError(f"not a quantifier-free Tarski formula: {type(formula).__name__}")


def _atom_where(relation: Relation, masks: Masks, cells: int) -> tuple[int, int]:
    true, false, signs = cells, cells, relation.signs
    for sign, mask in masks.items():
        if sign in signs:
            false &= ~mask
        else:
            true &= ~mask
    return true, false


def _times(a: Masks, b: Masks) -> Masks:
    """The cells that may have each sign of a product."""
    return {1: a[1] & b[1] | a[-1] & b[-1], 0: a[0] | b[0], -1: a[1] & b[-1] | a[-1] & b[1]}


class Columns:
    """The signs of factors on a list of cells, one bit for each."""

    def __init__(self, cells: Sequence[FreeCell], factors: Sequence[Sequence[Poly]]) -> None:
        self.everything = (1 << len(cells)) - 1
        self.of_factor = dict(_masks(cells, factors))

    def of(self, poly: Poly) -> Masks:
        """The signs of a product of the factors."""
        unit, factors = poly.factors()
        signs: Masks = {1 if unit > 0 else -1: self.everything, 0: 0, -1 if unit > 0 else 1: 0}
        for factor, exponent in factors:
            masks = self.of_factor[factor]
            even = exponent % 2 == 0
            signs = _times(signs, {1: masks[1] | masks[-1], 0: masks[0], -1: 0} if even else masks)
        return signs

    def where(self, formula: Formula) -> tuple[int, int]:
        """The cells on which a formula in products of the factors is true, and those on which it is false."""
        return where(formula, self.of, self.everything)


@dataclass(frozen=True, slots=True)
class Literal:
    """``poly relation 0`` with the cells it holds on (``true`` cells) and the false cells it does not exclude."""

    poly: Poly
    relation: Relation
    holds: int
    keeps: int
    cost: int


class SignTable:
    """The signs on the true cells and on the false cells, one bit for all that have the same."""

    def __init__(self, factors: Sequence[Sequence[Poly]], cells: Iterable[FreeCell]) -> None:
        listing = list({(c.truth, *c.signs): c for c in reversed(list(cells))}.values())[::-1]
        self.true = [c for c in listing if c.truth]
        self.false = [c for c in listing if not c.truth]
        self.on_true, self.on_false = Columns(self.true, factors), Columns(self.false, factors)

    def flipped(self) -> SignTable:
        """The table with true and false exchanged."""
        other = SignTable((), ())
        other.true, other.false = self.false, self.true
        other.on_true, other.on_false = self.on_false, self.on_true
        return other

    @cached_property
    def literals(self) -> list[Literal]:
        """What covers a true cell and excludes a false one; a sign that is not known on a cell covers nothing there."""
        on_true, on_false = self.on_true.of_factor, self.on_false.of_factor
        return [x for factor in on_true for x in self._about(factor, on_true[factor], on_false[factor])]

    @cached_property
    def with_products(self) -> list[Literal]:
        """Those about products of two variables, too: ``a*b < 0`` for two cases."""
        on_true, on_false = self.on_true.of_factor, self.on_false.of_factor
        pairs = combinations([f for f in on_true if f.total_degree == f.term_count() == 1], 2)
        products = [(f * g, _times(on_true[f], on_true[g]), _times(on_false[f], on_false[g])) for f, g in pairs]
        return self.literals + [x for product in products for x in self._about(*product)]

    def _about(self, poly: Poly, on_true: Masks, on_false: Masks) -> Iterator[Literal]:
        cost, everything = poly.total_degree + poly.term_count(), self.on_false.everything
        for relation in _WEAK_FIRST:
            holds, _ = _atom_where(relation, on_true, self.on_true.everything)
            kept = everything & ~_atom_where(relation, on_false, everything)[1]
            if holds and kept != everything:
                yield Literal(poly, relation, holds, kept, cost)


def _masks(cells: Sequence[FreeCell], factors: Sequence[Sequence[Poly]]) -> Iterator[tuple[Poly, Masks]]:
    """For every factor and every sign the cells that may have it."""
    for level, polys in enumerate(factors):
        width = len(polys)
        rows = [c.signs[level] if level < len(c.signs) else "" for c in reversed(cells)]
        text = "".join([row.ljust(width, "?") for row in rows])
        for j, factor in enumerate(polys):
            column = text[j::width]
            yield factor, {sign: int("0" + column.translate(table), 2) for sign, table in _MAY_BE.items()}
