"""Is a quantifier-free formula true, or false, everywhere? Most are neither, and a few points show that."""

from __future__ import annotations

from collections.abc import Callable

from qe.elimination.protocol import Context
from qe.elimination.samples import Trials
from qe.engine.redundant import COARSE, FINE, FIRST, Points, Start
from qe.exact.watch import IDLE
from qe.formula.build import exists
from qe.formula.features import length
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import atoms, bound_variables
from qe.options import Budget, Stage
from qe.proof.step import Nested

DEGREES = {1: 40, 2: 8, 3: 3, 4: 2}
"""With so many variables a formula of at most this total degree is decided; with more, linear ones are."""

MANY = 20
"""The closure of a question in more variables is not asked for: a chain of 300 differences took minutes."""

SETTLE_WORK = 2000
"""Units of work for the question whether an answer is constant."""

LEFT_OUT = frozenset({Stage.BRANCHING, Stage.SAMPLES, Stage.SQUARES})
"""What this question is not worth: points have been tried, and these took more than all the rest of some questions."""

ATOMS, LONG = 40, 1000
"""A formula of more atoms is not decided; one of more than ``LONG`` is not even evaluated."""


def constant(formula: Formula, context: Context, start: Start | None) -> Formula:
    """TRUE or FALSE where the answer turns out to be that, if this is cheap to find out.

    Where the question itself has no solution, the steps to the answer are left out.
    """
    if start is None or (decide := context.decide) is None:
        return formula
    budget, decisions, question = context.budget.part(SETTLE_WORK), list[Nested](), start.question
    options = context.options.with_(without=context.options.without | LEFT_OUT)

    def satisfiable(sentence: Formula) -> bool:
        decisions.append(decide(sentence, options, budget).nested(sentence))
        return decisions[-1].answer == TRUE

    value = constant_value(formula, satisfiable, question, context.budget.check)
    if value is None:
        return formula
    context.log.choice("", (), f"the answer was decided to be {value}")
    (decision,), before = decisions, formula
    if decision.start == exists(question.free, question):
        context.log.forget_steps(start.mark)
        before = question
    return context.log.step("constant", before, value, evidence={"proof": {"exceptions": [decision]}})


def constant_value(
    formula: Formula,
    is_satisfiable: Callable[[Formula], bool],
    question: Formula | None = None,
    watch: Callable[[], object] = IDLE,
) -> Formula | None:
    """TRUE or FALSE if the quantifier-free formula is equivalent to that and deciding it is cheap, else None.

    ``is_satisfiable`` decides a sentence; it is asked only where no point settles it. Where the formula seems to
    hold nowhere and is larger than the ``question`` that it answers, it is asked about that: with all variables
    quantified the question leaves a freedom of order that the answer has lost (the existential closure).
    """
    names = formula.free
    if not names or formula.ring is None:
        return None
    listed = list(atoms(formula))
    cheap = len(listed) <= ATOMS and max(a.poly.total_degree for a in listed) <= DEGREES.get(len(names), 1)
    if not cheap and (question is None or not _closes(question) or len(listed) > LONG):
        return None
    points, fails = Points(names, watch), nnf(formula, negate=True)
    points.fill(FIRST)
    always = bool(points.holding(nnf(formula)))
    if always and (not cheap or points.holding(fails)):
        return None
    exception = fails if always else nnf(formula)
    if cheap and (trials := Trials.of(exception)) and trials.near([0] * formula.ring.size, Budget()) is not None:
        return None
    if points.fill(COARSE + FINE) and points.holding(exception):
        return None
    if question is not None and not always and (not cheap or length(question)[1] < length(formula)[1]):
        exception = question
    if is_satisfiable(exists(exception.free, exception)):
        return None
    return TRUE if always else FALSE


def _closes(question: Formula) -> bool:
    """Whether quantifying all its variables may make a question easier: it has quantifiers, and few variables."""
    if question.is_quantifier_free:
        return False
    return len(question.free) + len(bound_variables(question)) <= MANY
