"""Levels that are to be told apart by signs, where a factor is nullified."""

from itertools import permutations

import pytest

import qe
from qe.certify.verify import verify
from qe.decomposition.decompose import decompose
from qe.decomposition.operators.lazard import LAZARD
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import Cell
from qe.proof.certificate import Certificate

POSITIVE_ROOT = "x^3 + b*x^2 + c*x + d = 0 and x > 0"


def _stacks(cell: Cell, depth: int) -> list[Cell]:
    if cell.stack is None:
        return []
    return [cell] if depth == 0 else [c for below in cell.stack.cells for c in _stacks(below, depth - 1)]


def test_all_cells_of_a_separated_stack_differ_in_signs() -> None:
    """The discriminant of the cubic is zero where d = c = 0; a derivative tells b < 0 from b > 0 there."""
    order, quantifiers = ("d", "c", "b", "x"), ("", "", "", "E")

    def repeated(thom_levels: frozenset[int]) -> int:
        table = decompose(
            read(POSITIVE_ROOT),
            order,
            quantifiers,
            budget=Budget(),
            operator=LAZARD,
            thom_levels=thom_levels,
        ).table
        assert verify(Certificate.cells(table)).accepted
        stacks = [s.stack.cells for s in _stacks(table.root, 2) if s.stack is not None]
        return sum(len({c.signs for c in cells}) < len(cells) for cells in stacks)

    assert repeated(frozenset())
    assert not repeated(frozenset({2}))


SLOW = (("c", "d", "b"), ("d", "c", "b"))
"""Orders with seconds of work each; the one above is of their kind."""


@pytest.mark.parametrize(
    "order", [pytest.param(o, marks=pytest.mark.deep if o in SLOW else ()) for o in permutations("bcd")]
)
def test_a_positive_root_of_a_cubic_in_every_order(order: tuple[str, ...]) -> None:
    answer = qe.eliminate(f"ex x. {POSITIVE_ROOT}", method="cad", order=order).formula
    assert qe.equivalent(answer, "d < 0 or (b < 0 or c < 0) and 4*b^3*d - b^2*c^2 - 18*b*c*d + 4*c^3 + 27*d^2 <= 0")
