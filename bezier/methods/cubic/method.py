"""The cubic method for the rest of the program: words, entries, pictures and checks around its plan."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from bezier.curves.scalar import brief, described
from bezier.methods.control.terms import named_multipliers
from bezier.methods.cubic import plan as cubic_plan
from bezier.methods.cubic import report as cubic_report
from bezier.methods.cubic.plan import CubicPlan
from bezier.plans import Method, Restored, Stated
from bezier.problem import Problem
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


def summary_lines(plan: CubicPlan) -> list[str]:
    """The lines of the summary that only this method has."""
    if plan.path is None:
        return []
    best = [f"best {name} = ({', '.join(map(brief, plan.path.points[name]))})" for name in plan.system.shape.free]
    return [*best, *(f"{name}: {cubic_report.speed_text(slow)}" for name, slow in plan.slowest.items())]


def json_entries(plan: CubicPlan) -> dict[str, Any]:
    """The entries of the JSON summary that only this method has."""
    multipliers = named_multipliers(plan.system, plan.optimum)
    return {
        "multipliers": [{"condition": label, **described(value)} for label, value in multipliers],
        "least_speed": {name: slow.least.to_json() for name, slow in plan.slowest.items()},
        "joins": [item.join.smoothness.name for item in plan.path.joins] if plan.path else [],
        "trivial_choice": {"violates": list(plan.trivial.violated), "smoothness": plan.trivial.path.smoothness.name},
    }


def files(plan: CubicPlan) -> dict[str, str]:
    """None beyond those of every method."""
    return {}


def draw(plan: CubicPlan, folder: FilePath) -> Drawing:
    """Where Q1 may be with Q2 at its optimum, the path, and its speed and curvature over time."""
    from bezier.pictures import plot
    from bezier.pictures.picture import Drawing, path_picture, region_picture

    region = None
    if plan.path is not None:
        conditions = plan.system.seen_by("Q1", plan.path.points)
        region = region_picture(conditions, conditions, plan.path.points["Q1"])
    picture = path_picture(plan.problem, plan.path, plan.system.given, region=region, hatted_names=False)
    title = "Where Q₁ may be while Q₂ stays at its optimum: a slice of the region of formula (7)"
    plot.save_region(picture, folder / "region.png", title)
    plot.save_path(picture, folder / "path.png")
    written = ("region.png", "path.png")
    if plan.path is None:
        return Drawing(picture, written, plot.views(picture))
    from bezier.pictures import plot_motion

    plot_motion.save(plan.path, folder / "motion.png")
    return Drawing(picture, (*written, "motion.png"), plot.views(picture), plot_motion.charts(plan.path))


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> Restored[CubicPlan]:
    """The plan that the certificates of a folder prove; nothing else in the folder is needed for it."""
    plan = cubic_plan.restore(problem, certificate)
    lines = [
        "the elimination belongs to formula (7) of this problem",
        "the optimum belongs to formula (7) of this problem",
    ]
    if problem.join_speed and plan.path is not None:
        lines.append(f"the conditions for a speed of at least {problem.join_speed} at both joins hold")
    return Restored(plan, tuple(lines))


CUBIC: Method[CubicPlan] = Method(
    begin=cubic_plan.begin,
    finish=cubic_plan.finish,
    reason=cubic_report.reason,
    summary_lines=summary_lines,
    json_entries=json_entries,
    files=files,
    draw=draw,
    hatted_names=False,
    story=cubic_report.story,
    restore=restore,
    questions=cubic_plan.questions,
)
