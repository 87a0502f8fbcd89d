"""Builders refuse parts over different rings, and join all others."""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations

import pytest

from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall, iff, implies, neg, root_atom
from qe.formula.syntax import TRUE, And, Formula, Or, Relation
from tests.tables import each

NARROW, WIDE = Ring.of(("x",)), Ring.of(("x", "y"))
SMALL = atom(NARROW.var("x"), Relation.GT)
LARGE = atom(WIDE.var("x") - 1, Relation.LT)
ROOT = root_atom("x", Relation.EQ, WIDE.var("x") ** 3 - WIDE.var("y"), 1)


@each(conj, disj, And, Or)
@pytest.mark.parametrize(
    "foreign",
    [LARGE, ROOT, neg(ROOT), conj((LARGE, ROOT)), disj((LARGE, ROOT)), exists(["y"], ROOT), forall(["x"], LARGE)],
    ids=str,
)
def test_a_formula_over_two_rings_is_an_error_where_it_is_built(
    join: Callable[[tuple[Formula, ...]], Formula], foreign: Formula
) -> None:
    own = atom(NARROW.var("x") + 2, Relation.NE)
    for parts in permutations((SMALL, own, foreign)):
        with pytest.raises(InternalError, match=r"over two rings: Ring\(x(, y)?\) and Ring\(x(, y)?\)"):
            join(parts)
    assert join((SMALL, own)).ring is NARROW


@each(implies, iff)
def test_implications_are_over_one_ring(join: Callable[[Formula, Formula], Formula]) -> None:
    with pytest.raises(InternalError):
        join(SMALL, LARGE)
    assert join(convert(SMALL, WIDE), LARGE).ring is WIDE


def test_constants_go_with_every_ring() -> None:
    assert conj((TRUE, SMALL)) is SMALL
    assert And((TRUE, SMALL)).ring is NARROW
    assert And((TRUE, TRUE)).ring is None
