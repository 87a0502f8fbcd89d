"""Topology on the line and in the plane, against the definitions with quantifiers and against known sets."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

import qe
from qe.api.input import read_formula
from qe.formula.build import conj, disj, neg
from qe.formula.normal import nnf
from qe.io.substitution import over_one_ring
from qe.regions.region import Region
from qe.regions.topology import near
from tests.strategies import formulas
from tests.tables import each


@each(
    ("x > 0 and x < 1 or x = 2 or x > 3", 3),
    ("x^3 - 3*x + 1 = 0", 3),
    ("x*y > 1", 2),
    ("x*y = 1", 2),
    ("x*y >= 0", 1),
    ("x*y > 0", 2),
    ("x*y = 0 and x^2 + y^2 > 0", 4),
    ("x^2 + y^2 < 1 or x = 1 and y = 0", 1),
    ("y^2 = x^3 - x", 2),
    ("y^2 = x^2*(x - 1)", 2),
    ("y^2 = x^2*(x + 1)", 1),
    ("y^2 > x^2*(x + 1)", 1),
    ("y^2 < x^2*(x + 1)", 2),
    ("x*y^2 > 1", 2),
    ("x*y^2 < 1 and x > 0", 1),
    ("1 < x^2 + y^2 and x^2 + y^2 < 4 and y /= 0", 2),
    ("x^2 < 0", 0),
    ("ex y. x = y^2", 1),
)
def test_components(text: str, count: int) -> None:
    whole = qe.region(text)
    parts = whole.components()
    assert len(parts) == count
    assert all(len(part.components()) == 1 for part in parts)
    assert not any(a.is_subset(b) or not a.is_disjoint(b) for a in parts for b in parts if a is not b)
    assert not parts or qe.equivalent(disj(over_one_ring(*(p.formula for p in parts))), whole.formula)


@settings(max_examples=6)
@given(formulas(names=("x",), max_degree=3))
def test_closure_and_interior_on_the_line(formula) -> None:
    _agrees(formula, ("x",))


@settings(max_examples=6)
@given(formulas(names=("x", "y"), max_degree=1))
def test_closure_and_interior_in_the_plane(formula) -> None:
    _agrees(formula, ("x", "y"))


@pytest.mark.deep
@each("y^2 < x^2*(x - 1)", "x*y > 1 or y = 0", "x^2 + y^2 > 1 and x*y <= 1", "x*y^2 < 1")
def test_closure_and_interior_of_curved_sets(text: str) -> None:
    _agrees(read_formula(text), ("x", "y"))


def _agrees(formula, order: tuple[str, ...]) -> None:
    region = Region.of(formula, order)
    f = nnf(region.formula)
    assert qe.equivalent(region.closure().formula, near(f, order), timeout=120)
    assert qe.equivalent(region.interior().formula, neg(near(nnf(f, negate=True), order)), timeout=120)
    border = conj(over_one_ring(region.closure().formula, neg(region.interior().formula)))
    assert qe.equivalent(region.boundary().formula, border)
