"""What the rules of one quantifier block share: limits, switches, facts; and what a rule hands back."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from qe.formula.build import conj
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.run_log import RunLog
from qe.rules.step import StepKind
from qe.simplifier.facts import NOTHING, Facts

if TYPE_CHECKING:
    from qe.rules.tree import Node

_SPLITS = 24  # case distinctions allowed within one block


@dataclass(slots=True)
class BlockContext:
    """``splits``: case distinctions still allowed; ``facts``: what holds outside, as the formulas ``known`` say;
    ``path``: what the steps began with that led here.
    """

    budget: Budget
    enabled: frozenset[StepKind]
    facts: Facts = NOTHING
    known: tuple[Formula, ...] = ()
    splits: int = _SPLITS
    log: RunLog = field(default_factory=RunLog)
    path: list[Formula] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.facts = self.facts.watched(self.watch)

    def watch(self) -> None:
        """Raises ``BudgetExceeded`` at a limit."""
        self.budget.check("prepare")

    def may_split(self, kind: StepKind, cases: int) -> bool:
        """Whether a case distinction is allowed; if so, it is charged."""
        if kind not in self.enabled or cases - 1 > self.splits:
            return False
        self.splits -= cases - 1
        return True

    def given(self, formulas: Sequence[Formula]) -> BlockContext:
        """The same where these hold too."""
        return replace(self, facts=self.facts.extended(formulas), known=(*self.known, *formulas))

    def step(
        self, rule: str, before: Formula, after: Formula, detail: str = "", proof: Mapping[str, object] | None = None
    ) -> None:
        """Record a step under what is known."""
        evidence: dict[str, object] = {"detail": detail} if detail else {}
        if proof:
            evidence["proof"] = proof
        self.log.step(rule, before, after, context=conj(self.known), evidence=evidence)


@dataclass(frozen=True, slots=True)
class Found:
    """What a rule found: the tree, whose pending leaves are reduced next, and a word on what was done.

    ``proof``: what a checker needs beside the formulas.
    """

    kind: StepKind
    detail: str
    node: Node
    proof: Mapping[str, object] | None = None


Apply = Callable[[tuple[str, ...], Formula, BlockContext], Found | None]


@dataclass(frozen=True, slots=True)
class Rule:
    """``apply`` is tried where steps of one of the ``kinds`` are enabled: what it makes of ``ex variables. body``, or
    None."""

    kinds: frozenset[StepKind]
    apply: Apply


def rule(apply: Apply, *kinds: StepKind) -> Rule:
    """The rule that takes steps of these kinds."""
    return Rule(frozenset(kinds), apply)
