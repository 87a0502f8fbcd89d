"""The quadratic method for the rest of the program: words, files, pictures and checks around its plan."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from bezier.curves.containment import Leaves
from bezier.curves.scalar import decimal_text, exact_text, with_decimal
from bezier.methods.quadratic import formula as quadratic
from bezier.methods.quadratic.plan import FORMULA, QuadraticPlan, above_label
from bezier.methods.quadratic.plan import begin as begin
from bezier.methods.quadratic.plan import finish as finish
from bezier.methods.quadratic.plan import questions as questions
from bezier.methods.quadratic.plan import restore as restore
from bezier.plans import Story
from bezier.report import html, mathml, parts
from bezier.report.first import region_box
from bezier.report.html import Section, Text, toned
from bezier.report.parts import norm, shown
from qe.exact.radicals import root_text

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


REPORTED = (
    "The paper reports about 15.4 s for formula (8) with a general computer algebra system on a laptop of 2018 (other"
    " points, other machine)."
)
NAMES = ("P0", "Q0", "R0", "R2")


def story(plan: QuadraticPlan, drawing: Drawing | None) -> Story:
    """What the page says in this method's own words."""
    names = parts.names()
    further = len(plan.system.conditions) - len(quadratic.SHAPE.inner)
    counts = "9 variables, 6 of them quantified, 6 equations, 3 norm conditions"
    more = f", {further} further conditions" if further else ""
    intro = Markup(
        "Formula (8) of the paper: which {Q1} leave room for {P1} and {R1} such that both joins are C¹ and all three"
        " control points stay in the workspace?"
    ).format(**names)
    formulas = parts.question_with_answer(plan, FORMULA, parts.question(plan, plan.system), counts + more)
    title, free = Markup("The best {}").format(names["Q1"]), "the unconstrained minimum, the midpoint of the via points"
    sections = (
        Section("question", "The question", html.paragraph(intro) + formulas),
        _region(plan, drawing),
        parts.optimum(plan, plan.system, plan.optimum, title, free),
        _table(plan, drawing),
    )
    return Story(
        kind="three quadratic Bézier curves",
        place="4.2.1",
        given=NAMES,
        claims={
            "region": "The answer describes exactly the region: every cell has the truth value stated",
            "optimum": "The chosen Q1 is the global optimum"
            if plan.path
            else "The conditions on Q1 contradict each other",
            "below the table": "The printed formula allows the example below the table",
            **{above_label(p): f"The printed formula keeps {p} above the table" for p in quadratic.SHAPE.inner},
        },
        none=None if plan.path else _infeasibility(plan),
        sections=tuple(section for section in sections if section is not None),
        reported=REPORTED,
    )


def reason(plan: QuadraticPlan) -> str:
    """Why there is no control point, in one sentence with the numbers, and what the radius has to do with it."""
    return "; ".join([_balls_reason(plan), *([plan.radius_rule.in_words()] if plan.radius_rule else [])])


def _balls_reason(plan: QuadraticPlan) -> str:
    balls = plan.balls
    radius = plan.problem.workspace.radius_text
    if balls.meet:
        return (
            "no control point exists: the three balls meet, but nowhere do all control points also satisfy the other"
            " conditions (the certificate shows it)"
        )
    shape = "acute" if balls.is_acute else "right or obtuse or flat"
    return (
        f"no control point exists: the balls of radius r = {_root(radius, balls.radius_squared)} about O, 2 Q0 and"
        f" 2 R0 have no common point; the triangle O, Q0, R0 is {shape}, so r would have to be at least"
        f" {_root(balls.needed_text, balls.needed_squared)}"
    )


def _root(exact: str, square: Fraction) -> str:
    return with_decimal(exact, f"{float(square) ** 0.5:.6g}")


def _region(plan: QuadraticPlan, drawing: Drawing | None) -> Section:
    """The region of Q1: its picture, its bounds and its cells."""
    name = parts.names()["Q1"]
    content: list[Text] = [html.paragraph(_region_sentence(plan))]
    if drawing is not None and drawing.picture.region is not None:
        content.append(region_box(drawing.picture.region, "the possible places of Q1, seen in space"))
    bounds, cells = parts.bounds(plan.region, quadratic.FREE), parts.cells(plan.region)
    if bounds:
        content += [html.heading("Bounds"), bounds]
    if cells:
        said = (
            f"Every point of the region lies in exactly one of these {len(cells)} cells; each bound depends only on the"
            " variables above it."
        )
        count = f"{len(cells)} cell{'s' * (len(cells) != 1)}"
        content += [html.heading("Cylindrical description"), html.folded(count, html.note(said), *cells)]
    return Section("region", Markup("The region of {}").format(name), html.joined(*content), "region")


def _region_sentence(plan: QuadraticPlan) -> str:
    """What kind of set the region is."""
    region = plan.region
    if region.is_empty:
        return "The region is empty, proved by a cylindrical algebraic decomposition."
    shape = {0: "points", 1: "a curve", 2: "a surface", 3: "a solid"}.get(region.dimension, "a set")
    count = len(region.cells)
    return (
        f"The region is not empty and has dimension {region.dimension}: {shape}."
        f" A cylindrical algebraic decomposition describes it by {count} cell{'s' if count != 1 else ''}."
    )


def _infeasibility(plan: QuadraticPlan) -> Section:
    """Why there is no control point."""
    balls = plan.balls
    labels = ("|Q0|²", "|R0|²", "|Q0 − R0|²")
    rows: list[tuple[Text, Text]] = [
        (label, parts.number(v)) for label, v in zip(labels, balls.sides_squared, strict=True)
    ]
    for label, square in (("radius r", balls.radius_squared), ("least radius that would do", balls.needed_squared)):
        exact, decimal = root_text(square), f"{float(square) ** 0.5:.8g}"
        folded = html.folded(decimal, shown(mathml.number_text(exact)))
        rows.append((label, decimal if exact == decimal else folded))
    text = (
        "Q1 has to lie in the three balls of radius r about O, 2 Q0 and 2 R0. They have a common point exactly when the"
        " smallest circle around the triangle O, Q0, R0 has a radius of at most r/2. "
    )
    text += (
        "The triangle is acute, so that circle goes through all three corners."
        if balls.is_acute
        else "The triangle has no acute shape, so its longest side is the diameter of that circle."
    )
    if balls.meet:
        text = "The three balls of radius r about O, 2 Q0 and 2 R0 meet, but not where the other conditions hold."
    suggestion = (
        'Try method = "cubic": with three cubic curves, formula (7), control points always exist (Q1 = Q0, Q2 = R0 is'
        " one choice)."
    )
    more = (html.paragraph(suggestion), html.paragraph(text), html.table(("", "value"), rows))
    return parts.contradiction(plan.system, plan.optimum, reason(plan), *more)


def _table(plan: QuadraticPlan, drawing: Drawing | None) -> Section:
    """The hemisphere question."""
    result, names = plan.gap, parts.names()
    content: list[Text] = [
        html.paragraph(
            "The printed formula keeps the control points in the ball, not in the hemisphere: it has no condition on z."
        )
    ]
    if result.example is None:
        said = (
            "For this problem it makes no difference: no allowed control point lies below the table"
            " (decided by elimination)."
        )
        content.append(html.paragraph(html.strong(said)))
    else:
        radius = plan.problem.workspace.radius_text
        said = f"For this problem that matters: with r = {radius}, it allows control points below the table."
        rows = [
            (shown(mathml.name(name)), toned(parts.point(p), False if float(p[2]) < 0 else None), norm(p))
            for name, p in result.example.items()
        ]
        content += [
            html.paragraph(html.strong(said)),
            html.table(("example", "coordinates (mm)", "distance from the origin (mm)"), rows),
        ]
    if plan.gap.chosen:
        bad = [f"{p.curve} at t = {p.outcome.t}" for p in plan.gap.chosen if isinstance(p.outcome, Leaves)]
        stays = "The chosen path itself stays above the table: z ≥ 0 is proved along all three curves."
        content.append(html.paragraph(f"The chosen path goes below the table: {', '.join(bad)}." if bad else stays))
    if said := _corrected(plan):
        content += [html.heading("The corrected region"), html.paragraph(said)]
    extra = {} if drawing is None else drawing.picture.extra
    if "corrected" in extra and "printed" in extra:
        above = Markup("with z ≥ 0 for {P1}, {Q1} and {R1}").format(**names)
        first, only = "the region as printed, seen in space", "the ball conditions only, as printed"
        pair = [
            region_box(extra["printed"], first, only),
            region_box(extra["corrected"], "the corrected region, seen from the same side", above, extra["printed"]),
        ]
        content.append(Markup('<div class="views wide">{}</div>').format(html.joined(*pair)))
    return Section("table", "Above the table?", html.joined(*content), "table")


def _corrected(plan: QuadraticPlan) -> str:
    region = plan.gap.region
    if region is None:
        return ""
    if region.is_empty:
        return "With z ≥ 0 added for all three control points, nothing is left: the corrected region is empty."
    low, high = region.bounds(quadratic.FREE[2])
    ends = " and ".join(f"{decimal_text(v, 6)}" for v in (low, high))
    count = len(region.cells)
    return (
        "With z ≥ 0 added for all three control points the region becomes smaller:"
        f" {count} cell{'s' if count != 1 else ''}, dimension {region.dimension}, z between {ends}."
    )


def summary_lines(plan: QuadraticPlan) -> list[str]:
    """The lines of the summary that only this method has."""
    table = "formula (8) has no condition z ≥ 0; here " + (
        "it allows control points below the table (example in the report)"
        if plan.gap.can_leave
        else "every admissible control point has z ≥ 0 anyway"
    )
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
    data: dict[str, Any] = {"leaves_hemisphere": {"allowed": plan.gap.can_leave, "chosen": dips}}
    if plan.path is None:
        data["suggestion"] = 'method = "cubic"'
    return data


def draw(plan: QuadraticPlan, folder: FilePath) -> Drawing:
    """The region of Q1, the path, and the region with z >= 0 where that makes a difference."""
    from bezier.pictures import plot
    from bezier.pictures.picture import Drawing, path_picture, region_picture

    named = quadratic.as_conditions_on_q1(plan.system)
    chosen = plan.path.points["Q1"] if plan.path else None
    region = None if plan.region.is_empty else region_picture(named, named, chosen)
    extra = {}
    if plan.gap.region is not None and not plan.gap.region.is_empty:
        both = quadratic.as_conditions_on_q1(quadratic.corrected(plan.problem))
        printed = region_picture(both[:3], both, None)
        corrected = region_picture(both, both, None)
        if printed is not None and corrected is not None:
            extra = {"printed": printed, "corrected": corrected}
    picture = path_picture(plan.problem, plan.path, plan.system.given, region=region, extra=extra)
    plot.save_region(picture, folder / "region.png", "Where Q\u0302₁ may be: the region of formula (8)")
    plot.save_path(picture, folder / "path.png")
    return Drawing(picture, ("region.png", "path.png"), plot.views(picture))
