"""Preparation of an existential block: the prepared problem holds wherever the body does, and its solutions lift.

For every step alone and for all together, on bodies built to hold at a known rational point:
(1) the point satisfies some branch of the tree (nothing is lost);
(2) every assignment that satisfies the tree lifts to one that satisfies the body, exactly evaluated (nothing is
    invented, and the lift is right).
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import Formula, Relation
from qe.rules.lift import Value, holds_at, root
from qe.rules.preparation import Prepared, prepare
from qe.rules.rewrite import rewrite
from qe.rules.step import ALL_STEPS, StepKind
from qe.rules.tree import Leaf

from .prepare_support import RING, formulas, interesting, named, points, prepared_with_rules

STEP_SETS = [
    frozenset({StepKind.SIMPLIFY}),
    frozenset({StepKind.MINISCOPE}),
    frozenset({StepKind.LINEAR}),
    frozenset({StepKind.LINEAR, StepKind.GUARDED_LINEAR}),
    frozenset({StepKind.LINEAR, StepKind.GUARDED_LINEAR, StepKind.SIMPLIFY, StepKind.MINISCOPE}),
    frozenset({StepKind.GROEBNER, StepKind.FACTOR_SPLIT}),
    # these change values: their own tests are below
    ALL_STEPS - {StepKind.DEGREE_SHIFT, StepKind.SCALING, StepKind.TRANSLATION, StepKind.ROTATION},
]


Problem = tuple[Formula, tuple[Fraction, ...]]
"""A body, and a point where it holds."""
PLACES = st.lists(points, max_size=6)


def assert_solutions_lift(prepared: Prepared, body: Formula, places: Iterable[tuple[Fraction, ...]]) -> None:
    """What satisfies the tree lifts to what satisfies the body."""
    assert prepared.tree is not None
    for at in (named(RING, values) for values in places):
        if prepared.tree.satisfied(at):
            assert holds_at(body, prepared.lift(at))


def made_true(poly: Poly, point: tuple[Fraction, ...], equation: bool) -> Formula:
    """A comparison of (a shift of) the polynomial that holds at the point."""
    value = poly.evaluate(point)
    if equation:
        return atom(poly * value.denominator - value.numerator, Relation.EQ)
    relation = Relation.GT if value > 0 else Relation.LT if value < 0 else Relation.LE
    return atom(poly, relation)


@st.composite
def solvable(draw: st.DrawFn, ring: Ring = RING) -> Problem:
    """Equations, inequalities, and disjunctions with one true member."""
    point = draw(points)
    equations = [made_true(p, point, True) for p in draw(st.lists(interesting(ring), min_size=1, max_size=3))]
    others = [made_true(p, point, False) for p in draw(st.lists(interesting(ring), max_size=3))]
    if draw(st.booleans()) and others:
        others[0] = disj((draw(formulas(ring, 3)), others[0]))
    return conj(equations + others), point


@pytest.mark.parametrize("enabled", STEP_SETS, ids=lambda s: "+".join(sorted(k.name for k in s)))
@settings(max_examples=30, deadline=None)
@given(solvable(), PLACES, st.sampled_from([("x", "y"), ("a", "b", "x", "y"), ("y",)]))
def test_nothing_is_lost_and_solutions_lift(enabled, problem: Problem, elsewhere, block) -> None:  # type: ignore[no-untyped-def]
    body, point = problem
    prepared, known = prepare(exists(block, body), enabled=enabled), named(RING, point)
    if prepared.tree is None:
        assert holds_at(prepared.formula, known)
        return
    assert prepared.tree.satisfied(known)
    lifted = prepared.lift(known)
    assert all(lifted[name] == known[name] for name in RING.names if name not in block)
    assert_solutions_lift(prepared, body, (point, *elsewhere))


@settings(max_examples=25, deadline=None)
@given(solvable())
def test_universal_blocks_lift_counterexamples(problem: Problem) -> None:
    body, point = problem
    prepared, known = prepare(forall(("x", "y"), neg(body))), named(RING, point)
    if prepared.tree is None or isinstance(prepared.tree, Leaf):
        return
    assert prepared.universal
    assert prepared.tree.satisfied(known)
    assert not holds_at(neg(body), prepared.lift(known))


@settings(max_examples=30, deadline=None)
@given(solvable(), st.integers(2, 3), PLACES)
def test_degree_shift(problem: Problem, k: int, elsewhere: list[tuple[Fraction, ...]]) -> None:
    """f(x^k) is satisfied at x iff its shifted form is at x^k (a higher power, if it can be shifted again);
    a solution of the shifted form lifts to the root.
    """
    body, point = problem
    x = RING.index["x"]
    stretched = rewrite(body, lambda a: atom(a.poly.compose({x: RING.gen(x) ** k}), a.relation), ())
    prepared, taken, details = prepared_with_rules(exists(("x",), stretched), enabled={StepKind.DEGREE_SHIFT})
    if "x" not in stretched.free:
        return
    shifts = [int(d.removeprefix("x^")) for d, k in zip(details, taken) if k is StepKind.DEGREE_SHIFT]
    assert shifts and prepared.tree is not None
    for at in (named(RING, values) for values in (point, *elsewhere)):
        shifted = at | {"x": at["x"] ** prod(shifts)}
        assert holds_at(stretched, at) == prepared.tree.satisfied(shifted)
    assert_solutions_lift(prepared, stretched, (point, *elsewhere))


@st.composite
def homogeneous(draw: st.DrawFn) -> Problem:
    """Every polynomial is homogeneous in x and y of weights 1 and w."""
    weight, point = draw(st.sampled_from([1, 2, 3])), draw(points)
    members = []
    for base in draw(st.lists(interesting(), min_size=1, max_size=4)):
        degree = max(e[2] + weight * e[3] for e, _ in base.terms()) if base else 0
        terms: dict[tuple[int, ...], int] = {}
        for e, c in base.terms():
            key = (e[0], e[1], degree - weight * e[3], e[3])
            terms[key] = terms.get(key, 0) + c
        members.append(made_true(RING.from_terms(terms), point, False))
    return conj(members), point


@settings(max_examples=40, deadline=None)
@given(homogeneous(), PLACES)
def test_scaling(problem: Problem, elsewhere: list[tuple[Fraction, ...]]) -> None:
    """A body that holds at a point still holds for some value of the scaled block; what is found is a solution."""
    body, point = problem
    prepared, _, details = prepared_with_rules(exists(("x", "y"), body), enabled={StepKind.SCALING})
    if prepared.tree is None:
        return
    known = named(RING, point)
    if len(details) == 1:  # one variable is left: try the images of the point under all scalings
        name = details[0][0]
        other = "y" if name == "x" else "x"
        candidates = [known | {other: v} for v in scaled_images(known, name, other)]
        assert any(prepared.tree.satisfied(c) for c in candidates)
    assert_solutions_lift(prepared, body, (point, *elsewhere))


def scaled_images(known: dict[str, Fraction], name: str, other: str) -> list[Value]:
    """The values of ``other`` when ``name`` is scaled to -1, 0 or 1 by weights 1:1, 1:2, 1:3 and back."""
    size, value = abs(known[name]), known[other]
    if size == 0:
        return [value, Fraction(1), Fraction(-1), Fraction(0)]
    images: list[Value] = [value, Fraction(0), Fraction(1), Fraction(-1)]
    for k in (1, 2, 3):
        images += [value / size**k, value / root(size, k)]
    return images


@st.composite
def open_bodies(draw: st.DrawFn) -> Problem:
    """Strict comparisons that hold at the point, and inequations that may fail there."""
    point = draw(points)
    strict = []
    for p in draw(st.lists(interesting(), max_size=3)):
        value = p.evaluate(point)
        if value:
            strict.append(atom(p, Relation.GT if value > 0 else Relation.LT))
    others = draw(st.lists(interesting(), min_size=1, max_size=3))
    apart = [atom(p - int(p.evaluate(point)), Relation.NE) for p in others]
    return conj((*strict, *apart)), point


@settings(max_examples=40, deadline=None)
@given(open_bodies(), PLACES)
def test_inequations_in_open_bodies(problem: Problem, elsewhere: list[tuple[Fraction, ...]]) -> None:
    """What is left holds wherever the body does, and its solutions move to solutions of the body."""
    body, point = problem
    prepared = prepare(exists(("x", "y"), body), enabled={StepKind.GENERIC, StepKind.MINISCOPE})
    if prepared.tree is None:
        return
    for at in (named(RING, values) for values in (point, *elsewhere)):
        assert prepared.tree.satisfied(at) or not holds_at(body, at)
    assert_solutions_lift(prepared, body, (point, *elsewhere))


@settings(max_examples=30, deadline=None)
@given(solvable(), st.integers(-2, 2), PLACES)
def test_translation(problem: Problem, slope: int, elsewhere: list[tuple[Fraction, ...]]) -> None:
    """f(a, b, y - s*x) is the same along (1, s): with x moved to 0 it holds at y - s*x, and solutions lift."""
    x, y = RING.index["x"], RING.index["y"]
    merged = {x: RING.constant(1), y: RING.gen(y) - slope * RING.gen(x)}
    body = rewrite(problem[0], lambda a: atom(a.poly.compose(merged), a.relation), ())
    prepared, taken, _ = prepared_with_rules(exists(("x", "y"), body), enabled={StepKind.TRANSLATION})
    if prepared.tree is None or not taken:
        return
    for at in (named(RING, values) for values in elsewhere):
        images = [at | {"x": Fraction(0), "y": at["y"] - slope * at["x"]}]
        images += [at | {"y": Fraction(0), "x": at["x"] - at["y"] / slope}] if slope else []
        assert any(prepared.tree.satisfied(image) == holds_at(body, at) for image in images)
    assert_solutions_lift(prepared, body, elsewhere)
