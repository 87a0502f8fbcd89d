"""The page of the quadratic method: formula (8), the region of Q1, the best Q1, and the question of the table."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.curves.containment import Leaves
from bezier.curves.scalar import decimal_text, with_decimal
from bezier.curves.workspace import root_text
from bezier.methods.quadratic import formula as quadratic
from bezier.methods.quadratic.plan import QuadraticPlan
from bezier.report import mathml, parts
from bezier.report.parts import Row, exact, norm, shown

NAMES = ("P0", "Q0", "R0", "R2")


def sections(plan: QuadraticPlan) -> dict[str, Any]:
    """What the page shows beyond the parts of every method."""
    return {
        "title": "Three quadratic Bézier curves over an obstacle",
        "subtitle": "exact region, best control point, proved path",
        "given": parts.given(plan, NAMES),
        "infeasible": _infeasibility(plan),
        "question": parts.question(plan, plan.system),
        "further_conditions": len(plan.system.conditions) - len(quadratic.SHAPE.inner),
        "region": {
            "sentence": _region_sentence(plan),
            "bounds": parts.bounds(plan.region, quadratic.FREE),
            "cells": parts.cells(plan.region),
        },
        "optimum": parts.optimum(
            plan, plan.system, plan.optimum, "the unconstrained minimum, the midpoint of the via points"
        ),
        "gap": _gap(plan),
        "certificates": parts.certificates(plan, _claims(plan)),
    }


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


def _claims(plan: QuadraticPlan) -> dict[str, str]:
    return {
        "region": "The answer describes exactly the region: every cell has the truth value stated",
        "optimum": "The chosen Q1 is the global optimum" if plan.path else "The conditions on Q1 contradict each other",
        "below the table": "The printed formula allows the example below the table",
    }


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


def _infeasibility(plan: QuadraticPlan) -> Row | None:
    """Why there is no control point."""
    if plan.path is not None:
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
    text += (
        "The triangle is acute, so that circle goes through all three corners."
        if balls.is_acute
        else ("The triangle has no acute shape, so its longest side is the diameter of that circle.")
    )
    if balls.meet:
        text = "The three balls of radius r about O, 2 Q0 and 2 R0 meet, but not where the other conditions hold."
    suggestion = (
        'Try method = "cubic": with three cubic curves, formula (7), control points always exist (Q1 = Q0, Q2 = R0 is'
        " one choice)."
    )
    contradiction = parts.contradiction(plan.system, plan.optimum, reason(plan))
    return contradiction | {"explanation": text, "ball_rows": rows, "suggestion": suggestion}


def _gap(plan: QuadraticPlan) -> Row:
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


def _chosen(plan: QuadraticPlan) -> str:
    if not plan.gap.chosen:
        return ""
    bad = [p for p in plan.gap.chosen if isinstance(p.outcome, Leaves)]
    if not bad:
        return "The chosen path itself stays above the table: z ≥ 0 is proved along all three curves."
    places = ", ".join(f"{p.curve} at t = {p.outcome.t}" for p in bad if isinstance(p.outcome, Leaves))
    return f"The chosen path goes below the table: {places}."


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
