"""``report.html``: one page that needs nothing from elsewhere."""

from __future__ import annotations

import json
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path as FilePath
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from bezier import mathml, quadratic
from bezier import report_parts as parts
from bezier.picture import PathPicture
from bezier.plan import Plan
from bezier.workspace import WorkspaceKind


def render(plan: Plan, *, picture: PathPicture | None, views: str, seconds: float) -> str:
    """The page. Without ``picture`` there are no drawings and no script."""
    environment = Environment(loader=PackageLoader("bezier"), autoescape=True, undefined=StrictUndefined)
    environment.trim_blocks = True
    template = environment.get_template("report.html.j2")
    return template.render(context(plan, picture, views, seconds))


def context(plan: Plan, picture: PathPicture | None, views: str, seconds: float) -> dict[str, Any]:
    """Everything the template shows."""
    problem = plan.problem
    return {
        "title": "Three quadratic Bézier curves over an obstacle",
        "subtitle": f"{FilePath(problem.source).name}: exact region, best control point, proved path",
        "cards": parts.cards(plan, seconds),
        "infeasible": parts.infeasibility(plan),
        "given": parts.given(plan),
        "workspace": parts.workspace_text(plan),
        "radius": parts.shown("<mi>r</mi><mo>=</mo>" + mathml.number_text(problem.workspace.radius_text)),
        "radius_note": ", the maximum of the norms" if problem.radius_is_auto else "",
        "notes": problem.notes,
        "names": parts.names(),
        "question": parts.question(plan),
        "extra_conditions": ", 3 conditions z ≥ 0" if problem.workspace.kind is WorkspaceKind.HEMISPHERE else "",
        "formula_text": plan.formula,
        "answer": [Markup(line) for line in mathml.conjunction_lines(plan.answer.formula)],
        "answer_text": str(plan.answer.formula),
        "answer_story": "",
        "region": {
            "sentence": parts.region_sentence(plan),
            "bounds": parts.bounds(plan.region, quadratic.FREE),
            "cells": parts.cells(plan.region),
        },
        "optimum": parts.optimum(plan),
        "path": {"proofs": parts.proofs(plan.path.proofs) if plan.path else [], "joins": parts.joins(plan)},
        "gap": parts.gap(plan),
        "certificates": parts.certificates(plan),
        "timings": parts.timings(plan.seconds),
        "views": Markup(views),
        "figures": figures(picture),
        "plotly_script": _script(picture),
        "version": _version(),
        "source": FilePath(problem.source).name,
    }


def figures(picture: PathPicture | None) -> dict[str, Any]:
    """The turnable pictures: which there are, and all of them as JSON for the script."""
    found: dict[str, Any] = {}
    if picture is not None:
        from bezier import scene

        found["region"] = scene.region_figure(picture)
        found["path"] = scene.path_figure(picture) if picture.curves else None
        if "corrected" in picture.extra and "printed" in picture.extra:
            printed = picture.extra["printed"]
            found["corrected"] = scene.compared_figure(picture.extra["corrected"], printed)
            found["printed"] = scene.compared_figure(printed, printed)
    found = {name: figure for name, figure in found.items() if figure is not None}
    text = json.dumps(found, separators=(",", ":")).replace("</", "<\\/")
    shown = {name: name in found for name in ("region", "path", "corrected")}
    return {**shown, "any": bool(found), "json": Markup(text)}


def _script(picture: PathPicture | None) -> Markup:
    if picture is None:
        return Markup("")
    from bezier.scene import plotly_script

    return Markup(plotly_script().replace("</script", "<\\/script"))


def _version() -> str:
    try:
        return version("bezier-qe")
    except PackageNotFoundError:
        return "(not installed)"
