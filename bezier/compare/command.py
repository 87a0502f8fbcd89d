"""What ``bezier compare`` does inside the worker: compare, draw, write, and say it as a table or as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path as FilePath
from time import perf_counter
from typing import Any

from markupsafe import Markup

from bezier.compare.comparison import METHODS, Comparison, compare
from bezier.compare.output import TITLES, Row, notes, rows, step_rows, table, to_json
from bezier.pictures.picture import Chart
from bezier.planner import derivations
from bezier.planner.outputs import COMPARED, COMPARISON, write_texts
from bezier.plans import Clock
from bezier.problem import Problem
from bezier.report import html, parts
from bezier.report.first import DRAWING, computed, duration
from bezier.report.html import Card, Page, Section, Text
from bezier.report.page import PAPER
from qe.processes.channel import Channel

PAGE = "compare.html"
NAMES = ("P0", "Q0", "R0", "R2")
PLANE = (
    "In the plane through O, Q0 and R0, with coordinates q1u along R0 − Q0 and q1v across: the places that formula (8)"
    " allows, those that keep the whole quadratic curves inside (8*), and those that formula (7) leaves with some Q2."
)
REPORTED = (
    "The paper reports about 15.4 s for formula (8) with a general computer algebra system on a laptop of 2018 (other"
    " points, other machine), and that elimination for formula (7) has not yet been successful."
)


def render(comparison: Comparison, drawings: Mapping[str, Sequence[Chart]], first: Markup | None = None) -> str:
    """The page; ``drawings``: of the paths and the regions; ``first``: both paths in space; none of them is needed."""
    file = FilePath(comparison.problem.source).name
    page = Page(
        title=f"{file.removesuffix('.toml').replace('_', ' ')}: quadratic and cubic curves side by side",
        lead="three quadratic curves with C¹ joins, formula (8), and three cubic curves with C² joins, formula (7)",
        cards=_cards(comparison),
        first=first,
        sections=[
            _results(comparison, drawings),
            _regions(comparison, drawings),
            *_derivations(comparison),
            _problem(comparison),
            _timings(comparison),
        ],
        footer=f"{PAPER}, section 4.2. Made by bezier-qe {html.package_version()} from {file}.",
    )
    return html.document(page)


def _cards(comparison: Comparison) -> list[Card]:
    cards = []
    for method in METHODS:
        side = comparison.sides[method]
        good = side.plan.outcome.is_success
        facts = [f"eliminated in {duration(side.plan.seconds['elimination'])}"]
        if side.quality is not None and (worst := side.quality.curvature) is not None:
            bend = "a cusp" if worst.high is None else f"curvature at most {worst.shown()} per mm"
            facts = [f"length {side.quality.length.shown()} mm", bend, *facts]
        cards.append(
            Card(f"{method.value} curves", "path found" if good else "no path", html.tone(good), "; ".join(facts))
        )
    return [*cards, computed(comparison.seconds, duration)]


def _results(comparison: Comparison, drawings: Mapping[str, Sequence[Chart]]) -> Section:
    content = html.joined(
        html.figures(drawings.get("paths", ()), wide=True),
        _side_by_side(rows(comparison)),
        html.note("Lengths, curvatures, areas and volumes are enclosures: the number lies between the two ends."),
    )
    return Section("results", "Side by side", content)


def _side_by_side(lines: Iterable[Row], *, numbers: Sequence[int] = ()) -> Markup:
    return html.table(("", *TITLES.values()), lines, numbers=numbers)


def _regions(comparison: Comparison, drawings: Mapping[str, Sequence[Chart]]) -> Section:
    content = [html.paragraph(PLANE), html.figures(drawings.get("regions", ()), wide=True)]
    content += [html.paragraph(f"{line[0].upper()}{line[1:]}.") for line in notes(comparison)]
    for name, item in comparison.planar.named.items():
        if item.region:
            cells = [piece.brief() for piece in item.region.cells]
            count = f"{name}: cylindrical description, {len(cells)} cell{'s' * (len(cells) != 1)}"
            content.append(html.folded(count, html.pre("\n".join(cells))))
    for name, item in comparison.planar.named.items():
        content.append(html.folded(f"{name} as handed to the engine", html.pre(item.formula)))
    theorem = html.pre(comparison.existence.sentence)
    content.append(html.folded("the existence theorem as handed to the engine", theorem))
    return Section("regions", "Where Q1 may be", html.joined(*content), "regions")


def _derivations(comparison: Comparison) -> list[Section]:
    """The eliminations whose every step was checked, with links to their pages."""
    if not comparison.derivations:
        return []
    rows: list[tuple[Text, Text]] = [
        (derivation_title(name), parts.derivation_link(comparison, name)) for name in comparison.derivations
    ]
    rows += [
        (f"{name[0].upper()}{name[1:]}", f"not every step checked: {why}") for name, why in comparison.unproved.items()
    ]
    said = "The certificates of both plans and of these derivations are in compare_certificate.json."
    content = html.table(("decided by the engine", "how"), rows) + html.note(said)
    return [Section("certified", "What was certified", content, short="certificates")]


def derivation_title(name: str) -> str:
    """What a derivation is about, in the table and on its page."""
    return f"The elimination of {name}" if "formula" in name else f"{name[0].upper()}{name[1:]}"


def _problem(comparison: Comparison) -> Section:
    given = parts.given(comparison.problem.named_points, NAMES)
    radius = f"{float(comparison.problem.workspace.radius_squared) ** 0.5:.8g}"
    said = html.paragraph(f"Radius r = {radius} mm (exactly {comparison.problem.workspace.radius_text}).")
    return Section("problem", "The problem", given + said)


def _timings(comparison: Comparison) -> Section:
    common = [(name, duration(seconds)) for name, seconds in comparison.seconds.items()]
    content = html.joined(
        _side_by_side(step_rows(comparison), numbers=(1, 2)),
        html.table(("common step", "time"), common, numbers=(1,)),
        html.note(REPORTED),
    )
    return Section("timings", "Timings", content)


def run(
    channel: Channel,
    problem: Problem,
    folder: FilePath | None = None,
    target: FilePath | None = None,
    *,
    plots: bool = True,
    timeout: float | None = None,
) -> tuple[dict[str, Any], list[str]]:
    """The comparison, with its files in ``folder`` (later ``target``), if any; what to print, as data and as lines."""
    clock = Clock(limit=timeout, listener=channel.event, note=channel.fact)
    result = compare(problem, clock, proofs=folder is not None)
    files, last = list[str](), list[str]()
    if folder is not None and target is not None:
        files = _write(result, folder, target, plots=plots)
        last = [f"{len(files)} files in {target}: open {target / PAGE}"]
    return to_json(result, files), [table(result), *last]


def _write(comparison: Comparison, folder: FilePath, target: FilePath, *, plots: bool) -> list[str]:
    """All files into ``folder``; the places where they will be."""
    names, drawings, first = [PAGE, COMPARISON], {}, None
    if plots:
        start = perf_counter()
        from bezier.compare import pictures as plot_compare

        names += plot_compare.FILES
        drawings, first = plot_compare.charts(comparison, folder), plot_compare.first(comparison)
        comparison = replace(comparison, seconds={**comparison.seconds, DRAWING[0]: perf_counter() - start})
    files_of = comparison.derivation_pages
    pages = {
        files_of[name]: derivations.page(name, item, COMPARED, derivation_title(name))
        for name, item in comparison.derivations.items()
    }
    texts = {COMPARED: comparison.certificate.to_json(), **pages}
    files = [str(target / name) for name in sorted([*names, *write_texts(folder, texts)])]
    (folder / PAGE).write_text(render(comparison, drawings, first), encoding="utf-8")
    text = json.dumps(to_json(comparison, files), indent=1, ensure_ascii=False)
    (folder / COMPARISON).write_text(text + "\n", encoding="utf-8")
    return files
