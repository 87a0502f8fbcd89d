"""Existential sentences about convex sets: decided by convex optimisation, however many variables there are."""

from __future__ import annotations

from fractions import Fraction

from qe.convex.optimum import Decision, decide
from qe.convex.system import NotConvex
from qe.elimination.protocol import Context, Outcome, Problem
from qe.formula.syntax import FALSE, TRUE, Exists
from qe.options import Budget, Options


class ConvexOptimisation:
    """Sentences about convex sets, however many variables there are."""

    name = "convex"

    def suits(self, problem: Problem, options: Options) -> str | None:
        """Sentences of one block."""
        return f"{len(problem.variables)} variables, a convex set" if problem.is_flat and not problem.free else None

    def run(self, problem: Problem, context: Context) -> Outcome | None:
        """A decision with its certificate; None where the set is not a convex one that can be read."""
        dual = problem.dual
        sentence = Exists(dual.variables, dual.body)
        found = decide_convex(sentence, budget=context.budget)
        if found is None:
            return None
        truth = FALSE if found.values is None else TRUE
        known = found.values
        values = None if known is None else {name: known.get(name, Fraction(0)) for name in dual.variables}
        proof = found.certificate if values is None else dual.witnessed(values)
        context.log.step("convex", problem.formula, problem.asked(truth), evidence={"proof": {"certificate": proof}})
        if values is None:
            return Outcome(problem.asked(truth), certificate=found.certificate)
        return Outcome(problem.asked(truth), values)


def decide_convex(sentence: Exists, *, budget: Budget) -> Decision | None:
    """Whether convex quadratic inequalities and linear equations have a common solution; None for other sentences.

    Raises ``Unable`` when neither a solution nor a contradiction was proved.
    """
    if sentence.body.ring is None:
        return None
    try:
        return decide(sentence.body, budget=budget)
    except NotConvex:
        return None
