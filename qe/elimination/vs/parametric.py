"""Parametric witnesses: solutions of an existential block as terms in the parameters, each under its guard.

Source: extended quantifier elimination by virtual substitution (Loos & Weispfenning 1993, section 4; Kosta 2016,
chapter 2: "extended answers").
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import islice

from qe.arguments import by_name, flag, seconds
from qe.decomposition.interval import Coordinate, number_of
from qe.elimination.vs.block import eliminate_block
from qe.elimination.vs.result import Answer
from qe.errors import DegreeTooHigh, InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.number import ExactPoint
from qe.exact.sample import Point
from qe.formula.build import disj
from qe.formula.evaluate import truth_under
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Constant, Exists, ForAll, Formula
from qe.options import Budget
from qe.processes.execution import perform
from qe.processes.limits import Limits
from qe.proof import answer as solution
from qe.proof.run_log import RunLog
from qe.simplifier.simplify import simplify
from qe.spelling import quoted

Number = Fraction | RealAlgebraic

MOST = 1000
"""So many guarded terms are looked at; a block with more gets ``Unable``."""


@dataclass(frozen=True, slots=True)
class ParametricWitness:
    """Wherever ``guard`` holds, ``terms`` solve the block (refute it, for a universal block).

    ``terms``: text by variable, in the order in which values are found: a term may mention the parameters and the
    variables before it. ``epsilon`` in it is a positive number, ``infinity`` a number, that is small or large enough;
    ``at`` finds one.
    """

    guard: Formula
    terms: Mapping[str, str]
    _answer: Answer = field(repr=False)
    _variables: tuple[str, ...] = field(repr=False)

    def at(
        self, parameters: Mapping[str, Coordinate], *, timeout: float | None = None, process: bool = True
    ) -> dict[str, Number]:
        """Exact values at these parameters; ``timeout`` and ``process`` as in ``qe.eliminate``.

        Raises ``InputError`` where the guard does not hold, ``BudgetExceeded`` at the limit.
        """
        given = {
            n: number_of(v, "parameters", f"an exact number for {n}")
            for n, v in by_name(parameters, "parameters").items()
        }
        missing = [name for name in self.guard.free if name not in given]
        if missing:
            raise InputError(f"parameters: a value for {missing[0]} expected")
        limits = Limits(seconds(timeout), process=flag(process, "process"))
        return perform(partial(self._at, given), limits, at_once=timeout is not None)

    def _at(self, given: dict[str, Number], budget: Budget) -> dict[str, Number]:
        budget.check("guard")
        if not _holds(self.guard, given):
            raise InputError("parameters: the guard does not hold there")
        values = self._answer.witness(given, budget=budget)
        return ExactPoint({name: values.get(name, Fraction(0)) for name in self._variables})

    def __str__(self) -> str:
        names = self.guard.ring.names if self.guard.ring else ()
        terms = ", ".join(f"{quoted(name, names)} = {term}" for name, term in self.terms.items())
        return f"{terms or 'anything'} if {self.guard}"


class ParametricWitnesses(tuple[ParametricWitness, ...]):
    """Guarded terms. ``answer``: that the block holds where one of the guards does (a universal one: where none does),
    with its derivation, and a certificate where one was asked for and found."""

    answer: solution.Answer

    def with_(self, answer: solution.Answer) -> ParametricWitnesses:
        """The same with this answer."""
        made = ParametricWitnesses(self)
        made.answer = answer
        return made

    def under(self, known: Formula) -> ParametricWitnesses:
        """The same where ``known`` holds: guards without what it says."""
        if known == TRUE:
            return self
        made = ParametricWitnesses(replace(one, guard=simplify(one.guard, known)) for one in self)
        return made.with_(self.answer)

    def equivalent_to(self, block: Formula) -> Formula:
        """What the guards say of the block."""
        return nnf(disj(answer.guard for answer in self), negate=isinstance(block, ForAll))


def parametric_witnesses(block: Formula, *, budget: Budget, log: RunLog | None = None) -> ParametricWitnesses:
    """Guarded terms for the variables of ``block`` = ``ex x, ... phi`` or ``all x, ... phi``, phi quantifier-free.

    The disjunction of the guards is equivalent to the existential block (to the negation of the universal one), which
    ``log`` gets as a step.
    Raises ``InputError`` for other formulas and ``DegreeTooHigh`` where substitution cannot eliminate it.
    """
    if isinstance(block, Constant):
        text = "true" if block.value else "false"
        raise InputError(f"the formula is {text} as it stands: no quantifier is left to find witnesses for")
    if not isinstance(block, Exists | ForAll) or not block.body.is_quantifier_free:
        raise InputError("a formula that begins with one quantifier, with a quantifier-free body, expected")
    tidy = partial(simplify, watch=budget.check)
    body = tidy(nnf(block.body, negate=isinstance(block, ForAll)))
    result = eliminate_block(block.variables, body, budget=budget, simplify=tidy)
    if result.remaining:
        names = ", ".join(result.remaining[0].variables)
        raise DegreeTooHigh(f"no parametric witness: substitution does not eliminate {names}, whose degree is too high")
    answers = list(islice(result.answers, MOST + 1))
    if len(answers) > MOST:
        raise Unable(f"more than {MOST} parametric witnesses")
    guarded = ((tidy(answer.guard), answer) for answer in answers)
    made = ParametricWitnesses(
        ParametricWitness(guard, _terms(answer), answer, block.variables) for guard, answer in guarded if guard != FALSE
    )
    if log is not None:
        log.step("elimination set", block, made.equivalent_to(block), evidence={"trace": result.trace})
    return made


def _terms(answer: Answer) -> dict[str, str]:
    return {
        c.variable: str(c.point) if c.exponent == 1 else f"root({c.exponent}, {c.point})"
        for c in reversed(answer.choices)
    }


def _holds(guard: Formula, values: Mapping[str, Number]) -> bool:
    ring = guard.ring
    if ring is None:
        return truth_under(guard, lambda poly: 0) is True
    numbers = [values.get(name, Fraction(0)) for name in ring.names]
    return truth_under(guard, Point.of(ring, numbers).sign) is True
