"""The values that an objective takes on a set, as a formula in one new variable (and in the parameters).

Theorem: inf f(S) = inf { v : ex x. x in S and v = f(x) }, and it is attained exactly where that set contains its
infimum. Elimination of x gives the set as a formula; over the reals it is a finite union of intervals (Tarski), for
every choice of parameters.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain
from typing import TypeVar

from qe.elimination.protocol import Outcome
from qe.engine.run import answer_to, answered, proved
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, exists
from qe.formula.syntax import Formula, Relation
from qe.options import VERIFY_SECONDS, Budget, Options
from qe.proof.answer import UNPROVED, Answer
from qe.proof.certificate import Certificate

VALUE = "value"

Kind = TypeVar("Kind")
Members = list[tuple[str, Certificate]]
"""Certificates with their labels."""


@dataclass(frozen=True, slots=True)
class Objective:
    """A term that has a value: ``graph`` holds where the variable ``value`` is that value, over a ring with it.

    Where the term has no value (as 1/x at 0) no value fits. ``polynomial``: p and s where the term is s*p.
    """

    graph: Formula
    value: str
    names: tuple[str, ...]
    polynomial: tuple[Poly, Fraction] | None = None

    @staticmethod
    def of(poly: Poly, scale: Fraction | int, value: str) -> Objective:
        """The polynomial ``scale * poly``; ``value`` names none of its variables."""
        scale, names = Fraction(scale), tuple(poly.ring.names[i] for i in poly.variables)
        ring = Ring.of((value, *poly.ring.names))
        equation = ring.var(value) * scale.denominator - poly.convert(ring) * scale.numerator
        return Objective(atom(equation, Relation.EQ), value, names, (poly, scale))


def new_name(*taken: Iterable[str]) -> str:
    """A name for the value of an objective that is none of these."""
    names, value = set(chain(*taken)), VALUE
    while value in names:
        value += "_"
    return value


@dataclass(frozen=True, slots=True)
class Goal:
    """The ``graph`` of an objective and the set that ``conditions`` describe, both over ``ring``.

    ``variables`` are optimised over, ``parameters`` are not; ``value`` names none of them. ``polynomial``: p over the
    ring and s where the objective is s*p.
    """

    ring: Ring
    graph: Formula
    conditions: Formula
    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    value: str
    polynomial: tuple[Poly, Fraction] | None

    @staticmethod
    def of(objective: Objective, conditions: Formula, parameters: Iterable[str] = ()) -> Goal:
        """The goal with all names in one ring; parameters may be others."""
        given, parts = tuple(parameters), (objective.graph, conditions)
        rings = [ring.names for part in parts if (ring := part.ring) is not None]
        if objective.polynomial is not None:
            rings.insert(0, objective.polynomial[0].ring.names)
        names = [name for name in dict.fromkeys(chain(*rings)) if name != objective.value]
        ring = Ring.of((*given, objective.value, *(name for name in names if name not in given)))
        used = {*conditions.free, *objective.names}
        variables = tuple(name for name in names if name in used and name not in given)
        polynomial = None
        if objective.polynomial is not None:
            polynomial = objective.polynomial[0].convert(ring), objective.polynomial[1]
        graph, conditions = (convert(part, ring) for part in parts)
        return Goal(ring, graph, conditions, variables, given, objective.value, polynomial)

    @property
    def taken(self) -> Formula:
        """That the value is taken somewhere."""
        return exists(self.variables, conj((self.conditions, self.graph)))


def first_answer(question: Formula, budget: Budget, *, check: bool) -> tuple[Outcome, Answer]:
    """The answer to a question on the way to an optimum; nothing is proved yet."""
    outcome = answered(question, Options(certify=check), budget)
    return outcome, replace(answer_to(question, outcome), certificate=None, reason=UNPROVED if check else "")


def with_proof(
    optimum: Kind, question: Formula, outcome: Outcome, label: str, members: Members, budget: Budget, *, check: bool
) -> Kind:
    """An optimum (a dataclass) with the proved answer to its question, and what else proves it; always limited."""
    if check:
        budget.keep(replace(optimum, reason=UNPROVED))  # type: ignore[type-var]
    budget = budget if budget.deadline else Budget(VERIFY_SECONDS / 2, listener=budget.listener, parent=budget)
    answer = answer_to(question, proved(question, outcome, Options(certify=check), budget))
    proof = None if answer.certificate is None else Certificate.bundle([(label, answer.certificate), *members])
    return replace(optimum, answer=answer, certificate=proof)  # type: ignore[type-var]
