"""simplify: facts -> (formula <-> result), never larger, idempotent, negations in the atoms."""

from __future__ import annotations

from fractions import Fraction
from functools import reduce

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj, exists, neg
from qe.formula.syntax import And, Exists, Formula, Not, Relation
from qe.formula.traverse import children, polynomials
from qe.rules.lift import holds_at
from qe.simplify.ranges import EMPTY, EVERYTHING, add, compare, meet, multiply, power, scale
from qe.simplify.simplify import simplify

from .prepare_support import RING, formulas, holds, literals, named, points, rationals, weight

Point = dict[str, Fraction]
places = points.map(lambda values: named(RING, values))
ranges = st.lists(st.builds(compare, st.sampled_from(Relation), rationals), max_size=3)


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
