"""Whether a convex quadratic system has a solution, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from qe.convex.minimise import Task, solve
from qe.convex.strict import settle_strict
from qe.errors import Unable
from qe.exact.quadratic_form import Quadratic
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumStatus


def feasible(forms: Sequence[Quadratic], relations: Sequence[FormRelation], *, budget: Budget) -> bool:
    """Whether some point satisfies forms[i] relations[i] 0 for all i: convex inequalities and linear equations.

    Minimises nothing over the set: the evidence is a feasible point or a contradiction. Raises ``Unable`` when
    neither could be proved.
    """
    size = forms[0].size
    names = tuple(f"y{k}" for k in range(size))
    nothing = Quadratic(((Fraction(0),) * size,) * size, (Fraction(0),) * size, Fraction(0))
    task = Task(names, nothing, tuple(forms), tuple(relations))
    try:
        evidence = settle_strict(task, solve(task, budget=budget), budget=budget)
    except OverflowError:
        raise Unable("the numbers are beyond the range of floats, which propose the solution") from None
    if evidence.status is OptimumStatus.UNBOUNDED:
        raise Unable("a constant objective was found unbounded")
    return evidence.status is OptimumStatus.OPTIMAL
