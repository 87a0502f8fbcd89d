"""What the engine asks of an elimination method: a problem goes in, an outcome comes back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Protocol

from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.build import convert, exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import Exists, ForAll, Formula
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, Root
from qe.proof.run_log import RunLog


@dataclass(frozen=True, slots=True)
class Problem:
    """One block of quantifiers of one kind: ``ex variables. body``, or ``all variables. body`` if ``universal``.

    The body may hold further quantifiers. A method that knows existential blocks only works on the dual problem,
    ``ex variables. positive``, and turns its formula back by ``asked``.
    """

    variables: tuple[str, ...]
    body: Formula
    universal: bool = False

    @staticmethod
    def of(formula: Formula) -> Problem | None:
        """The outermost block of a formula; None where it does not begin with a quantifier."""
        if isinstance(formula, Exists | ForAll):
            return Problem(formula.variables, formula.body, isinstance(formula, ForAll))
        return None

    @property
    def formula(self) -> Formula:
        """The problem as one formula."""
        return (forall if self.universal else exists)(self.variables, self.body)

    @property
    def free(self) -> tuple[str, ...]:
        """The parameters."""
        return self.formula.free

    @property
    def is_flat(self) -> bool:
        """Whether nothing inside is quantified."""
        return self.body.is_quantifier_free

    @property
    def positive(self) -> Formula:
        """The body of the existential problem that is this one, or its negation if ``universal``."""
        return nnf(self.body, negate=self.universal)

    @property
    def dual(self) -> Problem:
        """The existential problem that is this one, or its negation if ``universal``, in negation normal form."""
        positive = self.positive
        return Problem(self.variables, positive) if self.universal or positive != self.body else self

    def witnessed(self, values: Values) -> Certificate:
        """That the body of the existential dual, quantifier-free, holds at these values of the variables."""
        ring = Ring.of(self.variables)
        return Certificate.witness(
            convert(self.positive, ring), self.variables, [Root.of(values[name]) for name in self.variables]
        )

    def asked(self, formula: Formula) -> Formula:
        """The answer to this problem, from one to its dual."""
        return nnf(formula, negate=self.universal)


@dataclass(frozen=True, slots=True)
class Outcome:
    """``formula`` is equivalent to the problem over R; it may keep quantifiers that a method could not remove.

    ``witness``: exact values for the block's variables that make a true existential sentence true, or a false universal
    one false; None when not known. ``certificate``: of this very problem and formula, where the method makes one.
    ``order``: that of the free variables in which the formula was found, where that matters to who goes on.
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

    @property
    def stats(self) -> Mapping[str, object]:
        """What was done, counted from the log."""
        return self.log.stats()


@dataclass(frozen=True, slots=True)
class Context:
    """What every method is given beside its problem. ``decide``: the outcome for a sentence of its own, by any method,
    within a budget; raises ``Unable``."""

    options: Options
    budget: Budget
    log: RunLog
    decide: Callable[[Formula, Budget], Outcome] | None = None


class Method(Protocol):
    """A complete or partial procedure for one block.

    ``suits`` is pure and cheap: why the method can take the problem, or None. ``run`` may raise ``Unable``; it returns
    None where a closer look shows that the problem is not of its kind. Methods never call each other: what one
    leaves open stands in its outcome as quantified subformulas, and the engine goes on with them.
    """

    name: str

    def suits(self, problem: Problem, options: Options) -> str | None: ...

    def run(self, problem: Problem, context: Context) -> Outcome | None: ...
