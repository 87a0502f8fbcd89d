"""Convex regions with strict and narrow conditions: every question gives what the decomposition gives, in any order."""

from __future__ import annotations

import pickle
from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.cells.interval import Interval, Number
from qe.errors import InputError, Unable
from qe.exact.ring import Ring
from qe.formula.build import conj, exists
from qe.formula.syntax import Formula
from qe.regions.convex_region import ConvexRegion
from qe.regions.region import Region
from tests.enough import enough
from tests.strict_problems import conditions
from tests.tables import each

RING = Ring.of(("x", "y", "u", "v"))
ORDER = ("x", "y")


@st.composite
def shadows(draw: st.DrawFn) -> Formula:
    """A convex set of the plane behind one or two hidden variables."""
    hidden = ("u", "v")[: draw(st.integers(1, 2))]
    ring = Ring.of((*ORDER, *hidden))
    return exists(hidden, conj(draw(conditions(ring))))


def ends(intervals: list[Interval]) -> list[tuple[object, ...]]:
    return [(i.lower, i.upper, i.lower_closed, i.upper_closed) for i in intervals]


def answers(region: Region, at: list[tuple[Number, Number]]) -> list[object]:
    """What a region says: empty or not, bounds, fibres over the first coordinates, membership of the points."""
    found: list[object] = [region.is_empty]
    for name in ORDER:
        try:
            found.append(ends([region.bounds(name)]))
        except InputError:
            found.append("empty")
    found.append(ends(region.fibre()))
    for x, y in at:
        found.append(ends(region.fibre([x])))
        found.append(region.contains({"x": x, "y": y}))
    return found


def corners(region: Region) -> list[tuple[Number, Number]]:
    """Points at the ends of fibres, where strict and weak conditions differ."""
    if region.is_empty:
        return []
    found: list[tuple[Number, Number]] = []
    whole = region.bounds("x")
    for x in (whole.lower, whole.upper, *(i.simplest() for i in region.fibre())):
        for interval in region.fibre([x]) if x is not None else []:
            middle = interval.simplest()
            found += [(x, y) for y in (interval.lower, interval.upper, middle) if y is not None]
    return found


def consistent(formula: Formula) -> bool:
    """Whether optimisation answers for the formula; then all ways of asking agree."""
    fresh = qe.region(formula, order=ORDER)
    if not isinstance(fresh, ConvexRegion):
        return False
    table = Region.of(qe.eliminate(formula, method="cad").formula, ORDER)
    at: list[tuple[Number, Number]] = [(F(0), F(0)), (F(1), F(1, 1000)), *corners(table)]
    expected = answers(table, at)
    assert answers(fresh, at) == expected
    read = qe.region(formula, order=ORDER)
    _ = read.formula, read.table
    assert answers(read, at) == expected
    assert answers(pickle.loads(pickle.dumps(fresh)), at) == expected
    for region in (table, fresh):
        assert all(table.contains(p) and fresh.contains(p) for p in region.sample_points())
    assert table.is_empty == (not fresh.sample_points())
    return True


def decided(formula: Formula) -> bool:
    try:
        return consistent(formula)
    except Unable as reason:
        assert "degree above" in str(reason)
        return False


@each((4, 5), pytest.param(200, 400, marks=pytest.mark.deep))
def test_questions_agree_with_the_decomposition_in_any_order(at_least: int, of: int) -> None:
    enough(at_least, of, shadows())(decided)()


@settings(max_examples=5)
@given(st.integers(1, 40), st.sampled_from((2, 3, 5)), st.booleans())
def test_a_narrow_hidden_variable_changes_nothing(digits: int, square: int, weak: bool) -> None:
    """The range of the hidden variable is as small as 1/10^40, the ends of x irrational."""
    bound = f"x^2 {'<=' if weak else '<'} {square}"
    region = qe.region(f"ex u. {bound} and u > 0 and {10**digits}*u < 1")
    root = qe.region(f"x^2 = {square} and x > 0").bounds("x").lower
    interval = region.bounds("x")
    assert interval.upper == root and interval.lower == -root
    assert interval.lower_closed == interval.upper_closed == weak
    assert region.contains({"x": root}) == weak
    assert region.fibre() == [interval]
