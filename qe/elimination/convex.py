"""Existential sentences about convex sets: decided by convex optimisation, however many variables there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from qe.convex.optimum import Optimum, minimize
from qe.convex.read import NotConvex
from qe.elimination.protocol import Context, Outcome, Problem
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement
from qe.formula.syntax import FALSE, TRUE, Exists
from qe.formula.traverse import ring_of
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.multipliers import OptimumStatus


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


@dataclass(frozen=True, slots=True)
class ConvexDecision:
    """``values``: a point of the set; None when it is empty, which ``certificate`` then proves."""

    values: Mapping[str, Fraction | RealAlgebraic] | None
    certificate: Certificate


def decide_convex(sentence: Exists, *, budget: Budget) -> ConvexDecision | None:
    """Whether convex quadratic inequalities and linear equations have a common solution; None for other sentences.

    The minimum of the constant 0 over the set: an optimal point is a solution (one of the closure only may have been
    found; the point that proves the strict conditions possible is one then), and there is none iff nonnegative
    multipliers combine the constraints to a contradiction (up to facial reduction; see ``qe.convex.minimise``).
    Raises ``Unable`` when neither was proved.
    """
    ring = ring_of(sentence.body)
    if ring is None:
        return None
    try:
        found = minimize(ring.constant(0), sentence.body, budget=budget)
    except NotConvex:
        return None
    if found.status is OptimumStatus.INFEASIBLE:
        return ConvexDecision(None, found.certificate)
    if found.status is OptimumStatus.UNBOUNDED:
        raise Unable("a constant objective was found unbounded")
    return ConvexDecision(_solution(found), found.certificate)


def _solution(found: Optimum) -> dict[str, Fraction | RealAlgebraic]:
    values = found.point.values() if found.attained else found.evidence.inner_point
    return {
        name: value.to_algebraic() if isinstance(value, FieldElement) else Fraction(value)
        for name, value in zip(found.point, values, strict=True)
    }
