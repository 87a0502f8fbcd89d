"""Members, subformulas, bound names and connected parts of formulas."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Exists, Not, Relation
from qe.formula.traverse import atoms, bound_variables, conjuncts, connected, disjuncts, subformulas
from qe.io.text import read

RING = Ring.of(("a", "b", "c", "d", "e"))


def test_members() -> None:
    both, either, one = read("x > 0 and y > 0"), read("x > 0 or y > 0"), read("x > 0")
    assert conj(conjuncts(both)) == both and len(conjuncts(both)) == 2
    assert conjuncts(either) == (either,) and conjuncts(one) == (one,)
    assert disj(disjuncts(either)) == either and len(disjuncts(either)) == 2
    assert disjuncts(both) == (both,)


def test_subformulas_come_from_the_outside_in() -> None:
    formula = read("(ex x. x > a and not x < root(1, x^2 - 2)) or b = 0")
    found = list(subformulas(formula))
    assert found[0] is formula
    assert [f for f in found if f in set(atoms(formula))] == list(atoms(formula))
    assert any(isinstance(f, Not) for f in found) and any(isinstance(f, Exists) for f in found)


def test_bound_variables_in_order_without_repetition() -> None:
    assert bound_variables(read("ex y, x. (all z. x < z) or (ex x. x = y)")) == ("y", "x", "z")
    assert bound_variables(read("x > 0")) == ()


@given(st.lists(st.sets(st.sampled_from(RING.names)).map(frozenset), max_size=6))
def test_connected_parts(shares: list[frozenset[str]]) -> None:
    """Groups partition the parts, share no name, and cannot be split further."""
    parts = [
        atom(sum((RING.var(n) for n in sorted(names)), RING.constant(0)) * RING.var("e") ** 2 - k, Relation.GT)
        for k, names in enumerate(shares, start=1)
    ]
    block = frozenset("abcd")
    outside, groups = connected(parts, lambda part: block.intersection(part.free))
    assert sorted(map(str, (*outside, *(p for _, members in groups for p in members)))) == sorted(map(str, parts))
    assert all(not block & set(p.free) for p in outside)
    seen: set[str] = set()
    for names, members in groups:
        assert names == frozenset().union(*(block & set(p.free) for p in members))
        assert not names & seen
        seen |= names
        reached = {members[0]}
        for _ in members:
            known = {n for p in reached for n in p.free if n in block}
            reached |= {p for p in members if known & set(p.free)}
        assert reached == set(members)
