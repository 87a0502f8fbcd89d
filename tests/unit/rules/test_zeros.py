"""Conditions on zeros that follow from others: dropped, and only these; and the steps are the kernel's."""

from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf
from qe.formula.syntax import Exists, ForAll, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from qe.rules.zeros import needed
from tests.tables import each
from tests.unit.proving.elaborated import refused

VECTORS = "x*v - y*u /= 0 and x^2 + y^2 + u^2 + v^2 < a"
RULE = "conditions on zeros that follow"


@each(
    (f"ex x, y, u, v. (x /= 0 or y /= 0) and {VECTORS}", f"ex x, y, u, v. {VECTORS}"),
    (f"ex x, y, u, v. (x*u /= 0 or x*v /= 0 or y*u /= 0 or y*v /= 0) and {VECTORS}", f"ex x, y, u, v. {VECTORS}"),
    (f"ex x, y, u, v. (x /= 0 or y = 0) and {VECTORS}", None),
    ("ex x, y. (x /= 0 or y /= 0) and x*y + a = 0", None),
    ("ex x, y. (x /= 0 or y /= 0) and x*y + 2 < 0", "ex x, y. x*y + 2 < 0"),
    ("ex x, y. (x /= 0 or y /= 0) and (x = 0 or y = 0) and x*y^3 + x >= 0", None),
    ("ex x, y. (x /= 0 or y /= 0) and x*y - 2 > 0", "ex x, y. x*y - 2 > 0"),
    ("ex x, y. (x /= 0 or y /= 0) and x*y - 2 < 0", None),
    ("ex x, y, z, w. (x /= 0 or y /= 0) and (z /= 0 or w /= 0) and z^2 - z*w + x < 0", None),
    ("ex x, y, z, w. (x /= 0 or y /= 0) and (z /= 0 or w /= 0) and w^2 - z*w + x < 0", None),
    ("all x, y. x = 0 and y = 0 or x*a - y*b = 0", "all x, y. x*a - y*b = 0"),
    ("all x, y. x = 0 and y = 0 or x*a - y*b > 0", None),
)
def test_what_follows_is_dropped(text: str, left: str | None) -> None:
    found = prepare(read(text), enabled={StepKind.ZEROS}).formula
    assert str(found) == str(prepare(read(left or text), enabled=set()).formula)


@each(
    "(x /= 0 or y > 0) and y /= 0",  # a sign is no condition on zeros: x = 0 and y = -1
    "(x /= 0 or x + y = 0) and y /= 0",  # nor is a sum: x = 0 and y = 1
    "(x /= 0 or y /= 0) and z^2 + x*y <= 0",  # z may be 0 where x and y are
    "(x /= 0 or y /= 0) and z^3 + x*y > 1",
)
def test_what_does_not_follow_stays(text: str) -> None:
    parts = conjuncts(read(text))
    assert needed(parts) == parts


RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.var(name) for name in RING.names)
ABOUT = [X, Y, Z, X * Y, Y * Z, X * X * Z]
OTHERS = [X * Y - Z, X + Y, X * X + 1, X * Y + 1, X * X * Y * Y + Z, Y * Y - Z * Z, X - 1, X * X * Y * Y, -Z * Z]
ZEROS = st.builds(atom, st.sampled_from(ABOUT), st.sampled_from([Relation.EQ, Relation.NE]))
CLAUSES = st.one_of(
    st.lists(ZEROS, min_size=2, max_size=3).map(disj),
    st.lists(st.lists(ZEROS, min_size=1, max_size=2).map(conj), min_size=2, max_size=3).map(disj),
)
PLAIN = st.builds(atom, st.sampled_from(OTHERS), st.sampled_from(list(Relation)))
GRID = [dict(zip(RING.names, point, strict=True)) for point in product((-2, -1, 0, 1, 2), repeat=3)]


@settings(max_examples=60, deadline=None)
@given(st.lists(CLAUSES, min_size=1, max_size=3), st.lists(st.one_of(PLAIN, CLAUSES), max_size=3))
def test_the_truth_stays_and_the_checker_agrees(clauses: list[Formula], others: list[Formula]) -> None:
    whole = conj((*clauses, *others))
    left = conj(needed(conjuncts(whole)))
    assert all(holds_at(whole, point) == holds_at(left, point) for point in GRID)
    if left != whole and left.ring is not None:
        assert not refused(RULE, Exists(RING.names, whole), Exists(RING.names, left))
        dual, short = (ForAll(RING.names, nnf(f, negate=True)) for f in (whole, left))
        assert not refused(RULE, dual, short)


@settings(max_examples=60, deadline=None)
@given(st.lists(CLAUSES, min_size=1, max_size=2), st.lists(st.one_of(PLAIN, CLAUSES), min_size=1, max_size=3))
def test_a_false_step_is_refused(clauses: list[Formula], others: list[Formula]) -> None:
    before, after = Exists(RING.names, conj((*clauses, *others))), Exists(RING.names, conj(others))
    same = all(holds_at(before.body, point) == holds_at(after.body, point) for point in GRID)
    assert same or refused(RULE, before, after)


def test_a_vector_that_is_not_zero_does_not_hide_a_rotation() -> None:
    text = f"ex x, y, u, v. (x /= 0 or y /= 0) and (x /= 0 and u /= 0 or x /= 0 and v /= 0 or y /= 0) and {VECTORS}"
    answer = qe.eliminate(text)
    rules = [step.rule for step in answer.derivation.steps]
    assert rules.index("conditions on zeros that follow") < rules.index("rotation of the axes")
    assert qe.eliminate(text, without="zeros").formula == answer.formula
