"""``Solver``: assertions that come and go, with the names of z3py. Each check is an elimination."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, TypeVar, Unpack, cast

from qe import arguments
from qe.api.eliminate import eliminate
from qe.api.input import AnyFormula, read_assumptions
from qe.api.limits import limits_of, posed
from qe.api.optimum import maximize, minimize
from qe.api.settings import Limited, Proved, ProvedQuestion, settings_in, with_settings
from qe.convex.optimum import Optimum
from qe.errors import InputError, Unable
from qe.exact.number import Assignment, ExactPoint
from qe.formula.build import conj, exists
from qe.formula.syntax import Formula
from qe.io import formats
from qe.io.expressions import graph_of, substituted
from qe.io.names import refuse_numbers
from qe.io.substitution import over_one_ring
from qe.optimization.global_optimum import GlobalOptimum
from qe.optimization.values import new_name
from qe.proof.answer import Answer

Part = TypeVar("Part")


def needed(parts: Sequence[Part], refuted: Callable[[Sequence[Part]], bool]) -> list[Part]:
    """Of parts that are refuted together those that still are, none of which can be omitted."""
    kept = list(parts)
    for part in parts:
        rest = [other for other in kept if other is not part]
        if refuted(rest):
            kept = rest
    return kept


@dataclass(frozen=True, slots=True)
class _Asserted:
    formula: Formula
    name: str | None = None


@dataclass(slots=True)
class Objective:
    """A term that a solver makes as small or as great as it can; ``optimum``: what the last check found."""

    term: AnyFormula
    least: bool
    optimum: Optimum | GlobalOptimum | None = field(default=None, repr=False)

    def value(self) -> Any:
        """The least or greatest value, which need not be taken; an infinite float where there is no bound."""
        if self.optimum is None:
            raise InputError("value: a check that was sat, and whose objectives before this one have optima, expected")
        return self.optimum.value if self.optimum.value is not None else float("-inf" if self.least else "inf")


def optimised(
    objectives: Iterable[Objective], whole: Formula, settings: Any, *, box: bool = False
) -> Mapping[str, Any]:
    """Optimise in order, each where those before it are optimal, up to the first value that is not taken, or (``box``)
    each by itself; the last point that was found, if any. Raises ``Unable``."""
    point: Mapping[str, Any] = {}
    for objective in objectives:
        solve = minimize if objective.least else maximize
        best = objective.optimum = solve(objective.term, whole, **settings)
        if box:
            continue
        if not best.attained or best.value is None:
            return point
        point, value = best.point, new_name(whole.free, best.point)
        same = substituted(graph_of(value, objective.term), {value: best.value})
        whole = conj(over_one_ring(whole, same))
    return point


class Solver:
    """Formulas that are to hold together, of any kind that ``qe.decide`` takes; free variables are unknowns.

    Settings are those of ``qe.find``, for every check; with ``check`` the last ``answer`` has a certificate. After
    ``check()`` that was ``"sat"`` there is a ``model()``, after ``"unsat"`` a ``core()``. Objectives are optimised in
    their order, each where those before it are optimal; the model is such a point where the values are taken.
    """

    answer: Answer | None

    @with_settings(ProvedQuestion)
    def __init__(self, **settings: Unpack[ProvedQuestion]) -> None:
        self._known = read_assumptions(settings["assuming"])
        formats.checked(settings["format"])
        self._settings: dict[str, Any] = {**settings, "assuming": None}
        self.reset()

    def add(self, *formulas: AnyFormula) -> None:
        """Assert formulas. Raises ``InputError`` for what cannot be read."""
        self._asserted += [_Asserted(self._read(formula)) for formula in formulas]
        self.answer = None

    def assert_and_track(self, formula: AnyFormula, name: str) -> None:
        """Assert a formula that ``core`` calls by a name."""
        self._asserted.append(_Asserted(self._read(formula), arguments.text(name, "name")))
        self.answer = None

    def push(self) -> None:
        """Begin a level, which ``pop`` ends."""
        self._levels.append((len(self._asserted), len(self._objectives)))

    def pop(self, num: int = 1) -> None:
        """Forget what was asserted on the last ``num`` levels. Raises ``InputError`` where there are fewer."""
        for _ in range(arguments.whole(num, "num", len(self._levels))):
            asserted, objectives = self._levels.pop()
            del self._asserted[asserted:], self._objectives[objectives:]
        self.answer = None

    def reset(self) -> None:
        """Forget everything but the settings."""
        self._asserted: list[_Asserted] = []
        self._assumed: list[_Asserted] = []
        self._objectives: list[Objective] = []
        self._levels: list[tuple[int, int]] = []
        self._best: Mapping[str, Any] = {}
        self.answer = None
        self._reason = ""

    def num_scopes(self) -> int:
        """How many levels there are."""
        return len(self._levels)

    def assertions(self) -> list[Formula]:
        """What is asserted."""
        return [one.formula for one in self._asserted]

    def minimize(self, term: AnyFormula) -> Objective:
        """Ask for the least value of a term, as ``qe.minimize`` takes it."""
        return self._wanted(term, True)

    def maximize(self, term: AnyFormula) -> Objective:
        """Ask for the greatest value of a term."""
        return self._wanted(term, False)

    def _wanted(self, term: AnyFormula, least: bool) -> Objective:
        refuse_numbers(graph_of("value", term).free)  # what is no term is refused here, too
        self.answer = None
        self._objectives.append(Objective(term, least))
        return self._objectives[-1]

    def objectives(self) -> list[Objective]:
        """What is optimised."""
        return [*self._objectives]

    def lower(self, objective: Objective) -> Any:
        """The value of an objective, which is known exactly: ``upper`` is the same."""
        if not isinstance(objective, Objective):
            raise arguments.wrong("objective", "what minimize or maximize gave", objective)
        return objective.value()

    upper = lower

    def check(self, *assumptions: AnyFormula) -> str:
        """``"sat"``, ``"unsat"`` or, at a limit, ``"unknown"``: can all assertions and these formulas hold together?"""
        self._assumed = [_Asserted(self._read(formula)) for formula in assumptions]
        self.answer = self._answer([*self._asserted, *self._assumed])
        self._reason, self._best = self.answer.reason, {}
        for objective in self._objectives:
            objective.optimum = None
        if self.answer.truth and self._objectives:
            try:
                settings: Any = {name: self._settings[name] for name in settings_in(Proved)}
                self._best = optimised(self._objectives, self._whole([*self._asserted, *self._assumed]), settings)
            except Unable as error:
                self.answer, self._reason = None, str(error)
                return "unknown"
        return {True: "sat", False: "unsat", None: "unknown"}[self.answer.truth]

    def reason_unknown(self) -> str:
        """Why the last check was ``"unknown"``."""
        return "" if self.answer is not None and self.answer.truth is not None else self._reason

    def model(self) -> Assignment:
        """Exact values of the unknowns from the last check. Raises ``InputError`` where that was not ``"sat"``."""
        if self.answer is None or self.answer.truth is not True:
            raise InputError("model: a check that was sat expected before")
        names = dict.fromkeys(name for one in (*self._asserted, *self._assumed) for name in one.formula.free)
        point = {**(self.answer.witness or {}), **self._best}
        return ExactPoint({name: point.get(name, Fraction(0)) for name in names})

    def core(self) -> list[Any]:
        """Assertions and assumptions of the last check that contradict each other, by their names where they have some;
        none of them can be omitted. Raises ``InputError`` where that was not ``"unsat"``."""
        if self.answer is None or self.answer.truth is not False:
            raise InputError("core: a check that was unsat expected before")
        kept = needed([*self._asserted, *self._assumed], lambda some: self._answer(some).truth is False)
        return [one.name or one.formula for one in kept]

    unsat_core = core

    def _read(self, formula: AnyFormula) -> Formula:
        return posed(formula, self._settings, limits_of(cast(Limited, self._settings))).restricted

    def _whole(self, parts: Iterable[_Asserted]) -> Formula:
        return conj(over_one_ring(self._known, *(one.formula for one in parts)))

    def _answer(self, parts: Iterable[_Asserted]) -> Answer:
        whole = self._whole(parts)
        return eliminate(exists(whole.free, whole), **self._settings)

    def __repr__(self) -> str:
        return f"Solver({', '.join(one.formula.brief() for one in self._asserted)})"
