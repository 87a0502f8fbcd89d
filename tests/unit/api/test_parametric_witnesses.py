"""Parametric witnesses: guards cover the block, and the terms solve it wherever their guard holds."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest

import qe
from qe.api.input import read_formula
from tests.tables import each

BLOCKS = [
    "ex x. a*x^2 + b*x + c = 0",
    "ex x. a*x + b > 0 and x < c",
    "ex x, y. x + y = a and x*y > b",
    "ex x. (x^2 = a or x^2 = b) and x > c",
    "ex x. a*x^2 + b*x + c < 0 and x > 1",
]


@pytest.mark.parametrize("text", BLOCKS)
def test_the_guards_together_are_the_block(text: str) -> None:
    found = qe.parametric_witnesses(text)
    assert found
    guards = " or ".join(f"({w.guard})" for w in found)
    assert qe.equivalent(qe.eliminate(text).formula, guards)


@pytest.mark.parametrize("text", BLOCKS)
def test_values_solve_the_body_where_the_guard_holds(text: str) -> None:
    from qe.exact.ring import Ring
    from qe.exact.sample import Point
    from qe.formula.build import convert
    from qe.formula.evaluate import truth_under

    block = read_formula(text)
    found = qe.parametric_witnesses(block)
    tried = 0
    for numbers in product((-2, 0, 1, Fraction(3, 2)), repeat=3):
        parameters = dict(zip("abc", numbers))
        for witness in found:
            try:
                values = witness.at(parameters)
            except qe.InputError:
                continue
            tried += 1
            everything = parameters | values
            ring = Ring.of(tuple(everything))
            place = Point.of(ring, [v if isinstance(v, qe.RealAlgebraic) else Fraction(v) for v in everything.values()])
            assert truth_under(convert(block.body, ring), place.sign) is True, (parameters, str(witness))
    assert tried > 10


def test_a_universal_block_gets_counterexamples() -> None:
    (found,) = qe.parametric_witnesses("all x. x^2 + b*x + c > 0")
    assert str(found.guard) == "b^2 - 4*c >= 0"
    assert found.at({"b": 0, "c": -1}).keys() == {"x"}


def test_inner_quantifiers_are_eliminated_first() -> None:
    (found,) = qe.parametric_witnesses("ex x. all y. y^2 + a > x and x > b")
    assert qe.equivalent(found.guard, "a > b")


@each(("x > 0", qe.InputError), ("ex x. x^5 + a*x + b = 0 and x > a", qe.DegreeTooHigh))
def test_what_has_none_says_so(text: str, error: type[qe.QEError]) -> None:
    with pytest.raises(error):
        qe.parametric_witnesses(text)


def test_a_missing_parameter_is_named() -> None:
    witness = qe.parametric_witnesses("ex x. x^2 = a")[0]
    with pytest.raises(qe.InputError, match="a value for a expected"):
        witness.at({})
