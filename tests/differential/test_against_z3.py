"""The whole engine against z3 on random formulas; ``make deep`` offers a hundred thousand."""

from __future__ import annotations

import pytest

pytest.importorskip("z3")

from tests.differential.against_z3 import block
from tests.tables import each

AT_THE_LIMIT = {"sharing 3", "sharing 5"}
"""Problems whose whole time goes by without an answer: `make deep` asks them."""
FAMILIES = ("alternations", "linear", "local", "terms", "levels", "sharing")
THOUSANDS = [("z3", first) for first in range(0, 100_000, 1000)]
THOUSANDS += [(family, first) for family in FAMILIES for first in range(0, 5000, 1000)]


@each(
    *(("z3", range(first, first + 40), 15) for first in (0, 40)),
    *((family, range(6), 2) for family in FAMILIES),
    *(pytest.param(family, range(first, first + 1000), 200, marks=pytest.mark.deep) for family, first in THOUSANDS),
)
def test_no_answer_differs(family: str, numbers: range, agreeing: int) -> None:
    seeds = [f"{family} {i}" for i in numbers]
    counts, wrong = block([seed for seed in seeds if seed not in AT_THE_LIMIT or len(seeds) > 6])
    assert not wrong
    assert counts["agree"] >= agreeing
