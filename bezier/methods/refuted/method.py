"""The plan where the start or the goal lies in an obstacle: a proof that no path exists, by any method."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

import qe
from bezier.obstacles.obstacle import PointInside
from bezier.plans import Begun, Clock, Outcome, Plan, Stated, Story
from bezier.problem import Problem, ends_inside
from bezier.report import html, parts
from qe.formula.syntax import Formula
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class RefutedPlan(Plan):
    """``inside``: the ends of the path that lie in obstacles, one at least."""

    inside: tuple[PointInside, ...]


def begin(problem: Problem, clock: Clock) -> Begun:
    """No path."""
    return Begun(
        problem=problem, outcome=Outcome.INFEASIBLE, path=None, found=ends_inside(problem), seconds=clock.seconds
    )


def finish(given: Begun, clock: Clock) -> RefutedPlan:
    """The proof, checked."""
    plan = _plan(given.problem)
    with clock.step("verification"):
        checks = {item.label: qe.verify(item.certificate()) for item in plan.inside}
    return replace(plan, checks=checks, seconds=clock.seconds)


def _plan(problem: Problem) -> RefutedPlan:
    """What follows from the problem alone."""
    result = ends_inside(problem)
    return RefutedPlan(
        problem=problem,
        outcome=Outcome.INFEASIBLE,
        formula="",
        objective=None,
        path=None,
        active=(),
        certificate=Certificate.bundle((item.label, item.certificate()) for item in result),
        inside=result,
    )


def questions(problem: Problem) -> dict[str, Formula]:
    """None."""
    return {}


def reason(plan: RefutedPlan) -> str:
    """Which end lies in which obstacle, and where."""
    return "; ".join(item.in_words() for item in plan.inside)


def summary_lines(plan: RefutedPlan) -> list[str]:
    """None beyond the reason."""
    return []


def json_entries(plan: RefutedPlan) -> dict[str, Any]:
    """The ends in obstacles, with their places."""
    listed = ((item.name, item.obstacle.name, list(map(str, item.place))) for item in plan.inside)
    return {"inside": [{"point": point, "obstacle": name, "place": place} for point, name, place in listed]}


def draw(plan: RefutedPlan, folder: FilePath) -> Drawing:
    """The given points among the obstacles."""
    from bezier.pictures import plot
    from bezier.pictures.picture import Drawing, path_picture

    ends = {"P0": plan.problem.start, "the goal": plan.problem.goal}
    picture = path_picture(plan.problem, None, ends, region=None, hatted_names=False)
    plot.save_path(picture, folder / "path.png")
    return Drawing(picture, ("path.png",), plot.views(picture))


def story(plan: RefutedPlan, drawing: Drawing | None) -> Story:
    """Why there is no path."""
    more = "Every path begins at the start and ends at the goal, so none is clear of the obstacles, by any method."
    return Story(
        kind="a path",
        place="4",
        given=("start", "Q0", "R0", "goal"),
        claims={item.label: item.in_words() for item in plan.inside},
        none=parts.no_path(reason(plan), html.paragraph(more)),
        sections=(),
    )


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> tuple[RefutedPlan, tuple[str, ...]]:
    """The plan, which follows from the problem alone: so do the certificates that the folder has to have."""
    plan = _plan(problem)
    return plan, tuple(item.in_words() for item in plan.inside)
