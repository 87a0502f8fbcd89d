"""``report.html``: the page of a plan as a list of sections, the same for every method."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from bezier.plans import Method, Outcome, Plan
from bezier.report import facts, first, html, joints, mathml, parts
from bezier.report.html import Page, Section

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing

PAPER = (
    "Method: R. Hatakeyama, A. Terui, M. Mikawa, “Towards Trajectory Planning of a Robot Manipulator with Computer"
    " Algebra using Bézier Curves for Obstacle Avoidance”, SCSS 2024"
)


def render(plan: Plan, method: Method[Any], drawing: Drawing | None) -> str:
    """The page of a plan by this method. Without ``drawing`` there are no pictures."""
    page = html.document(page_of(plan, method, drawing))
    return page if method.hatted_names else mathml.without_hats(page)


def page_of(plan: Plan, method: Method[Any], drawing: Drawing | None) -> Page:
    """The page: the scene with what matters, why it holds, and the details."""
    story = method.story(plan, drawing)
    arm = joints.moving(plan.joints)
    file = FilePath(plan.problem.source).name
    why: list[Section | None] = [
        story.none,
        facts.path(plan, drawing),
        facts.obstacles(plan, drawing),
        facts.certificates(plan, story.claims),
    ]
    details = [
        facts.problem(plan, parts.given(plan.problem.named_points, story.given)),
        *story.sections,
        facts.quality(plan, drawing),
        None if plan.joints is None else joints.section(plan.joints),
        facts.timings(plan.seconds, story.reported),
    ]
    footer = f"{PAPER}, section {story.place}. Made by bezier-qe {html.package_version()} from {file}."
    return Page(
        title=f"{file.removesuffix('.toml').replace('_', ' ')}: {first.RESULTS[plan.outcome]}",
        lead=_lead(plan, story.kind),
        cards=first.cards(plan),
        first=first.picture(plan, drawing, arm),
        sections=[section for section in (*why, *details) if section is not None],
        footer=footer,
    )


def _lead(plan: Plan, kind: str) -> str:
    """What was asked and found, in a sentence."""
    found = "" if plan.outcome is Outcome.INFEASIBLE else f"{kind} "
    ends = " to ".join(parts.decimal_point(p, 5) for p in (plan.problem.start, plan.problem.goal))
    obstacles = len(plan.problem.obstacles)
    around = f" around {obstacles} obstacle{'s' * (obstacles > 1)}" if obstacles else ""
    where = "half ball" if plan.problem.workspace.kind.value == "hemisphere" else "ball"
    radius = f"{float(plan.problem.workspace.radius_squared) ** 0.5:.6g}"
    return f"{found}from {ends}{around}, in the {where} of radius {radius} mm".strip()
