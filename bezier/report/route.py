"""The page of ``bezier route``: the scene, in space to be turned, and what is proved of it."""

from __future__ import annotations

from collections.abc import Sequence

from bezier.pictures import scene
from bezier.pictures.picture import COLOURS
from bezier.pictures.route import inline
from bezier.report import html
from bezier.report.first import scene_box
from bezier.report.html import Card, Page, Section
from bezier.report.parts import decimal_point
from bezier.scenes.route import Blocked, Route


def page(known: Route | Blocked, lines: Sequence[str], title: str) -> Page:
    """``lines``: what the command says."""
    said = lines[0].partition(":")[0]
    cards, first = [Card("start to goal", said, html.tone(not known.blocked))], None
    sections = [Section("proved", "What is proved", html.bullets(lines), short="proved")]
    if isinstance(known, Route):
        cards.append(Card("length", f"{float(known.length):.6g}", note="at most"))
        rows = [(str(k + 1), html.joined(*(decimal_point(p, 6) for p in c))) for k, c in enumerate(known.curves)]
        listed = html.table(("curve", "control points"), rows)
        sections.append(Section("points", "Control points", listed, short="points"))
        if known.at_least is not None:
            cards.append(Card("every path", f"{float(known.at_least):.6g}", note="at least, proved"))
    if known.scene.dimension == 3:
        legend = [("the way", COLOURS["R"])] * (not known.blocked)
        first = scene_box(scene.text(scene.route_scene(known)), said, "", legend, moving=False)
    else:
        sections.insert(0, Section("picture", "Picture", html.figures([(inline(known), said)], wide=True), "picture"))
    note = "Pictures are floating point; what is said of the scene is proved in exact arithmetic."
    return Page(title=f"Route {title}", lead=lines[0], first=first, sections=sections, footer=note, cards=cards)
