"""The quadratic method for the rest of the program: words, files, pictures and checks around its plan."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from bezier.curves.containment import Leaves
from bezier.curves.scalar import exact_text
from bezier.methods.quadratic import formula as quadratic
from bezier.methods.quadratic import plan as quadratic_plan
from bezier.methods.quadratic import report as quadratic_report
from bezier.methods.quadratic import restore as quadratic_restore
from bezier.methods.quadratic.plan import QuadraticPlan
from bezier.plans import Method, Restored, Stated
from bezier.problem import Problem
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


def summary_lines(plan: QuadraticPlan) -> list[str]:
    """The lines of the summary that only this method has."""
    gap = "control points" if plan.gap.can_leave else "no control point"
    more = " (example in the report)" if plan.gap.can_leave else ""
    table = f"the printed formula allows {gap} below the table z = 0 here{more}"
    if plan.path is None:
        return ['try method = "cubic"', table]
    cells = len(plan.region.cells)
    return [
        f"region of Q1: dimension {plan.region.dimension}, {cells} cell{'s' if cells != 1 else ''}",
        f"best Q1 = ({', '.join(map(exact_text, plan.path.points['Q1']))})",
        table,
    ]


def json_entries(plan: QuadraticPlan) -> dict[str, Any]:
    """The entries of the JSON summary that only this method has."""
    dips = any(isinstance(proof.outcome, Leaves) for proof in plan.gap.chosen)
    found: dict[str, Any] = {"leaves_hemisphere": {"allowed": plan.gap.can_leave, "chosen": dips}}
    if plan.path is None:
        found["suggestion"] = 'method = "cubic"'
    return found


def files(plan: QuadraticPlan) -> dict[str, str]:
    """The region of Q1."""
    return {"region.json": plan.region.to_json()}


def draw(plan: QuadraticPlan, folder: FilePath) -> Drawing:
    """The region of Q1, the path, and the region with z >= 0 where that makes a difference."""
    from bezier.pictures import plot
    from bezier.pictures.picture import Drawing, path_picture, region_picture
    from bezier.report.recognise import as_conditions

    named = quadratic.as_conditions_on_q1(plan.system)
    chosen = plan.path.points["Q1"] if plan.path else None
    conditions = as_conditions(plan.answer.formula, quadratic.FREE)
    region = None if plan.region.is_empty or conditions is None else region_picture(conditions, named, chosen)
    extra = {}
    if plan.gap.region is not None and not plan.gap.region.is_empty:
        both = quadratic.as_conditions_on_q1(quadratic.corrected(plan.problem))
        printed = region_picture(both[:3], both, None, level=3)
        corrected = region_picture(both, both, None, level=3)
        if printed is not None and corrected is not None:
            extra = {"printed": printed, "corrected": corrected}
    picture = path_picture(plan.problem, plan.path, plan.system.given, region=region, extra=extra)
    plot.save_region(picture, folder / "region.png", "Where Q\u0302₁ may be: the region of formula (8)")
    plot.save_path(picture, folder / "path.png")
    return Drawing(picture, ("region.png", "path.png"), plot.views(picture))


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> Restored[QuadraticPlan]:
    """The plan that the certificates of a folder prove; nothing else in the folder is needed for it."""
    plan = quadratic_restore.restore(problem, certificate)
    lines = ("the region belongs to formula (8) of this problem", "the optimum belongs to this problem")
    return Restored(plan, lines)


QUADRATIC: Method[QuadraticPlan] = Method(
    begin=quadratic_plan.begin,
    finish=quadratic_plan.finish,
    reason=quadratic_report.reason,
    summary_lines=summary_lines,
    json_entries=json_entries,
    files=files,
    draw=draw,
    hatted_names=True,
    story=quadratic_report.story,
    restore=restore,
    questions=quadratic_plan.questions,
)
