"""Planning with obstacles: the method's path, proved clear of every obstacle, or the documented alternatives.

The objective knows nothing of the obstacles, so a path that is blocked does not mean that none exists.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.enclosure import root_below
from bezier.curves.scalar import add
from bezier.input.toml_table import Table
from bezier.obstacles import survey
from bezier.obstacles.clearance import Clear, ClearanceArgument
from bezier.planner.derivations import listed
from bezier.planner.table import method_for
from bezier.plans import Attempt, Clock, Outcome, Plan, make
from bezier.problem import INNER, PlanMethod, Problem, ends_inside, problem_of, to_json
from qe.errors import BudgetExceeded, CertificateRejected, InputError, Unable

RAISES = (Fraction(1, 4), Fraction(1, 2), Fraction(1))
METHODS = (PlanMethod.QUADRATIC, PlanMethod.CUBIC, PlanMethod.SINGLE)
"""Those after the one asked for are tried in this order."""


ENDS = (Outcome.SOLVED, Outcome.NEAR_OPTIMAL, Outcome.BLOCKED, Outcome.INFEASIBLE)
"""What an attempt can end with, the best first: at most one of the first two, and that is the last attempt."""
FINER = (ClearanceArgument.SUBDIVISION, ClearanceArgument.ROOTS)
AS_GIVEN = "as given"
"""The first attempt."""
NOT_FOUND = "no path found: every path that was tried MEETS an obstacle"


def avoiding(problem: Problem, clock: Clock) -> Plan:
    """The first alternative whose whole path is clear of the obstacles; else the first path, ``Outcome.BLOCKED``. Where
    the start or the goal lies in an obstacle, the proof that no path exists, at once."""
    first = _attempted(AS_GIVEN, problem, clock)
    if first.outcome.is_success or ends_inside(problem):
        return first
    attempts = first.attempts
    for what, candidate in _alternatives(problem, first):
        try:
            plan = _attempted(what, candidate, clock)
        except BudgetExceeded:
            raise
        except Unable as error:
            attempts += (Attempt(what, None, str(error)),)
            continue
        attempts += plan.attempts
        if plan.outcome.is_success:
            return replace(plan, attempts=attempts)
        if first.path is None and plan.path is not None:
            first = plan
    return replace(first, attempts=attempts)


def _attempted(what: str, problem: Problem, clock: Clock) -> Plan:
    """The plan of one problem, proved clear of the obstacles or not."""
    plan: Plan = make(method_for(problem), problem, clock)
    with clock.step(f"clearance, {what}"):
        plan = examined(plan)
    clock.learn(what, _detail(plan))
    return replace(plan, attempts=(Attempt(what, plan.outcome, _detail(plan)),))


def examined(plan: Plan) -> Plan:
    """The plan with what was found out about its curves and the obstacles, and with the certificates of that."""
    if plan.path is None:
        return plan
    findings = survey.survey(plan.path.curves, plan.problem.obstacles)
    if survey.contacts(findings):
        return replace(plan, findings=findings, outcome=Outcome.BLOCKED)
    result = survey.certificates(findings)
    checks = {**plan.checks, "clearance": qe.verify(qe.Certificate.bundle(result))} if result else plan.checks
    certificate = qe.Certificate.bundle([*listed(plan.certificate), *result])
    remarks = plan.remarks
    for f in findings:
        if isinstance(f.outcome, Clear) and f.outcome.argument in FINER:
            unseen = f"the control polygon of {f.name} does not show that it stays clear of {f.obstacle.name}"
            remarks += (f"{unseen}; the curve itself is proved to",)
    return replace(plan, findings=findings, certificate=certificate, checks=checks, remarks=remarks)


def _detail(plan: Plan) -> str:
    if ends_inside(plan.problem):
        return method_for(plan.problem).reason(plan)
    if plan.outcome is Outcome.INFEASIBLE:
        return "no control point exists"
    return "; ".join(map(survey.in_words, survey.contacts(plan.findings))) or "clear of all obstacles"


def _alternatives(problem: Problem, first: Plan) -> Iterator[tuple[str, Problem]]:
    """What to try after the first plan, in order."""
    height = _height(problem, first)
    for method in METHODS[METHODS.index(problem.method) :]:
        named = "" if method is problem.method else f'method "{method.value}"'
        for share in (Fraction(0), *RAISES) if named else RAISES:
            lift = share * height
            raised = f"via points raised by {lift}" if lift else ""
            candidate = changed(problem, method, lift)
            if candidate is not None:
                yield ", ".join(filter(None, (named, raised))), candidate


def _height(problem: Problem, plan: Plan) -> Fraction:
    """The height of the highest obstacle met, or of the highest one at all; without any, a tenth of the radius."""
    hit = [finding.obstacle for finding in survey.contacts(plan.findings)]
    heights = [o.box[1][2] - o.box[0][2] for o in hit or problem.obstacles if o.box is not None]
    return max(heights, default=root_below(problem.workspace.radius_squared, bits=10) / 10)


def changed(problem: Problem, method: PlanMethod, lift: Fraction) -> Problem | None:
    """The problem with another method and higher via points.

    None when these do not fit into the workspace, or when the problem states what the other method does not know.
    """
    if problem.single is not None and problem.single.states_via:
        return None
    table = to_json(problem)
    radius = table.pop("radius_squared")
    table["radius"] = "auto" if problem.radius_is_auto else f"sqrt({radius})"
    table["method"] = method.value
    table["via"] = [[str(c) for c in add(p, (Fraction(0), Fraction(0), lift))] for p in problem.via]
    for entry in (*table.get("half_space", ()), *table.get("obstacle", ())):
        for key in ("points", "above"):
            if key in entry and method is not problem.method:
                known = INNER.get(method, ())
                entry[key] = [name for name in known if name[0] + "1" in entry[key] or name in entry[key]]
    try:
        return problem_of(Table(table, problem.source))
    except InputError:
        return None


def with_stated_attempts(plan: Plan, stated: Any) -> Plan:
    """The examined plan with the attempts that a summary states.

    The plan's own attempt is found again; the others, about problems that are not in the folder, are only read. Raises
    ``CertificateRejected`` where they cannot have led to this plan.
    """
    if not isinstance(stated, list) or not stated:
        raise CertificateRejected("summary.json: attempts", "expected a list of attempts")
    attempts = [_attempt(item, f"summary.json: attempts[{i}]") for i, item in enumerate(stated)]
    outcomes = [item.outcome for item in attempts]
    last = outcomes.index(plan.outcome) if plan.outcome in outcomes else 0
    solved = plan.outcome.is_success
    best = next((o for o in ENDS if o in outcomes), None)
    if best is not plan.outcome or (solved and last != len(attempts) - 1) or outcomes[0] is None:
        raise CertificateRejected("summary.json: attempts", f"these do not end with {plan.outcome.value}")
    what = attempts[last].what if last else AS_GIVEN
    attempts[last] = Attempt(what, plan.outcome, _detail(plan))
    return replace(plan, attempts=tuple(attempts))


def _attempt(stated: Any, place: str) -> Attempt:
    """An attempt as ``json_entries`` writes it."""
    if not isinstance(stated, dict) or not all(isinstance(text, str) for text in stated.values()):
        raise CertificateRejected(place, "expected an object of texts")
    known = {"unable": None, **{o.value: o for o in ENDS}}
    if stated.keys() != {"what", "outcome", "detail"} or stated["outcome"] not in known:
        raise CertificateRejected(place, f"expected what, outcome ({', '.join(known)}) and detail")
    return Attempt(stated["what"], known[stated["outcome"]], stated["detail"])


# --- for people ---------------------------------------------------------------------------------------


def summary_lines(plan: Plan) -> list[str]:
    """The lines of the summary about obstacles."""
    if not plan.problem.obstacles:
        return []
    lines = [survey.in_words(finding) for finding in plan.findings]
    if plan.outcome is Outcome.BLOCKED:
        lines.append(f"{NOT_FOUND}; a path may exist all the same")
    if len(plan.attempts) > 1:
        lines += [f"tried: {attempt.what}: {attempt.detail}" for attempt in plan.attempts]
    return lines


def json_entries(plan: Plan) -> dict[str, Any]:
    """The entries of the JSON summary about obstacles."""
    if not plan.problem.obstacles:
        return {}
    tried = [
        {"what": a.what, "outcome": a.outcome.value if a.outcome else "unable", "detail": a.detail}
        for a in plan.attempts
    ]
    return {"clearance": [survey.to_json(finding) for finding in plan.findings], "attempts": tried}
