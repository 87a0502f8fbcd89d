"""What one rule alone does with a question."""

from qe.api.input import read_formula
from qe.formula.syntax import Formula
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind


def steps_of(asked: str | Formula, kind: StepKind, *others: StepKind) -> list[Step]:
    """The steps of this rule, where no rule is enabled but it and the others."""
    log = RunLog()
    prepare(read_formula(asked) if isinstance(asked, str) else asked, enabled={kind, *others}, log=log)
    return [step for step in log.steps() if step.rule == kind.value]
