"""Method 1 for the rest of the program: words, entries, pictures and checks around its plan."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from bezier import stored
from bezier.curves.curve import Bezier, Smoothness
from bezier.curves.scalar import Vector, brief, described
from bezier.methods import Claim, Method
from bezier.problem import Problem
from bezier.single import plan as single_plan
from bezier.single import report as single_report
from bezier.single.closed import ProvedCurve, close
from bezier.single.plan import CLOSED, NAME, SinglePlan, above_label, of_axis, points_of, task_of
from bezier.single.program import TIE_BREAK, Dip, Task, choose, curve, dips
from bezier.single.simplex import Contradiction, certificate
from qe.errors import CertificateRejected
from qe.proof.certificate import Certificate, Kind

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


def words(plan: SinglePlan) -> list[str]:
    """The lines of the summary that only this method has."""
    given = plan.task
    lines = [f"degree {given.degree}, p = {given.p}, q = {given.q}; identities (2) and (3) proved"]
    lines += [f"least sum of {name}: {brief(value)}" for name, value in plan.least_sums.items()]
    lines += single_report.holes(plan)
    if plan.path is not None:
        lines += [f"{name} >= h proved for all t from t_a to t_b" for name in plan.above]
    return lines


def entries(plan: SinglePlan) -> dict[str, Any]:
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


def files(plan: SinglePlan) -> dict[str, str]:
    """None beyond those of every method."""
    return {}


def draw(plan: SinglePlan, folder: FilePath) -> Drawing:
    """The path in its workspace, and the heights over x with [a, b] and h marked."""
    from bezier.pictures import plot, plot_profile
    from bezier.pictures.picture import Drawing, path_picture

    ends = {f"{NAME}0": plan.problem.start, f"{NAME}{plan.task.degree}": plan.problem.goal}
    picture = path_picture(plan.problem, plan.path, ends, region=None, hats=False)
    plot.save_path(picture, folder / "path.png")
    curves = {"chosen": plan.path.curves[NAME]} if plan.path else {}
    if plan.printed is not None and not plan.printed.holds:
        curves["(4) as printed"] = plan.printed.curve
    elif plan.printed is not None and plan.printed.allowed:
        curves["allowed by (4), same sum"] = plan.printed.lowest
    plot_profile.save(plan.task, curves, folder / "profile.png")
    charts = plot_profile.svg(plan.task, curves)
    return Drawing(picture, plot.views_svg(picture), ("path.png", "profile.png"), charts)


def claim(problem: Problem, found: Certificate) -> Claim:
    """What the certificates of a folder show about this problem.

    The linear programs are built again from the problem, those of Method 1* by generating its cuts again; the heights
    are proved again on the part of the curve from t_a to t_b that its certificates are about.
    """
    given = task_of(problem)
    chosen = [choose(given, axis) for axis in given.raised]
    none = [item for item in chosen if isinstance(item.outcome, Contradiction)]
    for item in none or chosen:
        same_program(of_axis(item.axis.name), found, certificate(item.program, item.objective, item.outcome))
    lines = ["the linear problems (4) belong to this problem"]
    if none:
        return Claim(tuple(lines), None, Smoothness.C2, ())
    if any(member.label == CLOSED for member in members(found)):
        closed = close(given, problem.workspace)
        same_program(CLOSED, found, closed.certificate)
        lines.append("the linear problem of Method 1* follows from its conditions for all t")
        if not isinstance(closed, ProvedCurve):
            return Claim(tuple(lines), None, Smoothness.C2, ())
    drawn = certified_curve(given, found)
    lines.append("the curve satisfies (4) and keeps its heights for all t from t_a to t_b")
    return Claim(tuple(lines), points_of(drawn), Smoothness.C2, (NAME,))


def members(found: Certificate) -> tuple[Any, ...]:
    """The labelled certificates of a bundle."""
    return found.payload if isinstance(found.payload, tuple) else ()


def same_program(label: str, found: Certificate, expected: Certificate) -> None:
    """The certificate of this label is about the expected problem, with the expected status."""
    payload: Any = stored.member(found, label, Kind.OPTIMUM)
    wanted: Any = expected.payload
    for key in ("problem", "status"):
        if payload[key] != wanted[key]:
            raise CertificateRejected(f"{label}: {key}", "not the one of this problem")


def certified_curve(given: Task, found: Certificate) -> Bezier:
    """The curve of the certificate that it stays in the ball, which has to satisfy (4) and to keep its heights."""
    payload: Any = stored.member(found, f"{NAME} in ball", Kind.CONTAINMENT)
    flat = [stored.numbers(point, payload["field"], "points") for point in payload["points"]]
    drawn = Bezier(tuple(flat))
    if drawn.degree != given.degree or drawn.dimension != 1 + len(given.axes):
        raise CertificateRejected("points", f"expected {given.degree + 1} points")
    values = {axis.name: drawn.coordinate(1 + k) for k, axis in enumerate(given.axes) if axis in given.raised}
    if drawn != curve(given, values):
        raise CertificateRejected("points", "x or a coordinate without a height is not equally spaced")
    for axis in given.raised:
        row: tuple[Fraction, ...] = values[axis.name]
        low = all(row[i] >= given.lower_bound(axis, i) for i in range(1, given.degree))
        through = all(drawn.point(t)[1 + given.axes.index(axis)] == axis.height for t in given.times)
        if not low or not through or (row[0], row[-1]) != (axis.start, axis.goal):
            raise CertificateRejected("points", f"the {axis.name} coordinates do not satisfy (4)")
    for dip in dips(given, drawn):
        raise CertificateRejected("points", f"{dip.axis.name} is below the height at t = {dip.t}")
    for name in single_plan.heights_proved(given, drawn):
        label = above_label(name)
        if any(member.label == label for member in members(found)):
            part: Any = stored.member(found, label, Kind.CONTAINMENT)
            check_points(label, part, drawn.segment(*given.times).points)
    return drawn


def check_points(label: str, payload: Any, expected: tuple[Vector, ...]) -> None:
    """The certificate of this label is about these control points."""
    if payload["points"] != [[[str(c)] for c in point] for point in expected]:
        raise CertificateRejected(f"{label}: points", "not the part of the curve from t_a to t_b")


SINGLE: Method[SinglePlan] = Method(
    make=single_plan.make,
    reason=single_report.reason,
    words=words,
    entries=entries,
    files=files,
    draw=draw,
    hats=False,
    template="single.html.j2",
    sections=single_report.sections,
    claim=claim,
)
