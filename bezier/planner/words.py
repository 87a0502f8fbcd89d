"""A plan in words: the lines of the summary, and why there is no path to use."""

from __future__ import annotations

from bezier.curves.scalar import brief, decimal_text
from bezier.motion import motion
from bezier.obstacles import survey
from bezier.paths import heights
from bezier.planner import arm, avoid
from bezier.planner.table import method_for
from bezier.plans import Outcome, Plan

NONE = "no path exists"
"""What is proved; ``avoid.NOT_FOUND`` says that a search gave up."""


def lines(made: Plan) -> list[str]:
    """The summary for people, but for the files."""
    problem, method = made.problem, method_for(made.problem)
    result = [f"radius r = {problem.workspace.radius_text}, {problem.workspace.kind.value}"]
    result += [f"note: {note}" for note in (*problem.notes, *made.remarks)]
    if made.outcome is Outcome.INFEASIBLE:
        result.append(why_not(made) or "")
    result += method.summary_lines(made)
    if made.objective is not None:
        below = "" if made.bound is None else f", never below {decimal_text(made.bound, 12)}"
        result.append(f"objective {brief(made.objective)}{below}, active: {', '.join(made.active) or 'nothing'}")
    if made.path is not None:
        inside = "proved to lie in the workspace" if made.path.is_inside else "which LEAVES the workspace"
        joins = f"{made.path.smoothness.name} at both joins, " if made.path.joins else ""
        result.append(f"path: {joins}{inside}")
    if made.heights is not None:
        result += heights.summary_lines(made.heights)
    result += motion.summary_lines(made.quality)
    result += avoid.summary_lines(made)
    result += arm.summary_lines(made)
    accepted = all(verdict.accepted for verdict in made.checks.values())
    result.append(f"certificates: {'accepted' if accepted else 'REJECTED'}")
    if made.derivations:
        result.append(f"derivations checked: {', '.join(made.derivations)}")
    result += [f"derivation of {name}: not every step checked: {why}" for name, why in made.unproved.items()]
    return result


def why_not(made: Plan) -> str | None:
    """Why the plan is not a path to use, in one line; None where it is one."""
    match made.outcome:
        case Outcome.SOLVED | Outcome.NEAR_OPTIMAL:
            return None
        case Outcome.INFEASIBLE:
            return f"{NONE}: {method_for(made.problem).reason(made)}"
        case Outcome.BLOCKED:
            contacts = "; ".join(map(survey.in_words, survey.contacts(made.findings)))
            return f"{avoid.NOT_FOUND} ({contacts}); a path may exist all the same"
        case Outcome.OUT_OF_REACH:
            return f"the arm cannot follow the path: {'; '.join(arm.summary_lines(made))}"
    moving = None if made.quality is None else made.quality.motion
    if moving is not None and moving.reason:
        return f"{moving.reason}; kept at all times with {moving.suggestion}"
    return "; ".join(made.joints.remarks if made.joints is not None else ()) or "limits of the joints are not kept"
