"""Guarded terms: wherever a guard holds, the values found satisfy the body; elsewhere there are none."""

from fractions import Fraction
from itertools import product

import pytest

from qe.elimination.vs.parametric import parametric_witnesses
from qe.errors import DegreeTooHigh, InputError
from qe.exact.sample import Point
from qe.formula.evaluate import holds_at, truth_under
from qe.formula.syntax import Exists, ForAll
from qe.io.text import read
from qe.options import Budget
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from tests.tables import each


@each(
    "ex x. a*x = b",
    "ex x. x > a and x < b",
    "ex x. x^2 = a and x > b",
    "ex x, y. x + y = a and x - y > b and y >= 0",
    "all x. a*x > b",
    "ex x. a*x^2 + x < b",
)
def test_values_at_every_parameter(text: str) -> None:
    block = read(text)
    assert isinstance(block, Exists | ForAll)
    found = parametric_witnesses(block, budget=Budget(60))
    equivalent = found.equivalent_to(block)
    solved = 0
    for a, b in product(map(Fraction, (-2, 0, 1, 3)), repeat=2):
        given = {"a": a, "b": b}
        everywhere = {**dict.fromkeys(block.ring.names if block.ring else (), Fraction(0)), **given}
        guarded = [w for w in found if holds_at(w.guard, everywhere)]
        assert holds_at(equivalent, everywhere) is (bool(guarded) is isinstance(block, Exists))
        for witness in guarded[:2]:
            values = witness.at(given)
            names = block.ring.names if block.ring else ()
            point = Point.of(block.ring, [values.get(n, given.get(n, Fraction(0))) for n in names])  # type: ignore[arg-type]
            assert truth_under(block.body, point.sign) is isinstance(block, Exists)
            solved += 1
    assert solved


def test_terms_and_errors() -> None:
    (one,) = parametric_witnesses(read("ex x. x = a + 1"), budget=Budget(60))  # type: ignore[arg-type]
    assert str(one).startswith("x = ") and one.at({"a": 2}) == {"x": 3}
    with pytest.raises(InputError, match="a value for a expected"):
        parametric_witnesses(read("ex x. x^2 = a"), budget=Budget(60))[0].at({})
    bounded = parametric_witnesses(read("ex x. x^2 = a"), budget=Budget(60))
    with pytest.raises(InputError, match="the guard does not hold"):
        bounded[0].at({"a": -1})


@each(
    ("true", InputError, "true as it stands"),
    ("x > 0", InputError, "begins with one quantifier"),
    ("ex x. all y. y*x > a", InputError, "quantifier-free body"),
    ("ex x. x^5 + x^3 + a*x = 1", DegreeTooHigh, "does not eliminate x"),
)
def test_what_is_refused(text: str, kind: type[Exception], said: str) -> None:
    with pytest.raises(kind, match=said):
        parametric_witnesses(read(text), budget=Budget(60))


def test_the_step_is_recorded() -> None:
    log = RunLog()
    block = read("ex x. a*x = b")
    found = parametric_witnesses(block, budget=Budget(60), log=log)
    (step,) = (entry for entry in log.entries if isinstance(entry, Step))
    assert step.rule == "elimination set" and step.before == block and step.after == found.equivalent_to(block)
