"""``experiments proofs``: what is counted."""

from __future__ import annotations

from typer.testing import CliRunner

from experiments.cli import app
from experiments.problem import Problem
from experiments.proofs import Proved, lines, measured


def test_a_proved_answer() -> None:
    row = measured(Problem("mine", "line", "ex x. a*x = b and x > 1"), 10, 2048)
    assert row.by_steps
    assert row.same
    assert row.size > 100
    assert row.check > 0


def test_the_figures() -> None:
    problem = Problem("mine", "one", "true")
    rows = [
        Proved(problem, True, True, (), True, 0.1, 0.3, 0.2, 1000),
        Proved(problem, True, True, ("magic",), True, 0.1, 0.3, 0.2, 1000),
        Proved(problem, True, False, ("magic",), False, 0.1, 0.3),
        Proved(problem, False),
    ]
    text = "\n".join(lines(rows))
    assert "4 problems, 3 solved" in text
    assert "every step checked 1, by a decomposition instead 1, not checked 1" in text
    assert "median 2.00" in text
    assert "magic (2)" in text
    assert "OTHER ANSWERS with the check: one" in text


def test_the_command() -> None:
    result = CliRunner().invoke(app, ["proofs", "--only", "vacuous-exists"])
    assert result.exit_code == 0
    assert "every step checked 1" in result.output
