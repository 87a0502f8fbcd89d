"""The page of the cubic method: formula (7), the best Q1 and Q2, speed, and the cusps of the trivial choice."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bezier.methods.control.terms import named_multipliers
from bezier.methods.cubic.plan import CubicPlan
from bezier.paths.speed import Slowest
from bezier.report import mathml, parts
from bezier.report.parts import Row, shown, tone

NAMES = ("P0", "Q0", "R0", "R3")
INTERIOR = "the unconstrained minimum, Q1 = (2 Q0 + R0)/3 and Q2 = (Q0 + 2 R0)/3"


def sections(plan: CubicPlan) -> dict[str, Any]:
    """What the page shows beyond the parts of every method."""
    solved = plan.path is not None
    claims = {
        "optimum": "The chosen Q1 and Q2 are the global optimum"
        if solved
        else "The conditions on Q1 and Q2 contradict each other"
    }
    return {
        "title": "Three cubic Bézier curves over an obstacle",
        "subtitle": "exact best control points, C² joins, proved path",
        "given": parts.given(plan, NAMES),
        "infeasible": None if solved else parts.contradiction(plan.system, plan.optimum, reason(plan)),
        "question": parts.question(plan, plan.system),
        "further_conditions": len(plan.system.conditions) - len(plan.system.shape.inner),
        "ratio": None if plan.problem.ratio == 1 else parts.exact(plan.problem.ratio),
        "optimum": parts.optimum(plan, plan.system, plan.optimum, INTERIOR),
        "speeds": _speeds(plan.slowest),
        "required_speed": str(plan.problem.join_speed) if plan.problem.join_speed else "",
        "trivial": _trivial(plan),
        "certificates": parts.certificates(plan, claims),
    }


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


def _speeds(found: Mapping[str, Slowest]) -> list[Row]:
    return [
        {
            "curve": shown(mathml.name(name) + "<mo>(</mo><mi>t</mi><mo>)</mo>"),
            "result": speed_text(slow),
            "tone": tone(not slow.stops),
        }
        for name, slow in found.items()
    ]


def _trivial(plan: CubicPlan) -> Row:
    """The choice Q1 = Q0, Q2 = R0 with this problem's numbers."""
    found = plan.trivial
    if found.violated:
        allowed = f"Here further conditions forbid it: {', '.join(map(parts.on_point, found.violated))}."
    elif plan.radius_rule is not None:
        allowed = f"Here it satisfies every condition, and in part it is forced: {plan.radius_rule.in_words()}."
    else:
        allowed = "Here it satisfies every condition, so control points exist; the objective is what avoids it."
    return {
        "allowed": allowed,
        "points": [
            {"name": shown(mathml.name(name)), "point": shown(mathml.vector(found.path.points[name]))}
            for name in plan.system.shape.inner
        ],
        "smoothness": parts.SMOOTHNESS[found.path.smoothness],
        "speeds": _speeds(found.slowest),
    }
