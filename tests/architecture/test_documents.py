"""What the documents point at is there."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
MODULE = re.compile(r"`([\w/]+\.py)`")
LINK = re.compile(r"\]\(([^)#:]+)[)#]")


def test_named_modules_and_links_are_there() -> None:
    folders = ("qe", "bezier", "experiments", "paper_repro", "tests", "examples")
    modules = {str(path.relative_to(ROOT)) for folder in folders for path in (ROOT / folder).rglob("*.py")}
    wrong = []
    for document in DOCUMENTS:
        text = document.read_text(encoding="utf-8")
        named = [n for n in MODULE.findall(text) if not any(p == n or p.endswith(f"/{n}") for p in modules)]
        links = [link for link in LINK.findall(text) if not (document.parent / link).exists()]
        wrong += [f"{document.name}: {name}" for name in named + links]
    assert not wrong
