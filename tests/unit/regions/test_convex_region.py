"""Convex regions without a decomposition: membership, fibres, bounds, walks, and the way to the formula."""

from fractions import Fraction as F

import pytest

import qe
from qe.decomposition.interval import Interval
from qe.errors import BudgetExceeded, InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.formula.build import exists
from qe.formula.syntax import Formula
from qe.io import formats
from qe.options import Budget
from qe.regions.convex_region import ConvexRegion, shadow_of
from tests.optimum_problems import at_most_zero, cubic
from tests.tables import each

SQRT2 = RealAlgebraic.from_root((-2, 0, 1), 1, 2)
BALL = "x^2 + y^2 + z^2 + w^2 <= 4 and x + y >= 1"


def shadow(q0: tuple[int, ...], r0: tuple[int, ...], r2: int) -> Formula:
    """The region of Q1: the body of formula (7) with Q2 quantified."""
    _, forms, _ = cubic(q0, r0, r2)
    return exists(forms[0].ring.names[len(q0) :], at_most_zero(forms))


def test_four_variables_are_not_decomposed() -> None:
    region = qe.region(BALL)
    assert isinstance(region, ConvexRegion) and not region.is_empty
    assert region.contains({"x": 1, "y": 0, "z": SQRT2, "w": 1})
    assert not region.contains({"x": 0, "y": 0, "z": 0, "w": 0})
    (point,) = region.sample_points()
    assert region.contains(point)


def test_bounds_have_certificates() -> None:
    interval = qe.region(BALL).bounds("z")
    assert interval.upper == -interval.lower and interval.upper * interval.upper == F(7, 2)
    assert interval.lower_closed and interval.upper_closed
    assert all(qe.verify(c).accepted for c in interval.certificates) and len(interval.certificates) == 2


def test_fibres_and_walk() -> None:
    region = qe.region(BALL)
    assert region.fibre([3]) == []
    point: list[F | RealAlgebraic] = []
    for _ in region.order:
        (interval,) = region.fibre(point)
        point.append(interval.simplest())
    assert region.contains(dict(zip(region.order, point, strict=True)))
    (last,) = region.fibre({"x": 1, "y": 1, "z": 1})
    assert (last.lower, last.upper) == (-1, 1)
    with pytest.raises(Unable, match="rational"):
        region.fibre([SQRT2])


def test_strict_conditions_and_unbounded_directions() -> None:
    region = qe.region("x^2 + y^2 < 1 and z > x + y and w >= 2")
    assert region.bounds("x").upper == 1 and not region.bounds("x").upper_closed
    assert region.bounds("z").upper is None and region.bounds("w") == region.bounds("w")
    assert region.bounds("w").lower_closed and region.bounds("w").upper is None
    (point,) = region.sample_points()
    assert region.contains(point)


def test_empty() -> None:
    region = qe.region("x^2 + y^2 + z^2 + w^2 <= 1 and x + y >= 2")
    assert region.is_empty and region.sample_points() == [] and region.fibre() == []
    with pytest.raises(InputError, match="empty"):
        region.bounds("x")


def test_hidden_variables() -> None:
    region = qe.region("ex y, z. (x - y)^2 + z^2 <= 1 and y^2 + z^2 <= 4 and z >= 1")
    assert isinstance(region, ConvexRegion)
    third = RealAlgebraic.from_root((-3, 0, 1), 1, 2)
    assert tuple(region.bounds("x")) == (-third, third)
    assert region.contains({"x": third}) and region.contains({"x": F(17, 10)}) and not region.contains({"x": F(7, 4)})
    assert str(region.formula) == "x^2 <= 3"
    assert region.cells and qe.verify(region.certificate).accepted


def test_region_of_cubic_curves_in_the_plane() -> None:
    region = qe.region(shadow((-3, 2), (2, 2), 27))
    assert region.contains({"a0": -2, "a1": 2}) and not region.contains({"a0": 2, "a1": 2})
    (fibre,) = region.fibre([-2])
    assert fibre.lower + fibre.upper == F(16, 3) and fibre.lower * fibre.upper == F(41, 9)
    lower, upper = region.bounds("a0").lower, region.bounds("a0").upper
    assert region.fibre([lower]) == [Interval(F(8, 3), F(8, 3), True, True)]
    assert len({str(c.poly) for c in region.formula.args}) == 3  # type: ignore[attr-defined]
    assert all(region.contains(p) for p in region.sample_points())
    assert all(isinstance(c, F) for p in region.sample_points() for c in p.values())
    assert region.contains({"a0": lower, "a1": F(8, 3)}) and lower < upper
    low, high = region.volume(0.05)
    assert 0 < low <= high


def test_spatial_membership_and_box() -> None:
    region = qe.region(shadow((-3, 1, 2), (2, 1, 2), 15))
    assert region.contains({"a0": F(-5, 2), "a1": F(13, 10), "a2": F(13, 5)})
    assert not region.contains({"a0": -2, "a1": 1, "a2": 0})
    box = {name: region.bounds(name) for name in region.order}
    assert all(qe.verify(c).accepted for interval in box.values() for c in interval.certificates)
    assert box["a0"].lower < -3 < box["a0"].upper < -2
    (rim,) = region.fibre([F(-5, 2), F(13, 10)])
    assert isinstance(rim.upper, RealAlgebraic)
    assert region.contains({"a0": F(-5, 2), "a1": F(13, 10), "a2": rim.upper})
    assert not region.contains({"a0": F(-5, 2), "a1": F(13, 10), "a2": rim.upper + F(1, 10**9)})
    with pytest.raises(Unable, match="irrational"):
        region.contains({"a0": SQRT2, "a1": SQRT2, "a2": 0})


@each(((3, 4), (1, 2), 25, (3, 4)), ((3, 4), (-3, 4), 25, (3, 4)), ((3, 4), (3, 4), 25, (3, 4)))
def test_via_point_on_the_circle(q0: tuple[int, int], r0: tuple[int, int], r2: int, point: tuple[int, int]) -> None:
    """|Q0| = r leaves Q1 = Q0 alone: a set without interior points."""
    region = qe.region(shadow(q0, r0, r2))
    assert [tuple(region.bounds(name)) for name in region.order] == [(point[0],) * 2, (point[1],) * 2]
    assert qe.equivalent(region.formula, f"a0 = {point[0]} and a1 = {point[1]}")


@each(
    ((0, 0), (0, 0), 1, "9*a0^2 + 9*a1^2 <= 1"),
    ((1, 1), (1, 1), 4, "9*a0^2 + 9*a1^2 - 24*a0 - 24*a1 + 28 <= 0 and a0^2 + a1^2 <= 4"),
)
def test_coinciding_via_points_and_the_origin(q0: tuple[int, int], r0: tuple[int, int], r2: int, formula: str) -> None:
    assert qe.equivalent(qe.region(shadow(q0, r0, r2)).formula, formula)


def test_a_bound_that_optimisation_cannot_prove_comes_from_the_decomposition() -> None:
    """The least p touches two conditions in one irrational point, where one of them has no part in the optimum."""
    text = "y^2 + z^2 <= 5 and (p + y - 2)^2 + (q + z)^2 <= 5 and z + 2 <= p"
    with pytest.raises(Unable):
        qe.minimize("p", text)
    region = qe.region(f"ex y, z. {text}", order=("p", "q"))
    assert region.bounds("p").lower == 2 - RealAlgebraic.from_root((-5, 0, 1), 2, 3)


def test_nonconvex_formulas_are_decomposed() -> None:
    region = qe.region("ex y. x^2 + y^2 = 1 and y > 0")
    assert not isinstance(region, ConvexRegion)
    assert tuple(region.bounds("x")) == (-1, 1)


def test_every_question_has_a_budget_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Budget] = []

    def counted(*arguments: object, **keywords: object) -> Budget:
        made.append(Budget(60))
        return made[-1]

    monkeypatch.setattr("qe.processes.channel.Budget", counted)
    found = shadow_of(formats.read(BALL, "text"), lambda formula, budget: formula)
    assert found is not None
    region = ConvexRegion(found, None)
    assert not made and not region.is_empty
    assert len(made) == 1
    assert region.bounds("z").upper and len(made) == 2 and region.bounds("z").lower and len(made) == 2


def test_the_limit_holds_for_questions_that_need_the_decomposition() -> None:
    hard = qe.region(shadow((-3, 2), (3, 2), 27), timeout=1)
    with pytest.raises(BudgetExceeded):
        _ = hard.cells
