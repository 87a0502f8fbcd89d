"""Every method that is offered can answer; what cannot is not offered."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

import qe
from qe.cli import app


@pytest.mark.parametrize("method", list(qe.Method))
def test_every_offered_method_answers(method: qe.Method) -> None:
    """``cgs`` was offered and always ended in "not available"."""
    answer = qe.eliminate("ex x. x^2 + y^2 <= 1 and x >= y", method=method)
    assert qe.decide(f"all y. ({answer.formula}) <-> (y <= 1 and y >= -1 and (y <= 0 or 2*y^2 <= 1))") is True


def test_the_help_names_no_other_method() -> None:
    shown = CliRunner().invoke(app, ["eliminate", "--help"], env={"COLUMNS": "200"}).output
    assert "critical" in shown and "cgs" not in shown
    with pytest.raises(qe.InputError, match="method"):
        qe.eliminate("x > 0", method="cgs")
