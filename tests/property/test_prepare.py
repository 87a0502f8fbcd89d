"""Preparation: formulas keep their meaning, simplified or whole, and a solution of what is prepared lifts.

For every step alone and for all together, on bodies built to hold at a known rational point:
(1) the point satisfies some branch of the tree (nothing is lost);
(2) every assignment that satisfies the tree lifts to one that satisfies the body, exactly evaluated (nothing is
    invented, and the lift is right).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import reduce
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import And, Atom, Exists, Formula, Not, Relation, RootAtom
from qe.formula.traverse import children, map_atoms, polynomials
from qe.rules.lift import Value, holds_at, root
from qe.rules.preparation import Prepared, prepare
from qe.rules.rewrite import rewrite
from qe.rules.step import ALL_STEPS, StepKind
from qe.rules.tree import Leaf
from qe.simplifier.ranges import EMPTY, EVERYTHING, add, meet, multiply, power, scale
from qe.simplifier.ranges import compare as range_where
from qe.simplifier.simplify import simplify
from tests.differential.check import Comparison, compare, reduced
from tests.differential.generate import LARGE, NESTED, SMALL, Shape, random_formula

from .prepare_support import (
    RING,
    formulas,
    holds,
    interesting,
    literals,
    named,
    points,
    prepared_with_rules,
    rationals,
    weight,
)

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


SHAPES = (*SMALL, *NESTED, *LARGE, Shape(0, 3, 2, 5), Shape(1, 2, 2, 5), Shape(2, 2, 2, 4))


def with_equations(rng: random.Random, formula: Formula) -> Formula:
    """Half of the atoms turned into equations."""

    def change(found: Atom | RootAtom) -> Formula:
        return atom(found.poly, Relation.EQ) if isinstance(found, Atom) and rng.random() < 0.5 else found

    return map_atoms(formula, change)


def check(seed: str, *, seconds: float) -> bool:
    """Fail with a reduced formula if preparation changes the meaning of the formula of this seed.

    Whether the oracles could tell anything about it.
    """
    rng = random.Random(seed)
    formula = with_equations(rng, random_formula(rng, rng.choice(SHAPES)))
    some = frozenset(k for k in StepKind if rng.random() < 0.6)
    decided = 0
    for enabled in (ALL_STEPS, some):

        def compared(candidate: Formula, enabled: frozenset[StepKind] = enabled) -> Comparison:
            after = prepare(candidate, enabled=enabled).formula
            return compare(candidate, after, random.Random(seed), points=3, seconds=seconds)

        def fails(candidate: Formula, compared: Callable[[Formula], Comparison] = compared) -> bool:
            return compared(candidate).difference is not None

        found = compared(formula)
        assert found.difference is None, f"meaning changed: {reduced(formula, fails)}"
        decided += found.decided
    return decided > 0


@pytest.mark.parametrize("block", range(5))
def test_meaning_is_kept(block: int) -> None:
    assert sum(check(f"prepare {seed}", seconds=0.2) for seed in range(12 * block, 12 * block + 12)) >= 4


@pytest.mark.deep
@pytest.mark.parametrize("block", range(60))
def test_meaning_is_kept_deep(block: int) -> None:
    assert sum(check(f"deep prepare {seed}", seconds=1.0) for seed in range(20 * block, 20 * block + 20)) >= 7


Point = dict[str, Fraction]
places = points.map(lambda values: named(RING, values))
ranges = st.lists(st.builds(range_where, st.sampled_from(Relation), rationals), max_size=3)


def has_negation(formula: Formula) -> bool:
    return isinstance(formula, Not) or any(has_negation(c) for c in children(formula))


@settings(max_examples=120, deadline=None)
@given(formulas(), st.lists(places, min_size=1, max_size=12))
def test_equivalent_smaller_and_idempotent(formula: Formula, where: list[Point]) -> None:
    result = simplify(formula)
    assert all(holds(formula, point) == holds(result, point) for point in where)
    assert weight(result) <= weight(formula)
    assert not has_negation(result)
    assert simplify(result) == result


@settings(max_examples=60, deadline=None)
@given(formulas(), st.lists(literals(), min_size=1, max_size=3), st.lists(places, min_size=1, max_size=20))
def test_assumptions_may_be_used_but_only_where_they_hold(
    formula: Formula, assumed: list[Formula], where: list[Point]
) -> None:
    assumptions = conj(assumed)
    result = simplify(formula, assumptions)
    assert all(holds(formula, point) == holds(result, point) for point in where if holds(assumptions, point))


@settings(max_examples=50, deadline=None)
@given(formulas(), places)
def test_negation_commutes(formula: Formula, point: Point) -> None:
    assert holds(simplify(neg(formula)), point) != holds(simplify(formula), point)


@settings(max_examples=40, deadline=None)
@given(formulas(), st.lists(places, min_size=1, max_size=8))
def test_bound_variables_are_not_confused_with_free_ones(formula: Formula, where: list[Point]) -> None:
    """``f and ex x. f`` is f: what f says about the free x must not leak into the quantifier, nor back."""
    result = simplify(conj((formula, exists(("x",), formula))))
    parts = result.args if isinstance(result, And) else (result,)
    for point in where:
        if holds(formula, point):
            assert all(holds(part.body if isinstance(part, Exists) else part, point) for part in parts)


@settings(max_examples=200, deadline=None)
@given(ranges, ranges, rationals, rationals, st.integers(1, 4))
def test_range_arithmetic_encloses(first, second, u, v, exponent) -> None:  # type: ignore[no-untyped-def]
    a, b = reduce(meet, first, EVERYTHING), reduce(meet, second, EVERYTHING)
    both = meet(a, b)
    assert both.admits(u) == (a.admits(u) and b.admits(u)) if both != EMPTY else not (a.admits(u) and b.admits(u))
    if not (a.admits(u) and b.admits(v)):
        return
    assert add(a, b).admits(u + v)
    assert multiply(a, b).admits(u * v)
    assert power(a, exponent).admits(u**exponent)
    assert scale(a, Fraction(-3, 2)).admits(u * Fraction(-3, 2))


LINE = Ring.of(("x",))
line_polys = st.lists(st.integers(-3, 3), min_size=2, max_size=5).map(
    lambda c: LINE.from_terms({(k,): v for k, v in enumerate(c)})
)
line_atoms = st.builds(atom, line_polys, st.sampled_from(Relation))


@settings(max_examples=60, deadline=None)
@given(st.lists(line_atoms, min_size=2, max_size=4), line_atoms, st.booleans())
def test_one_variable_at_its_roots_and_between(found: list[Formula], extra: Formula, conjunctive: bool) -> None:
    """The truth is the same at every real root of every polynomial and at rational points around them."""
    inner, outer = (disj, conj) if conjunctive else (conj, disj)
    formula = outer((*found[1:], inner((found[0], extra))))
    result = simplify(formula)
    cuts = [r for p in polynomials(formula) for r in real_roots(p.to_univariate(0))]
    near = [end + d for r in cuts for end in r.interval(20) for d in (Fraction(-1, 100), Fraction(1, 100))]
    for value in (*cuts, *near, Fraction(0), Fraction(50), Fraction(-50)):
        assert holds_at(formula, {"x": value}) == holds_at(result, {"x": value})
