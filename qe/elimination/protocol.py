"""What the engine asks of an elimination method: a problem goes in, an outcome comes back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import Protocol

from qe.exact.number import Number, Values
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import convert
from qe.formula.syntax import TRUE, Formula
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, Root
from qe.proof.on_demand import Evidence, OnDemand
from qe.proof.run_log import RunLog
from qe.proof.step import Nested


def certified_by(make: Callable[[], Certificate]) -> dict[str, object]:
    """The evidence of a step of which this makes the certificate, where somebody wants it."""
    return {"proof": OnDemand(partial(_made, make))}


def _made(make: Callable[[], Certificate], budget: Budget) -> Evidence:
    return {"certificate": make()}


def witness_of(block: Block, values: Values) -> Certificate:
    """That the body of the existential dual, quantifier-free, holds at these values of the variables."""
    ring, names = Ring.of(block.variables), block.variables
    return Certificate.witness(convert(block.positive, ring), names, [Root.of(values[name]) for name in names])


@dataclass(frozen=True, slots=True)
class Outcome:
    """``formula`` is equivalent to the problem over R; it may keep quantifiers that a method could not remove.

    ``witness``: exact values for the block's variables that make a true existential sentence true, or a false universal
    one false; None when not known. ``certificate``: of this very problem and formula, where the method makes one;
    ``make``: what makes it where it is read, of a ``large`` one only where it is asked for.
    ``order``: that of the free variables in which the formula was read off, where that matters to who goes on.
    ``back``: where a method reduces the problem to another question, which is ``formula`` then: the outcome for the
    problem from the one for that question. ``shortest``: no part of the formula can be left out.
    ``unchecked``: the rules of the steps that no checker has accepted, where that was asked for. ``checked``: whether
    the checkers have accepted the certificate; ``reason``: why there is none. ``log``: how the whole answer was found;
    the engine fills these in.
    """

    formula: Formula
    witness: Values | None = None
    certificate: Certificate | None = None
    order: tuple[str, ...] | None = None
    unchecked: tuple[str, ...] = ()
    checked: bool = False
    reason: str = ""
    log: RunLog = field(default_factory=RunLog)
    back: Callable[[Outcome], Outcome] | None = None
    shortest: bool = False
    make: Callable[[], Certificate] | None = None
    large: bool = False

    def nested(self, question: Formula) -> Nested:
        """How the answer to the question was derived, as evidence of a step to another."""
        return Nested(question, tuple(self.log.steps()), self.formula)

    @property
    def stats(self) -> Mapping[str, object]:
        """What was done, counted from the log."""
        return self.log.stats()


@dataclass(frozen=True, slots=True)
class Known:
    """An outcome, the question that it is for, and where it is right; FALSE where nothing can hold.

    ``generic``: the inequations in ``assuming`` that the caller did not assume; ``plainly``: by the way without any.
    """

    question: Formula
    outcome: Outcome
    assuming: Formula = TRUE
    generic: tuple[Formula, ...] = ()
    plainly: bool = False


@dataclass(frozen=True, slots=True)
class Context:
    """What every method is given with its problem. ``decide``: the outcome for another question, by any methods that
    the options allow; raises ``Unable``."""

    options: Options
    budget: Budget
    log: RunLog
    decide: Callable[[Formula, Options, Budget], Outcome] | None = None


class Method(Protocol):
    """A complete or partial procedure for one block.

    ``suits`` is pure and cheap: why the method can take the problem, or None. ``run`` may raise ``Unable``; it returns
    None where a closer look shows that the problem is not of its kind. Methods never call each other: what one
    leaves open stands in its outcome as quantified subformulas, and the engine goes on with them.
    """

    name: str

    def suits(self, problem: Block, options: Options) -> str | None: ...

    def run(self, problem: Block, context: Context) -> Outcome | None: ...


def shown(problem: Block, known: Mapping[str, Number], context: Context, rule: str) -> Outcome:
    """What a point says at which the body of the existential dual holds."""
    values = {name: known.get(name, Fraction(0)) for name in problem.variables}
    evidence = certified_by(partial(witness_of, problem.dual, values))
    return Outcome(context.log.step(rule, problem.formula, problem.asked(TRUE), evidence=evidence), values)
