"""``Solver``: assertions that come and go, with the names of z3py. Each check is an elimination."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeVar, Unpack, cast

from qe import arguments
from qe.api.eliminate import eliminate
from qe.api.input import AnyFormula, read_assumptions
from qe.api.limits import limits_of, posed
from qe.api.settings import Limited, ProvedQuestion, with_settings
from qe.errors import InputError
from qe.exact.number import Assignment, ExactPoint
from qe.formula.build import conj, exists
from qe.formula.syntax import Formula
from qe.io import formats
from qe.io.substitution import over_one_ring
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


class Solver:
    """Formulas that are to hold together, of any kind that ``qe.decide`` takes; free variables are unknowns.

    Settings are those of ``qe.find``, for every check; with ``check`` the last ``answer`` has a certificate. After
    ``check()`` that was ``"sat"`` there is a ``model()``, after ``"unsat"`` a ``core()``.
    """

    @with_settings(ProvedQuestion)
    def __init__(self, **settings: Unpack[ProvedQuestion]) -> None:
        self._known = read_assumptions(settings["assuming"])
        formats.checked(settings["format"])
        self._settings: dict[str, Any] = {**settings, "assuming": None}
        self._asserted: list[_Asserted] = []
        self._levels: list[int] = []
        self._assumed: list[_Asserted] = []
        self.answer: Answer | None = None

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
        self._levels.append(len(self._asserted))

    def pop(self, num: int = 1) -> None:
        """Forget what was asserted on the last ``num`` levels. Raises ``InputError`` where there are fewer."""
        for _ in range(arguments.whole(num, "num", len(self._levels))):
            del self._asserted[self._levels.pop() :]
        self.answer = None

    def reset(self) -> None:
        """Forget everything but the settings."""
        self._asserted, self._levels, self._assumed, self.answer = [], [], [], None

    def num_scopes(self) -> int:
        """How many levels there are."""
        return len(self._levels)

    def assertions(self) -> list[Formula]:
        """What is asserted."""
        return [one.formula for one in self._asserted]

    def check(self, *assumptions: AnyFormula) -> str:
        """``"sat"``, ``"unsat"`` or, at a limit, ``"unknown"``: can all assertions and these formulas hold together?"""
        self._assumed = [_Asserted(self._read(formula)) for formula in assumptions]
        self.answer = self._answer([*self._asserted, *self._assumed])
        return {True: "sat", False: "unsat", None: "unknown"}[self.answer.truth]

    def reason_unknown(self) -> str:
        """Why the last check was ``"unknown"``."""
        return "" if self.answer is None or self.answer.truth is not None else self.answer.reason

    def model(self) -> Assignment:
        """Exact values of the unknowns from the last check. Raises ``InputError`` where that was not ``"sat"``."""
        if self.answer is None or self.answer.truth is not True:
            raise InputError("model: a check that was sat expected before")
        names = dict.fromkeys(name for one in (*self._asserted, *self._assumed) for name in one.formula.free)
        return ExactPoint({name: (self.answer.witness or {}).get(name, Fraction(0)) for name in names})

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

    def _answer(self, parts: Iterable[_Asserted]) -> Answer:
        whole = conj(over_one_ring(self._known, *(one.formula for one in parts)))
        return eliminate(exists(whole.free, whole), **self._settings)

    def __repr__(self) -> str:
        return f"Solver({', '.join(one.formula.brief() for one in self._asserted)})"
