"""The HTML page: everything of benchmarks.md with the pictures inside, one self-contained file."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from bezier.report import html as pages
from bezier.report.html import Page, Section
from experiments.figures import Picture
from experiments.results import Log
from experiments.tables import page as markdown_page

FOOTER = "Made by the experiments of bezier-qe."
STYLE = """\
table { font-size: 13px; }
@media (prefers-color-scheme: dark) { figure svg { background: #fff; border-radius: 8px; padding: 6px; } }
"""


def html(log: Log, pictures: Sequence[Picture]) -> str:
    """The page; tables are those of the Markdown page."""
    title, sections = "bezier-qe: benchmarks", list[Section]()
    heading, content = "Overview", list[pages.Text]()

    def close() -> None:
        if content:
            key = re.sub(r"[^a-z0-9]+", "-", heading.lower()).strip("-")
            sections.append(Section(f"{key}-{len(sections)}", heading, pages.joined(*content)))

    for kind, block in _blocks(markdown_page(log)):
        match kind, block:
            case "title", str(text):
                title = text
            case "heading", str(text):
                close()
                heading, content = text, []
            case "table", (head, rows):
                content.append(pages.table(head, rows))
            case _:
                content.append(pages.paragraph(str(block)))
    close()
    if pictures:
        drawn = pages.figures([(_inline(p.svg()), p.caption) for p in pictures], wide=True)
        sections.append(Section("figures", "Figures", drawn))
    lead = "every solver on every problem, checked" if log.results else "no results"
    return pages.document(Page(title=title, lead=lead, sections=sections, footer=FOOTER, style=STYLE))


def _inline(svg: str) -> str:
    """The svg element alone, with names of its own (pictures on one page share one space of names)."""
    return svg[svg.index("<svg") :]


def _blocks(text: str) -> list[tuple[str, Any]]:
    """(kind, content) of the few Markdown forms that the page has: title, heading, table, paragraph."""
    blocks: list[tuple[str, Any]] = []
    for part in re.split(r"\n\s*\n", text.strip()):
        lines = part.strip().splitlines()
        if lines[0].startswith("#"):
            level, _, title = lines[0].partition(" ")
            blocks.append(("title" if level == "#" else "heading", title))
        elif lines[0].startswith("|"):
            rows = [[c.strip().replace("\\|", "|") for c in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
            blocks.append(("table", (rows[0], rows[2:])))
        else:
            blocks.append(("paragraph", re.sub(r"[*`]", "", " ".join(lines))))
    return blocks
