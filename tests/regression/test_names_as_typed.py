"""A name that stands in a question may be named in its order and its parameters, whatever reading simplified away."""

from __future__ import annotations

import pytest
import sympy

import qe
from tests.cli.command import run
from tests.tables import each

GONE = (
    "0 < 0 and (ex x. x > a)",
    "1 > 0 or (all x. x^2 > a)",
    "0*x > 1 and 0*a < x",
    "ex x. x - x = 0*a",
    "`x` < `x` and a = a",
    "not (0 < 1 or (all x, a. x = a))",
)


@pytest.mark.parametrize("text", GONE)
def test_an_order_may_name_what_reading_simplified_away(text):
    expected = qe.eliminate(text).formula
    for order in ("x, a", "a, x", "x", ["a"]):
        assert qe.eliminate(text, order=order).formula == expected
        assert qe.decide(text, order=order) is qe.eliminate(text).truth
    assert qe.equivalent(text, str(expected), order="a x")
    qe.find_instance(text, order="a")
    for strange in ("b", "x, b", "ex", "and"):
        for ask in (qe.eliminate, qe.find_instance):
            with pytest.raises(qe.InputError, match="order"):
                ask(text, order=strange)


def test_names_of_other_formats_and_on_the_command_line():
    x, a = sympy.symbols("x a")
    body = sympy.Lt(x - x, sympy.Symbol("b"), evaluate=False)
    assert qe.eliminate(qe.Exists(x, sympy.And(body, sympy.Gt(a, 0))), order=[a, x]).formula is not None
    script = "(declare-const x Real)(declare-const a Real)(assert (and (< 0 0) (< x a)))"
    assert qe.eliminate(script, format="smtlib", order="a, x").truth is False
    assert run("qe", "eliminate", GONE[0], "--order", "x, a").stdout == "false\n"
    refused = run("qe", "eliminate", GONE[0], "--order", "x, b")
    assert refused.returncode == 2 and "x, b found" in refused.stderr


@each(("x^2 + 0*a", "x > 1"), ("x^2", "0*a = 0"), ("x", "a < a and x > 0"), ("x*0 + x", "a = a"))
def test_parameters_may_be_what_reading_simplified_away(objective, constraints):
    assert str(qe.minimize(objective, constraints, parameters="a"))
    with pytest.raises(qe.InputError, match="parameters"):
        qe.minimize(objective, constraints, parameters="b")


def test_a_witness_may_be_named_in_the_order():
    assert qe.check_witness("all a. ex x. x > a", {"x": "a + 1"}, order="a, x")
