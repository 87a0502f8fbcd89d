"""Blocks that only ask polynomials not to vanish."""

from __future__ import annotations

import pytest

import qe
from qe.elimination.nonzero import OnlyNonzero, only_nonzero
from qe.elimination.protocol import Context, Problem
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.run_log import RunLog


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("a*x^5 + b /= 0", "a /= 0 or b /= 0"),
        ("a*x + b /= 0 and x^2 - c /= 0", "a /= 0 or b /= 0"),
        ("a*x /= 0 and b*x - b /= 0 and c > 0", "a /= 0 and b /= 0 and c > 0"),
    ],
)
def test_some_coefficient_does_not_vanish(body: str, expected: str) -> None:
    found = only_nonzero(("x",), read(body))
    assert found is not None
    assert qe.equivalent(found, expected)
    assert qe.equivalent(found, qe.eliminate(f"ex x. {body}", method="cad").formula)


@pytest.mark.parametrize("body", ["a*x > 0", "a*x /= 0 or x = 1", "a*x /= 0 and x >= b"])
def test_other_shapes_are_left_alone(body: str) -> None:
    assert only_nonzero(("x",), read(body)) is None


def test_a_body_that_asks_more_is_left_to_other_methods() -> None:
    for text, answer in (("ex x. a*x^2 + b /= 0", "a /= 0 or b /= 0"), ("ex x. a*x /= 0 and x > b", None)):
        problem = Problem.of(read(text))
        assert problem is not None and OnlyNonzero().suits(problem, Options())
        found = OnlyNonzero().run(problem, Context(Options(), Budget(), RunLog()))
        assert (None if found is None else str(found.formula)) == answer
