"""What pages are made of beyond text: exact numbers, points, formulas and their names, as HTML with MathML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from html import escape
from itertools import pairwise
from typing import Any

from markupsafe import Markup

from bezier.curves.curve import Smoothness
from bezier.curves.scalar import decimal_text, dot, generator_of, rational
from bezier.curves.workspace import HalfSpace
from bezier.methods.control.system import Combination, OnPoint, System
from bezier.methods.control.terms import named_multipliers
from bezier.paths.path import Path
from bezier.plans import Plan
from bezier.report import html, mathml
from bezier.report.html import Section, Text
from qe.exact.radicals import root_text

DIGITS = 8
CONTRADICTION = (
    "Write each condition as g ≤ 0, with g = ‖·‖² − r², g = −z or g = offset − normal · p as a function of the free"
    " control points. The sum of these functions with the multipliers below is positive everywhere, so the conditions"
    " cannot hold together."
)
GIVEN = ("start", "via 1", "via 2", "goal")
SMOOTHNESS = {
    Smoothness.C2: "C² (value, first, second derivative)",
    Smoothness.C1: "C¹ (value, first derivative)",
    Smoothness.C0: "C⁰ (value)",
    Smoothness.GAP: "apart",
}


def shown(body: str) -> Markup:
    """Inline mathematics that the template does not escape."""
    return Markup(mathml.math(body))


def number(value: Any, digits: int = DIGITS) -> Markup:
    """A number as a decimal; the exact form folded where the decimal is not the whole number."""
    decimal = decimal_text(value, digits)
    return Markup(escape(decimal)) if _is_all(value, decimal) else html.folded(decimal, shown(mathml.number(value)))


def _is_all(value: Any, decimal: str) -> bool:
    """Whether the decimal is the number itself."""
    exact = rational(value)
    return exact is not None and exact == Fraction(decimal)


def point(coordinates: Sequence[Any], digits: int = DIGITS) -> Markup:
    """A point in decimals, its exact coordinates folded where that says more."""
    decimal = decimal_point(coordinates, digits)
    if all(_is_all(c, decimal_text(c, digits)) for c in coordinates):
        return Markup(escape(decimal))
    lines = [shown(f"<mi>{axis}</mi><mo>=</mo>{mathml.number(c)}") for axis, c in zip("xyz", coordinates, strict=True)]
    return html.folded(decimal, html.formula(lines))


def decimal_point(coordinates: Sequence[Any], digits: int = DIGITS) -> str:
    """A point in decimals."""
    return "(" + ", ".join(decimal_text(c, digits) for c in coordinates) + ")"


def norm(coordinates: Sequence[Any]) -> Markup:
    """The norm of a point as a decimal, with its exact form folded where its square is rational."""
    square = dot(coordinates, coordinates)
    found, decimal = rational(square), f"{float(square) ** 0.5:.6g}"
    if found is None or root_text(found) == decimal:
        return Markup(escape(decimal))
    return html.folded(decimal, shown(mathml.number_text(root_text(found))))


def names() -> dict[str, Markup]:
    """The control points as the paper writes them."""
    return {f"{p}{i}": shown(mathml.name(f"{p}{i}")) for p in "PQR" for i in range(4)}


def given(points: Mapping[str, Sequence[Any]], named: Iterable[str]) -> Markup:
    """The given points with the paper's names for them."""
    rows = [
        (words, shown(mathml.name(name)), point(p), norm(p))
        for words, p, name in zip(GIVEN, points.values(), named, strict=True)
    ]
    return html.table(("point", "in the paper", "coordinates (mm)", "distance from the origin (mm)"), rows)


def question(plan: Plan, system: System) -> list[Markup]:
    """The formula in the paper's notation, with the given points below it."""
    shape = system.shape
    equations = [f"{mathml.name(point)}<mo>=</mo>{_combination(terms)}" for point, terms in shape.follows.items()]
    body = "<mo>∧</mo>".join(
        f"<mrow><mo>(</mo>{part}<mo>)</mo></mrow>" for part in [*equations, *map(_condition, system.conditions)]
    )
    bound = "".join(f"<mo>∃</mo>{mathml.name(point)}" for point in shape.follows)
    radius = mathml.number_text(plan.problem.workspace.radius_text)
    values = [f"{mathml.name(name)}<mo>=</mo>{mathml.vector(system.given[name])}" for name in ("Q0", "R0")]
    where = "<mo>,</mo><mspace width='0.8em'/>".join([*values, f"<mi>r</mi><mo>=</mo>{radius}"])
    whole = Markup(mathml.lines(f"{bound}<mspace width='0.4em'/><mo>(</mo>{body}<mo>)</mo>"))
    return [whole, shown(where)]


def _combination(terms: Combination) -> str:
    pieces: list[str] = []
    for coefficient, point in terms:
        sign = "<mo>−</mo>" if coefficient < 0 else "<mo>+</mo>" if pieces else ""
        size = abs(coefficient)
        pieces.append(sign + ("" if size == 1 else mathml.number(size)) + mathml.name(point))
    return "".join(pieces)


def _condition(item: OnPoint) -> str:
    """A condition on a control point; norms and heights as in the paper."""
    point, condition = mathml.name(item.point), item.condition
    match condition.name, condition:
        case "ball", _:
            return f"<mo>‖</mo>{point}<mo>‖</mo><mo>≤</mo><mi>r</mi>"
        case "floor", _:
            return f"<msub><mrow><mo>(</mo>{point}<mo>)</mo></mrow><mi>z</mi></msub><mo>≥</mo><mn>0</mn>"
        case _, HalfSpace(normal, offset):
            return f"{mathml.vector(normal)}<mo>·</mo>{point}<mo>≥</mo>{mathml.number(-offset)}"
    return f"{point}<mo>∈</mo><mtext>{escape(condition.name)}</mtext>"


def contradiction(system: System, certified: Any, reason: str, *more: Text) -> Section:
    """Why there is no path, with the multipliers that prove it."""
    proof = multipliers(system, certified)
    shown_proof = [html.heading("The proof"), html.paragraph(CONTRADICTION), proof] if proof else []
    return no_path(reason, *more, *shown_proof)


def no_path(reason: str, *more: Text) -> Section:
    """Why there is no path."""
    first = html.paragraph(html.strong(f"{reason[0].upper()}{reason[1:]}."))
    return Section("none", "Why there is no path", html.joined(first, *more))


def bounds(region: Any, variables: Iterable[str]) -> Markup:
    """The least and greatest value of each coordinate."""
    if region.is_empty:
        return Markup("")
    rows = [(shown(mathml.name(name)), *map(_end, region.bounds(name), ("−∞", "∞"))) for name in variables]
    return html.table(("coordinate", "least", "greatest"), rows)


def _end(value: Any, unbounded: str) -> Markup:
    return Markup(unbounded) if value is None else number(value)


def multipliers(system: System, optimum: Any, what: str = "condition") -> Markup:
    """The non-zero multipliers with the conditions they belong to."""
    rows = [(on_point(label), number(value)) for label, value in named_multipliers(system, optimum)]
    return html.table((what, "multiplier"), rows)


def optimum(plan: Plan, system: System, certified: Any, title: Text, free_minimum: str) -> Section | None:
    """The best free control points and those that follow; ``free_minimum`` describes the unconstrained minimum."""
    if plan.path is None:
        return None
    if plan.bound is not None:
        active = f"Conditions that bound it: {', '.join(map(on_point, plan.active))}."
    elif plan.active:
        active = f"Conditions that hold with equality there: {', '.join(map(on_point, plan.active))}."
    else:
        active = f"No condition is active: {free_minimum}, is allowed."
    squares = (
        f"<msup><mrow><mo>‖</mo>{mathml.name(b)}<mo>−</mo>{mathml.name(a)}<mo>‖</mo></mrow><mn>2</mn></msup>"
        for a, b in pairwise(system.shape.route)
    )
    theta = generator_of(c for place in plan.path.points.values() for c in place)
    said = f"All coordinates lie in one number field, generated by {theta}, about {float(theta or 0):.8g}"
    content = (
        html.paragraph(Markup("The paper asks for the least {}.").format(shown("<mo>+</mo>".join(squares)))),
        least(plan),
        control_points(plan.path),
        html.paragraph(active),
        multipliers(system, certified, "active condition"),
        None if theta is None else html.note(f"{said}; root(k, p) is the k-th real root of p in ascending order."),
    )
    return Section("best", title, html.joined(*content), short="optimum")


def least(plan: Plan) -> Markup:
    """The value of the objective."""
    decimal = decimal_text(plan.objective, 12)
    said = html.paragraph(Markup("It is {} {}.").format(decimal, plan.unit))
    if plan.bound is not None:
        low = decimal_text(plan.bound, 12)
        near = Markup("At these control points it is {} {unit}, and no choice has less than {} {unit}, proved.")
        said = html.paragraph(near.format(decimal, low, unit=plan.unit))
    if _is_all(plan.objective, decimal):
        return said
    return said + html.folded("exactly", html.formula([shown(mathml.number(plan.objective))]))


def control_points(path: Path) -> Markup:
    """All control points."""
    rows = [(shown(mathml.name(name)), point(p)) for name, p in path.points.items()]
    return html.table(("control point", "coordinates (mm)"), rows)


def on_point(label: str) -> str:
    """A condition on a control point in words."""
    point, _, condition = label.partition(".")
    known = {"": f"‖{point}‖ ≤ r", "z": f"{point} not below the table", "speed": f"speed at the join next to {point}"}
    return known.get(condition, f"{point} in {condition}")


def question_with_answer(plan: Plan, name: str, lines: Iterable[Text], counts: str) -> Markup:
    """The question in the paper's notation and the quantifier-free answer, both also as text, with a link to its
    derivation; ``name``: what the plan calls the question."""
    formula, answer = plan.formula, plan.answer.formula
    parts = [Markup(line) for line in mathml.conjunction_lines(answer)]
    linked = [part + Markup(" <math><mo>∧</mo></math>") for part in parts[:-1]] + parts[-1:]
    return html.joined(
        html.formula(lines),
        html.note(f"Written out: {counts}."),
        html.folded("as handed to the engine", html.pre(formula)),
        html.heading("The quantifier-free answer"),
        html.formula(linked),
        html.folded("as text", html.pre(str(answer))),
        derived(plan, name),
    )


def derived(plan: Plan, name: str) -> Markup | None:
    """The line that links to the derivation of an answer; None where there is none."""
    if name not in plan.derivations:
        return None
    return html.paragraph(html.joined("How it was found:", derivation_link(plan, name)))


def derivation_link(made: Any, name: str) -> Markup:
    """A link to the page with the derivation of an answer of a plan or a comparison."""
    count, file = len(made.derivations[name].rules), made.derivation_pages[name]
    few = ("no step was needed, checked", "1 step, with its theorem, checked")
    words = few[count] if count < len(few) else f"{count} steps, each with its theorem, all checked"
    return Markup('<a href="{}">{}</a>').format(file, words)


def cells(region: Any) -> list[Markup]:
    """The cells of the region, one line per variable."""
    return [html.formula(Markup(line) for line in mathml.cell(piece)) for piece in region.cells]
