"""The page and the Markdown text: complete, self-contained, and written all or nothing."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest

import qe
from paper_repro import __main__ as command
from paper_repro import markdown, page
from paper_repro.claim import examine_all
from paper_repro.claims import CLAIMS
from tests.paper_repro.test_claims import stated

ROOT = Path(__file__).resolve().parents[2]
SOME = ("radius-rule", "spline-leaves", "eq-3", "index-condition", "conclusion-future")
VOID = {"meta", "br", "img", "link"}


class Reader(HTMLParser):
    """Links, identifiers, and whether every element is closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.links: list[str] = []
        self.ids: list[str] = []
        self.fetched: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attributes:
            if tag == "a" and name == "href":
                self.links.append(value or "")
            elif name == "id":
                self.ids.append(value or "")
            elif name == "src" or (tag == "link" and name == "href"):
                self.fetched.append(value or "")

    def handle_startendtag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("paper") / "out"
    assert command.main(["--out", str(place), *(word for key in SOME for word in ("--only", key))]) == 0
    return place


@pytest.fixture(scope="module")
def html(folder: Path) -> str:
    return (folder / "index.html").read_text()


def test_the_page_needs_nothing_from_elsewhere(html: str, folder: Path) -> None:
    reader = Reader()
    reader.feed(html)
    assert not reader.open
    assert reader.fetched == ["data:,"], "no icon is asked for either"
    assert not re.search(r"@import|url\((?!#)", html)
    for link in reader.links:
        assert link[1:] in reader.ids if link.startswith("#") else (folder / link).is_file(), link


def test_every_entry_is_on_the_page(html: str) -> None:
    for given in CLAIMS:
        assert (f'<article id="{given.key}">' in html) is (given.key in SOME)
        if given.key in SOME:
            assert given.verdict.value in html
            assert f"--only {given.key}" in html


def test_formulas_are_mathml_and_none_is_left_as_source(html: str) -> None:
    elements = re.findall(r"<math.*?</math>", html, re.DOTALL)
    assert len(elements) > 20
    for element in elements:
        ElementTree.fromstring(element)
    visible = re.sub(r"<(pre|code|svg|style).*?</\1>", "", html, flags=re.DOTALL)
    assert "$" not in visible
    assert "\\" not in visible


def test_certificates_beside_the_page_are_accepted(folder: Path) -> None:
    files = sorted(folder.glob("certificate-*.json"))
    assert files
    assert all(qe.verify(qe.Certificate.from_json(f.read_text())).accepted for f in files)


def test_markdown_has_every_entry_and_its_files(folder: Path) -> None:
    text = (folder / "paper.md").read_text()
    for key in SOME:
        assert f"--only {key}" in text
    targets = re.findall(r"\]\(([^)]+)\)", text)
    assert targets
    assert all((folder / t).is_file() for t in targets)


def test_an_unknown_entry_is_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["--out", str(tmp_path / "out"), "--only", "nothing"]) == 2
    assert "nothing" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_failed_check_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "CLAIMS", (stated("bad", False),))
    assert command.main(["--out", str(tmp_path)]) == 1
    assert "not borne out: the statement" in capsys.readouterr().out
    assert "the check failed" in (tmp_path / "index.html").read_text()
    assert "✗ the statement" in (tmp_path / "paper.md").read_text()


def test_sections_keep_the_order_of_the_paper() -> None:
    entries = examine_all([stated("one", True)])
    assert list(page.by_section(entries)) == ["1 Introduction"]
    assert page.counted(entries)[page.Verdict.REPRODUCED] == 1


def test_every_claim_stands_under_a_heading() -> None:
    """The claims of the paper's references have no section of the paper: the page was not written at all."""
    (entry,) = examine_all([stated("one", True)])
    found = page.by_section([replace(entry, claim=claim) for claim in CLAIMS])
    assert sum(map(len, found.values())) == len(CLAIMS)
    last = [e.claim.key for e in found[page.SECTIONS["references"]]]
    assert "arm-33-segments" in last and all(key.startswith("arm-") for key in last)


def test_the_documentation_lists_the_verdicts() -> None:
    text = (ROOT / "docs" / "paper.md").read_text()
    missing = [line for line in markdown.summary(CLAIMS) if line not in text.splitlines()]
    assert not missing, "python -m paper_repro --list prints the table"
