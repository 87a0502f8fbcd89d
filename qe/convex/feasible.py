"""Whether a convex quadratic system has a solution, exactly."""

from __future__ import annotations

from collections.abc import Sequence

from qe.convex.minimise import solve
from qe.convex.strict import settle_strict
from qe.convex.system import ConvexSystem, constant
from qe.errors import Unable
from qe.exact.quadratic_form import Quadratic
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumEvidence, OptimumStatus


def proved(system: ConvexSystem, *, budget: Budget, near: bool = False) -> OptimumEvidence:
    """Evidence about the least value of the objective, strict conditions included; ``near`` as in ``solve``.

    Raises ``Unable`` without a proof, also where the floating-point numbers that propose one are beyond their range."""
    try:
        return settle_strict(system, solve(system, budget=budget, near=near), budget=budget)
    except Unable:
        raise
    except OverflowError:
        raise Unable("the numbers are beyond the range of floats, which propose the solution") from None


def feasible(forms: Sequence[Quadratic], relations: Sequence[FormRelation], *, budget: Budget) -> bool:
    """Whether some point satisfies forms[i] relations[i] 0 for all i: convex inequalities and linear equations.

    Minimises nothing over the set: the evidence is a feasible point or a contradiction. Raises ``Unable`` when
    neither could be proved.
    """
    size = forms[0].size
    names = tuple(f"y{k}" for k in range(size))
    optimum = proved(ConvexSystem(names, constant(size, 0), tuple(forms), tuple(relations)), budget=budget)
    if optimum.status is OptimumStatus.UNBOUNDED:
        raise Unable("a constant objective was found unbounded")
    return optimum.status is OptimumStatus.OPTIMAL
