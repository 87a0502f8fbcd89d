"""Method 1 for the rest of the program: words, entries, pictures and checks around its plan."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from bezier.curves.scalar import brief, described
from bezier.methods.single import plan as single_plan
from bezier.methods.single import report as single_report
from bezier.methods.single import restore as single_restore
from bezier.methods.single.closed import ProvedCurve
from bezier.methods.single.cuts import Cut
from bezier.methods.single.plan import NAME, SinglePlan
from bezier.methods.single.program import TIE_BREAK, Dip
from bezier.plans import Method, Restored, Stated
from bezier.problem import Problem
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


def summary_lines(plan: SinglePlan) -> list[str]:
    """The lines of the summary that only this method has."""
    given = plan.task
    lines = [f"degree {given.degree}, p = {given.p}, q = {given.q}; identities (2) and (3) proved"]
    lines += [f"least sum of {name}: {brief(value)}" for name, value in plan.least_sums.items()]
    lines += single_report.holes(plan)
    if plan.path is not None:
        lines += [f"{name} >= h proved for all t from t_a to t_b" for name in plan.above]
    return lines


def json_entries(plan: SinglePlan) -> dict[str, Any]:
    """The entries of the JSON summary that only this method has."""
    given, closed = plan.task, plan.closed
    found: dict[str, Any] = {
        "degree": given.degree,
        "p": given.p,
        "q": given.q,
        "times": [described(t) for t in given.times],
        "tie_break": TIE_BREAK,
        "least_sums": {name: described(value) for name, value in plan.least_sums.items()},
        "piecewise": {name: str(piece.least) for name, piece in plan.pieces.items()},
        "dips": [],
        "dips_allowed": [],
        "leaves": [],
        "closed": None,
        "cuts": [_cut(cut) for cut in closed.cuts] if closed is not None else [],
    }
    if plan.printed is not None:
        found["dips"] = [_dip(dip) for dip in plan.printed.dips]
        found["dips_allowed"] = [_dip(dip) for dip in plan.printed.allowed]
        found["leaves"] = [proof.condition.name for proof in plan.printed.leaving]
    if isinstance(closed, ProvedCurve):
        found["closed"] = {
            "sum": described(closed.value),
            "bound": described(closed.bound),
            "cuts": len(closed.cuts),
            "rounds": closed.rounds,
            "attainable": plan.attainable,
        }
    return found


def _dip(dip: Dip) -> dict[str, str]:
    return {"axis": dip.axis.name, "t": str(dip.t), **described(dip.value)}


def _cut(cut: Cut) -> dict[str, Any]:
    return {"kind": cut.kind.value, "axis": cut.axis, "t": str(cut.t), "plane": [str(c) for c in cut.plane]}


def files(plan: SinglePlan) -> dict[str, str]:
    """None beyond those of every method."""
    return {}


def draw(plan: SinglePlan, folder: FilePath) -> Drawing:
    """The path in its workspace, and the heights over x with [a, b] and h marked."""
    from bezier.pictures import plot, plot_profile
    from bezier.pictures.picture import Drawing, path_picture

    ends = {f"{NAME}0": plan.problem.start, f"{NAME}{plan.task.degree}": plan.problem.goal}
    picture = path_picture(plan.problem, plan.path, ends, region=None, hatted_names=False)
    plot.save_path(picture, folder / "path.png")
    curves = {"chosen": plan.path.curves[NAME]} if plan.path else {}
    if plan.printed is not None and not plan.printed.holds:
        curves["(4) as printed"] = plan.printed.curve
    elif plan.printed is not None and plan.printed.allowed:
        curves["allowed by (4), same sum"] = plan.printed.lowest
    plot_profile.save(plan.task, curves, folder / "profile.png")
    charts = plot_profile.charts(plan.task, curves)
    return Drawing(picture, ("path.png", "profile.png"), plot.views(picture), charts)


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> Restored[SinglePlan]:
    """The plan that the files of a folder prove."""
    plan = single_restore.restore(problem, certificate, stated)
    lines = ["the linear problems (4) belong to this problem"]
    if plan.closed is not None:
        lines.append("the linear problem of Method 1* follows from its conditions for all t")
    if plan.path is not None:
        lines.append("the curve satisfies (4) and keeps its heights for all t from t_a to t_b")
    return Restored(plan, tuple(lines))


SINGLE: Method[SinglePlan] = Method(
    begin=single_plan.begin,
    finish=single_plan.finish,
    reason=single_report.reason,
    summary_lines=summary_lines,
    json_entries=json_entries,
    files=files,
    draw=draw,
    hatted_names=False,
    story=single_report.story,
    restore=restore,
    questions=single_plan.questions,
)
