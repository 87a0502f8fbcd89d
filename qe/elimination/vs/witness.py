"""Standard real values for parametric answers: infinitesimals and infinities become numbers."""

from __future__ import annotations

from fractions import Fraction

from qe.elimination.vs.plan import occurring
from qe.elimination.vs.result import Answer
from qe.elimination.vs.univariate_samples import Number, Values, solution
from qe.errors import InternalError
from qe.formula.traverse import ring_of
from qe.options import Budget


def witness(answer: Answer, parameters: Values | None = None, *, budget: Budget) -> dict[str, Number]:
    """Values for the variables of the block, at these values of the parameters; the answer's guard holds there.

    Variables that take no part get 0. THEOREM: the choices are made last to first; each is any solution of the
    formula in which its variable was eliminated, at the values chosen already. That formula has one, because its
    elimination was an equivalence; ``line.solution`` finds and checks it by exact evaluation.
    Raises ``Unable`` for formulas with root atoms, ``InternalError`` if there is no solution.
    """
    values: dict[str, Number] = dict(parameters or {})
    given = set(values)
    for choice in reversed(answer.choices):
        budget.check("witness")
        ring = ring_of(choice.before)
        if ring is None:
            values.setdefault(choice.variable, Fraction(0))
            continue
        for i in occurring(choice.before):
            if ring.names[i] != choice.variable:
                values.setdefault(ring.names[i], Fraction(0))
        found = solution(choice.before, choice.variable, values)
        if found is None:
            raise InternalError(f"no solution for {choice.variable}: its elimination was not an equivalence")
        values[choice.variable] = found
    return {name: value for name, value in values.items() if name not in given}
