"""Finite sets of minimisers are listed point by point; infinite ones are not."""

from __future__ import annotations

from typing import Any

import pytest

import qe
from qe.cli.app import main
from qe.exact.number import point_text
from qe.io.text import read
from qe.optimization.finite import listed
from qe.options import Budget
from tests.tables import each


@each(
    ("x^2 = 1 and y^2 = 2 and x*y > 0", ["x = -1, y = -sqrt(2)", "x = 1, y = sqrt(2)"]),
    ("x^2 + y^2 <= 0", ["x = 0, y = 0"]),
    ("x^2 + y^2 <= 1", []),
    (
        "x*y = 0 and x^2 = x and y >= 0 and y <= 1 and y^2 = y*x^2 + y",
        ["x = 0, y = 0", "x = 0, y = 1", "x = 1, y = 0"],
    ),
    ("x = 0 and y >= 0", []),
    ("x = 0", []),
    ("x = y and ex z. z^2 + x^2 = 0", ["x = 0, y = 0"]),
    ("x = y and x^2 < 0", []),
)
def test_points_of_a_set(text: str, points: list[str]) -> None:
    assert list(map(point_text, listed(read(text), ("x", "y"), Budget()))) == points


def test_little_work_is_spent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("qe.optimization.finite.MOST_WORK", 1)
    assert listed(read("x^2 = 1 and y^2 = x"), ("x", "y"), Budget()) == ()
    monkeypatch.undo()
    monkeypatch.setattr("qe.optimization.finite.MOST_POINTS", 1)
    assert listed(read("x^2 = 1 and y^2 = x"), ("x", "y"), Budget()) == ()


@each(
    ("x^4 - x^2", "x^2 <= 4", "-1/4 at x = -sqrt(2)/2 or x = sqrt(2)/2"),
    ("x^4 + y^4 - 4*x*y", "true", "-2 at x = -1, y = -1 or x = 1, y = 1"),
    ("abs(x - 1) + abs(x + 1)", "true", "2 at x = 1, for example"),
    ("(x*y - 1)^2 + x^2", "true", "0, not attained"),
    ("x", "ex y. y^2 = x - 1", "1 at x = 1"),
)
def test_all_minimisers_are_shown(objective: str, where: str, shown: str) -> None:
    found: Any = qe.minimize(objective, where)
    assert repr(found) == f"GlobalOptimum({shown})"
    assert ("or" in found._repr_latex_()) is (len(found.points) > 1)


def test_at_numbers_for_the_parameters() -> None:
    found = qe.minimize("x^4 - a*x^2", parameters="a").at({"a": 2})
    assert repr(found) == "GlobalOptimum(-1 at x = -1 or x = 1)"


def test_the_command_prints_all_points(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["minimize", "x^4 - x^2", "x^2 <= 4"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(" (")[0] for line in lines[1:4]] == [
        "at x = -sqrt(2)/2",
        "at x = sqrt(2)/2",
        "attained nowhere else",
    ]
