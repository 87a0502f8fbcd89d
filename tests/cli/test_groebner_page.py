"""The page about Gröbner bases is true: it is run."""

from __future__ import annotations

import doctest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_page() -> None:
    text = (ROOT / "docs" / "groebner.md").read_text()
    test = doctest.DocTestParser().get_doctest(text.replace("```", ""), {}, "groebner", "docs/groebner.md", 0)
    assert len(test.examples) > 8
    assert doctest.DocTestRunner().run(test).failed == 0
