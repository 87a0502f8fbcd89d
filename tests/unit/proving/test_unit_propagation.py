"""Unit propagation against truth tables: what it derives is implied, and it derives what it should."""

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from qe.proving.unit_propagation import Clauses

SIZE = 5
LITERALS = st.integers(1, SIZE).flatmap(lambda v: st.sampled_from((v, -v)))
CLAUSES = st.lists(st.lists(LITERALS, max_size=4), max_size=9)


def clauses(given: list[list[int]]) -> Clauses:
    found = Clauses(lambda: None)
    for clause in given:
        found.add(clause)
    return found


def models(given: list[list[int]]) -> list[tuple[bool, ...]]:
    """The assignments that make all clauses true."""
    found = product((False, True), repeat=SIZE)
    return [m for m in found if all(any(m[abs(x) - 1] is (x > 0) for x in clause) for clause in given)]


def by_hand(given: list[list[int]], clause: list[int]) -> bool:
    """The same by going through all clauses again and again."""
    true = {-x for x in clause}
    if any(-x in true for x in true):
        return True
    while True:
        new = set()
        for c in given:
            left = {x for x in c if -x not in true}
            if not left:
                return True
            if len(left) == 1:
                new |= left - true
        if not new:
            return False
        true |= new
        if any(-x in true for x in true):
            return True


@given(CLAUSES, st.lists(st.lists(LITERALS, max_size=3), min_size=1, max_size=5))
def test_what_it_derives_is_implied_and_nothing_is_missed(known: list[list[int]], asked: list[list[int]]) -> None:
    prover = clauses(known)
    for clause in asked:  # one after the other: what was watched last time is watched the next time
        used = prover.implying(clause)
        assert (used is not None) is by_hand(known, clause)
        if used is None:
            continue
        part = [known[k] for k in used]
        assert all(any(m[abs(x) - 1] is (x > 0) for x in clause) for m in models(part))
        if used:
            prover.add(clause)
            known = [*known, clause]


def test_every_literal_is_work() -> None:
    ticks: list[int] = []
    prover = Clauses(lambda: ticks.append(1))
    for k in range(1, 50):
        prover.add([-k, k + 1])
    assert prover.implying([-1, 50]) is not None
    assert len(ticks) >= 48
