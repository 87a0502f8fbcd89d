"""The page of Method 1: problem (4), its optimum with multipliers, the holes of the printed method and Method 1*."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.curves.containment import Leaves
from bezier.curves.scalar import brief, decimal_text
from bezier.input.task import Axis, Task
from bezier.methods.single.closed import ProvedCurve
from bezier.methods.single.plan import CLOSED, SinglePlan, above_label, of_axis
from bezier.methods.single.program import TIE_BREAK, Chosen, Dip
from bezier.methods.single.simplex import Contradiction, LinearOptimum
from bezier.report import mathml, parts
from bezier.report.parts import Row, shown, tone


def sections(plan: SinglePlan) -> dict[str, Any]:
    """What the page shows beyond the parts of every method."""
    given, names = plan.task, ("P0", "(a, h)", "(b, h)", f"P{plan.task.degree}")
    return {
        "title": "One Bézier curve over an obstacle",
        "subtitle": "exact linear problem, proved heights, proved path",
        "given": parts.given(plan, names),
        "infeasible": None if plan.path else _infeasible(plan),
        "question": [shown(line) for axis in given.raised for line in _question(given, axis)],
        "further_conditions": 0,
        "indices": f"n = {given.degree}, p = {given.p}, q = {given.q}",
        "times": [parts.exact(t) for t in given.times],
        "optimum": _optimum(plan),
        "problems": [_problem(given, item) for item in plan.chosen],
        "pieces": [{"axis": name, "text": str(piece.least)} for name, piece in plan.pieces.items()],
        "tie_break": TIE_BREAK,
        "holes": [line[0].upper() + line[1:] for line in holes(plan)],
        "closed": _closed(plan),
        "certificates": parts.certificates(plan, _claims(plan)),
    }


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
    if isinstance(plan.closed, ProvedCurve):
        lines.append(f"Method 1*: {_quality(plan.closed)}")
    return lines


def _dip_text(dip: Dip) -> str:
    return f"{dip.axis.name} = {decimal_text(dip.value, 8)}"


def _quality(closed: ProvedCurve) -> str:
    if closed.is_optimal:
        return f"a curve with the least possible sum, {brief(closed.value)}, by {len(closed.cuts)} cuts"
    return (
        f"a curve with the sum {brief(closed.value)}; no curve has a sum below {decimal_text(closed.bound, 8)}"
        f" ({len(closed.cuts)} cuts)"
    )


def reason(plan: SinglePlan) -> str:
    """Why there is no path, in one sentence."""
    none = [item.axis.name for item in plan.chosen if isinstance(item.outcome, Contradiction)]
    if none:
        return f"no control points exist: problem (4) for {' and '.join(none)} contradicts itself"
    return (
        f"no curve of degree {plan.task.degree} satisfies (4), keeps its heights between a and b and stays in the"
        " workspace: already at finitely many t these conditions contradict each other (the certificate shows it)"
    )


def _infeasible(plan: SinglePlan) -> Row:
    stated = reason(plan)
    return {
        "reason": stated[0].upper() + stated[1:],
        "explanation": "A higher degree may help.",
        "ball_rows": [],
        "multipliers": [],
        "multiplier_text": "",
        "suggestion": "",
    }


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


def _optimum(plan: SinglePlan) -> Row | None:
    if plan.path is None:
        return None
    total = "<mo>+</mo>".join(_indexed(axis.name, i) for axis in plan.task.raised for i in plan.task.middle)
    points = [
        {"name": shown(mathml.name(name)), "exact": parts.exact_point(point), "decimal": parts.decimal_point(point)}
        for name, point in plan.path.points.items()
    ]
    bounds = ", ".join(plan.active)
    return {
        "objective": shown(total),
        "value": parts.exact(plan.objective),
        "decimal": decimal_text(plan.objective),
        "points": points,
        "active": f"Lower bounds of (4) that hold with equality there: {bounds}." if bounds else "",
        "multipliers": [],
        "field": "",
    }


def _problem(given: Task, item: Chosen) -> Row:
    """Problem (4) of one axis with its dual proof."""
    labels = [f"P_{item.axis.name}(t_{end}) = h" for end in ("a", "b")]
    labels += [f"{name} >= {low}" for name, low in zip(item.program.names, item.program.lower, strict=True)]
    duals = (*item.outcome.duals.rows, *item.outcome.duals.bounds)
    return {
        "axis": item.axis.name,
        "value": parts.exact(item.outcome.value) if isinstance(item.outcome, LinearOptimum) else "",
        "result": "the least sum" if isinstance(item.outcome, LinearOptimum) else "no solution",
        "rows": [
            {"label": label, "value": parts.exact(dual), "decimal": decimal_text(dual, 8)}
            for label, dual in zip(labels, duals, strict=True)
            if dual
        ],
    }


def _closed(plan: SinglePlan) -> Row | None:
    closed = plan.closed
    if not isinstance(closed, ProvedCurve):
        return None
    gap: Fraction = plan.gap
    return {
        "value": parts.exact(closed.value),
        "bound": decimal_text(closed.bound, 10),
        "gap": decimal_text(gap, 4) if gap else "",
        "cuts": [
            {"kind": cut.kind.value, "axis": cut.axis, "t": brief(cut.t), "tone": tone(True)} for cut in closed.cuts
        ],
        "attainable": plan.attainable,
    }


def _claims(plan: SinglePlan) -> dict[str, str]:
    """What each certificate of the method says."""
    found = {
        of_axis(item.axis.name): f"Problem (4) for {item.axis.name}: the sum is the least possible one"
        if isinstance(item.outcome, LinearOptimum)
        else f"Problem (4) for {item.axis.name} contradicts itself"
        for item in plan.chosen
    }
    found |= {above_label(name): f"The curve is not below h in {name} from t_a to t_b" for name in plan.above}
    proved = isinstance(plan.closed, ProvedCurve)
    found[CLOSED] = "No curve has a smaller sum than the bound" if proved else "No curve of this degree exists"
    return found
