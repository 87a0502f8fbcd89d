"""The table of the planning methods: the one place that knows all of them."""

from __future__ import annotations

from typing import Any

from bezier.plans import Method
from bezier.problem import PlanMethod, Problem, ends_inside
from qe.extras import wanted


def method_for(problem: Problem) -> Method[Any]:
    """The method of a problem: the one that it asks for, unless its start or goal lies in an obstacle."""
    if ends_inside(problem):
        from bezier.methods.refuted import method as refuted

        return refuted
    return method_of(problem.method)


def method_of(choice: PlanMethod) -> Method[Any]:
    """The method of this name, loaded when it is needed. Raises ``Unable`` where a library it needs is absent."""
    with wanted():
        match choice:
            case PlanMethod.QUADRATIC:
                from bezier.methods.quadratic import method as quadratic

                return quadratic
            case PlanMethod.CUBIC:
                from bezier.methods.cubic import method as cubic

                return cubic
            case PlanMethod.SINGLE:
                from bezier.methods.single import method as single

                return single
