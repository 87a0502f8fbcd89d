"""Numerical proposals: near the known optima, and honest about how near."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.convex.interior_point import OutOfFloats, interior_point, natural_scale, solve_floats, to_float
from qe.exact.quadratic_form import Quadratic
from tests.tables import each
from tests.unit.convex.quadratics import ball, diagonal, line


@each(
    (ball((3, -1), 0), [], (3, -1), ()),
    (ball((3, 0), 0), [ball((0, 0), 1)], (1, 0), (2,)),
    (line(1, 1), [line(-1, 0, constant=2), line(0, -1, constant=3)], (2, 3), (1, 1)),
    (line(1, 0), [ball((0, 0), 4)], (-2, 0), (0.25,)),
    (line(1, 0), [ball((0, 0), 4), line(1, 0, constant=-9)], (-2, 0), (0.25, 0)),
    (diagonal(1, 100, slope=(-2, -200)), [line(1, 1, constant=-1)], (0.0099, 0.9901), (1.9802,)),
    (line(1000, 0), [line(-2000, 0, constant=4000), diagonal(0, 1)], (2, 0), (0.5, None)),
)
def test_known_optima(objective: Quadratic, forms: list[Quadratic], point: tuple, multipliers: tuple) -> None:  # type: ignore[type-arg]
    found = interior_point(objective, forms, [0.0, 0.0])
    assert found.residual < 1e-5
    assert found.point == pytest.approx(point, abs=1e-2 if len(forms) == 2 and forms[1].hessian[1][1] else 1e-4)
    for got, wanted, slack, form in zip(found.multipliers, multipliers, found.slacks, forms):
        if wanted is not None:
            assert got == pytest.approx(wanted, abs=1e-3)
            assert slack == pytest.approx(-float(form.value([Fraction(c) for c in found.point])), abs=1e-3)


@each(
    (line(1, 0), [ball((0, 0), 1), ball((5, 0), 1)]),  # infeasible
    (line(1, 0), [line(0, 1)]),  # unbounded
)
def test_nothing_good_is_said_of_problems_without_optimum(objective: Quadratic, forms: list[Quadratic]) -> None:
    assert not interior_point(objective, forms, [0.0, 0.0]).residual < 1e-5


def test_numbers_beyond_floats() -> None:
    huge = line(10**400, 1)
    found = interior_point(huge, [ball((0, 0), 1)], [0.5, 0.0])
    assert found.residual == math.inf and found.point == (0.5, 0.0) and found.multipliers == (0.0,)
    with pytest.raises(OutOfFloats):
        natural_scale(huge)
    with pytest.raises(OutOfFloats):
        natural_scale(line(Fraction(1, 10**400), 0))
    with pytest.raises(OutOfFloats):
        to_float(line(1, 0, constant=10**400))


def test_the_natural_scale_is_of_the_largest_coefficient() -> None:
    assert natural_scale(line(3, -8, constant=1000)) == 0.125
    assert natural_scale(diagonal(5, 1, slope=(1, 1))) == 0.1
    assert natural_scale(line(0, 0, constant=7)) == 1.0


@given(st.lists(st.integers(-5, 5), min_size=8, max_size=8), st.tuples(st.integers(-4, 4), st.integers(-4, 4)))
def test_values_and_slopes(c: list[int], at: tuple[int, int]) -> None:
    form = Quadratic(
        ((Fraction(c[0]), Fraction(c[1])), (Fraction(c[1]), Fraction(c[2]))),
        (Fraction(c[3]), Fraction(c[4])),
        Fraction(c[5]),
    )
    value, slope = to_float(form, 2.0).value_and_slope([float(v) for v in at])
    exact = [Fraction(v) for v in at]
    assert value == 2 * form.value(exact) and slope == [2 * s for s in form.slope(exact)]


@given(st.lists(st.integers(-4, 4), min_size=9, max_size=9), st.lists(st.integers(-9, 9), min_size=3, max_size=3))
def test_linear_systems(entries: list[int], x: list[int]) -> None:
    rows = [[float(v) for v in entries[3 * k : 3 * k + 3]] for k in range(3)]
    a, b, c = (entries[3 * k : 3 * k + 3] for k in range(3))
    det = sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3))
    found = solve_floats(rows, [float(sum(p * q for p, q in zip(row, x))) for row in rows])
    if det:
        assert found == pytest.approx(x, abs=1e-6)


def test_a_singular_system_has_no_solution() -> None:
    assert solve_floats([[0.0, 0.0], [0.0, 1.0]], [1.0, 1.0]) is None
    assert solve_floats([[0.0, 1.0], [2.0, 0.0]], [3.0, 4.0]) == [2.0, 3.0]  # rows are exchanged
    assert solve_floats([], []) == []
