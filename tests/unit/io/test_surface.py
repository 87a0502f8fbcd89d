"""Surface trees: an odd number of parts."""

from __future__ import annotations

from itertools import product

import pytest

from qe.errors import InputError
from qe.formula.evaluate import holds_at
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.lowering import lower


@pytest.mark.parametrize("count", range(5))
def test_an_odd_number_of_parts_holds(count: int) -> None:
    parts: list[s.Node] = [s.Comparison([s.Name(f"x{k}", 0), s.Number(0)], [Relation.GT], 0) for k in range(count)]
    formula = lower(s.odd(parts), lambda message, at: InputError(message))
    for signs in product((0, 1), repeat=count):
        assert holds_at(formula, {f"x{k}": sign for k, sign in enumerate(signs)}) == bool(sum(signs) % 2)


def test_the_functions_take_as_many_arguments_as_the_text_says() -> None:
    assert {name: ends for name, ends in s.FUNCTIONS.items() if ends != (1, 1)} == {"min": (1, 1000), "max": (1, 1000)}
