"""Propagation over sets of signs, against all assignments: what follows is implied, and nothing is missed."""

from __future__ import annotations

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from qe.kernel.clauses import Clauses, Literal
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, ZERO, Identity

SIZE = 4
SIGNS = (NEGATIVE, ZERO, POSITIVE)
LITERALS = st.tuples(st.integers(0, SIZE - 1), st.integers(1, 6))
CLAUSES = st.lists(st.lists(LITERALS, max_size=4), max_size=8)
SUM = Identity(((POSITIVE, ((0, True),)), (POSITIVE, ((1, True),)), (NEGATIVE, ((2, True),))))
"""Polynomial 2 is the sum of 0 and 1."""


def clauses(listed: list[list[Literal]], *, with_sum: bool) -> Clauses:
    found = Clauses(lambda: None)
    for _ in range(SIZE):
        found.new(ANY)
    if with_sum:
        found.learn(SUM)
    for clause in listed:
        found.add(clause)
    return found


def models(listed: list[list[Literal]], *, with_sum: bool) -> list[tuple[int, ...]]:
    """The assignments of one sign each that make all clauses true."""
    return [
        m
        for m in product(SIGNS, repeat=SIZE)
        if all(any(m[i] & signs for i, signs in clause) for clause in listed)
        and (not with_sum or m[0] == m[1] == m[2] or m[0] | m[1] in (ANY - ZERO, m[2], m[2] | ZERO))
    ]


def by_hand(listed: list[list[Literal]], assumed: list[Literal]) -> list[int] | None:
    """The same by going through all clauses again and again."""
    domains = [ANY] * SIZE
    for i, signs in assumed:
        domains[i] &= signs
    while all(domains):
        before = list(domains)
        for clause in listed:
            joined: dict[int, int] = {}
            for i, signs in clause:
                joined[i] = joined.get(i, 0) | signs
            open_ = [(i, signs) for i, signs in joined.items() if domains[i] & signs]
            if not open_:
                return None
            if len(open_) == 1:
                domains[open_[0][0]] &= open_[0][1]
        if domains == before:
            return domains
    return None


@given(CLAUSES, st.lists(st.lists(LITERALS, max_size=3), min_size=1, max_size=6))
def test_what_is_left_is_what_going_through_all_clauses_leaves(
    known: list[list[Literal]], asked: list[list[Literal]]
) -> None:
    """One question after the other: what was watched last time is watched the next time, with a clause more."""
    found = clauses(known, with_sum=False)
    for assumed in asked:
        assert found.settled(assumed) == by_hand(known, assumed)
        found.add(assumed)
        known = [*known, assumed]


@given(CLAUSES, st.lists(LITERALS, max_size=3), st.booleans())
def test_what_is_said_to_follow_does(known: list[list[Literal]], clause: list[Literal], with_sum: bool) -> None:
    found = clauses(known, with_sum=with_sum)
    if found.implies(clause):
        assert all(any(m[i] & signs for i, signs in clause) for m in models(known, with_sum=with_sum))
    for m in models(known, with_sum=with_sum):
        left = found.settled()
        assert left is not None and all(a & b for a, b in zip(left, m, strict=True))


def test_a_lemma_and_a_clause_take_turns() -> None:
    """0 or 3 is positive; 3 is not; 1 is positive, so the sum is; but it is not."""
    found = clauses([[(0, POSITIVE), (3, POSITIVE)], [(1, POSITIVE)]], with_sum=True)
    assert found.settled([(3, ZERO)]) == [POSITIVE, POSITIVE, POSITIVE, ZERO]
    assert found.implies([(3, POSITIVE), (2, POSITIVE)])
    assert not found.implies([(2, POSITIVE)])


def test_an_empty_clause_refutes_everything() -> None:
    found = clauses([[]], with_sum=False)
    assert found.settled() is None and found.implies([])
    assert not clauses([], with_sum=False).implies([])


def test_what_follows_for_one_question_is_forgotten_for_the_next() -> None:
    found = clauses([[(0, POSITIVE), (1, POSITIVE)]], with_sum=False)
    assert found.settled([(0, ZERO)]) == [ZERO, POSITIVE, ANY, ANY]
    assert found.settled([(1, ZERO)]) == [POSITIVE, ZERO, ANY, ANY]
    assert found.settled() == [ANY] * SIZE


def test_every_variable_is_work() -> None:
    ticks: list[int] = []
    found = Clauses(lambda: ticks.append(1))
    for _ in range(50):
        found.new(NEGATIVE | POSITIVE)
    for k in range(49):
        found.add([(k, NEGATIVE), (k + 1, POSITIVE)])
    assert found.implies([(0, NEGATIVE), (49, POSITIVE)])
    assert len(ticks) >= 48
