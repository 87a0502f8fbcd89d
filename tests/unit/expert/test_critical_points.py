"""Sets of active conditions with their Jacobian minors, and chains of combinations of them."""

from __future__ import annotations

from typing import Any

import pytest

from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Poly, Ring
from qe.expert.critical_points import MOST_SETS, MOST_VARIABLES, active_sets, vanishing
from qe.proof.entry import Entry, poly_to_text
from tests.tables import each

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)
FREE = 2


def sets(inequalities: list[Poly], equations: list[Poly] = [], free: int = FREE) -> list[list[Poly]]:
    return list(active_sets(inequalities, equations, free))


def test_one_condition_vanishes_with_its_gradient() -> None:
    disc = (X - A) ** 2 + (Y - B) ** 2 - 1
    assert sets([disc]) == [[disc, 2 * (X - A), 2 * (Y - B)]]


def test_up_to_one_condition_more_than_variables() -> None:
    """m + 1 = 3 of four conditions in two variables; where there are as many as variables, their Jacobian vanishes."""
    lines = [X - A, Y - B, X + Y, X - Y]
    found = sets(lines)
    assert [len([p for p in part if p in lines]) for part in found] == [1] * 4 + [2] * 6 + [3] * 4
    # a single linear condition has a constant gradient: a nonzero constant is among what vanishes
    assert [p.is_constant for p in found[0][1:]] == [True]
    (both,) = [part for part in found if part[:2] == lines[:2] and part[2] not in lines]
    assert both[2] == RING.constant(1)
    assert all(len(part) == 3 for part in found[-4:])  # no minors of more rows than columns


def test_the_jacobian_of_two_curves() -> None:
    f, g = X**2 + A * Y, X * Y - B
    part = next(s for s in sets([f, g]) if s[:2] == [f, g])
    assert part[2] == 2 * X * X - A * Y


def test_three_rows_by_expansion() -> None:
    ring = Ring.of(("a", "x", "y", "z"))
    x, y, z = (ring.var(name) for name in "xyz")
    f, g, h = x * y, y * z, z * x + y
    part = next(s for s in active_sets([f, g, h], [], 1) if s[:3] == [f, g, h])
    assert part[3] == 2 * x * y * z - y**2


def test_equations_are_always_active_and_leave_room_for_fewer() -> None:
    h, f, g = X - A, X * Y - B, Y**2 - B
    assert sets([], [h]) == [[h, RING.constant(1)]]
    found = sets([f, g], [h])
    assert [part[0] for part in found] == [h] * 4 and [sum(p in part for p in (f, g)) for part in found] == [0, 1, 1, 2]
    assert sets([f], [h, X - 1, Y - 2]) == [[h, X - 1, Y - 2]]


def test_conditions_without_the_variables_stand_alone() -> None:
    assert sets([A - B, X - A, X - A]) == [[A - B], [X - A, RING.constant(1)]]
    assert sets([A]) == [[A]]
    assert sets([]) == []


def test_limits() -> None:
    many = Ring.of(tuple(f"y{k}" for k in range(MOST_VARIABLES + 1)))
    with pytest.raises(Unable, match=f"more than {MOST_VARIABLES} variables"):
        list(active_sets([many.gen(0)], [], 0))
    few = Ring.of(tuple(f"y{k}" for k in range(MOST_VARIABLES)))
    conditions = [few.gen(0) - k for k in range(40)]
    with pytest.raises(Unable, match=f"more than {MOST_SETS} sets"):
        for _ in active_sets(conditions, [], 0):
            pass


def chain(*rows: list[tuple[int, Poly | int]]) -> Entry:
    def text(c: Poly | int) -> str:
        return poly_to_text(RING.constant(c) if isinstance(c, int) else c)

    return Entry([[[k, text(c)] for k, c in row] for row in rows], "chain")


def test_a_chain_leads_to_the_parameters() -> None:
    """From x^2 - a = 0 and x - b = 0 to b^2 - a = 0."""
    start = [X**2 - A, X - B]
    assert vanishing(start, chain([(0, 1), (1, -X - B)]), FREE, RING) == [(B**2 - A).normal()[1]]
    two = chain([(1, X)], [(0, 1), (2, -1)], [(3, 1), (1, -B)])
    assert vanishing(start, two, FREE, RING) == [(B**2 - A).normal()[1]]
    assert vanishing([A - 1, X], Entry([], "chain"), FREE, RING) == [A - 1]


@each(
    (chain(), "no polynomial in the parameters"),
    (chain([(0, 1)]), "no polynomial in the parameters"),
    (chain([(0, 1), (0, -1)]), "the combination is 0"),
    (chain([]), "the combination is 0"),
    (chain([(2, 1)]), "number of a polynomial before it"),
    (chain([(0, X), (1, 1)], [(3, 1)]), "number of a polynomial before it"),
    (Entry([[[0]]], "chain"), "number of a polynomial"),
    (Entry([[[0, "x", "1"]]], "chain"), "number of a polynomial"),
)
def test_chains_that_prove_nothing(given: Any, reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        vanishing([X**2 - A, X - B], given, FREE, RING)


def test_long_products_are_refused() -> None:
    long = sum((X**i * Y**j for i in range(25) for j in range(25)), RING.constant(0))
    with pytest.raises(Unable, match="a product of more than"):
        vanishing([long], chain([(0, long)]), FREE, RING)
