"""Existential sentences about convex sets: decided by convex optimisation, however many variables there are."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from qe.convex.linear_point import LinearContradiction, linear_point
from qe.convex.optimum import Decision, decide
from qe.convex.system import NotConvex
from qe.elimination.protocol import Context, Outcome, certified_by, shown
from qe.exact.number import Number
from qe.formula.block import Block
from qe.formula.syntax import FALSE, Exists, Formula
from qe.options import Budget, Options
from qe.proof.certificate import Certificate


class ConvexOptimisation:
    """Sentences about convex sets, however many variables there are."""

    name = "convex"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Sentences of one block."""
        return f"{len(problem.variables)} variables, a convex set" if problem.is_flat and not problem.free else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """A decision with its certificate; None where the set is not a convex one that can be read."""
        dual = problem.dual
        known: LinearContradiction | Mapping[str, Number] | None = linear_point(dual.body, budget=context.budget)
        if isinstance(known, LinearContradiction):
            answer = problem.asked(FALSE)
            make = partial(_by_farkas, problem, answer, known)
            context.log.step("convex", problem.formula, answer, evidence=certified_by(make))
            return Outcome(answer, make=make)
        if known is None:
            found = decide_convex(Exists(dual.variables, dual.body), budget=context.budget)
            if found is None:
                return None
            known = found.values
            if known is None:
                answer, refuted = problem.asked(FALSE), {"proof": {"certificate": found.certificate}}
                context.log.step("convex", problem.formula, answer, evidence=refuted)
                return Outcome(answer, certificate=found.certificate)
        return shown(problem, known, context, "convex")


def _by_farkas(problem: Block, answer: Formula, point: LinearContradiction) -> Certificate:
    return Certificate.step("signs", problem.variables, problem.formula, answer, point.evidence())


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
