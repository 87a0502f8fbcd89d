"""The simplex method: the least cost, or a proof that there are no weights, or a ray without end."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.convex.linear import LinearBest, LinearConflict, LinearFall, linear_optimum
from qe.convex.simplex import Endless, Least, Nowhere, least_cost
from qe.exact.field import NumberField
from qe.exact.quadratic_form import Quadratic
from qe.options import Budget

ROOT = NumberField.from_root([-2, 0, 1], 1, 2).generator()


def steps() -> None:
    """No limit."""


def dot(a, b):
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


@st.composite
def problems(draw: st.DrawFn):
    height, count = draw(st.integers(1, 3)), draw(st.integers(1, 5))
    numbers = st.integers(-3, 3).map(Fraction)
    columns = [draw(st.lists(numbers, min_size=height, max_size=height)) for _ in range(count)]
    rhs = draw(st.lists(numbers, min_size=height, max_size=height))
    cost = draw(st.lists(numbers, min_size=count, max_size=count))
    if draw(st.booleans()):
        rhs = [ROOT * v for v in rhs]
    return columns, rhs, cost


@given(problems())
def test_every_outcome_proves_itself(problem) -> None:
    """Weak duality and Farkas: each of the three outcomes excludes the others."""
    columns, rhs, cost = problem
    found = least_cost(columns, rhs, cost, check=steps)
    if isinstance(found, Nowhere):
        assert all(dot(found.dual, column) <= 0 for column in columns)
        assert dot(found.dual, rhs) > 0
        return
    assert all(w > 0 for w in found.weights.values())
    for r, right in enumerate(rhs):
        total = sum((w * columns[j][r] for j, w in found.weights.items()), Fraction(0))
        assert total == (right if isinstance(found, Least) else 0)
    if isinstance(found, Endless):
        assert sum(w * cost[j] for j, w in found.weights.items()) < 0
        return
    for j, column in enumerate(columns):
        assert dot(found.dual, column) <= cost[j]
        if j in found.weights:
            assert dot(found.dual, column) == cost[j]


def test_a_known_least_cost() -> None:
    """w1 + w2 = 1, w1 - w2 + w3 = 0 with costs 1, 3, 1: w = (1/2, 1/2, 0) costs 2, w = (0, 1, 1) costs 4."""
    columns = [[Fraction(1), Fraction(1)], [Fraction(1), Fraction(-1)], [Fraction(0), Fraction(1)]]
    found = least_cost(columns, [Fraction(1), Fraction(0)], [Fraction(c) for c in (1, 3, 1)], check=steps)
    assert isinstance(found, Least)
    assert found.weights == {0: Fraction(1, 2), 1: Fraction(1, 2)}


def test_a_cycling_problem_ends() -> None:
    """Beale's example, on which the rule of the steepest descent runs in a circle."""
    rows = [["1/4", -60, "-1/25", 9], ["1/2", -90, "-1/50", 3], [0, 0, 1, 0]]
    columns = [[Fraction(row[j]) for row in rows] for j in range(4)]
    columns += [[Fraction(int(r == k)) for r in range(3)] for k in range(3)]
    cost = [Fraction(c) for c in ("-3/4", 150, "-1/50", 6, 0, 0, 0)]
    found = least_cost(columns, [Fraction(0), Fraction(0), Fraction(1)], cost, check=steps)
    assert isinstance(found, Least)
    assert sum(w * cost[j] for j, w in found.weights.items()) == Fraction(-1, 20)


def form(*coefficients: int) -> Quadratic:
    """A linear polynomial: the gradient, and the constant last."""
    *gradient, constant = map(Fraction, coefficients)
    size = len(gradient)
    return Quadratic(((Fraction(0),) * size,) * size, tuple(gradient), constant)


LINES = st.tuples(*[st.integers(-3, 3)] * 3)


@given(st.lists(LINES, min_size=1, max_size=5), LINES)
def test_linear_problems_in_the_plane(lines: list[tuple[int, int, int]], goal: tuple[int, int, int]) -> None:
    """Against all corners of the region, cut with a large square."""
    objective, forms = form(*goal), [form(*line) for line in lines]
    found = linear_optimum(objective, forms, budget=Budget())
    if isinstance(found, LinearConflict):
        total = [sum((w * Fraction(lines[i][k]) for i, w in found.weights.items()), Fraction(0)) for k in range(3)]
        assert all(w > 0 for w in found.weights.values()) and total[:2] == [0, 0] and total[2] > 0
        return
    assert all(f.value(found.point) <= 0 for f in forms)
    if isinstance(found, LinearFall):
        assert dot(objective.gradient, found.direction) < 0
        assert all(dot(f.gradient, found.direction) <= 0 for f in forms)
        return
    assert isinstance(found, LinearBest)
    square = [form(1, 0, -100), form(-1, 0, -100), form(0, 1, -100), form(0, -1, -100)]
    least = min(objective.value(p) for p in corners([*forms, *square]))
    assert objective.value(found.point) == least


def corners(forms: list[Quadratic]) -> list[tuple[Fraction, Fraction]]:
    found = []
    for f, g in combinations(forms, 2):
        (a, b), (c, d) = f.gradient, g.gradient
        if det := a * d - b * c:
            p = (b * g.constant - d * f.constant) / det, (c * f.constant - a * g.constant) / det
            if all(h.value(p) <= 0 for h in forms):
                found.append(p)
    return found


def test_the_budget_is_looked_at() -> None:
    calls: list[int] = []

    def check() -> None:
        calls.append(1)
        raise TimeoutError

    with pytest.raises(TimeoutError):
        least_cost([[Fraction(1)]], [Fraction(1)], [Fraction(1)], check=check)
    assert calls
