"""Planning: a method's path around the obstacles, and what is decided about every plan afterwards."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from bezier.motion.motion import quality_of
from bezier.motion.timelaw import Law
from bezier.paths import heights
from bezier.planner import radius_rule
from bezier.planner.arm import check_arm, with_joints
from bezier.planner.avoid import avoiding
from bezier.planner.derivations import with_derivations
from bezier.planner.table import method_of
from bezier.plans import Begun, Clock, Outcome, Plan, RadiusRule, make
from bezier.problem import Problem, ends_inside
from qe.errors import BudgetExceeded, Unable
from qe.proof.certificate import Certificate

NEAR = (
    "the exact optimum needs a number field of high degree: rational control points are proved to be within 10^-9 of"
    " its objective"
)


def make_plan(problem: Problem, clock: Clock | None = None, *, proofs: bool = False) -> Plan:
    """Plan a path; with ``proofs`` also the derivations of all eliminations.

    Raises ``Unable`` where no answer is reached, at limits with what is known by then.
    """
    problem = check_arm(problem)
    watch = clock or Clock()
    with _telling(watch):
        plan: Plan = avoiding(problem, watch) if problem.obstacles else make(method_of(problem.method), problem, watch)
        return _completed(plan, watch, proofs)


def begin_plan(problem: Problem, clock: Clock) -> Begun | None:
    """The path alone, of a problem in which nothing but the workspace decides about it; None for any other one.

    Raises as ``make_plan``.
    """
    if problem.obstacles or problem.arm is not None or problem.timing is not None:
        return None
    with _telling(clock):
        return method_of(problem.method).begin(problem, clock)


def finish_plan(begun: Begun, clock: Clock, *, proofs: bool = False) -> Plan:
    """The plan that was begun. Raises as ``make_plan``."""
    with _telling(clock):
        return _completed(method_of(begun.problem.method).finish(begun, clock), clock, proofs)


def _completed(plan: Plan, watch: Clock, proofs: bool) -> Plan:
    """The plan with what is decided about every path."""
    with watch.step("radius and heights"):
        made = plan
        plan = with_findings(made, lambda solvable: radius_rule.radius_rule(made.problem, solvable, watch.remaining))
    with watch.step("quality"):
        plan = with_quality(plan)
    if plan.problem.arm is not None:
        with watch.step("joints"):
            plan = with_joints(plan)
    if proofs:
        with watch.step("derivations"):
            plan = with_derivations(plan, watch)
    return plan


@contextmanager
def _telling(watch: Clock) -> Iterator[None]:
    """An error at a limit says what is known by then."""
    try:
        yield
    except Unable as error:
        limit = error.limit if isinstance(error, BudgetExceeded) else "time" if watch.is_over else None
        if limit is None:
            raise
        known = "; ".join(f"{name}: {value}" for name, value in watch.facts.items()) or "nothing yet"
        raise BudgetExceeded(f"{error}; known so far: {known}", limit=limit) from None


def with_findings(plan: Plan, rule: Callable[[bool], RadiusRule | None]) -> Plan:
    """The plan with what the radius forces (``rule`` is given whether the problem has a solution), the height
    condition, and a note where the path goes through the origin."""
    result, remarks = plan, []
    try:
        solvable = plan.outcome is not Outcome.INFEASIBLE
        forced = None if ends_inside(plan.problem) else rule(solvable)
        if forced is not None:
            result = replace(result, radius_rule=forced)
            remarks += [forced.in_words()] if solvable else []  # else it is part of the reason
        remarks += [] if plan.bound is None else [NEAR]
        if plan.path is not None:
            result = replace(result, heights=heights.heights_of(plan.problem.strip, plan.path))
            remarks += heights.remarks(plan.path)
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            raise
        remarks.append(f"what the radius forces and the heights are not all decided: {error}")
    return replace(result, remarks=(*result.remarks, *remarks))


def with_quality(plan: Plan, given: Certificate | None = None) -> Plan:
    """The plan with lengths, curvatures and the motion; it is not solved when the motion does not keep its limits.

    Without them, and with a remark, if they were not found and not asked for. ``given``: the certificate of its folder.
    """
    timing = plan.problem.timing
    if plan.path is None:
        return plan
    try:
        quality = quality_of(plan.path, timing)
    except Unable as error:
        if isinstance(error, BudgetExceeded) or timing is not None:
            raise
        return replace(plan, remarks=(*plan.remarks, f"lengths and curvatures are left out: {error}"))
    if timing is not None and timing.law is Law.LEAST:
        from bezier.planner.least_time import with_least_time  # and numpy, which plans do without otherwise

        return with_least_time(plan, quality, plan.path, timing, given)
    kept = quality.motion is None or quality.motion.keeps_limits
    solved = plan.outcome.is_success
    return replace(plan, quality=quality, outcome=Outcome.TOO_FAST if solved and not kept else plan.outcome)
