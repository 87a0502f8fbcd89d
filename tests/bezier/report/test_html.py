"""The building blocks of pages: text is escaped once, pages are well formed, and what is folded is not lost."""

from __future__ import annotations

from html.parser import HTMLParser

from hypothesis import example, given, settings
from hypothesis import strategies as st
from markupsafe import Markup

from bezier.report import html
from bezier.report.html import Card, Page, Section

VOID = {"meta", "link", "input", "img", "br"}
SPITEFUL = "<b>\"&'</b></script><!--"


class Reader(HTMLParser):
    """The text of a page; fails where an element is not closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.text: list[str] = []
        self.links: list[str] = []
        self.ids: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag not in VOID:
            self.open.append(tag)
        known = dict(attributes)
        self.ids += [str(known["id"])] if "id" in known else []
        self.links += [str(known["href"])] if tag == "a" else []

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not self.open or self.open[-1] not in ("style", "script"):
            self.text.append(data)


def read(page: str) -> Reader:
    reader = Reader()
    reader.feed(page)
    reader.close()
    assert not reader.open
    return reader


@example(SPITEFUL)
@example("a < b & c")
@settings(max_examples=60, deadline=None)
@given(st.text(alphabet=st.characters(exclude_categories=("Cs", "Cc")), max_size=30))
def test_text_comes_out_as_it_went_in(text: str) -> None:
    pieces = html.joined(
        html.table((text, "b"), [(text, html.toned(text, True))]),
        html.folded(text, html.pre(text)),
        html.bullets([text]),
        html.formula([text]),
        html.paragraph(text, "note"),
        html.heading(html.strong(text)),
        html.figures([("<svg></svg>", text)]),
    )
    card = Card(text, text, "good", text)
    page = Page(title=text, lead=text, cards=[card], sections=[Section("a", text, pieces)], footer=text)
    assert "".join(read(html.document(page)).text).count(text) >= 14


def test_a_page_leads_to_its_sections() -> None:
    sections = [Section(key, f"about {key}", html.paragraph(SPITEFUL), short=key) for key in ("one", "two")]
    page = read(html.document(Page(title=SPITEFUL, lead="", sections=sections, footer="")))
    assert page.links == ["#content", "#one", "#two"] and {"content", "one", "two"} <= set(page.ids)
    assert "data-scene" not in html.document(Page(title="", lead="", sections=sections, footer=""))


def test_drawings_have_alternative_texts() -> None:
    shown = html.described('<svg width="3"><path/></svg>', 'a "view"')
    assert shown == '<svg role="img" aria-label="a &#34;view&#34;" width="3"><path/></svg>'


def test_tables_without_rows_are_nothing() -> None:
    assert html.table(("a",), []) == "" and html.bullets([]) == "" and html.figures([]) == ""
    assert html.table((), [("x", Markup("<b>1</b>"))], numbers=(1,)).count('<td class="num"><b>1</b></td>') == 1
