"""The cubic method for the rest of the program: words, entries, pictures and checks around its plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from bezier.curves.scalar import brief, described
from bezier.methods.control import optimal_path
from bezier.methods.control.system import System
from bezier.methods.control.terms import named_multipliers
from bezier.methods.cubic import formula as cubic
from bezier.paths.path import Path, Slowest, slowest_of
from bezier.plans import Begun, Clock, Stated, Story
from bezier.problem import Problem
from bezier.report import html, mathml, parts
from bezier.report.first import region_box
from bezier.report.html import Section, toned
from bezier.report.page import curve_name
from bezier.report.parts import shown
from qe.formula.syntax import Formula
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


FORMULA = "formula (7)"
"""What the engine is asked."""


@dataclass(frozen=True, slots=True)
class Trivial:
    """The choice Q1 = Q0, Q2 = R0, which always satisfies formula (7) as printed."""

    path: Path
    """Through it."""
    violated: tuple[str, ...]
    """The problem's further conditions that it violates."""
    slowest: Mapping[str, Slowest]
    """Each curve's least speed, which is zero at the joins."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class CubicPlan(optimal_path.SystemPlan):
    """``slowest``: of each curve of the path (empty without a path)."""

    slowest: Mapping[str, Slowest]
    trivial: Trivial


def begin(problem: Problem, clock: Clock) -> Begun:
    """The path of formula (7)."""
    return optimal_path.begun(problem, cubic.system(problem), clock)


def finish(given: Begun, clock: Clock) -> CubicPlan:
    """The plan with formula (7)."""
    found: dict[str, Any] = given.found
    system = found["system"]
    with clock.step("speed"):
        fields = found | _speed_fields(given.problem, system, given.path)
    members = _members(system, found["optimum"].certificate)
    return CubicPlan(**optimal_path.verified(fields, members, clock), eliminations={FORMULA: found["answer"]})


def questions(problem: Problem) -> dict[str, Formula]:
    """What is asked of the engine about a problem."""
    return {FORMULA: cubic.system(problem).statement().formula}


def _members(system: System, certificate: Certificate) -> optimal_path.Members:
    return [optimal_path.elimination(system), *optimal_path.optimum_members(certificate)]


def _speed_fields(problem: Problem, system: System, path: Path | None) -> dict[str, Any]:
    """What only the plan of this method has."""
    points = system.points(cubic.trivial_choice(problem))
    there = optimal_path.path_through(problem, system, points)
    trivial = Trivial(there, system.violated(points), slowest_of(there))
    return {"slowest": slowest_of(path) if path else {}, "trivial": trivial, "remarks": _remarks(problem)}


def _remarks(problem: Problem) -> tuple[str, ...]:
    result = []
    if problem.ratio != 1:
        result.append(f"the outer curves take {problem.ratio} of the time of the middle one")
    if problem.join_speed:
        result.append(
            f"a speed of at least {problem.join_speed} mm per unit of time at both joins is required, in the form of a"
            " speed in the direction from Q0 to R0"
        )
    return tuple(result)


NAMES = ("P0", "Q0", "R0", "R3")
REPORTED = (
    "The paper reports that quantifier elimination for formula (7) was computationally expensive and had not yet been"
    " successful."
)
INTERIOR = "the unconstrained minimum, Q1 = (2 Q0 + R0)/3 and Q2 = (Q0 + 2 R0)/3"


def story(plan: CubicPlan, drawing: Drawing | None) -> Story:
    """What the page says in this method's own words."""
    solved, names = plan.path is not None, parts.names()
    further = len(plan.system.conditions) - len(plan.system.shape.inner)
    counts = "18 variables, 12 of them quantified, 12 equations, 6 norm conditions"
    more = f", {further} further conditions" if further else ""
    formulas = parts.question_with_answer(plan, FORMULA, parts.question(plan, plan.system), counts + more)
    title = Markup("The best {} and {}").format(names["Q1"], names["Q2"])
    sections = (
        Section("question", "The question", _intro(plan) + formulas),
        _region(drawing),
        parts.optimum(plan, plan.system, plan.optimum, title, INTERIOR),
        _stops(plan, drawing) if solved else None,
        _cusp(plan),
    )
    claim = "The chosen Q1 and Q2 are the global optimum"
    return Story(
        kind="three cubic Bézier curves",
        place="4.2",
        given=NAMES,
        claims={"optimum": claim if solved else "The conditions on Q1 and Q2 contradict each other"},
        none=None if solved else parts.contradiction(plan.system, plan.optimum, reason(plan)),
        sections=tuple(section for section in sections if section is not None),
        reported=REPORTED,
    )


def reason(plan: CubicPlan) -> str:
    """Why there are no control points, in one sentence."""
    used = ", ".join(label for label, _ in named_multipliers(plan.system, plan.optimum))
    shown = f"no control points exist: the conditions on {used} contradict each other (the certificate shows it)"
    return shown if plan.radius_rule is None else f"{shown}; {plan.radius_rule.in_words()}"


def speed_text(slow: Slowest) -> str:
    """The least speed of a curve in words."""
    if slow.stops:
        return f"stops at t = {', '.join(str(low) if low == high else f'{float(low):.6g}' for low, high in slow.stops)}"
    return f"never slower than {slow.least.to_json(6)['low']}"


def _intro(plan: CubicPlan) -> Markup:
    text = Markup(
        "Formula (7) of the paper: which {Q1} and {Q2} leave room for {P1}, {P2}, {R1} and {R2} such that both joins"
        " are C² and all six control points stay in the workspace?"
    ).format(**parts.names())
    if plan.problem.ratio != 1:
        text += Markup(
            " The outer curves take {} of the time of the middle one; velocity and acceleration with respect to time"
            " are what agrees at the joins."
        ).format(parts.number(plan.problem.ratio))
    return html.paragraph(text)


def _region(drawing: Drawing | None) -> Section | None:
    if drawing is None or drawing.picture.region is None:
        return None
    names = parts.names()
    said = Markup(
        "The conditions leave a convex set of pairs ({Q1}, {Q2}) in six dimensions. Its slice with {Q2} at the optimum"
        " is a set of {Q1}, bounded by spheres and planes:"
    ).format(**names)
    box = region_box(drawing.picture.region, "the places of the first free control point, seen in space")
    return Section(
        "region", Markup("Room around the best {}").format(names["Q1"]), html.paragraph(said) + box, "region"
    )


def _stops(plan: CubicPlan, drawing: Drawing | None) -> Section:
    said = (
        'Where a path stops, it may turn on the spot, and "C²" says nothing about its direction. Least speed of each'
        " curve, proved for all t (mm per unit of time):"
    )
    content = [html.paragraph(said), _speeds(plan.slowest)]
    if plan.problem.join_speed:
        required = Markup(
            "Required at both joins: a speed of at least {} in the direction from {} to {}, hence at least this speed."
        ).format(plan.problem.join_speed, parts.names()["Q0"], parts.names()["R0"])
        content.append(html.paragraph(required))
    content.append(html.figures(drawing.charts if drawing else (), wide=True))
    return Section("stops", "Does it ever stop?", html.joined(*content), "stops")


def _speeds(speeds: Mapping[str, Slowest]) -> Markup:
    rows = [(curve_name(name), toned(speed_text(slow), not slow.stops)) for name, slow in speeds.items()]
    return html.table(("curve", "least speed"), rows)


def _cusp(plan: CubicPlan) -> Section:
    """The choice Q1 = Q0, Q2 = R0 with this problem's numbers."""
    result = plan.trivial
    if result.violated:
        allowed = f"Here further conditions forbid it: {', '.join(map(parts.on_point, result.violated))}."
    elif plan.radius_rule is not None:
        allowed = f"Here it satisfies every condition, and in part it is forced: {plan.radius_rule.in_words()}."
    else:
        allowed = "Here it satisfies every condition, so control points exist; the objective is what avoids it."
    said = Markup(
        "With {Q1} = {Q0} and {Q2} = {R0} all other control points are {Q0}, {R0} or lie between them (for outer curves"
        " that do not take longer than the middle one), so formula (7) as printed always has a solution. But then the"
        " velocity vanishes at both joins: the first curve comes back to {Q0} from the direction of {R0}, stops there,"
        " and the second one leaves in the direction of {R0} again. Value and both derivatives agree, and yet the path"
        " turns round: a cusp."
    ).format(**parts.names())
    points = [(shown(mathml.name(name)), parts.point(result.path.points[name])) for name in plan.system.shape.inner]
    content = (
        html.paragraph(said),
        html.paragraph(html.strong(allowed)),
        html.table(("control point", "in the trivial choice"), points),
        html.note(f"Joins: {parts.SMOOTHNESS[result.path.smoothness]}."),
        _speeds(result.slowest),
    )
    return Section("cusp", "Why the objective matters: the cusp", html.joined(*content), "cusp")


def summary_lines(plan: CubicPlan) -> list[str]:
    """The lines of the summary that only this method has."""
    if plan.path is None:
        return []
    best = [f"best {name} = ({', '.join(map(brief, plan.path.points[name]))})" for name in plan.system.shape.free]
    return [*best, *(f"{name}: {speed_text(slow)}" for name, slow in plan.slowest.items())]


def json_entries(plan: CubicPlan) -> dict[str, Any]:
    """The entries of the JSON summary that only this method has."""
    multipliers = named_multipliers(plan.system, plan.optimum)
    return {
        "multipliers": [{"condition": label, **described(value)} for label, value in multipliers],
        "least_speed": {name: slow.least.to_json() for name, slow in plan.slowest.items()},
        "joins": [item.join.smoothness.name for item in plan.path.joins] if plan.path else [],
        "trivial_choice": {"violates": list(plan.trivial.violated), "smoothness": plan.trivial.path.smoothness.name},
    }


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
    from bezier.pictures import charts

    over_time = charts.saved(charts.motion(plan.path), folder / "motion.png")
    return Drawing(picture, (*written, "motion.png"), plot.views(picture), over_time)


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> tuple[CubicPlan, tuple[str, ...]]:
    """The plan that the certificates of a folder prove; nothing else in the folder is needed for it."""
    system = cubic.system(problem)
    optimum = optimal_path.restored_optimum(system, certificate)
    fields = optimal_path.drawn(problem, system, optimum)
    fields |= _speed_fields(problem, system, fields["path"])
    plan = CubicPlan(**optimal_path.restored(fields, _members(system, optimum.certificate)))
    lines = [
        "the elimination belongs to formula (7) of this problem",
        "the optimum belongs to formula (7) of this problem",
    ]
    if problem.join_speed and plan.path is not None:
        lines.append(f"the conditions for a speed of at least {problem.join_speed} at both joins hold")
    return plan, tuple(lines)
