"""Test points put for a variable: against the truth at the root itself, found with exact algebraic numbers."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import polynomials
from qe.kernel.virtual_substitution import TestPoint, put
from tests.unit.elimination.vs.line import holds, samples, specialise

RING = Ring.of(("a", "x"))
A, X = RING.gen(0), RING.gen(1)
SMALL = st.integers(-3, 3)


@st.composite
def values(draw: st.DrawFn, degree: int) -> list[int]:
    return [draw(SMALL) for _ in range(degree + 1)]


def of(coefficients: list[int]) -> Poly:
    return sum((X**k * c for k, c in enumerate(coefficients)), RING.constant(0))


def truth_at(formula: Formula, root: object, shift: int) -> bool:
    """At a number; or right or left of it, before the next root."""
    if not shift:
        return holds(formula, 1, root)  # type: ignore[arg-type]
    rest = [X * 0 + X] if root is None else []
    listed = samples([*polynomials(formula), *rest], 1)
    if root is None:
        return holds(formula, 1, listed[-1] + 1 if shift > 0 else listed[0] - 1)
    roots = sorted({r for p in polynomials(formula) for r in real_roots(p.to_univariate(1))} - {root})  # type: ignore[type-var]
    beyond = [r for r in roots if (r > root) is (shift > 0)]  # type: ignore[operator]
    if not beyond:
        return holds(formula, 1, root + shift)  # type: ignore[operator]
    nearest = beyond[0] if shift > 0 else beyond[-1]
    return holds(formula, 1, (root + nearest) * Fraction(1, 2))  # type: ignore[operator]


@settings(max_examples=40)
@given(values(3), values(2), st.sampled_from(tuple(Relation)), st.sampled_from((-1, 0, 1)), st.sampled_from((-1, 1)))
def test_the_formula_at_a_root_has_its_truth(
    f: list[int], g: list[int], relation: Relation, shift: int, branch: int
) -> None:
    assume(any(g[1:]))
    if g[2]:
        point = TestPoint(tuple(RING.constant(c) for c in g), branch, shift)
        assume(g[1] ** 2 - 4 * g[0] * g[2] >= 0)
        roots = sorted(real_roots(of(g).to_univariate(1)))
        root = roots[-1] if (branch > 0) is (g[2] > 0) else roots[0]
    else:
        point = TestPoint(tuple(RING.constant(c) for c in g[:2]), 0, shift)
        root = real_roots(of(g).to_univariate(1))[0]
    given_ = atom(of(f), relation)
    assume(isinstance(given_, Atom))
    found = put(given_, 1, point)
    assert found == atom(RING.constant(1 if truth_at(given_, root, shift) else 0), Relation.GT)


@settings(max_examples=40)
@given(values(3), st.sampled_from(tuple(Relation)), st.sampled_from((-1, 1)))
def test_near_infinity_the_first_nonzero_coefficient_decides(f: list[int], relation: Relation, side: int) -> None:
    given_ = atom(of(f), relation)
    assume(isinstance(given_, Atom))
    found = put(given_, 1, TestPoint((), 0, side))
    assert found == atom(RING.constant(1 if truth_at(given_, None, side) else 0), Relation.GT)


@pytest.mark.parametrize("number", [-2, 0, 3])
@pytest.mark.parametrize("shift", [-1, 0, 1])
def test_parameters_are_kept(number: int, shift: int) -> None:
    """a*x - 1 put into x^2 - a*x: at every nonzero value of a the same as with the number put in first."""
    point = TestPoint((RING.constant(-1), A), 0, shift)
    for relation in Relation:
        found = put(atom(X * X - A * X, relation), 1, point)
        assert "x" not in found.free
        if number:
            fixed = TestPoint((RING.constant(-1), RING.constant(number)), 0, shift)
            expected = put(atom(X * X - X * number, relation), 1, fixed)
            assert specialise(found, {"a": Fraction(number)}) == expected


def test_atoms_settled_at_the_root_are_taken_there() -> None:
    """Right of 0 the atom x > 0 holds, at 0 it does not."""
    given_ = atom(X, Relation.GT)
    right_of_zero = TestPoint((RING.constant(0), RING.constant(1)), 0, 1)
    assert put(given_, 1, right_of_zero) == atom(RING.constant(1), Relation.GT)
    assert put(given_, 1, right_of_zero, (given_,)) == atom(RING.constant(0), Relation.GT)


def test_near_infinity_every_coefficient_counts_where_the_ones_before_vanish() -> None:
    given_ = atom(A * X * X + (A + 1) * X - 3, Relation.LT)
    for side, expected in ((1, {0: False, -1: True, 2: False}), (-1, {0: True, -1: True, 2: False})):
        found = put(given_, 1, TestPoint((), 0, side))
        for number, truth in expected.items():
            assert specialise(found, {"a": Fraction(number)}) == atom(RING.constant(int(truth)), Relation.GT)
    constant = put(atom(A * X - 3, Relation.LT), 1, TestPoint((), 0, 1))
    assert specialise(constant, {"a": Fraction(0)}) == atom(RING.constant(1), Relation.GT)
