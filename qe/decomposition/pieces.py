"""Merging: the true cells of a decomposition as few cylindrical pieces with bounds as root functions.

A piece gives, for each variable in order, an interval (or a single value) whose ends are roots of factors over
the earlier variables. Adjacent cells of a stack merge when everything above them has the same description.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

from qe.decomposition.radicals import halved, quotient_text, radicals
from qe.decomposition.sampled_cells import Number, Place, child, coordinates, root_place
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.radicals import brief_algebraic
from qe.exact.ring import Poly, format_poly
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import CellTable
from qe.spelling import QUOTED, WORD, between_quotes, is_product, quoted

LONGEST = 200
"""Characters of one bound in texts for people."""

LONGEST_BITS = 10_000
"""Of a coefficient that Python writes in decimals."""


@dataclass(frozen=True, slots=True)
class RootFunction:
    """The k-th real root (from 1) of ``poly`` in its main variable; its text is a term that can be read back.

    Distinct roots are counted, as in root atoms; those of a polynomial with a constant leading coefficient of degree 2
    or of two terms by their multiplicity: these are written with radicals. ``value`` is the number itself when the
    polynomial has one variable.
    """

    poly: Poly
    k: int
    value: RealAlgebraic | None = None

    def brief(self) -> str:
        """As ``str``, but where that is longer than ``LONGEST`` characters, what the root is, with its place."""
        if self.value is not None:
            return brief_algebraic(self.value, LONGEST)
        text = str(self) if self.poly.term_count() * 2 < LONGEST else ""
        if text and len(text) <= LONGEST:
            return text
        variable, degree = self.poly.ring.names[self.poly.level], self.poly.degree(self.poly.level)
        return f"root({self.k}, a polynomial of degree {degree} in {variable} with {self.poly.term_count()} terms)"

    def __str__(self) -> str:
        return readable(self._text(), self.poly.ring.names)

    def _text(self) -> str:
        if self.value is not None:
            return str(self.value)
        written, c = self.written, self.poly.coefficients(self.poly.level)
        if written is not None:
            return quotient_text(*written, -1 if self.k == 1 else 1)
        if not any(c[1:-1]):  # the leading coefficient is not zero where there is a root
            for radical in radicals(c, self.k, 1 + len(c) % 2, 1):
                return radical.text
        return f"root({self.k}, {format_poly(self.poly)}, {quoted(self.poly.ring.names[self.poly.level])})"

    @property
    def written(self) -> tuple[Poly, Poly | None, Poly] | None:
        """a, b, c of the root a/c (b is None) or (a ± sqrt(b))/c, with the minus where ``k`` is 1; None: it is no such.

        c is a constant where there is a square root.
        """
        c = self.poly.coefficients(self.poly.level)
        if len(c) == 2:
            return -c[0], None, c[1]
        if len(c) > 3 or not c[2].is_constant:
            return None
        return halved(c)


@dataclass(frozen=True, slots=True, repr=False)
class Range:
    """The values of one variable: from ``lower`` to ``upper`` (None: unbounded), ends included or not.

    A single value has equal ends, both included.
    """

    variable: str
    lower: RootFunction | None
    upper: RootFunction | None
    lower_closed: bool = False
    upper_closed: bool = False

    @property
    def is_point(self) -> bool:
        """Whether the range is a single value."""
        return self.lower is not None and self.lower == self.upper

    @property
    def is_bounded(self) -> bool:
        """Whether there is an end."""
        return self.lower is not None or self.upper is not None

    def end(self, *, lower: bool) -> tuple[RootFunction | None, bool]:
        """One end (None: there is none), and whether it is included."""
        return (self.lower, self.lower_closed) if lower else (self.upper, self.upper_closed)

    def __str__(self) -> str:
        return self._text(str)

    def __repr__(self) -> str:
        return f"<{self.brief()}>"

    def brief(self) -> str:
        """As ``str``, with long bounds described only."""
        return self._text(RootFunction.brief)

    def _text(self, shown: Callable[[RootFunction], str]) -> str:
        ends = self.lower, self.upper
        lower, upper = ("" if end is None else shown(end) for end in ends)
        name = quoted(self.variable, next((end.poly.ring.names for end in ends if end is not None), ()))
        return (
            f"{name} = {lower}"
            if self.is_point
            else range_text(name, lower, upper, self.lower_closed, self.upper_closed)
        )


def readable(text: str, names: Collection[str]) -> str:
    """The text with those names between backquotes that reading would take for products of others."""
    made = {name for name in names if is_product(name, names)}
    if not made:
        return text
    return re.sub(rf"{QUOTED}|{WORD}", lambda word: between_quotes(word[0]) if word[0] in made else word[0], text)


def range_text(name: str, lower: str, upper: str, lower_closed: bool, upper_closed: bool) -> str:
    """What lies between two terms, either of which may be missing ("")."""
    if lower and not upper:
        return f"{name} {'>=' if lower_closed else '>'} {lower}"
    left = f"{lower} {'<=' if lower_closed else '<'} " if lower else ""
    return f"{left}{name} {'<=' if upper_closed else '<'} {upper}" if upper else f"{name} any"


@dataclass(frozen=True, slots=True, repr=False)
class Piece:
    """A union of cells with one description. ``dimension``: of its largest cell, the one at ``path`` in ``table``.

    ``str`` is a conjunction with a bound or two for each variable in terms of those before it; it can be read back.
    """

    ranges: tuple[Range, ...]
    dimension: int
    table: CellTable = field(repr=False, compare=False)
    path: tuple[int, ...] = field(repr=False, compare=False)

    @property
    def sample(self) -> Mapping[str, Number]:
        """A point of the largest cell. Irrational coordinates get their minimal polynomials, which can take long."""
        place = root_place(self.table)
        for position in self.path:
            place = child(self.table, place, position)
        return coordinates(self.table, place)

    @property
    def formula(self) -> Formula:
        """What ``str`` says, as a formula that holds at exactly the points of the piece; it may have root atoms."""
        return read(str(self), known=self.table.order)

    def __str__(self) -> str:
        return " and ".join(str(r) for r in self._bounded) or "true"

    def __repr__(self) -> str:
        return f"<{self.brief()}>"

    def brief(self) -> str:
        """As ``str``, for people: bounds whose exact text is longer than ``LONGEST`` characters are described only."""
        return " and ".join(r.brief() for r in self._bounded) or "true"

    @property
    def _bounded(self) -> list[Range]:
        return [r for r in self.ranges if r.is_bounded]


Candidates = frozenset[RootFunction]


@dataclass(frozen=True, slots=True)
class _Branch:
    """Positions ``start``..``stop`` of a stack that share one description of what is above."""

    start: int
    stop: int
    lower: Candidates | None
    upper: Candidates | None
    above: tuple[_Branch, ...] | None
    place: Place

    @property
    def closed(self) -> tuple[bool, bool]:
        return self.start % 2 == 1, self.stop % 2 == 1


def merge(table: CellTable, *, distinct: bool = False, budget: Budget | None = None) -> list[Piece]:
    """The pieces of the set of true cells (all variables free), in order.

    With ``distinct`` the roots in the bounds are counted without multiplicity, as root atoms do; then fewer
    cells merge. Raises ``BudgetExceeded``.
    """
    budget = budget or Budget()
    branches = _Merging(table, Sections(table, budget, distinct), budget).branches(root_place(table))
    if branches is None:
        return [_piece(table, (), root_place(table))]
    return [p for b in branches for p in _flatten(table, b, ())]


@dataclass(slots=True)
class Sections:
    """What the sections of a table are, with the real roots of its polynomials in one variable."""

    table: CellTable
    budget: Budget
    distinct: bool = True
    values: dict[Poly, list[RealAlgebraic]] = field(default_factory=dict)

    def of(self, place: Place) -> list[Candidates]:
        """For every section the root functions that describe it (several where roots meet or factors share it)."""
        stack = place.cell.stack
        assert stack is not None
        level = place.depth
        seen: dict[int, int] = {}
        met = dict.fromkeys(stack.used, 0)
        totals = {j: sum(j in s for s in stack.sections) for j in stack.used}
        nullified = {j for j, sign in zip(stack.used, stack.cells[0].signs, strict=True) if sign == "0"}
        result: list[Candidates] = []
        for members in stack.sections:
            found: set[RootFunction] = set()
            for j in members:
                poly = self.table.factors[level][j]
                k = seen.get(j, 0) + 1
                # both roots can be written with radicals wherever they are real, also where they meet
                c = poly.coefficients(level)
                paired = c[-1].is_constant and (len(c) == 3 or (len(c) % 2 and not any(c[1:-1])))
                double = not self.distinct and totals[j] == 1 and paired
                multiplicity = 2 if double else 1
                value = self.value(poly, met[j]) if poly.variables == (level,) else None
                met[j] += 1
                # where a polynomial is zero for every value, the place of its root is of no use in a text
                if j not in nullified or nullified.issuperset(members):
                    found.update(RootFunction(poly, k + m, value) for m in range(multiplicity))
                seen[j] = k + multiplicity - 1
            result.append(frozenset(found))
        return result

    def value(self, poly: Poly, position: int) -> RealAlgebraic:
        """A real root of a polynomial in one variable; over every point, all its roots are among the sections."""
        stored = self.values.get(poly)
        if stored is None:
            self.budget.check("merge cells")
            stored = self.values[poly] = real_roots(poly.to_univariate(poly.level))
        return stored[position]


@dataclass(slots=True)
class _Merging:
    """The walk through a table."""

    table: CellTable
    sections: Sections
    budget: Budget

    def branches(self, place: Place) -> tuple[_Branch, ...] | None:
        """The description of the truth set over a cell: None for everything, () for nothing."""
        self.budget.check("merge cells")
        cell = place.cell
        if cell.stack is None:
            return None if cell.truth else ()
        ends = self.sections.of(place)
        merged: list[_Branch] = []
        for position, below in enumerate(cell.stack.cells):
            if below.stack is None and not below.truth:
                continue
            inner = child(self.table, place, position)
            above = self.branches(inner)
            if above == ():
                continue
            lower = ends[(position - 1) // 2] if position > 0 else None
            upper = ends[position // 2] if position < len(cell.stack.cells) - 1 else None
            if position % 2:
                lower = upper = ends[position // 2]
            branch = _Branch(position, position, lower, upper, above, inner)
            joined = _joined(merged[-1], branch) if merged else None
            if joined is None:
                merged.append(branch)
            else:
                merged[-1] = joined
        return tuple(merged)


def _joined(left: _Branch, right: _Branch) -> _Branch | None:
    if right.start != left.stop + 1:
        return None
    same, above = _unified(left.above, right.above)
    if not same:
        return None
    place = left.place if left.place.dimension >= right.place.dimension else right.place
    return _Branch(left.start, right.stop, left.lower, right.upper, above, place)


def _unified(
    left: tuple[_Branch, ...] | None, right: tuple[_Branch, ...] | None
) -> tuple[bool, tuple[_Branch, ...] | None]:
    """(whether the descriptions agree, the common description)."""
    if left is None or right is None:
        return left is right, None
    if len(left) != len(right):
        return False, None
    result = []
    for a, b in zip(left, right, strict=True):
        single = (a.start == a.stop and a.start % 2 == 1, b.start == b.stop and b.start % 2 == 1)
        # a section may be the closed interval between two roots that meet there
        if a.closed != b.closed:
            return False, None
        lower, upper = _common(a.lower, b.lower), _common(a.upper, b.upper)
        if lower == frozenset() or upper == frozenset():
            return False, None
        same, above = _unified(a.above, b.above)
        if not same:
            return False, None
        keep = b if single[0] and not single[1] else a
        result.append(_Branch(keep.start, keep.stop, lower, upper, above, keep.place))
    return True, tuple(result)


def _common(a: Candidates | None, b: Candidates | None) -> Candidates | None:
    if a is None or b is None:
        return None if a is b else frozenset()
    return a & b


def _flatten(table: CellTable, branch: _Branch, ranges: tuple[Range, ...]) -> list[Piece]:
    variable = table.order[len(ranges)]
    lower, upper = _chosen(branch.lower), _chosen(branch.upper)
    if branch.start == branch.stop and branch.start % 2:
        upper = lower
    own = (*ranges, Range(variable, lower, upper, *branch.closed))
    if branch.above is None:
        return [_piece(table, own, branch.place)]
    return [p for b in branch.above for p in _flatten(table, b, own)]


def _piece(table: CellTable, ranges: tuple[Range, ...], place: Place) -> Piece:
    rest = tuple(Range(name, None, None) for name in table.order[len(ranges) :])
    dimension = sum(not r.is_point for r in (*ranges, *rest))
    return Piece((*ranges, *rest), dimension, table, place.path)


def _chosen(candidates: Candidates | None) -> RootFunction | None:
    if candidates is None:
        return None
    texts = {p: str(p.terms()) if p.height_bits() < LONGEST_BITS else "" for p in {r.poly for r in candidates}}
    return min(candidates, key=lambda r: (r.poly.degree(r.poly.level), r.poly.term_count(), texts[r.poly], r.k))
