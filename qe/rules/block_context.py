"""What the rules of one quantifier block share: limits, switches, facts, and the record of the steps taken."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from qe.formula.syntax import FALSE, TRUE, Formula
from qe.options import Budget
from qe.rules.step import Step, StepKind
from qe.rules.tree import NEVER, Any, Node
from qe.simplify.facts import NOTHING, Facts

_SPLITS = 24  # case distinctions allowed within one block
_BASES = 40  # Groebner bases computed within one block


@dataclass(slots=True)
class BlockContext:
    """``splits``, ``bases``: case distinctions and Groebner bases still allowed; ``facts``: what holds outside."""

    budget: Budget
    enabled: frozenset[StepKind]
    facts: Facts = NOTHING
    splits: int = _SPLITS
    bases: int = _BASES
    steps: list[Step] = field(default_factory=list)

    def note(self, kind: StepKind, detail: str, cases: int = 1) -> None:
        """Record a step."""
        self.steps.append(Step(kind, detail, cases))

    def may_split(self, kind: StepKind, cases: int) -> bool:
        """Whether a case distinction is allowed; if so, it is charged."""
        if kind not in self.enabled or cases - 1 > self.splits:
            return False
        self.splits -= cases - 1
        return True


Recur = Callable[[Sequence[str], Formula, BlockContext], Node]
Rule = Callable[[tuple[str, ...], Formula, BlockContext, Recur], Node | None]


def either(nodes: Sequence[Node]) -> Node:
    """The disjunction of nodes: without the impossible ones; one that is certain stands alone."""
    possible = [n for n in nodes if n is not NEVER and n.formula != FALSE]
    for node in possible:
        if node.formula == TRUE:
            return node
    if not possible:
        return NEVER
    return possible[0] if len(possible) == 1 else Any(tuple(possible))
