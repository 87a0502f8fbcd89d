"""Regions of convex blocks: formula, optimisation and geometry say the same."""

from __future__ import annotations

from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.decomposition.interval import Interval
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Formula, Relation
from qe.regions.region import Region
from tests.optimum_problems import at_most_zero, cubic, norm
from tests.property.test_critical import eliminated
from tests.strategies import rationals

PLANE = Ring.of(("p0", "p1", "y0", "y1"))
SMALL = st.integers(-2, 2)
QUARTERS = rationals(3, 4)


@st.composite
def discs(draw: st.DrawFn) -> Poly:
    """|s y + t p + c|^2 - r for vectors y, p of the plane."""
    s, t = draw(st.sampled_from(((1, 0), (1, 1), (1, -1), (2, 1), (0, 1)))), draw(st.integers(1, 6))
    vector = [s[0] * PLANE.gen(2 + k) + s[1] * PLANE.gen(k) + draw(SMALL) for k in range(2)]
    return norm(vector) - t


@st.composite
def bodies(draw: st.DrawFn) -> Formula:
    ball = norm([PLANE.gen(2), PLANE.gen(3)]) - draw(st.integers(1, 5))
    others = draw(st.lists(discs(), min_size=1, max_size=3))
    if draw(st.booleans()):
        others.append(draw(SMALL) * PLANE.gen(0) + PLANE.gen(3) + draw(SMALL))
    return conj(atom(p, Relation.LE) for p in (ball, *others))


def ends(intervals: list[Interval]) -> list[tuple[object, ...]]:
    return [(i.lower, i.upper, i.lower_closed, i.upper_closed) for i in intervals]


@settings(max_examples=3, deadline=None)
@given(bodies(), st.lists(st.tuples(QUARTERS, QUARTERS), max_size=4))
def test_formula_and_optimisation_agree(body: Formula, at: list[tuple[F, F]]) -> None:
    shadow = qe.region(exists(("y0", "y1"), body), order=("p0", "p1"))
    try:
        same_set(Region.of(eliminated(("y0", "y1"), body), ("p0", "p1")), shadow, at)
    except qe.Unable:
        return  # conditions that touch in irrational points: optimisation may refuse, and critical values too


def same_set(region: Region, shadow: Region, at: list[tuple[F, F]]) -> None:
    assert region.is_empty == shadow.is_empty
    if not region.is_empty:
        for name in region.order:
            assert tuple(region.bounds(name)) == tuple(shadow.bounds(name))
        inner = shadow.fibre()[0].simplest()
        if isinstance(inner, F):
            assert ends(region.fibre([inner])) == ends(shadow.fibre([inner]))
    for x, y in at:
        assert region.contains({"p0": x, "p1": y}) == shadow.contains({"p0": x, "p1": y})
        assert ends(region.fibre([x])) == ends(shadow.fibre([x]))


def shadow_of_cubic(q0: tuple[F, ...], r0: tuple[F, ...], r2: int) -> Region:
    _, forms, _ = cubic(q0, r0, r2)
    return qe.region(exists(forms[0].ring.names[len(q0) :], at_most_zero(forms)))


def turned(p: tuple[F, F]) -> tuple[F, F]:
    """A rotation by an angle with cosine 3/5."""
    return F(3, 5) * p[0] - F(4, 5) * p[1], F(4, 5) * p[0] + F(3, 5) * p[1]


def upright(p: tuple[F, F]) -> tuple[F, F, F]:
    """The plane turned about its first axis into space."""
    return p[0], F(5, 13) * p[1], F(12, 13) * p[1]


def contains(region: Region, point: tuple[F, ...]) -> bool:
    return region.contains(dict(zip(region.order, point, strict=True)))


POINTS = st.tuples(st.integers(-4, 4), st.integers(-4, 4)).map(lambda p: (F(p[0]), F(p[1])))


@settings(max_examples=6, deadline=None)
@given(POINTS, POINTS, st.integers(0, 6), st.lists(POINTS, min_size=2, max_size=2))
def test_membership_under_rotation_and_in_space(
    q0: tuple[F, F], r0: tuple[F, F], slack: int, at: list[tuple[F, F]]
) -> None:
    r2 = int(max(q0[0] ** 2 + q0[1] ** 2, r0[0] ** 2 + r0[1] ** 2)) + slack
    plane = shadow_of_cubic(q0, r0, r2)
    rotated = shadow_of_cubic(turned(q0), turned(r0), r2)
    space = shadow_of_cubic(upright(q0), upright(r0), r2)
    for p in (*at, q0, ((2 * q0[0] + r0[0]) / 3, (2 * q0[1] + r0[1]) / 3)):
        inside = contains(plane, p)
        assert contains(rotated, turned(p)) == inside
        assert contains(space, upright(p)) == inside
        x, y, z = upright(p)
        off_the_plane = (x, y - F(12, 13) / 8, z + F(5, 13) / 8)
        assert inside or not contains(space, off_the_plane)
    assert contains(plane, q0)


@pytest.mark.deep
@settings(max_examples=9, deadline=None)
@given(POINTS, POINTS, st.integers(0, 9), st.lists(POINTS, min_size=3, max_size=3))
def test_region_of_random_cubic_curves(q0: tuple[F, F], r0: tuple[F, F], slack: int, at: list[tuple[F, F]]) -> None:
    r2 = int(max(q0[0] ** 2 + q0[1] ** 2, r0[0] ** 2 + r0[1] ** 2)) + max(1, slack)
    shadow = shadow_of_cubic(q0, r0, r2)
    formula = shadow.formula
    fresh = shadow_of_cubic(q0, r0, r2)
    for p in (*at, q0):
        assert Region.contains(shadow, dict(zip(shadow.order, p, strict=True))) == contains(fresh, p)
    region = Region.of(formula, shadow.order)
    for x in (q0[0], (2 * q0[0] + r0[0]) / 3):
        assert ends(region.fibre([x])) == ends(fresh.fibre([x]))
