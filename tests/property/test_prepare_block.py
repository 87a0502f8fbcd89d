"""Preparation of an existential block: the prepared problem holds wherever the body does, and its solutions lift.

For every step alone and for all together, on bodies built to hold at a known rational point:
(1) the point satisfies some branch of the tree (nothing is lost);
(2) every assignment that satisfies the tree lifts to one that satisfies the body, exactly evaluated (nothing is
    invented, and the lift is right).
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import Formula, Relation
from qe.prepare import ALL_STEPS, StepKind, prepare
from qe.prepare.lift import holds_at
from qe.prepare.tree import Leaf

from .prepare_support import RING, formulas, interesting, points

STEP_SETS = [
    frozenset({StepKind.SIMPLIFY}),
    frozenset({StepKind.MINISCOPE}),
    frozenset({StepKind.LINEAR}),
    frozenset({StepKind.LINEAR, StepKind.GUARDED_LINEAR}),
    frozenset({StepKind.LINEAR, StepKind.GUARDED_LINEAR, StepKind.SIMPLIFY, StepKind.MINISCOPE}),
    ALL_STEPS,
]


def made_true(poly: Poly, point: tuple[Fraction, ...], equation: bool) -> Formula:
    """A comparison of (a shift of) the polynomial that holds at the point."""
    value = poly.evaluate(point)
    if equation:
        return atom(poly * value.denominator - value.numerator, Relation.EQ)
    relation = Relation.GT if value > 0 else Relation.LT if value < 0 else Relation.LE
    return atom(poly, relation)


@st.composite
def solvable(draw: st.DrawFn, ring: Ring = RING) -> tuple[Formula, tuple[Fraction, ...]]:
    """(body, a point where it holds): equations, inequalities, and disjunctions with one true member."""
    point = draw(points)
    equations = [made_true(p, point, True) for p in draw(st.lists(interesting(ring), min_size=1, max_size=3))]
    others = [made_true(p, point, False) for p in draw(st.lists(interesting(ring), max_size=3))]
    if draw(st.booleans()) and others:
        others[0] = disj((draw(formulas(ring, 3)), others[0]))
    return conj(equations + others), point


@pytest.mark.parametrize("enabled", STEP_SETS, ids=lambda s: "+".join(sorted(k.name for k in s)))
@settings(max_examples=60, deadline=None)
@given(solvable(), st.lists(points, max_size=6), st.sampled_from([("x", "y"), ("a", "b", "x", "y"), ("y",)]))
def test_nothing_is_lost_and_solutions_lift(
    enabled: frozenset[StepKind],
    problem: tuple[Formula, tuple[Fraction, ...]],
    elsewhere: list[tuple[Fraction, ...]],
    block: tuple[str, ...],
) -> None:
    body, point = problem
    prepared = prepare(exists(block, body), enabled=enabled)
    if prepared.tree is None:
        assert holds_at(prepared.formula, dict(zip(RING.names, point, strict=True)))
        return
    known = dict(zip(RING.names, point, strict=True))
    assert prepared.tree.satisfied(known)
    lifted = prepared.lift(known)
    assert holds_at(body, lifted)
    assert all(lifted[name] == known[name] for name in RING.names if name not in block)
    for values in elsewhere:
        at = dict(zip(RING.names, values, strict=True))
        if prepared.tree.satisfied(at):
            assert holds_at(body, prepared.lift(at))


@settings(max_examples=40, deadline=None)
@given(solvable())
def test_universal_blocks_lift_counterexamples(problem: tuple[Formula, tuple[Fraction, ...]]) -> None:
    body, point = problem
    prepared = prepare(forall(("x", "y"), neg(body)))
    known = dict(zip(RING.names, point, strict=True))
    if prepared.tree is None or isinstance(prepared.tree, Leaf):
        return
    assert prepared.universal
    assert prepared.tree.satisfied(known)
    assert not holds_at(neg(body), prepared.lift(known))
