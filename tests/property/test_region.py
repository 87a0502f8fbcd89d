"""Regions against formula, decomposition, optimisation and geometry, at random and at boundary points, in any order."""

from __future__ import annotations

import pickle
from fractions import Fraction
from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.decomposition.interval import Interval, Number
from qe.decomposition.sampled_cells import child, root_place
from qe.errors import InputError, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, exists
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula, Relation
from qe.regions.convex_region import ConvexRegion
from qe.regions.region import Region
from tests.enough import enough
from tests.optimum_problems import at_most_zero, cubic, norm
from tests.property.test_vs import eliminated
from tests.strategies import formulas, points, rationals
from tests.strict_problems import conditions
from tests.tables import each


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


HIDDEN = Ring.of(("x", "y", "u", "v"))


XY = ("x", "y")


@st.composite
def shadows(draw: st.DrawFn) -> Formula:
    """A convex set of the plane behind one or two hidden variables."""
    hidden = ("u", "v")[: draw(st.integers(1, 2))]
    ring = Ring.of((*XY, *hidden))
    return exists(hidden, conj(draw(conditions(ring))))


def ends(intervals: list[Interval]) -> list[tuple[object, ...]]:
    return [(i.lower, i.upper, i.lower_closed, i.upper_closed) for i in intervals]


def answers(region: Region, at: list[tuple[Number, Number]]) -> list[object]:
    """What a region says: empty or not, bounds, fibres over the first coordinates, membership of the points."""
    found: list[object] = [region.is_empty]
    for name in XY:
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
    fresh = qe.region(formula, order=XY)
    if not isinstance(fresh, ConvexRegion):
        return False
    table = Region.of(qe.eliminate(formula, method="cad").formula, XY)
    at: list[tuple[Number, Number]] = [(F(0), F(0)), (F(1), F(1, 1000)), *corners(table)]
    expected = answers(table, at)
    assert answers(fresh, at) == expected
    read = qe.region(formula, order=XY)
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
