"""What the tables for newcomers from other systems promise is run, and the table of gains names every stage."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import sympy

import bezier
import qe

DOCS = Path(__file__).resolve().parents[2] / "docs"
TEXT = (DOCS / "coming-from.md").read_text()
ROWS = [line.split(" | ") for line in TEXT.splitlines() if line.startswith(("| `", "| reading"))]
CALL = re.compile(r"`(qe\.[a-z_]+\(.*?\)(?:\.\w+(?:\(\))?)?)`")
CALLS = [call for row in ROWS for call in CALL.findall(row[1]) if "…" not in call]


def test_the_calls_are_found() -> None:
    assert len(CALLS) >= 12


@pytest.mark.parametrize("call", CALLS)
def test_call(call: str) -> None:
    x, b = sympy.symbols("x b")
    formula = qe.eliminate("ex z. x^2 + y^2 + z^2 < 1").formula
    assert eval(call, {"qe": qe, "sympy": sympy, "x": x, "b": b, "formula": formula}) is not None


def test_every_stage_has_its_rows_in_the_table_of_gains() -> None:
    gains = (DOCS / "algorithms.md").read_text().partition("## What each step gains")[2]
    assert set(re.findall(r"^\| `(\w+)`", gains, re.M)) == {stage.value for stage in qe.Stage} | {"coverings"}


def test_every_projection_operator_has_its_row_in_the_comparison() -> None:
    text = (DOCS / "algorithms.md").read_text().partition("## The projection operators compared")[2]
    compared = text.partition("\n## ")[0]
    assert re.findall(r"^\| `([^`]+)` \| \d", compared, re.M) == [projection.value for projection in qe.Projection]


def test_every_public_name_is_in_the_reference() -> None:
    text = (DOCS / "api.md").read_text()
    for module in (qe, bezier):
        listed = set(re.findall(rf"auto(?:function|class):: {module.__name__}\.(\w+)", text)) | {"reduce"}
        errors = {name for name in module.__all__ if name in dir(qe.errors)}
        assert set(module.__all__) <= listed | errors
