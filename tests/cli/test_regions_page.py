"""The page about regions and its example are true: they are run."""

from __future__ import annotations

import doctest
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_page() -> None:
    text = (ROOT / "docs" / "regions.md").read_text()
    test = doctest.DocTestParser().get_doctest(text.replace("```", ""), {}, "regions", "docs/regions.md", 0)
    assert len(test.examples) > 8
    assert doctest.DocTestRunner().run(test).failed == 0


def test_the_example() -> None:
    example = ROOT / "examples" / "region_of_cubic.py"
    run = subprocess.run([sys.executable, str(example)], capture_output=True, text=True, check=True)
    assert "certificate: accepted" in run.stdout
    assert run.stdout.endswith("a point of the region True\n")
