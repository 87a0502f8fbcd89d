"""The HTML page: everything of benchmarks.md with the pictures inside, one self-contained file."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from experiments.figures import Picture
from experiments.results import Log
from experiments.tables import page as markdown_page

TEMPLATE = Path(__file__).parent / "templates" / "benchmarks.html.j2"


def html(log: Log, pictures: Sequence[Picture]) -> str:
    """The page; tables are those of the Markdown page."""
    import jinja2

    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(TEMPLATE.read_text())
    inline = [(p.caption, _inline(p.svg())) for p in pictures]
    return template.render(blocks=list(_blocks(markdown_page(log))), pictures=inline)


def _inline(svg: str) -> str:
    """The svg element alone, with names of its own (pictures on one page share one space of names)."""
    return svg[svg.index("<svg") :]


def _blocks(text: str) -> list[tuple[str, object]]:
    """(kind, content) of the few Markdown forms that the page has: title, heading, table, paragraph."""
    blocks: list[tuple[str, object]] = []
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
