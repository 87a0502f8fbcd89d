"""The Python sessions of the documentation's pages are run."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
SESSIONS = re.compile(r"```pycon\n(.*?)```", re.DOTALL)
OWN_TEST = {"extending.md"}  # its sessions need the files that the page adds: tests/cli/test_extras.py
PAGES = sorted({page.name for page in DOCS.glob("*.md") if SESSIONS.search(page.read_text())} - OWN_TEST)


@pytest.mark.parametrize("page", PAGES)
def test_sessions(page: str) -> None:
    text = "\n".join(SESSIONS.findall((DOCS / page).read_text()))
    test = doctest.DocTestParser().get_doctest(text, {}, page, page, 0)
    assert len(test.examples) == text.count(">>>") > 0
    assert doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test).failed == 0


def test_every_page_is_in_the_site() -> None:
    """A page that no table of contents names would be built and never found."""
    named = set(re.findall(r"^([a-z/-]+)$", (DOCS / "index.md").read_text(), re.MULTILINE))
    pages = {page.stem for page in DOCS.glob("*.md")} | {
        f"notebooks/{page.stem}" for page in DOCS.glob("notebooks/*.ipynb")
    }
    assert pages - {"index"} <= named


@pytest.mark.parametrize("page", sorted(page.name for page in DOCS.glob("*.md")))
def test_links_lead_somewhere(page: str) -> None:
    targets = re.findall(r"\]\(([^)#:]+)\)", (DOCS / page).read_text())
    assert not [target for target in targets if not (DOCS / target).exists()]
