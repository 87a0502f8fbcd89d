"""Regions against the formula they describe, at random and at boundary points."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.decomposition.sampled_cells import child, root_place
from qe.formula.evaluate import holds_at
from qe.regions.region import Region
from tests.strategies import formulas, points


def _located(region: Region, value: Fraction) -> bool:
    """Membership of a point of the line read off the stack: a section, or the cell between neighbouring sections."""
    place = root_place(region.table)
    stack = place.cell.stack
    if stack is None:
        return bool(place.cell.truth)
    position = 0
    for section in range(len(stack.sections)):
        number = child(region.table, place, 2 * section + 1).point.number(0)
        if number <= value:
            position = 2 * section + (1 if number == value else 2)
    return bool(stack.cells[position].truth)


@settings(max_examples=60)
@given(formulas(names=("x",), max_degree=3), st.lists(points(("x",)), min_size=3, max_size=3))
def test_cells_on_the_line_hold_exactly_the_solutions(formula, at) -> None:
    region = Region.of(formula, ("x",))
    for point in at:
        assert _located(region, point["x"]) == holds_at(formula, point)


@settings(max_examples=40)
@given(formulas(names=("x", "y"), max_degree=2))
def test_samples_and_certificate(formula) -> None:
    region = Region.of(formula, ("x", "y"))
    assert qe.verify(region.certificate).accepted
    samples = region.sample_points()
    assert region.is_empty == (not samples)
    assert all(region.contains(p) for p in samples)
    assert Region.from_json(region.to_json()).table == region.table


@settings(max_examples=30)
@given(formulas(names=("x", "y"), max_degree=2))
def test_bounds_of_the_first_variable_are_read_off_the_table(formula) -> None:
    region = Region.of(formula, ("x", "y"))
    if not region.is_empty:
        assert region.bounds("x") == Region.of(formula, ("y", "x")).bounds("x")


@settings(max_examples=40)
@given(st.lists(st.tuples(*[st.integers(-2, 2)] * 4), min_size=1, max_size=3), points(("x", "y", "z")))
def test_balls(balls, point) -> None:
    text = " and ".join(f"(x-({a}))^2+(y-({b}))^2+(z-({c}))^2 <= {r * r}" for a, b, c, r in balls)
    region = qe.region(text, order=("x", "y", "z"))
    inside = all((point["x"] - a) ** 2 + (point["y"] - b) ** 2 + (point["z"] - c) ** 2 <= r * r for a, b, c, r in balls)
    assert region.contains(point) == inside
    if inside:
        assert not region.is_empty
        for name in "xyz":
            low, high = region.bounds(name)
            assert low is not None and high is not None and low <= point[name] <= high
