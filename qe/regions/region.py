"""Regions: the solution set of a quantifier-free formula, described cylindrically, with a certificate."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from html import escape
from pathlib import Path
from typing import Any, TypeVar

from qe.arguments import by_name, by_place, instance, name, ratio, seconds
from qe.arguments import path as name_of_file
from qe.arguments import point as point_of
from qe.decomposition.decompose import decompose
from qe.decomposition.fibres import fibre_of
from qe.decomposition.interval import Coordinate, Interval, Number, number_of
from qe.decomposition.pieces import Piece, merge
from qe.decomposition.sampled_cells import Place, any_true, coordinates, first_shadow, free_part, leaves
from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.number import ExactPoint, simplest
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.extras import wanted
from qe.formula.build import conj, convert
from qe.formula.evaluate import truth_under
from qe.formula.normal import nnf
from qe.formula.syntax import Formula, FormulaNode
from qe.options import Budget
from qe.processes.execution import leave, perform
from qe.processes.limits import Limits
from qe.proof.answer import Answer, Guarantee
from qe.proof.cells import Cell, CellTable
from qe.proof.certificate import Certificate, table_of
from qe.regions.operators import SetOperations
from qe.regions.volume import enclose

T = TypeVar("T")
Values = Mapping[Any, Coordinate] | Sequence[Coordinate]
"""Coordinates by name (or by variable), or in order."""
PICTURE_SECONDS = 3.0
"""What the picture of a region may take that a notebook shows without being asked for it."""
NONE = Limits()
_CACHES = ("_bounds", "_formula", "_pieces", "_table")


class Region(SetOperations):
    """The set of real points that satisfy ``formula``; ``table`` proves where it is true.

    ``limits`` hold for every question (replace them to change them); ``timeout`` in seconds, where a question has one,
    goes before theirs. Questions that take long are worked on in another process (see ``qe.processes``); they raise
    ``BudgetExceeded`` at a limit. ``answer``: how ``formula`` was found, where quantifiers were eliminated (None: it
    was given). ``guarantee``, with ``qe.region(..., check=True)``: CHECKED where separate code accepted ``proof``, and
    otherwise ``reason`` says why not.
    """

    __slots__ = (
        "_bounds",
        "_budget",
        "_formula",
        "_pieces",
        "_table",
        "answer",
        "guarantee",
        "limits",
        "order",
        "reason",
    )

    order: tuple[str, ...]
    limits: Limits
    guarantee: Guarantee
    reason: str
    is_optimised: bool = False
    """Whether questions are answered by convex optimisation, without a table."""

    def __init__(
        self, formula: Formula | None, table: CellTable | None, order: tuple[str, ...], limits: Limits = NONE
    ) -> None:
        self._formula, self._table, self.order, self.limits = formula, table, order, limits
        self._pieces: list[Piece] | None = None
        self._bounds: dict[str, Interval] = {}
        self._budget: Budget | None = None
        self.answer: Answer | None = None
        self.guarantee, self.reason = Guarantee.DERIVED, ""

    @staticmethod
    def of(
        formula: Formula,
        order: tuple[str, ...] | None = None,
        *,
        budget: Budget | None = None,
        limits: Limits = NONE,
    ) -> Region:
        """Decompose the space of the free variables (or of ``order``, which may name more).

        Raises ``InputError`` when ``order`` misses a free variable.
        """
        instance(formula, FormulaNode, "formula", "a formula")
        chosen = checked_order(formula.free, order)
        matrix = nnf(convert(formula, Ring.of(chosen)))
        done = decompose(matrix, chosen, ("",) * len(chosen), budget=budget or Budget())
        return Region(matrix, done.table, chosen, limits)

    # --- questions under limits ----------------------------------------------------------------
    def _asked(
        self, work: Callable[[], T], timeout: float | None = None, *, at_once: bool = False, start: float | None = None
    ) -> T:
        """The answer to a question, found under the limits; what was learned on the way is kept. ``work`` knows the
        region, as a method or argument, and can be pickled. ``start``: when the time began to run, if before.

        A question that is part of another shares its budget; where it may take long, both move to another process.
        """
        limits = replace(self.limits, start=start)
        limits = limits if timeout is None else replace(limits, timeout=seconds(timeout))
        at_once = at_once and limits.timeout is not None
        if self._budget is not None:
            if at_once:
                leave()
            return work()
        answer, learned = perform(partial(self._learned, work), limits, at_once=at_once)
        for learnt, value in learned.items():
            setattr(self, learnt, value)
        return answer

    def _learned(self, work: Callable[[], T], budget: Budget) -> tuple[T, dict[str, Any]]:
        """The answer, and what of the caches is new; perhaps in another process, of the region's copy there."""
        before = {cache: _known(getattr(self, cache)) for cache in _CACHES}
        self._budget = budget
        try:
            answer = work()
        finally:
            self._budget = None
        learned = {cache: getattr(self, cache) for cache in _CACHES}
        return answer, {cache: value for cache, value in learned.items() if _known(value) != before[cache]}

    def _current(self) -> Budget:
        """The budget of the question that is being answered."""
        return Budget() if self._budget is None else self._budget

    def __getstate__(self) -> tuple[None, dict[str, Any]]:
        """A region is pickled without the question that is being answered."""
        names = {name for kind in type(self).__mro__ for name in getattr(kind, "__slots__", ())}
        return None, {name: getattr(self, name) if name != "_budget" else None for name in sorted(names)}

    # --- what it is --------------------------------------------------------------------------
    @property
    def formula(self) -> Formula:
        """The defining quantifier-free formula."""
        assert self._formula is not None
        return self._formula

    @property
    def condition(self) -> Formula:
        """The formula that is cheapest to have, perhaps with quantifiers."""
        return self.formula

    @property
    def table(self) -> CellTable:
        """The decomposition that proves where the formula is true."""
        assert self._table is not None
        return self._table

    @property
    def is_empty(self) -> bool:
        """Whether the region has no point."""
        return not any_true(self.table.root)

    @property
    def cells(self) -> list[Piece]:
        """The cylindrical pieces, merged from the true cells."""
        if self._pieces is None:
            unknown = self._table is None
            self._pieces = self._asked(self._merged, at_once=unknown)
        return self._pieces

    def _merged(self) -> list[Piece]:
        return merge(self.table, budget=self._current())

    @property
    def dimension(self) -> int:
        """The dimension of the set, -1 if it is empty."""
        size = len(self.order)
        return max((p.dimension + size - p.depth for p in leaves(self.table, is_true)), default=-1)

    def contains(self, point: Values, *, timeout: float | None = None) -> bool:
        """Exact membership. ``point``: values by name (or variable), or in the order of the variables.

        Coordinates: int, Fraction, decimal or fraction text, exact irrational numbers, numpy's and SymPy's. A float is
        the decimal number that it prints. Raises ``InputError`` for other things, and for missing or unknown names.
        """
        values = self._values(point_of(point, self.order), len(self.order))
        return self._asked(partial(self._holds, values), timeout, at_once=_are_irrational(values))

    def _values(self, point: Mapping[str, Coordinate], count: int) -> list[Number]:
        """The numbers given for the first ``count`` variables."""
        for variable in self.order[:count]:
            if variable not in point:
                raise InputError(f"point: a value for {variable} expected")
        return [number_of(point[v], "point", f"an exact number for {v}") for v in self.order[:count]]

    def _holds(self, values: list[Number]) -> bool:
        place = Point.of(Ring.of(self.order), values)
        budget = self._current()

        def sign(poly: Poly) -> int:
            budget.check("membership")
            return place.sign(poly)

        truth = truth_under(self.formula, sign)
        assert truth is not None
        return truth

    def fibre(
        self, prefix: Mapping[str, Coordinate] | Sequence[Coordinate] = (), *, timeout: float | None = None
    ) -> list[Interval]:
        """The exact set still possible for the next variable of ``order`` when the first ones have these values.

        ``prefix``: values by name (of the first variables of ``order``) or in order. Disjoint intervals, ascending;
        at most one for a convex set, none when no point begins like that. A walk that takes each value from the
        interval it is offered ends in a point of the region.
        """
        if isinstance(prefix, Mapping):
            named, size = by_name(prefix, "prefix"), len(prefix)
        else:
            values = by_place(prefix, "prefix")
            named, size = dict(zip(self.order, values, strict=False)), len(values)
        if len(named) < size or len(named) >= len(self.order) or set(named) != set(self.order[: len(named)]):
            expected = ", ".join(self.order[:-1])
            raise InputError(f"prefix: values for the first variables of {expected} expected")
        values = self._values(named, len(named))
        return self._asked(partial(self._fibre, values), timeout, at_once=_are_irrational(values))

    def _fibre(self, values: list[Number]) -> list[Interval]:
        return fibre_of(self.table, values, budget=self._current())

    def sample_points(self, *, timeout: float | None = None) -> list[dict[str, Number]]:
        """One exact point in every true cell of the decomposition."""
        return self._asked(self._samples, timeout, at_once=True)

    def _samples(self) -> list[dict[str, Number]]:
        return self._points_of(leaves(self.table, is_true))

    def _points_of(self, places: Iterable[Place]) -> list[dict[str, Number]]:
        points: list[dict[str, Number]] = []
        for place in places:
            self._current().check("sample points", len(points))
            points.append(ExactPoint(coordinates(self.table, place)))
        return points

    def bounds(self, variable: str, *, timeout: float | None = None) -> Interval:
        """The exact infimum and supremum of a variable over the region, and whether they are attained; of regions that
        are answered by convex optimisation with the certificates of both."""
        variable, timeout = name(variable, "variable"), seconds(timeout)
        if variable not in self.order:
            raise InputError(f"variable: one of {', '.join(self.order)} expected, {variable} found")
        if variable not in self._bounds:
            self._bounds[variable] = self._asked(partial(self._bounded, variable), timeout, at_once=True)
        return self._bounds[variable]

    def _bounded(self, variable: str) -> Interval:
        if self.is_empty:
            raise InputError("an empty region has no bounds")
        if variable == self.order[0] and self._table is not None:
            shadow = first_shadow(self.table)
        else:
            order = (variable, *(v for v in reversed(self.order) if v != variable))
            quantifiers = ("", *("E" for _ in order[1:]))
            shadow = free_part(decompose(self.formula, order, quantifiers, budget=self._current()).table)
        pieces = merge(shadow, budget=self._current())
        first, last = pieces[0].ranges[0], pieces[-1].ranges[0]
        ends = (None if end is None or end.value is None else simplest(end.value) for end in (first.lower, last.upper))
        lower, upper = ends
        return Interval(lower, upper, first.lower_closed, last.upper_closed)

    def volume(self, rel_error: float = 0.01, *, timeout: float | None = None) -> tuple[Fraction, Fraction]:
        """Rational numbers lo <= volume <= hi with hi - lo <= rel_error * hi (area in 2-D, length in 1-D).

        Regions bounded by planes and ellipsoids take well under a second at 0.01; other regions in space take longer.
        Raises ``Unable`` for unbounded regions, and ``BudgetExceeded``, with what is known by then, at a limit.
        """
        error = ratio(rel_error, "rel_error")
        return self._asked(partial(self._enclosed, error), timeout, at_once=True)

    def _enclosed(self, error: Fraction) -> tuple[Fraction, Fraction]:
        return enclose(self, error, budget=self._current())

    # --- evidence and files ----------------------------------------------------------------------
    @property
    def certificate(self) -> Certificate:
        """What ``qe.verify`` accepts: the whole cell table."""
        return Certificate.cells(self.table)

    @property
    def proof(self) -> Certificate:
        """The certificate, next to that of the elimination of quantifiers where there is one."""
        formula = None if self.answer is None else self.answer.certificate
        cells = self.certificate
        return cells if formula is None else Certificate.bundle([("formula", formula), ("cells", cells)])

    def to_json(self) -> str:
        """The certificate's JSON, from which ``from_json`` restores the region."""
        return self.certificate.to_json()

    @staticmethod
    def from_json(text: str) -> Region:
        """The region of a JSON text. Nothing is verified; use ``qe.verify`` on ``certificate`` for that."""
        table = table_of(Certificate.from_json(text))
        if table is None or not table.is_decomposition:
            raise InputError("a region in JSON expected")
        return Region(table.matrix, table, table.order)

    def within(self, condition: Formula) -> Region:
        """The part where a quantifier-free condition on the region's variables holds, decomposed in the same order."""
        ring = Ring.of(self.order)
        instance(condition, FormulaNode, "condition", "a formula")
        both = conj((convert(self.formula, ring), convert(condition, ring)))
        return Region.of(both, self.order, budget=self._budget, limits=self.limits)

    def plot(self, path: str | Path | None = None, *, ax: Any = None, timeout: float | None = None) -> Any:
        """A picture of a region in one to three variables; the matplotlib axes.

        ``path``: written there, by its ending as PNG, SVG or PDF, or as a page (.html; turnable in three
        variables; returns None). ``ax``: painted on these axes (of projection "3d" in three variables). With neither,
        on new ones of pyplot's. ``timeout`` (seconds) limits the exact part, not the painting. Raises ``InputError`` in
        more variables and for a file that cannot be written, ``Unable`` where matplotlib is not installed.
        """
        with wanted():
            from qe.regions.picture import check_ending, show, write
            from qe.regions.sketch import sketch

        target = None if path is None else name_of_file(path)
        if target is not None:
            if ax is not None:
                raise InputError("ax: a file or axes expected, both found")
            check_ending(target)
        drawn = self._asked(partial(sketch, self), seconds(timeout), at_once=True)
        try:
            with wanted():
                return show(drawn, ax) if target is None else write(drawn, target)
        except OSError as error:
            raise InputError(f"{target}: cannot be written: {error.strerror}") from None

    def __repr__(self) -> str:
        return f"Region({', '.join(self.order)}: {self.formula.brief()})"

    def _repr_html_(self) -> str:
        """The formula, for notebooks with a picture in one or two variables, where it is found at once."""
        picture = ""
        if len(self.order) <= 2:
            from qe.regions.picture import inline
            from qe.regions.sketch import sketch

            try:
                picture = inline(self._asked(partial(sketch, self), PICTURE_SECONDS, at_once=True))
            except (Unable, ImportError):
                picture = ""
        return f"<div><code>{escape(repr(self))}</code><br>{picture}</div>"


def checked_order(free: tuple[str, ...], order: tuple[str, ...] | None) -> tuple[str, ...]:
    """The requested order, else that of the free variables; ``InputError`` when it misses one or repeats a name."""
    chosen = free if order is None else order
    missing = [v for v in free if v not in chosen]
    if missing or len(set(chosen)) != len(chosen):
        raise InputError(f"order: each of {', '.join(free)} once expected, {', '.join(chosen)} found")
    return chosen


def _known(value: object) -> int:
    """How much a cache holds."""
    return 0 if value is None else len(value) if isinstance(value, dict) else 1


def _are_irrational(values: Sequence[Number]) -> bool:
    return any(isinstance(value, RealAlgebraic) and not value.is_rational for value in values)


def is_true(cell: Cell) -> bool:
    """Whether a cell is an undecomposed one on which the formula is true."""
    return cell.stack is None and cell.truth is True
