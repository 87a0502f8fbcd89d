"""Variables that can be exchanged: which they are, and that ordering them changes nothing."""

from __future__ import annotations

import pytest

import qe
from experiments.suites.families import kissing, packing
from qe.api.input import read_formula
from qe.formula.block import Block
from qe.formula.build import exists
from qe.rules.ordered import in_order
from tests.tables import each


def body(text: str) -> Block:
    """The block of a sentence."""
    block = Block.of(read_formula(text))
    assert block is not None
    return block


@pytest.mark.parametrize(
    ("text", "pairs"),
    [
        (packing(3, "0"), [[2, 2], [2]]),
        (kissing(4), [[2, 2, 2], [2, 2], [2]]),
        ("ex x, y, z. x*y*z > 1 and x + y + z < 2", [[1, 1], [1]]),
        ("ex x, y, z. x*y*z > 1 and x + y + 2*z < 2", [[1]]),
        ("ex x, y. x - y > 1 and y < 0", []),
        ("ex x, y. x > y", []),
        ("ex x, y, z, u. x - y < 0 and z - u < 0 and x*z > 1 and y*u > 1", [[2]]),
        # x with y moves z and u: after it another of them may be the least
        ("ex x, y, z, u. x^3*y^2*z + y^3*x^2*u + z^3*u^2*x + u^3*z^2*y > 1", [[2]]),
    ],
)
def test_exchanges(text: str, pairs: list[list[int]]) -> None:
    assert [[len(exchange) // 2 for exchange in step] for step in in_order(body(text).positive)[1]] == pairs


@each(
    "ex x, y, z. x*y*z > a and x + y + z < 2 and 0 < x and 0 < y and 0 < z",
    "ex x, y, z, u. x^2 + y^2 + a < 0 and x^2 + z^2 + u^2 < 1 and y^2 + z^2 + u^2 < 1",
    "ex x, y, z, u. x - y < 0 and z - u < 0 and x*z > 1 and y*u > 1",
)
def test_ordering_changes_nothing(text: str) -> None:
    block = body(text)
    ordered, steps = in_order(block.positive)
    assert steps
    assert qe.equivalent(block.formula, exists(block.variables, ordered))
