"""The page: all entries as one HTML file that needs nothing from elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from importlib.resources import files
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from bezier.report.html import Card, Page, Section, described, document
from paper_repro import tex
from paper_repro.claim import Asked, Entry, Evidence, Fact, Picture, Table, Verdict

PAPER = (
    "R. Hatakeyama, A. Terui, M. Mikawa: Towards Trajectory Planning of a Robot Manipulator with Computer Algebra "
    "using "
    "Bézier Curves for Obstacle Avoidance. SCSS 2024, CEUR Workshop Proceedings 3754."
)
SECTIONS = {
    "1": "1 Introduction",
    "2": "2 The feasible region and its radius",
    "3": "3 Bézier curves",
    "4": "4 Path planning: assumptions",
    "4.1": "4.1 Method 1: one curve of degree n",
    "4.2": "4.2 Method 2: three cubic curves",
    "4.2.1": "4.2.1 Three curves of degree 2",
    "5": "5 Conclusions",
    "references": "References of the paper, about the arm",
}
_SECTION = re.compile(r"Section (\d(?:\.\d)*)")


def by_section(entries: Iterable[Entry]) -> dict[str, list[Entry]]:
    """The entries under the headings of the paper's sections, in its order; what its references say last."""
    found: dict[str, list[Entry]] = {heading: [] for heading in SECTIONS.values()}
    for entry in entries:
        section = _SECTION.search(entry.claim.place)
        found[SECTIONS["references" if section is None else section[1]]].append(entry)
    return {heading: members for heading, members in found.items() if members}


def counted(entries: Sequence[Entry]) -> dict[Verdict, int]:
    """How many entries have each verdict; the verdict FAILED only where it occurs."""
    numbers = {v: sum(e.verdict is v for e in entries) for v in Verdict}
    return {v: n for v, n in numbers.items() if n or v is not Verdict.FAILED}


def certificate_name(entry: Entry, item: Asked) -> str:
    """The file that holds the certificate of one answer."""
    members = [e for e in entry.evidence if isinstance(e, Asked) and e.certificate is not None]
    return f"certificate-{entry.claim.key}-{members.index(item) + 1}.json"


def picture_name(entry: Entry, item: Picture) -> str:
    """The file that holds one picture."""
    members = [e for e in entry.evidence if isinstance(e, Picture)]
    return f"figure-{entry.claim.key}-{members.index(item) + 1}.svg"


def render(entries: Sequence[Entry], made: str) -> str:
    """The HTML page. ``made``: with what and when, for the footer."""
    environment = Environment(loader=PackageLoader("paper_repro"), autoescape=True, undefined=StrictUndefined)
    environment.trim_blocks = environment.lstrip_blocks = True
    environment.filters["math"] = lambda text: Markup(tex.inline(text))
    article, overview = (environment.get_template(f"{name}.html.j2") for name in ("article", "overview"))
    shown = {heading: [_shown(e) for e in members] for heading, members in by_section(entries).items()}
    keys = {entry.claim.key for entry in entries}
    sections = [Section("overview", "Overview", Markup(overview.render(sections=shown, seconds=_seconds(entries))))]
    for heading, members in shown.items():
        articles = Markup("\n").join(Markup(article.render(entry=entry, keys=keys)) for entry in members)
        number = heading.partition(" ")[0]
        sections.append(Section(f"section-{number}", heading, articles, short=number, bare=True))
    page = Page(
        title="The paper, claim by claim",
        lead=PAPER,
        cards=[Card(v.value, str(n), v.name.lower()) for v, n in counted(entries).items()],
        sections=sections,
        footer=made,
        style=(files("paper_repro") / "templates" / "page.css").read_text(encoding="utf-8"),
    )
    return document(page)


def _seconds(entries: Sequence[Entry]) -> float:
    return sum(entry.seconds for entry in entries)


def _shown(entry: Entry) -> dict[str, Any]:
    return {
        "claim": entry.claim,
        "verdict": entry.verdict.value,
        "tone": entry.verdict.name.lower(),
        "evidence": list(_evidence(entry)),
        "seconds": entry.seconds,
    }


def _evidence(entry: Entry) -> Iterator[dict[str, Any]]:
    for item in entry.evidence:
        yield {"kind": type(item).__name__.lower(), "item": item, **_extra(entry, item)}


def _extra(entry: Entry, item: Evidence) -> dict[str, Any]:
    match item:
        case Asked():
            file = certificate_name(entry, item) if item.certificate is not None else ""
            return {
                "answer": Markup(tex.math(item.answer, display=not item.is_short)),
                "time": _time(item.seconds),
                "file": file,
            }
        case Picture():
            return {"svg": described(item.svg, item.caption)}
        case Fact() | Table():
            return {}


def _time(seconds: float) -> str:
    return f"{1000 * seconds:.0f} ms" if seconds < 1 else f"{seconds:.1f} s"
