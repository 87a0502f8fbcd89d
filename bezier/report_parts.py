"""The sections of the report as plain values for the template: numbers and formulas already as MathML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

from markupsafe import Markup

from bezier import mathml, mathml_cells, quadratic
from bezier.containment import Argument, Inside, Leaves
from bezier.curve import Smoothness
from bezier.outputs import reason
from bezier.path import Proof, speed_at_joins
from bezier.plan import Outcome, Plan
from bezier.scalar import decimal_text, dot, is_zero, rational
from bezier.terms import named_multipliers
from bezier.workspace import Ball, Condition, WorkspaceKind, root_text

Row = dict[str, Any]
PAPER_NAMES = {"start": "P0", "via[0]": "Q0", "via[1]": "R0", "goal": "R2"}
CONTRADICTION = (
    "Write each condition as g ≤ 0, with g = ‖·‖² − r² or g = −z as a function of Q1. The sum of these functions with"
    " the multipliers below is positive everywhere, so the conditions cannot hold together."
)
CONDITIONS = {"ball": "‖·‖ ≤ r", "floor": "z ≥ 0"}


def names() -> dict[str, Markup]:
    """Names of control points as inline mathematics."""
    return {name: shown(mathml.name(name)) for name in ("P0", "P1", "Q0", "Q1", "R0", "R1", "R2")}


def shown(body: str) -> Markup:
    """Inline mathematics that the template does not escape."""
    return Markup(mathml.math(body))


def exact(value: Any) -> Markup:
    """An exact number."""
    return shown(mathml.number(value))


def norm(point: Sequence[Any]) -> Markup:
    """The exact norm of a point where its square is rational, a decimal otherwise."""
    square = dot(point, point)
    number = rational(square)
    if number is None:
        return Markup(escape(f"≈ {float(square) ** 0.5:.6g}"))
    return shown(mathml.number_text(root_text(number)))


def cards(plan: Plan, seconds: float) -> list[Row]:
    """The figures at the top of the page."""
    solved = plan.outcome is Outcome.SOLVED
    found = [card("result", "path found" if solved else "no control point exists", "good" if solved else "bad")]
    found.append(card("radius", f"{float(plan.problem.workspace.radius_squared) ** 0.5:.6g} mm"))
    if plan.optimum:
        found.append(card("objective", f"{decimal_text(plan.optimum.value, 8)} mm²"))
        found.append(card("active conditions", ", ".join(plan.active) or "none"))
    tone = "good" if plan.certified else "bad"
    found.append(card("certified", "yes" if plan.certified else "not everything", tone))
    found.append(card("computed in", f"{sum(plan.seconds.values()):.2f} s"))
    return found


def card(label: str, value: str, tone: str = "") -> Row:
    """One figure."""
    return {"label": label, "value": value, "tone": tone}


def given(plan: Plan) -> list[Row]:
    """The four points."""
    return [
        {"key": key, "name": shown(mathml.name(PAPER_NAMES[key])), "point": shown(mathml.vector(p)), "norm": norm(p)}
        for key, p in plan.problem.named_points.items()
    ]


def workspace_text(plan: Plan) -> str:
    """The workspace in words."""
    if plan.problem.workspace.kind is WorkspaceKind.HEMISPHERE:
        return "the upper half (z ≥ 0) of the ball about the origin"
    return "the ball about the origin"


def question(plan: Plan) -> list[Markup]:
    """Formula (8) in the paper's notation, with the given points below it."""
    p1, q1, r1, q0, r0 = (mathml.name(n) for n in ("P1", "Q1", "R1", "Q0", "R0"))
    two = "<mn>2</mn>"

    def equation(left: str, first: str) -> str:
        return f"<mrow><mo>(</mo>{left}<mo>=</mo>{two}{first}<mo>−</mo>{q1}<mo>)</mo></mrow>"

    def bound(point: str) -> str:
        return f"<mrow><mo>(</mo><mo>‖</mo>{point}<mo>‖</mo><mo>≤</mo><mi>r</mi><mo>)</mo></mrow>"

    def above(point: str) -> str:
        height = f"<msub><mrow><mo>(</mo>{point}<mo>)</mo></mrow><mi>z</mi></msub>"
        return f"<mrow><mo>(</mo>{height}<mo>≥</mo><mn>0</mn><mo>)</mo></mrow>"

    parts = [equation(p1, q0), equation(r1, r0), bound(p1), bound(q1), bound(r1)]
    if plan.problem.workspace.kind is WorkspaceKind.HEMISPHERE:
        parts += [above(p1), above(q1), above(r1)]
    body = "<mo>∧</mo>".join(parts)
    formula = f"<mrow><mo>∃</mo>{p1}<mo>∃</mo>{r1}<mspace width='0.4em'/><mo>(</mo>{body}<mo>)</mo></mrow>"
    via = plan.problem.via
    radius = mathml.number_text(plan.problem.workspace.radius_text)
    where = (
        f"{q0}<mo>=</mo>{mathml.vector(via[0])}<mo>,</mo><mspace width='0.8em'/>{r0}<mo>=</mo>{mathml.vector(via[1])}"
        f"<mo>,</mo><mspace width='0.8em'/><mi>r</mi><mo>=</mo>{radius}"
    )
    return [shown(formula), shown(where)]


def region_sentence(plan: Plan) -> str:
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


def infeasibility(plan: Plan) -> Row | None:
    """Why there is no control point."""
    if plan.outcome is Outcome.SOLVED:
        return None
    balls = plan.balls
    labels = ("|Q0|²", "|R0|²", "|Q0 − R0|²")
    rows = [
        {"label": label, "value": exact(v), "decimal": decimal_text(v, 8)}
        for label, v in zip(labels, balls.sides_squared, strict=True)
    ]
    for label, square in (("radius r", balls.radius_squared), ("least radius that would do", balls.needed_squared)):
        value = shown(mathml.number_text(root_text(square)))
        rows.append({"label": label, "value": value, "decimal": f"{float(square) ** 0.5:.8g}"})
    text = (
        "Q1 has to lie in the three balls of radius r about O, 2 Q0 and 2 R0. They have a common point exactly when the"
        " smallest circle around the triangle O, Q0, R0 has a radius of at most r/2. "
    )
    text += "The triangle is acute, so that circle goes through all three corners." if balls.is_acute else (
        "The triangle has no acute shape, so its longest side is the diameter of that circle."
    )
    if balls.meet:
        text = "The three balls of radius r about O, 2 Q0 and 2 R0 meet, but not above the table."
    return {"reason": reason(plan)[0].upper() + reason(plan)[1:], "explanation": text, "ball_rows": rows} | {
        "multipliers": multipliers(plan, plan.infeasibility),
        "multiplier_text": CONTRADICTION,
    }


def multipliers(plan: Plan, optimum: Any) -> list[Row]:
    """The non-zero multipliers with the conditions they belong to."""
    return [
        {"label": _condition_text(label), "value": exact(value), "decimal": decimal_text(value, 8)}
        for label, value in named_multipliers(plan.problem, optimum)
    ]


def objective_formula() -> Markup:
    """|Q1 - Q0|^2 + |R0 - Q1|^2."""
    q0, q1, r0 = (mathml.name(n) for n in ("Q0", "Q1", "R0"))

    def squared(a: str, b: str) -> str:
        return f"<msup><mrow><mo>‖</mo>{a}<mo>−</mo>{b}<mo>‖</mo></mrow><mn>2</mn></msup>"

    return shown(f"{squared(q1, q0)}<mo>+</mo>{squared(r0, q1)}")


def optimum(plan: Plan) -> Row | None:
    """The best Q1 and the control points that follow from it."""
    if plan.optimum is None or plan.path is None:
        return None
    points = [
        {
            "name": shown(mathml.name(name)),
            "exact": shown(mathml.vector(point)),
            "decimal": "(" + ", ".join(decimal_text(c, 8) for c in point) + ")",
        }
        for name, point in plan.path.points.items()
    ]
    if plan.active:
        active = f"Conditions that hold with equality there: {', '.join(map(_condition_text, plan.active))}."
    else:
        active = "No condition is active: the unconstrained minimum, the midpoint of the via points, is allowed."
    return {
        "objective": objective_formula(),
        "value": exact(plan.optimum.value),
        "decimal": decimal_text(plan.optimum.value),
        "points": points,
        "active": active,
        "multipliers": multipliers(plan, plan.optimum),
        "field": field_text(plan),
    }


def _condition_text(label: str) -> str:
    return f"{label[:-2]} not below the table" if label.endswith(".z") else f"‖{label}‖ ≤ r"


def field_text(plan: Plan) -> str:
    """The number field of the coordinates, when they are irrational."""
    for point in plan.path.points.values() if plan.path else ():
        for value in point:
            if rational(value) is None and hasattr(value, "field"):
                terms = plan_polynomial(value.field.minimal_polynomial)
                near = float(value.field.theta)
                return f"All coordinates lie in one number field, generated by the root of {terms} near {near:.8g}."
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
    return CONDITIONS["ball" if isinstance(condition, Ball) else "floor"]


def joins(plan: Plan) -> list[Row]:
    """One row per join."""
    if plan.path is None:
        return []
    speeds = speed_at_joins(plan.path)
    rows = []
    for item in plan.path.joins:
        at = plan.path.curves[item.second].points[0]
        label = next(name for name in ("Q0", "R0") if plan.path.points[name] == at)
        velocity = speeds.get(f"{item.first}-{item.second}")
        level = item.join.smoothness
        text = {Smoothness.C2: "C² (value, first, second derivative)", Smoothness.C1: "C¹ (value, first derivative)"}
        jump = item.join.jumps[2]
        rows.append(
            {
                "at": shown(mathml.name(label)),
                "smoothness": text.get(level, level.name),
                "velocity": shown(mathml.vector(velocity)) if velocity else "",
                "jump": "none" if all(map(is_zero, jump)) else shown(mathml.vector(jump)),
            }
        )
    return rows


def gap(plan: Plan) -> Row:
    """The hemisphere question."""
    found = plan.gap
    radius = plan.problem.workspace.radius_text
    if found.example is None:
        allowed = (
            "For this problem it makes no difference: no allowed control point lies below the table"
            " (decided by elimination)."
        )
        rows: list[Row] = []
    else:
        allowed = f"For this problem that matters: with r = {radius}, it allows control points below the table."
        rows = [
            {
                "name": shown(mathml.name(name)),
                "point": shown(mathml.vector(point)),
                "norm": norm(point),
                "tone": "bad" if float(point[2]) < 0 else "",
            }
            for name, point in found.example.items()
        ]
    return {"allowed": allowed, "example": rows, "chosen": _chosen(plan), "region": _corrected(plan)}


def _chosen(plan: Plan) -> str:
    if not plan.gap.chosen:
        return ""
    bad = [p for p in plan.gap.chosen if isinstance(p.outcome, Leaves)]
    if not bad:
        return "The chosen path itself stays above the table: z ≥ 0 is proved along all three curves."
    places = ", ".join(f"{p.curve} at t = {p.outcome.t}" for p in bad if isinstance(p.outcome, Leaves))
    return f"The chosen path goes below the table: {places}."


def _corrected(plan: Plan) -> str:
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


def certificates(plan: Plan) -> list[Row]:
    """What was checked by whom."""
    claims = {
        "region": "The answer describes exactly the region: every cell has the truth value stated",
        "optimum": "The chosen Q1 is the global optimum"
        if plan.outcome is Outcome.SOLVED
        else "The conditions on Q1 contradict each other",
        "below the table": "The printed formula allows the example below the table",
        "path": "Every curve stays in the workspace, by its Bernstein coefficients",
    }
    rows = []
    for name, verdict in plan.checks.items():
        text = "accepted" if verdict.accepted else f"rejected at {verdict.step}: {verdict.reason}"
        how = "independent checker (qe.verify)"
        rows.append({"claim": claims.get(name, name), "how": how, "result": text, "tone": _tone(verdict.accepted)})
    if plan.path is not None:
        inside = plan.path.is_inside
        how = "exact arithmetic in the number field of the coordinates"
        result = "proved" if inside else "refuted"
        claim = "The whole path stays in the workspace (see the proofs above)"
        rows.append({"claim": claim, "how": how, "result": result, "tone": _tone(inside)})
        smooth = plan.path.smoothness
        claim = f"Both joins are {'C²' if smooth is Smoothness.C2 else 'C¹'}"
        rows.append({"claim": claim, "how": how, "result": "proved", "tone": _tone(smooth >= Smoothness.C1)})
    return rows


def _tone(good: bool) -> str:
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
