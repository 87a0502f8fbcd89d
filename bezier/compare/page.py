"""``compare.html``: the comparison as one page that needs nothing from elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath

from markupsafe import Markup

from bezier.compare.comparison import METHODS, Comparison
from bezier.compare.output import TITLES, duration, notes, rows, step_rows
from bezier.plans import Outcome
from bezier.report import parts
from bezier.report.page import package_version, template

DRAWINGS = ("regions", "paths")


def render(found: Comparison, drawings: Mapping[str, str]) -> str:
    """The page; ``drawings``: SVG text by name, none of them needed."""
    cards = []
    for method in METHODS:
        side = found.sides[method]
        good = side.plan.outcome is Outcome.SOLVED
        cards.append(parts.card(f"{method.value}", "path found" if good else "no path", parts.tone(good)))
        cards.append(parts.card("eliminated in", duration(side.plan.seconds["elimination"])))
    regions = {name: r.region for name, r in found.planar.named.items() if r.region}
    return template("compare.html.j2").render(
        file=FilePath(found.problem.source).name,
        title="Quadratic and cubic curves side by side",
        cards=cards,
        given=parts.given(found.sides[METHODS[0]].plan, ("P0", "Q0", "R0", "R2")),
        radius=found.problem.workspace.radius_text,
        headings=list(TITLES.values()),
        rows=rows(found),
        steps=step_rows(found),
        common={name: duration(s) for name, s in found.seconds.items()},
        notes=notes(found),
        planar={name: [piece.brief() for piece in region.cells] for name, region in regions.items()},
        formulas={name: r.formula for name, r in found.planar.named.items()},
        sentence=found.existence.sentence,
        drawings={name: Markup(drawings.get(name, "")) for name in DRAWINGS},
        version=package_version(),
    )
