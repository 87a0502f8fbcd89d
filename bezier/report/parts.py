"""What the pages of all methods show, as plain values for the templates: numbers and formulas already as MathML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from itertools import pairwise
from typing import Any

from markupsafe import Markup

from bezier.curves.containment import Argument, Inside
from bezier.curves.curve import Smoothness
from bezier.curves.scalar import decimal_text, dot, exact_text, is_zero, rational
from bezier.curves.workspace import Condition, HalfSpace, WorkspaceKind, root_text
from bezier.methods.control.system import Combination, OnPoint, System
from bezier.methods.control.terms import named_multipliers
from bezier.paths.path import Path, Proof, speed_at_joins
from bezier.plans import Outcome, Plan
from bezier.report import mathml, mathml_cells

Row = dict[str, Any]
LONG = 120
"""Characters of exact coordinates that a table shows openly."""
CONTRADICTION = (
    "Write each condition as g ≤ 0, with g = ‖·‖² − r², g = −z or g = offset − normal · p as a function of the free"
    " control points. The sum of these functions with the multipliers below is positive everywhere, so the conditions"
    " cannot hold together."
)
RESULTS = {
    Outcome.SOLVED: "path found",
    Outcome.INFEASIBLE: "no control point exists",
    Outcome.BLOCKED: "an obstacle is in the way",
    Outcome.TOO_FAST: "a limit of the motion is not kept",
    Outcome.OUT_OF_REACH: "the arm cannot follow the path",
}
SMOOTHNESS = {
    Smoothness.C2: "C² (value, first, second derivative)",
    Smoothness.C1: "C¹ (value, first derivative)",
    Smoothness.C0: "C⁰ (value)",
    Smoothness.GAP: "apart",
}


def shown(body: str) -> Markup:
    """Inline mathematics that the template does not escape."""
    return Markup(mathml.math(body))


def exact(value: Any) -> Markup:
    """An exact number, folded up if its minimal polynomial is long."""
    number = mathml.number(value)
    return shown(number) if len(exact_text(value)) <= LONG else _folded("minimal polynomial", [number])


def exact_point(point: Sequence[Any]) -> Markup:
    """An exact point, folded up if the minimal polynomials of its coordinates are long."""
    if sum(len(exact_text(c)) for c in point) <= LONG:
        return shown(mathml.vector(point))
    lines = [f"<mi>{axis}</mi><mo>=</mo>{mathml.number(c)}" for axis, c in zip("xyz", point, strict=True)]
    return _folded("minimal polynomials", lines)


def _folded(summary: str, lines: Iterable[str]) -> Markup:
    body = "".join(f"<div>{shown(line)}</div>" for line in lines)
    return Markup(f"<details><summary>{summary}</summary><div class='scroll'>{body}</div></details>")


def decimal_point(point: Sequence[Any]) -> str:
    """A point in decimals."""
    return "(" + ", ".join(decimal_text(c, 8) for c in point) + ")"


def norm(point: Sequence[Any]) -> Markup:
    """The exact norm of a point where its square is rational, a decimal otherwise."""
    square = dot(point, point)
    number = rational(square)
    if number is None:
        return Markup(escape(f"≈ {float(square) ** 0.5:.6g}"))
    return shown(mathml.number_text(root_text(number)))


def cards(plan: Plan) -> list[Row]:
    """The figures at the top of the page."""
    found = [card("result", RESULTS[plan.outcome], tone(plan.outcome is Outcome.SOLVED))]
    found.append(card("radius", f"{float(plan.problem.workspace.radius_squared) ** 0.5:.6g} mm"))
    if plan.objective is not None:
        found.append(card("objective", f"{decimal_text(plan.objective, 8)} {plan.unit}"))
        found.append(card("active conditions", ", ".join(plan.active) or "none"))
    if plan.radius_rule is not None and plan.path is not None:
        found.append(card("the radius forces", f"a stop at {' and '.join(plan.radius_rule.forced)}", tone(False)))
    if plan.heights is not None and plan.heights.strip is not None:
        kept = plan.heights.hold
        found.append(card("heights a ≤ x ≤ b", "kept on all curves" if kept else "not kept on all curves", tone(kept)))
    found.append(card("certified", "yes" if plan.certified else "not everything", tone(plan.certified)))
    found.append(card("computed in", f"{sum(plan.seconds.values()):.2f} s"))
    return found


def card(label: str, value: str, tone: str = "") -> Row:
    """One figure."""
    return {"label": label, "value": value, "tone": tone}


def given(plan: Plan, names: Iterable[str]) -> list[Row]:
    """The four given points with the paper's names for them."""
    return [
        {"key": key, "name": shown(mathml.name(name)), "point": shown(mathml.vector(p)), "norm": norm(p)}
        for (key, p), name in zip(plan.problem.named_points.items(), names, strict=True)
    ]


def workspace_text(plan: Plan) -> str:
    """The workspace in words."""
    if plan.problem.workspace.kind is WorkspaceKind.HEMISPHERE:
        return "the upper half (z ≥ 0) of the ball about the origin"
    return "the ball about the origin"


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
    return [shown(f"<mrow>{bound}<mspace width='0.4em'/><mo>(</mo>{body}<mo>)</mo></mrow>"), shown(where)]


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


def contradiction(system: System, found: Any, reason: str) -> Row:
    """Why there is no path, with the multipliers that prove it."""
    return {
        "reason": reason[0].upper() + reason[1:],
        "explanation": "",
        "ball_rows": [],
        "multipliers": multipliers(system, found),
        "multiplier_text": CONTRADICTION,
        "suggestion": "",
    }


def bounds(region: Any, variables: Iterable[str]) -> list[Row]:
    """The exact least and greatest value of each coordinate."""
    if region.is_empty:
        return []
    rows = []
    for variable in variables:
        low, high = region.bounds(variable)
        rows.append(
            {
                "name": shown(mathml.name(variable)),
                "low": _end(low, "−∞"),
                "low_decimal": "" if low is None else decimal_text(low, 8),
                "high": _end(high, "∞"),
                "high_decimal": "" if high is None else decimal_text(high, 8),
            }
        )
    return rows


def _end(value: Any, unbounded: str) -> Markup:
    return shown(f"<mi>{unbounded}</mi>") if value is None else exact(value)


def multipliers(system: System, optimum: Any) -> list[Row]:
    """The non-zero multipliers with the conditions they belong to."""
    return [
        {"label": on_point(label), "value": exact(value), "decimal": decimal_text(value, 8)}
        for label, value in named_multipliers(system, optimum)
    ]


def optimum(plan: Plan, system: System, found: Any, free_minimum: str) -> Row | None:
    """The best free control points and those that follow; ``free_minimum`` describes the unconstrained minimum."""
    if plan.path is None:
        return None
    points = [
        {
            "name": shown(mathml.name(name)),
            "exact": exact_point(point),
            "decimal": decimal_point(point),
        }
        for name, point in plan.path.points.items()
    ]
    if plan.active:
        active = f"Conditions that hold with equality there: {', '.join(map(on_point, plan.active))}."
    else:
        active = f"No condition is active: {free_minimum}, is allowed."
    return {
        "objective": objective_formula(system.shape.route),
        "value": exact(plan.objective),
        "decimal": decimal_text(plan.objective),
        "points": points,
        "active": active,
        "multipliers": multipliers(system, found),
        "field": field_text(plan.path),
    }


def objective_formula(route: Sequence[str]) -> Markup:
    """The sum of |b - a|^2 along the route."""
    squares = [
        f"<msup><mrow><mo>‖</mo>{mathml.name(b)}<mo>−</mo>{mathml.name(a)}<mo>‖</mo></mrow><mn>2</mn></msup>"
        for a, b in pairwise(route)
    ]
    return shown("<mo>+</mo>".join(squares))


def on_point(label: str) -> str:
    """A condition on a control point in words."""
    point, _, condition = label.partition(".")
    known = {"": f"‖{point}‖ ≤ r", "z": f"{point} not below the table", "speed": f"speed at the join next to {point}"}
    return known.get(condition, f"{point} in {condition}")


def field_text(path: Path) -> str:
    """The number field of the coordinates, when they are irrational."""
    for point in path.points.values():
        for value in point:
            if rational(value) is None and hasattr(value, "field"):
                terms = plan_polynomial(value.field.minimal_polynomial)
                near = float(value.field.theta)
                return (
                    f"All coordinates lie in one number field, generated by the root of {terms} near {near:.8g};"
                    " root(k, p) is the k-th real root of p in ascending order."
                )
    return ""


_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def plan_polynomial(coefficients: Sequence[int]) -> str:
    """A univariate polynomial in theta as text."""
    pieces: list[str] = []
    for k, c in reversed(list(enumerate(coefficients))):
        if c:
            power = "" if k == 0 else "θ" if k == 1 else f"θ{str(k).translate(_RAISED)}"
            size = str(abs(c)) if abs(c) != 1 or not power else ""
            sign = " − " if c < 0 else " + "
            pieces.append((sign if pieces or c < 0 else "") + size + power)
    return "".join(pieces).strip()


_TESTS = {
    Argument.POLYGON: "control polygon (all control points satisfy it, and the set is convex)",
    Argument.BERNSTEIN: "Bernstein coefficients of the distance to the boundary, all ≥ 0 after bisection",
    Argument.ROOTS: "square-free part of the distance to the boundary: it touches zero but does not cross",
}


def proofs(found: Iterable[Proof]) -> list[Row]:
    """One row per curve and condition."""
    rows = []
    for proof in found:
        row: Row = {"curve": shown(mathml.name(proof.curve) + "<mo>(</mo><mi>t</mi><mo>)</mo>")}
        row["condition"] = condition_name(proof.condition)
        if isinstance(proof.outcome, Inside):
            rows.append(row | {"result": "for all t in [0, 1]", "tone": "good", "test": _TESTS[proof.outcome.test]})
        else:
            at = f"leaves, e.g. at t = {proof.outcome.t}"
            rows.append(row | {"result": at, "tone": "bad", "test": "exact evaluation there"})
    return rows


def condition_name(condition: Condition) -> str:
    """A condition in words."""
    return {"ball": "‖·‖ ≤ r", "floor": "z ≥ 0"}.get(condition.name, condition.name)


def joins(path: Path | None) -> list[Row]:
    """One row per join."""
    if path is None:
        return []
    speeds = speed_at_joins(path)
    rows = []
    for item in path.joins:
        at = path.curves[item.second].points[0]
        label = next(name for name in ("Q0", "R0") if path.points[name] == at)
        velocity = speeds.get(f"{item.first}-{item.second}")
        jump = item.join.jumps[2]
        stops = "" if item.join.same_direction else ", but it stops there"
        rows.append(
            {
                "at": shown(mathml.name(label)),
                "smoothness": SMOOTHNESS[item.join.smoothness] + stops,
                "velocity": decimal_point(velocity) if velocity else "",
                "jump": "none" if all(map(is_zero, jump)) else decimal_point(jump),
            }
        )
    return rows


def certificates(plan: Plan, claims: Mapping[str, str]) -> list[Row]:
    """What was checked by whom; ``claims``: what each certificate of the method says."""
    claims = {
        "path": "Every curve stays in the workspace, by its Bernstein coefficients",
        "clearance": "Every curve stays clear of every obstacle, by Bernstein coefficients",
        **claims,
    }
    rows = []
    for name, verdict in plan.checks.items():
        text = "accepted" if verdict.accepted else f"rejected at {verdict.step}: {verdict.reason}"
        how = "independent checker (qe.verify)"
        rows.append({"claim": claims.get(name, name), "how": how, "result": text, "tone": tone(verdict.accepted)})
    if plan.path is not None:
        inside = plan.path.is_inside
        how = "exact arithmetic in the number field of the coordinates"
        result = "proved" if inside else "refuted"
        claim = "The whole path stays in the workspace (see the proofs above)"
        rows.append({"claim": claim, "how": how, "result": result, "tone": tone(inside)})
    if plan.path is not None and plan.path.joins:
        smooth = plan.path.smoothness
        claim = f"Both joins are {'C²' if smooth is Smoothness.C2 else 'C¹'}"
        rows.append({"claim": claim, "how": how, "result": "proved", "tone": tone(smooth >= Smoothness.C1)})
    return rows


def tone(good: bool) -> str:
    """The class of a good or a bad result."""
    return "good" if good else "bad"


def timings(seconds: Mapping[str, float]) -> list[Row]:
    """One row per step, with the length of a bar."""
    longest = max(seconds.values(), default=0.0) or 1.0
    return [
        {"name": name, "text": f"{s * 1e3:.1f} ms" if s < 1 else f"{s:.2f} s", "percent": round(100 * s / longest, 1)}
        for name, s in seconds.items()
    ]


def cells(region: Any) -> list[list[Markup]]:
    """The cells of the region, one line per variable."""
    return [[Markup(line) for line in mathml_cells.cell(piece)] for piece in region.cells]
