"""What the documents point at is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
MODULE = re.compile(r"`([\w/]+\.py)`")
LINK = re.compile(r"\]\(([^)#:]+)[)#]")


@pytest.fixture(scope="module")
def modules() -> set[str]:
    folders = ("qe", "bezier", "experiments", "paper_repro", "tests", "examples")
    return {str(path.relative_to(ROOT)) for folder in folders for path in (ROOT / folder).rglob("*.py")}


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_modules_and_links(document: Path, modules: set[str]) -> None:
    text = document.read_text(encoding="utf-8")
    named = MODULE.findall(text)
    gone = [name for name in named if not any(path == name or path.endswith(f"/{name}") for path in modules)]
    assert not gone, f"no such module: {gone}"
    broken = [link for link in LINK.findall(text) if not (document.parent / link).exists()]
    assert not broken, f"no such file: {broken}"
