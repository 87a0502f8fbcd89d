"""A whole question that preparation leaves as it is gets the attempts for whole questions once."""

import pytest

import qe
from qe.elimination.protocol import Block, Context, Outcome
from qe.elimination.witness import PolynomialWitnesses
from tests.tables import each


@each(
    ("all x. ex y. (y < 0 or x - 2*y = 0) and (x < (y - a)^2 -> x <= y)", 1),
    ("all x. ex y, v. v = x^2 + a and (y < 0 or x - 2*y = 0) and (x < (y - v)^2 -> x <= y)", 1),  # named
)
def test_the_search_for_witnesses_is_made_once(text: str, times: int, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Block] = []
    search = PolynomialWitnesses.run

    def counted(self: PolynomialWitnesses, problem: Block, context: Context) -> Outcome | None:
        seen.append(problem)
        return search(self, problem, context)

    monkeypatch.setattr(PolynomialWitnesses, "run", counted)
    qe.eliminate(text, process=False)
    assert len(seen) == times
