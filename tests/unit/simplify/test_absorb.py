"""Absorption between members of one level: nothing changes but the length."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.io.text import read
from qe.simplify.absorb import absorb
from tests.strategies import points
from tests.tables import each

NAMES = ("a", "b", "c")
RING = Ring.of(NAMES)


def formula(text: str) -> Formula:
    return convert(read(text), RING)


def level(parts: tuple[Formula, ...], conjunctive: bool) -> Formula:
    """What two comparisons of one polynomial say together, by their signs."""
    left, right = parts
    if not (isinstance(left, Atom) and isinstance(right, Atom) and left.poly == right.poly):
        return (conj if conjunctive else disj)(parts)
    join = frozenset.intersection if conjunctive else frozenset.union
    signs = join(left.relation.signs, right.relation.signs)
    if not signs:
        return FALSE
    if len(signs) == 3:
        return TRUE
    return Atom(left.poly, next(r for r in Relation if r.signs == signs))


def absorbed(*members: str, conjunctive: bool = False) -> set[Formula]:
    return set(absorb([formula(m) for m in members], conjunctive, level))


@each(
    (("a > 0 and b > 0", "a > 0 and b > 0 and c = 0"), ("a > 0 and b > 0",)),
    (("a > 0 and b > 0", "a > 0 and b = 0"), ("a > 0 and b >= 0",)),
    (("a > 0 and b > 0", "a > 0 and b <= 0"), ("a > 0",)),
    (("a > 0 and b > 0", "a > 0 and c > 0"), ("a > 0 and b > 0", "a > 0 and c > 0")),
    (("a > 0 and b > 0", "a = 0 and b = 0"), ("a > 0 and b > 0", "a = 0 and b = 0")),
    (("a > 0 and b > 0 and c > 0", "a > 0 and b > 0 and c <= 0", "a > 0 and b <= 0"), ("a > 0",)),
)
def test_members_of_a_disjunction(members: tuple[str, ...], left: tuple[str, ...]) -> None:
    assert absorbed(*members) == set(map(formula, left))


def test_members_of_a_conjunction() -> None:
    assert absorbed("a > 0 or b > 0", "a > 0 or b > 0 or c = 0", conjunctive=True) == {formula("a > 0 or b > 0")}
    assert absorbed("a > 0 or b >= 0", "a > 0 or b <= 0", conjunctive=True) == {formula("a > 0 or b = 0")}


def test_one_member_and_atoms_stay() -> None:
    members = [formula("a > 0"), formula("b > 0 and c > 0")]
    assert absorb(members, False, level) is members
    assert absorb([], False, level) == []


ATOMS = st.builds(lambda i, r: Atom(RING.gen(i), r), st.integers(0, 2), st.sampled_from(tuple(Relation)))


@settings(max_examples=40)
@given(st.lists(st.lists(ATOMS, min_size=1, max_size=3), max_size=5), st.booleans(), points(NAMES))
def test_the_truth_stays(parts: list[list[Formula]], conjunctive: bool, point: dict[str, object]) -> None:
    inner, outer = (disj, conj) if conjunctive else (conj, disj)
    members = list(dict.fromkeys(inner(part) for part in parts))
    found = absorb(members, conjunctive, level)
    assert holds_at(outer(found), point) is holds_at(outer(members), point)  # type: ignore[arg-type]
    assert len(found) <= len(members)
