"""The cell table: a (partial) cylindrical algebraic decomposition as pure data.

Levels count from 0: variable ``order[k]`` is the main variable of level ``k``. A ``Cell`` at depth k
lies in R^k; the root has depth 0. ``Cell.stack`` decomposes the cylinder over it by the real roots of
the factors of level k. A stack with m sections has 2m+1 cells: sectors at even positions 0, 2, …, 2m
and sections at odd positions 1, 3, … (position p is index p+1 in the usual 1-based convention, so odd
index is a sector and even index a section). Sector samples are rational and separate the sections:
section i lies strictly between sector samples i and i+1, and every factor listed for it has exactly
one real root over the cell's sample between those two numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.syntax import Formula
from qe.options import Projection

SIGN_OF = {"+": 1, "-": -1, "0": 0}
CHARACTER_OF: dict[int | None, str] = {1: "+", -1: "-", 0: "0", None: "?"}
"""Signs of factors on a cell are written as texts, one character each; ``?``: not known."""


@dataclass(frozen=True, slots=True)
class Stack:
    """The decomposition of the cylinder over one cell.

    ``used``: indices into the level's factor list of the factors isolated here. Below the last level it
    is always the whole list; at the last level it may leave out factors that no longer matter there.
    ``sectors``: m+1 ascending rational sample values. ``sections``: for each of the m sections the
    indices (ascending) of the used factors that vanish on it. ``cells``: 2m+1 cells. At a level with an equational
    constraint the sections are those of the constraint's factors and list only these, unless one of them is zero on
    the whole line over the sample.
    """

    used: tuple[int, ...]
    sectors: Sequence[Fraction]
    sections: tuple[tuple[int, ...], ...]
    cells: tuple[Cell, ...]

    @property
    def positions(self) -> range:
        """Its sectors and sections, from below."""
        return range(2 * len(self.sections) + 1)

    def signs_of(self, cell: Cell) -> dict[int, int]:
        """The signs of the level's factors, by their numbers, on a cell of the stack; without those that are open."""
        return {j: SIGN_OF[c] for j, c in zip(self.used, cell.signs, strict=True) if c != "?"}

    def __reduce__(self) -> tuple[type[Stack], tuple[object, ...]]:
        """Tables are sent between processes by the hundred thousand cells; the way of all dataclasses is slow."""
        return Stack, (self.used, self.sectors, self.sections, self.cells)


@dataclass(frozen=True, slots=True)
class Cell:
    """One cell.

    ``signs``: for the cell at depth k+1, one character of ``+-0`` per factor of level k that its parent's stack used,
    in the order of ``Stack.used`` (empty for the root). A factor that is nullified over the parent's sample has sign 0
    on the whole stack. In a sector between the sections of an equational constraint the signs of the other factors are
    open (``?``), and the cell is a leaf. ``truth``: the truth value of the formula (with its quantified variables above
    this depth) on the cell; None only for a cell that was not needed because its quantifier was already decided by a
    sibling, or for a cell over free variables that was decomposed. ``stack`` is None for a leaf.

    ``reach``: of an interval of a covering the first and last position, and that of its sample; ``own`` are the factors
    of its level that keep their signs on it, at least (None: nothing but its sample is looked at). Its truth follows,
    and no signs are listed. Sections between its sectors may then be empty.
    """

    signs: str
    truth: bool | None
    stack: Stack | None = None
    reach: tuple[int, int, int] | None = None
    own: tuple[int, ...] | None = None

    def __reduce__(self) -> tuple[type[Cell], tuple[object, ...]]:
        """See ``Stack.__reduce__``."""
        return Cell, (self.signs, self.truth, self.stack, self.reach, self.own)


@dataclass(frozen=True, slots=True)
class CellTable:
    """A certificate that ``formula`` (prenex) has the stated truth value on every cell.

    ``order``: all variables, free ones first. ``quantifiers``: for each level "" (free), "E" or "A".
    ``matrix``: the quantifier-free part, over a ring whose names are ``order``. ``factors[k]``: the
    irreducible polynomials of level k. ``projection``: the operator under which the lists are closed.
    ``constraints[k]``: indices of the factors of the equational constraint by which level k is restricted (none: it
    is not); ``()`` where no level is.
    """

    order: tuple[str, ...]
    quantifiers: tuple[str, ...]
    matrix: Formula
    projection: Projection
    factors: tuple[tuple[Poly, ...], ...]
    root: Cell
    constraints: tuple[tuple[int, ...], ...] = ()

    @property
    def free(self) -> int:
        """The number of free variables."""
        return sum(quantifier == "" for quantifier in self.quantifiers)

    @property
    def is_decomposition(self) -> bool:
        """Whether no cell is an interval of a covering."""

        def is_one(cell: Cell) -> bool:
            return cell.reach is None and (cell.stack is None or all(map(is_one, cell.stack.cells)))

        return is_one(self.root)


@dataclass(frozen=True, slots=True)
class FreeCell:
    """A cell of free-variable space with a truth value; ``signs[k]``: those of the factors of level k, one character of
    ``+-0?`` each (``?``: not known; nor are those beyond the end, so no text ends with it).

    ``path`` are the positions from the root. A cell left undecomposed at a lower depth stands for its cylinder.
    """

    path: tuple[int, ...]
    signs: tuple[str, ...]
    truth: bool
