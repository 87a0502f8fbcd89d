"""Formula (7) where the optimum is out of reach: "number field of degree above 40" was the end of the plan."""

from __future__ import annotations

import json
from fractions import Fraction as F
from pathlib import Path

import pytest

from bezier.check.recheck import recheck
from bezier.planner.command import plan
from bezier.problem import read_problem
from qe.errors import CertificateRejected
from tests.bezier.folder_mutation import Quiet

NEAR = """
method="cubic"
start=["0","-1/10","0"]
goal=["0","1/10","-1/20"]
via=[
  ["-164593/50000","619/2000","118817/100000"],
  ["36623/25000","3991/20000","120477/100000"]]
radius="448381/100000"
"""


def summary(text: str, folder: Path) -> dict:
    folder.mkdir()
    assert plan(Quiet(), read_problem(text), folder, folder, plots=False)[1]  # type: ignore[arg-type]
    recheck(Quiet(), folder)  # type: ignore[arg-type]
    return json.loads((folder / "summary.json").read_text())


def test_five_digits_end_in_a_path_and_a_bound(tmp_path: Path) -> None:
    told = summary(NEAR, tmp_path / "out")
    value, bound = (F(told[key]["exact"]) for key in ("objective", "bound"))
    assert told["status"] == "near-optimal" and told["certified"] and 0 < value - bound <= F(1, 10**9) * value
    assert told["active"] and any("10^-9" in note for note in told["notes"])
    page = (tmp_path / "out" / "report.html").read_text()
    assert "no choice has less than" in page and "near the optimum" in page
    file = tmp_path / "out" / "summary.json"
    file.write_text(file.read_text().replace(told["bound"]["exact"], told["objective"]["exact"]))
    with pytest.raises(CertificateRejected):
        recheck(Quiet(), tmp_path / "out")  # type: ignore[arg-type]
