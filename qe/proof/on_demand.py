"""Evidence that a method can make, and makes only where somebody asks for proofs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from qe.errors import Unable
from qe.formula.syntax import Formula
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from qe.proof.step import Nested, Step

Evidence = Mapping[str, object]


@dataclass(frozen=True)
class OnDemand:
    """``make``: the evidence of a step within a budget. It may raise ``Unable``."""

    make: Callable[[Budget], Evidence]


@dataclass(frozen=True, slots=True)
class Repeated:
    """The evidence that ``work`` leaves with its first step where proofs are asked for, by doing it once more."""

    work: Callable[[Formula, Options, Budget, RunLog], object]
    formula: Formula
    options: Options

    def __call__(self, budget: Budget) -> Evidence:
        log = RunLog()
        self.work(self.formula, self.options.with_(certify=True), budget, log)
        proof = next((step.evidence.get("proof") for step in log.steps()), None)
        return proof if isinstance(proof, Mapping) else {}


def completed(step: Step, budget: Budget) -> Step:
    """The step with all evidence made that waits for somebody to ask; what cannot be made is empty."""

    def made(value: object) -> object:
        match value:
            case OnDemand(make):
                try:
                    return made(make(budget))
                except Unable:
                    budget.check("prove")
                    return {}
            case Step():
                return completed(value, budget)
            case Nested():
                return replace(value, steps=tuple(completed(inner, budget) for inner in value.steps))
            case RunLog():
                return RunLog([completed(e, budget) if isinstance(e, Step) else e for e in value.entries])
            case Mapping():
                return {name: made(part) for name, part in value.items()}
            case list() | tuple():
                return type(value)(map(made, value))
        return value

    return replace(step, evidence={name: made(part) for name, part in step.evidence.items()})
