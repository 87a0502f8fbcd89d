"""Method 1 for the rest of the program: words, entries, pictures and checks around its plan."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from bezier.curves.containment import Leaves
from bezier.curves.scalar import brief, decimal_text, described
from bezier.input.task import Axis, Task
from bezier.methods.single import restore as single_restore
from bezier.methods.single.closed import ProvedCurve
from bezier.methods.single.plan import CLOSED, NAME, SUMS, SinglePlan, above_label, lowest_label, of_axis
from bezier.methods.single.plan import begin as begin
from bezier.methods.single.plan import finish as finish
from bezier.methods.single.plan import questions as questions
from bezier.methods.single.program import TIE_BREAK, Dip, lower_of
from bezier.plans import Stated, Story
from bezier.problem import Problem
from bezier.report import html, mathml, parts
from bezier.report.html import Section, Text
from bezier.report.parts import shown
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


def story(plan: SinglePlan, drawing: Drawing | None) -> Story:
    """What the page says in this method's own words."""
    given = plan.task
    lines = [shown(line) for axis in given.raised for line in _question(given, axis)]
    counts = "linear equations and bounds for each coordinate; v stands for the sum"
    formulas = parts.question_with_answer(plan, SUMS, lines, counts)
    sections = (
        Section("question", "The question", _intro(given) + formulas),
        _programs(plan),
        _open(plan, drawing),
        _proved_curve(plan),
        _optimum(plan),
    )
    return Story(
        kind=f"one Bézier curve of degree {given.degree}",
        place="4.1",
        given=("P0", "(a, h)", "(b, h)", f"P{given.degree}"),
        claims=_claims(plan),
        none=None if plan.path else parts.no_path(reason(plan), html.paragraph("A higher degree may help.")),
        sections=tuple(section for section in sections if section is not None),
    )


def _intro(given: Task) -> Markup:
    said = Markup(
        "Method 1 of the paper: one curve of degree n with equally spaced x-coordinates, so that x is linear in t."
        " Problem (4) asks for the other coordinates of its control points (n = {}, p = {}, q = {}); t<sub>a</sub> = {}"
        " and t<sub>b</sub> = {} belong to x = a and x = b."
    )
    return html.paragraph(said.format(given.degree, given.p, given.q, *map(brief, given.times)))


def holes(plan: SinglePlan) -> list[str]:
    """What the printed method left open here, and what became of it, in words."""
    if plan.printed is None:
        return []
    lines = [
        f"the curve of (4) as printed DIPS: {_dip_text(dip)} < {dip.axis.height} at t = {brief(dip.t)}"
        for dip in plan.printed.dips
    ]
    for proof in plan.printed.leaving:
        at = f", e.g. at t = {brief(proof.outcome.t)}" if isinstance(proof.outcome, Leaves) else ""
        lines.append(f"the curve of (4) as printed LEAVES the {proof.condition.name}{at}")
    if plan.printed.holds:
        lines.append("the curve of (4) keeps its heights between a and b and stays in the workspace, for all t")
        lines += [
            f"with the same least sum (4) also allows a curve that dips: {_dip_text(dip)} < {dip.axis.height}"
            f" at t = {brief(dip.t)}"
            for dip in plan.printed.allowed
        ]
    if isinstance(closed := plan.closed, ProvedCurve):
        cuts, value = f"{len(closed.cuts)} cuts", brief(closed.value)
        said = f"a curve with the sum {value}; no curve has a sum below {decimal_text(closed.bound, 8)} ({cuts})"
        best = f"a curve with the least possible sum, {value}, by {cuts}"
        lines.append(f"Method 1*: {best if closed.is_optimal else said}")
    return lines


def _dip_text(dip: Dip) -> str:
    return f"{dip.axis.name} = {decimal_text(dip.value, 8)}"


def reason(plan: SinglePlan) -> str:
    """Why there is no path, in one sentence."""
    none = [item.axis.name for item in plan.chosen if not item.outcome.optimal]
    if none:
        return f"no control points exist: problem (4) for {' and '.join(none)} contradicts itself"
    return (
        f"no curve of degree {plan.task.degree} satisfies (4), keeps its heights between a and b and stays in the"
        " workspace: already at finitely many t these conditions contradict each other (the certificate shows it)"
    )


def _question(given: Task, axis: Axis) -> list[str]:
    """Problem (4) for one axis, in the paper's notation."""
    name, height = axis.name, mathml.number(axis.height)
    curve = f"<msub><mi>P</mi><mi>{name}</mi></msub>"
    equation = "<mo>=</mo>".join(
        f"{curve}<mo>(</mo><msub><mi>t</mi><mi>{end}</mi></msub><mo>)</mo>" for end in ("a", "b")
    )
    bounds = [
        (axis.start, range(1, given.p + 1)),
        (axis.height, given.middle),
        (axis.goal, range(given.q + 1, given.degree)),
    ]
    listed = [
        f"{mathml.number(low)}<mo>≤</mo>" + "<mo>,</mo>".join(_indexed(name, i) for i in indices)
        for low, indices in bounds
        if indices
    ]
    total = "<mo>+</mo>".join(_indexed(name, i) for i in given.middle)
    lines = [f"{equation}<mo>=</mo>{height}", "<mspace width='0.6em'/>".join(listed)]
    return [*lines, f"<mi>min</mi><mspace width='0.3em'/>{total}"]


def _indexed(name: str, i: int) -> str:
    return f"<msub><mi>{name}</mi><mn>{i}</mn></msub>"


def _optimum(plan: SinglePlan) -> Section | None:
    if plan.path is None:
        return None
    total = "<mo>+</mo>".join(_indexed(axis.name, i) for axis in plan.task.raised for i in plan.task.middle)
    bounds = ", ".join(plan.active)
    active = f"Lower bounds of (4) that hold with equality there: {bounds}." if bounds else ""
    content = (
        html.paragraph(Markup("The paper asks for the least {}.").format(shown(total))),
        parts.least(plan),
        parts.control_points(plan.path),
        html.paragraph(active) if active else None,
    )
    return Section("best", "The control points", html.joined(*content), "optimum")


def _programs(plan: SinglePlan) -> Section:
    """Problem (4) of each axis with its dual proof."""
    content: list[Text] = []
    for item in plan.chosen:
        labels = [f"P_{item.axis.name}(t_{end}) = h" for end in ("a", "b")]
        labels += [
            f"{name} >= {low}"
            for name, low in zip(item.outcome.program.names, lower_of(plan.task, item.axis), strict=True)
        ]
        result = f"the least sum {brief(item.outcome.value)}" if item.outcome.optimal else "no solution"
        rows = [
            (label, parts.number(dual)) for label, dual in zip(labels, item.outcome.multipliers, strict=True) if dual
        ]
        content.append(html.heading(Markup("{}: {}").format(item.axis.name, result)))
        content.append(html.table(("condition", "multiplier of the dual proof"), rows))
    said = "The maximum norm keeps this choice linear and all numbers rational."
    content.append(html.note(f"Where several points have the least sum: {TIE_BREAK}. {said}"))
    if plan.pieces:
        pieces = [html.paragraph(f"{name}:") + html.pre(least) for name, least in plan.pieces.items()]
        none = html.note("For heights h without such a v, no curve satisfies (4).")
        content += [html.folded("The least sum v for every height h", none, *pieces)]
    return Section("linear", "The linear problem, solved exactly", html.joined(*content), "linear problem")


def _open(plan: SinglePlan, drawing: Drawing | None) -> Section:
    content = [html.paragraph("(4) says nothing about the heights between a and b, nor about the workspace.")]
    content += [html.paragraph(html.strong(f"{line[0].upper()}{line[1:]}.")) for line in holes(plan)]
    content.append(html.figures(drawing.charts if drawing else (), wide=True))
    return Section("open", "What (4) leaves open", html.joined(*content), "heights")


def _proved_curve(plan: SinglePlan) -> Section | None:
    closed = plan.closed
    if not isinstance(closed, ProvedCurve):
        return None
    gap: Fraction = plan.gap
    said = Markup(
        "(4) together with: not below the heights for all t from t<sub>a</sub> to t<sub>b</sub>, and in the workspace"
        " for all t. The sum of the curve is {}; a linear program with the cuts below proves that no curve has a sum"
        " below {}{}."
    ).format(
        decimal_text(closed.value, 10),
        decimal_text(closed.bound, 10),
        f", so it is at most {decimal_text(gap, 4)} too large" if gap else "",
    )
    content: list[Text] = [
        html.paragraph(said),
        html.folded("the sum exactly", html.formula([shown(mathml.number(closed.value))])),
    ]
    if plan.attainable:
        content.append(html.paragraph("Exact elimination of t gives all sums v that curves of this degree have:"))
        content.append(html.pre(str(plan.attainable)))
    cuts = [(cut.kind.value, cut.axis, brief(cut.t)) for cut in closed.cuts]
    content.append(html.folded("the cuts", html.table(("condition", "axis", "t"), cuts, numbers=(2,))))
    return Section("closed", "Method 1*: the conditions for all t", html.joined(*content), "method 1*")


def _claims(plan: SinglePlan) -> dict[str, str]:
    """What each certificate of the method says."""
    result = {
        of_axis(item.axis.name): f"Problem (4) for {item.axis.name}: the sum is the least possible one"
        if item.outcome.optimal
        else f"Problem (4) for {item.axis.name} contradicts itself"
        for item in plan.chosen
    }
    result |= {
        lowest_label(item.axis.name): f"Another curve has the same least sum of problem (4) for {item.axis.name}"
        for item in plan.chosen
    }
    result |= {above_label(name): f"The curve is not below h in {name} from t_a to t_b" for name in plan.above}
    proved = isinstance(plan.closed, ProvedCurve)
    result[CLOSED] = "No curve has a smaller sum than the bound" if proved else "No curve of this degree exists"
    return result


def summary_lines(plan: SinglePlan) -> list[str]:
    """The lines of the summary that only this method has."""
    given = plan.task
    lines = [f"degree {given.degree}, p = {given.p}, q = {given.q}; identities (2) and (3) proved"]
    lines += [f"least sum of {name}: {brief(value)}" for name, value in plan.least_sums.items()]
    lines += holes(plan)
    if plan.path is not None:
        lines += [f"{name} >= h proved for all t from t_a to t_b" for name in plan.above]
    return lines


def json_entries(plan: SinglePlan) -> dict[str, Any]:
    """The entries of the JSON summary that only this method has."""
    given, closed = plan.task, plan.closed
    data: dict[str, Any] = {
        "degree": given.degree,
        "p": given.p,
        "q": given.q,
        "times": [described(t) for t in given.times],
        "tie_break": TIE_BREAK,
        "least_sums": {name: described(value) for name, value in plan.least_sums.items()},
        "piecewise": dict(plan.pieces),
        "dips": [],
        "dips_allowed": [],
        "leaves": [],
        "closed": None,
        "cuts": [
            {"kind": cut.kind.value, "axis": cut.axis, "t": str(cut.t), "plane": [str(c) for c in cut.plane]}
            for cut in (() if closed is None else closed.cuts)
        ],
    }
    if plan.printed is not None:
        data["dips"] = [_dip(dip) for dip in plan.printed.dips]
        data["dips_allowed"] = [_dip(dip) for dip in plan.printed.allowed]
        data["leaves"] = [proof.condition.name for proof in plan.printed.leaving]
    if isinstance(closed, ProvedCurve):
        data["closed"] = {
            "sum": described(closed.value),
            "bound": described(closed.bound),
            "cuts": len(closed.cuts),
            "rounds": closed.rounds,
            "attainable": plan.attainable,
        }
    return data


def _dip(dip: Dip) -> dict[str, str]:
    return {"axis": dip.axis.name, "t": str(dip.t), **described(dip.value)}


def draw(plan: SinglePlan, folder: FilePath) -> Drawing:
    """The path in its workspace, and the heights over x with [a, b] and h marked."""
    from bezier.pictures import charts, plot
    from bezier.pictures.picture import Drawing, path_picture

    ends = {f"{NAME}0": plan.problem.start, f"{NAME}{plan.task.degree}": plan.problem.goal}
    picture = path_picture(plan.problem, plan.path, ends, region=None, hatted_names=False)
    plot.save_path(picture, folder / "path.png")
    curves = {"chosen": plan.path.curves[NAME]} if plan.path else {}
    if plan.printed is not None and not plan.printed.holds:
        curves["(4) as printed"] = plan.printed.curve
    elif plan.printed is not None and plan.printed.allowed:
        curves["allowed by (4), same sum"] = plan.printed.lowest
    heights = charts.saved(charts.profile(plan.task, curves), folder / "profile.png")
    return Drawing(picture, ("path.png", "profile.png"), plot.views(picture), heights)


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> tuple[SinglePlan, tuple[str, ...]]:
    """The plan that the files of a folder prove."""
    plan = single_restore.restore(problem, certificate, stated)
    lines = ["the linear problems (4) belong to this problem"]
    if plan.closed is not None:
        lines.append("the linear problem of Method 1* follows from its conditions for all t")
    if plan.path is not None:
        lines.append("the curve satisfies (4) and keeps its heights for all t from t_a to t_b")
    return plan, tuple(lines)
