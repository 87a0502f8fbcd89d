"""Every method that is offered can answer; what cannot is not offered."""

import pytest
from typer.testing import CliRunner

import qe
from qe.cli.app import app

OWN = {
    qe.Method.CONVEX: ("ex x, y. x^2 + y^2 <= 1 and x + y >= 1", "true"),
    qe.Method.WITNESS: ("all a. ex x. (x - a)^2 <= 0", "true"),
    qe.Method.COVERINGS: ("ex x, y. x^2 + y^2 < 1 and x*y > 1", "false"),
    qe.Method.CGS: ("ex x. x^2 = a and x > b", "a >= 0 and (b < 0 or b^2 < a)"),
}
"""Questions for methods that take problems of one kind only."""


@pytest.mark.parametrize("method", list(qe.Method))
def test_every_offered_method_answers(method: qe.Method) -> None:
    text, expected = OWN.get(
        method, ("ex x. x^2 + y^2 <= 1 and x >= y", "y <= 1 and y >= -1 and (y <= 0 or 2*y^2 <= 1)")
    )
    assert qe.equivalent(qe.eliminate(text, method=method), expected)


def test_the_help_names_no_other_method() -> None:
    shown = CliRunner().invoke(app, ["eliminate", "--help"], env={"COLUMNS": "200"}).output
    assert "critical" in shown and "fourier" not in shown
    with pytest.raises(qe.InputError, match="method"):
        qe.eliminate("x > 0", method="fourier")
