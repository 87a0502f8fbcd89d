"""The least value as a function of parameters: piecewise, over cylindrical cells of parameter space."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import groupby
from typing import NamedTuple

from qe.arguments import by_name, flag, seconds, whole
from qe.decomposition.decompose import decompose
from qe.decomposition.fibres import fibre_of
from qe.decomposition.interval import Coordinate, number_of
from qe.decomposition.pieces import Piece, Range, RootFunction, merge
from qe.decomposition.sampled_cells import child, leaves, root_place
from qe.engine.run import solve
from qe.errors import InputError
from qe.exact.number import Number, simplest
from qe.formula.build import conj, convert, exists
from qe.formula.syntax import FALSE, Formula
from qe.io.latex_text import formula_in_latex, term_in_latex
from qe.optimization.global_optimum import GlobalOptimum, attained_by, number_conditions
from qe.optimization.minimisers import End, ends, minimisers, points
from qe.optimization.values import Goal, first_answer, with_proof
from qe.options import Budget, Options
from qe.processes.execution import perform
from qe.processes.limits import Limits
from qe.proof.answer import Answer, Guarantee
from qe.proof.cells import CellTable
from qe.proof.certificate import Certificate
from qe.proof.multipliers import OptimumStatus
from qe.regions.by_value import cases_by_value, effort, is_determined
from qe.regions.parameter_conditions import Terms, both, only
from qe.services import SymPyForm
from qe.spelling import NUMBERS, QUOTED, WORD, quoted

Place = tuple[Range, ...]


@dataclass(frozen=True, slots=True, repr=False)
class Case:
    """Where the parameters lie in ``ranges``, the optimum is ``value`` (None: unbounded), taken or only approached.

    ``value`` is a root function of the parameters: the k-th root of a polynomial in them and in the value.
    ``minimisers``: all points that have it (for a maximum as well), in disjoint pieces: each variable a root function,
    or between two, of the parameters, the value and the variables before it. Empty where the value is not attained or
    nothing is optimised over; None where their description was too much work (see ``ParametricOptimum.minimisers``).
    """

    ranges: Place
    value: RootFunction | None
    attained: bool
    minimisers: tuple[Place, ...] | None = ()

    def __repr__(self) -> str:
        return f"<{self}>"

    def __str__(self) -> str:
        return str(self.stated)

    @property
    def stated(self) -> Stated:
        """The case as texts."""
        points = [
            _said(place) or (f"any {', '.join(quoted(r.variable) for r in place)}",) for place in self.minimisers or ()
        ]
        return Stated(None if self.value is None else str(self.value), self.attained, points, _said(self.ranges))


def _said(place: Place) -> Terms:
    """The ranges that say something."""
    return tuple(str(r) for r in place if r.is_bounded)


class Stated(NamedTuple):
    """A case as texts: where ``conditions`` hold the optimum is ``value`` (None: unbounded), at all ``points``."""

    value: str | None
    attained: bool
    points: Sequence[Terms]
    conditions: Terms

    def __str__(self) -> str:
        what = "unbounded" if self.value is None else f"{self.value}{'' if self.attained else ' (not attained)'}"
        at = f" at {' or '.join(map(', '.join, self.points))}" if self.points else ""
        return f"{what}{at} if {', '.join(self.conditions)}" if self.conditions else what + at

    def to_latex(self) -> str:
        """A line of ``cases``."""
        what = r"\text{unbounded}" if self.value is None else term_in_latex(self.value)
        note = "" if self.attained or self.value is None else r"\ (\text{not attained})"
        where = r" \lor ".join(", ".join(map(_in_latex, point)) for point in self.points)
        at = rf"\ \text{{at}}\ {where}" if where else ""
        return f"{what}{note}{at} & {', '.join(map(formula_in_latex, self.conditions))}"


def _in_latex(said: str) -> str:
    """What is said of a variable, or that some have any value."""
    if said.startswith("any ") and said[4] not in "<>=/":  # a variable may have that name
        return r",\,".join(map(term_in_latex, re.findall(f"{QUOTED}|{WORD}", said[4:]))) + r" \in \mathbb{R}"
    return formula_in_latex(said)


@dataclass(frozen=True, slots=True, repr=False)
class ParametricOptimum(SymPyForm):
    """The minimum or maximum as a function of the parameters: ``cases`` with disjoint conditions; ``stated``: each
    value once with its points and the condition under which they have it, as texts, where that is shorter.

    Where no case applies, no point meets the constraints. ``at`` gives the optimum at numbers. ``minimisers``: holds
    at exactly the parameters and points where the optimum is attained. ``values``: the values that are taken, a formula
    of ``variable`` and the parameters. ``certificate``: of the elimination and of the cells that the values and their
    ends are read from, not of the minimisers; None where it had none. ``answer``: how the values were found.
    ``guarantee``, ``reason``: with ``check``, as in ``GlobalOptimum``. ``str`` and ``to_latex`` write
    what is ``stated``, ``to_json`` all cases; in SymPy it is a ``Piecewise``.
    """

    cases: tuple[Case, ...]
    stated: tuple[Stated, ...]
    parameters: tuple[str, ...]
    values: Formula
    variable: str
    minimisers: Formula
    answer: Answer = field(repr=False)
    _goal: Goal = field(repr=False, compare=False)
    _table: CellTable = field(repr=False, compare=False)
    _sign: int = field(repr=False, compare=False)
    certificate: Certificate | None = None
    guarantee: Guarantee = Guarantee.DERIVED
    reason: str = ""

    @property
    def branches(self) -> list[tuple[str, str]]:
        """For each case the value, or infinity with its sign, and the condition under which it is the optimum."""
        none = "-infinity" if self._sign > 0 else "infinity"
        return [
            (case.value or none, both(*((part, " or " in part) for part in case.conditions)) or "true")
            for case in self.stated
        ]

    def __iter__(self) -> Iterator[Case]:
        return iter(self.cases)

    def __len__(self) -> int:
        return len(self.cases)

    def __repr__(self) -> str:
        count = len(self.cases)
        return f"ParametricOptimum({', '.join(self.parameters)}: {count} case{'s' if count != 1 else ''})"

    def __str__(self) -> str:
        return "\n".join(map(str, self.stated)) or "no point meets the constraints"

    def at(
        self, parameters: Mapping[str, Coordinate], *, timeout: float | None = None, process: bool = True
    ) -> GlobalOptimum:
        """The exact optimum at these values of the parameters, with a point that has it; limits as in ``qe.eliminate``.

        Raises ``InputError`` where a value is missing, of another name, or no exact number.
        """
        named = by_name(parameters, "parameters")
        for name in (*self.parameters, *named):
            if name not in named or name not in self.parameters:
                raise InputError(f"parameters: a value for each of {', '.join(self.parameters)} expected ({name})")
        given = {name: number_of(named[name], "parameters", f"an exact number for {name}") for name in self.parameters}
        limits = Limits(seconds(timeout), process=flag(process, "process"))
        return perform(partial(self._at, given), limits, at_once=timeout is not None)

    def _at(self, given: Mapping[str, Number], budget: Budget) -> GlobalOptimum:
        fixed = [part for name, value in given.items() for part in number_conditions(self._goal.ring, name, value)]
        place = replace(self._goal, conditions=conj((self._goal.conditions, *fixed)), polynomial=None)
        here = exists(self.parameters, conj((convert(self.values, self._goal.ring), *fixed)))
        taken = solve(here, Options(), budget).formula
        values = fibre_of(self._table, list(given.values()), budget=budget)
        nowhere = partial(GlobalOptimum, point={}, minimisers=FALSE, values=taken, variable=self.variable)
        if not values:
            return nowhere(OptimumStatus.INFEASIBLE, None, None, answer=self.answer)
        end = values[0] if self._sign > 0 else values[-1]
        value, attained = (end.lower, end.lower_closed) if self._sign > 0 else (end.upper, end.upper_closed)
        if value is None:
            return nowhere(OptimumStatus.UNBOUNDED, None, None, answer=self.answer)
        if not attained:
            return nowhere(OptimumStatus.OPTIMAL, simplest(value), False, answer=self.answer)
        return attained_by(place, simplest(value), taken, self.answer, budget)

    def to_dict(self) -> dict[str, object]:
        """The cases as plain data: where, value, attained, minimisers, each as text that ``str`` writes."""
        return {"parameters": list(self.parameters), "variable": self.variable, "cases": list(map(_data, self.cases))}

    def to_json(self, *, indent: int | None = None) -> str:
        """``to_dict`` as JSON."""
        if indent is not None:
            whole(indent, "indent", 80)
        return json.dumps(self.to_dict(), indent=indent, ensure_ascii=False)

    def to_latex(self) -> str:
        """The function by cases, for math mode."""
        lines = " \\\\\n".join(one.to_latex() for one in self.stated) or r"\text{no point meets the constraints} &"
        return f"\\begin{{cases}}\n{lines}\n\\end{{cases}}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.to_latex()}$"


def optimum_of(sign: int, goal: Goal, *, budget: Budget | None = None, check: bool = False) -> ParametricOptimum:
    """The minimum (``sign`` 1) or maximum (-1) for all values of the parameters at once.

    Raises ``Unable`` (``BudgetExceeded`` at a limit) where elimination does.
    """
    limits = budget or Budget()
    if not goal.graph.is_quantifier_free:
        goal = replace(goal, graph=solve(goal.graph, Options(), limits).formula)
    values, unproved = first_answer(goal.taken, limits, check=check)
    taken = values.formula
    order = (*goal.parameters, goal.value)
    table = decompose(taken, order, ("",) * len(order), budget=limits).table
    kinds = {end: ends(table, sign, end) for end in End}
    cases = [pair for end, cells in kinds.items() for pair in _by_value(merge(cells, budget=limits), end)]
    cases.sort(key=lambda pair: pair[0])
    roots = list(dict.fromkeys(case.value.poly for _, case in cases if case.value is not None and case.attained))
    attained = None
    if goal.variables and roots:
        attained = points(goal, taken, roots, sign, limits)
        if attained is None:
            cases = [(at, replace(case, minimisers=None if case.attained else ())) for at, case in cases]
        else:
            cases = [(at, case) for at, case in cases if not case.attained]
            cases += _with_points(merge(attained, budget=limits), len(goal.parameters))
            cases.sort(key=lambda pair: pair[0])
    listed = _for_numbers([case for _, case in cases], goal.parameters)
    optimum = ParametricOptimum(
        cases=listed,
        stated=_stated(listed, kinds if attained is None else {**kinds, End.ATTAINED: attained}, goal, limits),
        parameters=goal.parameters,
        values=taken,
        variable=goal.value,
        minimisers=minimisers(goal, taken, table, sign, limits),
        answer=unproved,
        _goal=goal,
        _table=table,
        _sign=sign,
    )
    members = [("cases", Certificate.cells(table))]
    return with_proof(optimum, goal.taken, values, "values", members, limits, check=check)


def _by_value(pieces: Iterable[Piece], end: End) -> Iterator[tuple[Number, Case]]:
    """The cases of the pieces of the ends of a kind, each with its place."""
    for piece in pieces:
        *ranges, values = piece.ranges
        yield _place(piece), Case(tuple(ranges), values.lower, end is End.ATTAINED)


def _with_points(pieces: Iterable[Piece], size: int) -> Iterator[tuple[Number, Case]]:
    """The cases of the pieces of the points that have the optimum, over ``size`` parameters and the value."""
    for ranges, stack in groupby(pieces, key=lambda piece: piece.ranges[: size + 1]):
        places = list(stack)
        points = tuple(piece.ranges[size + 1 :] for piece in places)
        yield _place(places[0]), Case(ranges[:-1], ranges[-1].lower, True, points)


def _stated(cases: Sequence[Case], tables: Mapping[End, CellTable], goal: Goal, budget: Budget) -> tuple[Stated, ...]:
    """The cases as texts: each value and its points once, if that is not longer."""
    plain = tuple(case.stated for case in cases)
    if _numbers(goal.parameters):
        return plain
    said = [pair for end, table in tables.items() for pair in _by_terms(table, end, goal, budget)]
    by_value = tuple(one for _, one in sorted(said, key=lambda pair: pair[0]))
    first, second = (effort(map(str, some), goal.variables) for some in (by_value, plain))
    return by_value if first <= second else plain


def _by_terms(table: CellTable, end: End, goal: Goal, budget: Budget) -> Iterator[tuple[Number, Stated]]:
    """The true cells as texts, each with a place; where points are no values of the parameters, by pieces."""
    size, levels = len(goal.parameters), len(table.order) - len(goal.parameters)
    kinds: dict[bool, set[tuple[int, ...]]] = {True: set(), False: set()}
    for base in leaves(table, depth=size):
        kinds[levels == 1 or is_determined(base.cell, levels)].add(base.path)
    by_value, by_piece = (only(table, frozenset(kinds[kind])) for kind in (True, False))
    for case in cases_by_value(by_value, size, budget) or ():
        place = case.base.point.number(0) if case.base.depth else Fraction(0)
        for value, same in groupby(case.terms, key=lambda terms: terms[:1]):
            number = "".join(value).removeprefix(f"{quoted(goal.value)} = ") if value else None
            points = [_all_said(terms[1:], goal.variables) for terms in same if len(table.order) > size + 1]
            yield place, Stated(number, end is End.ATTAINED, points, (case.condition,) if case.condition else ())
    for place, piece in _with_points(merge(by_piece, budget=budget), size) if kinds[False] else ():
        yield place, piece.stated


def _all_said(terms: Terms, variables: Sequence[str]) -> Terms:
    """What is said of the variables, and that the others have any value."""
    rest = ", ".join(map(quoted, variables[len(terms) :]))
    return (*terms, f"any {rest}") if rest else terms


def _for_numbers(cases: list[Case], parameters: Sequence[str]) -> tuple[Case, ...]:
    """The cases without the bounds of numbers that are not algebraic, first among the parameters: they hold."""
    size = _numbers(parameters)
    if size and len({tuple(map(str, case.ranges[:size])) for case in cases}) == 1:
        cases = [replace(case, ranges=case.ranges[size:]) for case in cases]
    return tuple(cases)


def _numbers(parameters: Iterable[str]) -> int:
    """How many of the parameters are numbers that are not algebraic."""
    return len({*NUMBERS}.intersection(parameters))


def _place(piece: Piece) -> Number:
    """The first coordinate of a sample of a piece that is no such number."""
    depth, place = _numbers(piece.table.order), root_place(piece.table)
    for k in piece.path[: depth + 1]:
        place = child(piece.table, place, k)
    return place.point.number(depth) if len(piece.path) > depth else Fraction(0)


def _data(case: Case) -> dict[str, object]:
    places = case.minimisers
    return {
        "where": [str(r) for r in case.ranges],
        "value": None if case.value is None else str(case.value),
        "attained": case.attained,
        "minimisers": None if places is None else [[str(r) for r in place] for place in places],
    }
