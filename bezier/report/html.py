"""The building blocks of every page: text, tables, pictures, and the page that holds them as a list of sections.

A section is a title with its content, so that a page is data until ``document`` writes it. Text is escaped where it
is inserted; what is already HTML is ``Markup``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

Text = str | Markup


@dataclass(frozen=True, slots=True)
class Section:
    """``key``: its anchor; ``short``: its name in the navigation; ``bare``: without a frame around it."""

    key: str
    title: Text
    content: Markup
    short: str = ""
    bare: bool = False


@dataclass(frozen=True, slots=True)
class Card:
    """One figure beside the first picture, with a smaller line below it."""

    label: str
    value: Text
    tone: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """``first``: the picture of the first screen, beside the cards; ``style``: rules of this page alone."""

    title: str
    lead: Text
    sections: Sequence[Section]
    footer: Text
    cards: Sequence[Card] = ()
    first: Markup | None = None
    style: str = ""


def document(page: Page) -> str:
    """The page as one file that needs nothing from elsewhere."""
    contents = [page.first or "", *(section.content for section in page.sections)]
    scripts = ["print.js", *(["scene.js"] if any("data-scene" in content for content in contents) else [])]
    script = Markup("".join(map(_shipped, scripts)))
    result: str = _template().render(page=page, style=Markup(_shipped("style.css")), script=script)
    return result


@lru_cache(maxsize=1)
def _template() -> Template:
    environment = Environment(loader=PackageLoader("bezier.report"), autoescape=True, undefined=StrictUndefined)
    environment.trim_blocks = True
    return environment.get_template("page.html.j2")


def _shipped(name: str) -> str:
    return (files("bezier.report") / "templates" / name).read_text(encoding="utf-8")


def package_version() -> str:
    """The version of this package, as installed."""
    try:
        return version("bezier-qe")
    except PackageNotFoundError:
        return "(not installed)"


# --- pieces -----------------------------------------------------------------------------------------------
def joined(*parts: Text | None) -> Markup:
    """One after the other; None is nothing."""
    return Markup("\n").join(part for part in parts if part is not None and part != "")


def paragraph(text: Text, kind: str = "") -> Markup:
    """A paragraph; ``kind``: note, good, bad."""
    return Markup('<p class="{}">{}</p>').format(kind, text) if kind else Markup("<p>{}</p>").format(text)


def note(text: Text) -> Markup:
    """A paragraph in a softer colour."""
    return paragraph(text, "note")


def strong(text: Text) -> Markup:
    """What the reader has to see."""
    return Markup("<strong>{}</strong>").format(text)


def heading(text: Text) -> Markup:
    """A heading inside a section."""
    return Markup("<h3>{}</h3>").format(text)


def toned(text: Text, good: bool | None) -> Markup:
    """Text in the colour of a good or a bad result; None: neither."""
    return Markup("{}").format(text) if good is None else Markup('<span class="{}">{}</span>').format(tone(good), text)


def tone(good: bool) -> str:
    """The class of a good or a bad result."""
    return "good" if good else "bad"


def table(head: Sequence[Text], rows: Iterable[Sequence[Text]], *, numbers: Sequence[int] = ()) -> Markup:
    """A table; ``numbers``: the columns that are aligned to the right. Nothing without rows."""
    lines = [_row("td", row, numbers) for row in rows]
    if not lines:
        return Markup("")
    top = _row("th", head, numbers) if head else Markup("")
    return Markup('<div class="scroll"><table>{}{}</table></div>').format(top, Markup("\n").join(lines))


def _row(kind: str, cells: Sequence[Text], numbers: Sequence[int]) -> Markup:
    shape = {False: Markup(f"<{kind}>{{}}</{kind}>"), True: Markup(f'<{kind} class="num">{{}}</{kind}>')}
    return Markup("<tr>{}</tr>").format(Markup("").join(shape[k in numbers].format(c) for k, c in enumerate(cells)))


def folded(summary: Text, *content: Text) -> Markup:
    """What is shown after a click."""
    return Markup("<details><summary>{}</summary>{}</details>").format(summary, joined(*content))


def formula(lines: Iterable[Text]) -> Markup:
    """Formulas, one a line."""
    return Markup('<div class="formula">{}</div>').format(
        Markup("\n").join(Markup("<div>{}</div>").format(line) for line in lines)
    )


def pre(text: str) -> Markup:
    """Text as it is."""
    return Markup("<pre>{}</pre>").format(text)


def bullets(lines: Iterable[Text]) -> Markup:
    """A list; nothing without lines."""
    items = [Markup("<li>{}</li>").format(line) for line in lines]
    return Markup("<ul>{}</ul>").format(Markup("").join(items)) if items else Markup("")


def figures(drawings: Iterable[tuple[str, str]], *, wide: bool = False) -> Markup:
    """Drawings side by side where there is room: SVG text and what it shows, in words."""
    items = [
        Markup("<figure>{}<figcaption>{}</figcaption></figure>").format(described(svg, words), words)
        for svg, words in drawings
    ]
    kind = "views wide" if wide else "views"
    return Markup('<div class="{}">{}</div>').format(kind, Markup("\n").join(items)) if items else Markup("")


def described(svg: str, words: str) -> Markup:
    """An SVG element with its alternative text."""
    return Markup('<svg role="img" aria-label="{}"').format(words) + Markup(svg.removeprefix("<svg"))
