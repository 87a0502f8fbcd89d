"""``report.html``: one page that needs nothing from elsewhere."""

from __future__ import annotations

import json
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

from bezier.paths import heights
from bezier.plans import Method, Plan
from bezier.report import joints, mathml, parts
from bezier.report import obstacles as obstacle_report

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing, PathPicture


def render(plan: Plan, method: Method[Any], drawing: Drawing | None) -> str:
    """The page of a plan by this method. Without ``drawing`` there are no pictures and no script."""
    page = template(method.template).render(_common(plan, drawing) | method.sections(plan))
    return page if method.hatted_names else mathml.without_hats(page)


def template(name: str) -> Template:
    """A page's template."""
    environment = Environment(loader=PackageLoader("bezier.report"), autoescape=True, undefined=StrictUndefined)
    environment.trim_blocks = True
    return environment.get_template(name)


def _common(plan: Plan, drawing: Drawing | None) -> dict[str, Any]:
    """What the pages of all methods show."""
    problem = plan.problem
    return {
        "file": FilePath(problem.source).name,
        "names": {f"{p}{i}": parts.shown(mathml.name(f"{p}{i}")) for p in "PQR" for i in range(4)},
        "cards": parts.cards(plan),
        "workspace": parts.workspace_text(plan),
        "radius": parts.shown("<mi>r</mi><mo>=</mo>" + mathml.number_text(problem.workspace.radius_text)),
        "radius_note": ", the maximum of the norms" if problem.radius_is_auto else "",
        "notes": (*problem.notes, *plan.remarks),
        "formula_text": plan.formula,
        "answer": [Markup(line) for line in mathml.conjunction_lines(plan.answer.formula)],
        "answer_text": str(plan.answer.formula),
        "path": {"proofs": parts.proofs(plan.path.proofs if plan.path else ()), "joins": parts.joins(plan.path)},
        "timings": parts.timings(plan.seconds),
        "views": Markup(drawing.views if drawing else ""),
        "charts": Markup(drawing.charts if drawing else ""),
        "clearance_chart": Markup(drawing.clearance if drawing else ""),
        **obstacle_report.sections(plan),
        **joints.sections(plan.joints),
        "heights": heights.summary_lines(plan.heights) if plan.heights else [],
        "heights_tone": parts.tone(plan.heights is None or plan.heights.hold),
        "figures": figures(drawing.picture if drawing else None),
        "plotly_script": _script(drawing),
        "version": package_version(),
    }


def figures(picture: PathPicture | None) -> dict[str, Any]:
    """The turnable pictures: which there are, and all of them as JSON for the script."""
    found: dict[str, Any] = {}
    if picture is not None:
        from bezier.pictures import scene

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


def _script(drawing: Drawing | None) -> Markup:
    if drawing is None:
        return Markup("")
    from bezier.pictures.scene import plotly_script

    return Markup(plotly_script().replace("</script", "<\\/script"))


def package_version() -> str:
    """The version of this package, as installed."""
    try:
        return version("bezier-qe")
    except PackageNotFoundError:
        return "(not installed)"
