"""The values that an objective takes on a set, as a formula in one new variable (and in the parameters).

Theorem: inf f(S) = inf { v : ex x. x in S and v = f(x) }, and it is attained exactly where that set contains its
infimum. Elimination of x gives the set as a formula; over the reals it is a finite union of intervals (Tarski), for
every choice of parameters.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from qe.engine.run import answer_to, solve
from qe.errors import InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, exists
from qe.formula.syntax import FALSE, Formula, Relation
from qe.formula.traverse import ring_of
from qe.options import Budget, Options
from qe.proof.answer import Answer

VALUE = "value"


@dataclass(frozen=True, slots=True)
class Goal:
    """The objective ``scale * objective`` on the set that ``conditions`` describe, over the ring of both and ``value``.

    ``variables`` are optimised over, ``parameters`` are not; ``value`` names none of them.
    """

    objective: Poly
    scale: Fraction
    conditions: Formula
    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    value: str

    @staticmethod
    def of(objective: Poly, scale: Fraction, conditions: Formula, parameters: Iterable[str] = ()) -> Goal:
        """The goal with all names in one ring. Raises ``InputError`` for a parameter that is unknown or named twice."""
        known = ring_of(conditions)
        names = dict.fromkeys((*objective.ring.names, *(known.names if known is not None else ())))
        given, value = tuple(parameters), VALUE
        while value in names or value in given:
            value += "_"
        strangers = [name for name in given if name not in names and conditions is not FALSE]
        if strangers or len(set(given)) < len(given):
            raise InputError(f"parameters: variables of the problem expected, each once, {', '.join(given)} found")
        ring = Ring.of((*given, value, *(name for name in names if name not in given)))
        used = {*conditions.free, *(objective.ring.names[i] for i in objective.variables)}
        variables = tuple(name for name in names if name in used and name not in given)
        return Goal(objective.convert(ring), scale, convert(conditions, ring), variables, given, value)

    @property
    def equation(self) -> Poly:
        """Zero where the value is that of the objective."""
        ring = self.objective.ring
        return ring.var(self.value) * self.scale.denominator - self.objective * self.scale.numerator

    @property
    def taken(self) -> Formula:
        """That the value is taken somewhere."""
        return exists(self.variables, conj((self.conditions, atom(self.equation, Relation.EQ))))

    def values(self, budget: Budget, *, check: bool) -> tuple[Formula, Answer]:
        """The values that are taken, as a formula in ``value`` and the parameters, and how that was found."""
        found = solve(self.taken, Options(certify=check, progress=budget.listener), budget)
        return found.formula, answer_to(self.taken, found)
