"""Standard real values for parametric answers: infinitesimals and infinities become numbers."""

from __future__ import annotations

from fractions import Fraction

from qe.elimination.vs.result import Answer
from qe.elimination.vs.univariate_samples import Number, Values
from qe.options import Budget


def witness(answer: Answer, parameters: Values | None = None, *, budget: Budget) -> dict[str, Number]:
    """Values for the variables of the block, at these values of the parameters; the answer's guard holds there.

    Variables that take no part get 0. THEOREM: the choices are made last to first; each is any solution of the
    formula in which its variable was eliminated, at the values chosen already. That formula has one, because its
    elimination was an equivalence; ``univariate_samples.solution`` finds and checks it by exact evaluation.
    Raises ``Unable`` for formulas with root atoms, ``InternalError`` if there is no solution.
    """
    values: dict[str, Number] = dict(parameters or {})
    given = set(values)
    for choice in reversed(answer.choices):
        budget.check("witness")
        for name in choice.before.free:
            values.setdefault(name, Fraction(0))
        values[choice.variable] = choice.value(values)
    return {name: value for name, value in values.items() if name not in given}
