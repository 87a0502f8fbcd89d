"""In floats: linear algebra, interior points; faces."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.convex.facial_reduction import implied_equations, on_flat
from qe.convex.float_linear_algebra import caratheodory, free_columns
from qe.convex.interior_point import OutOfFloats, interior_point, natural_scale, solve_floats, to_float
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import format_poly
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE
from qe.io.text import read
from qe.options import Budget
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


ROWS = st.integers(1, 4).flatmap(
    lambda n: st.lists(st.lists(st.integers(-3, 3), min_size=n, max_size=n), min_size=1, max_size=4)
)


@given(ROWS)
def test_the_free_columns_are_as_many_as_the_kernel_has_dimensions(rows: list[list[int]]) -> None:
    width = len(rows[0])
    free = free_columns(rows, width)
    matrix = np.array(rows, dtype=float)
    assert len(free) == width - np.linalg.matrix_rank(matrix)
    bound = [c for c in range(width) if c not in free]
    assert np.linalg.matrix_rank(matrix[:, bound]) == len(bound)  # the others are determined by them


def test_what_is_nearly_dependent_counts_as_dependent() -> None:
    assert free_columns([[1, 1], [1, 1 + 1e-9]], 2) != []
    assert free_columns([[1, 1], [1, 1 + 1e-3]], 2) == []
    assert free_columns([], 2) == [0, 1]


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=1, max_size=5), st.data())
def test_the_sum_stays_in_the_cone_of_independent_slopes(slopes: list[tuple[int, int]], data: st.DataObject) -> None:
    weights = data.draw(st.lists(st.integers(1, 5), min_size=len(slopes), max_size=len(slopes)))
    kept = caratheodory(range(len(slopes)), weights, slopes)
    matrix = np.array([slopes[i] for i in kept], dtype=float).reshape(len(kept), 2)
    assert np.linalg.matrix_rank(matrix) == len(kept)
    total = np.array(weights, dtype=float) @ np.array(slopes, dtype=float)
    if not kept:
        assert total == pytest.approx([0, 0])
        return
    found, *_ = np.linalg.lstsq(matrix.T, total, rcond=None)
    assert matrix.T @ found == pytest.approx(total, abs=1e-6)
    assert min(found) > -1e-6


TOUCH = "x^2 + y^2 <= 1 and (x - 2)^2 + y^2 <= 1"  # at (1, 0)


def equations(text: str) -> list[str] | None:
    found = implied_equations(read(text), budget=Budget(60))
    return None if found is None else sorted(format_poly(p.normal()[1]) for p in found)


def holding(text: str, at: dict[str, int]) -> bool:
    return all(
        p.evaluate([at[n] for n in p.ring.names]) == 0 for p in implied_equations(read(text), budget=Budget(60)) or ()
    )


@each(
    (TOUCH, [(1, 0)], [(1, 1), (0, 0)]),
    ("x + y <= 1 and x + y >= 1 and x^2 <= 4", [(2, -1), (0, 1)], [(0, 0)]),  # a slab of no width
)
def test_equations_of_the_flat(text: str, on: list[tuple[int, int]], off: list[tuple[int, int]]) -> None:
    assert equations(text) and all(holding(text, {"x": x, "y": y}) for x, y in on)
    assert not any(holding(text, {"x": x, "y": y}) for x, y in off)


@each(
    ("x^2 + y^2 <= 1", True),
    ("x^2 + y^2 <= 1 and x >= 0", True),
    ("x^2 < 1", True),
    ("x = 1", True),
    ("true", True),
    ("x^2 + y^2 <= 1 and (x - y)^2 <= 1", True),
    ("x^2 + y^2 <= 1 and (x - 3)^2 + y^2 <= 1", False),
    ("x^2 + y^2 <= 1 and x^2 - 3*x + y^2 - 3*y + 4 <= 0", False),
)
def test_no_equations_of_what_has_interior_points_or_is_not_weak(text: str, points: bool) -> None:
    assert equations(text) == ([] if points else None)


def test_a_line_that_touches() -> None:
    assert equations("x^2 + y^2 <= 2 and x + y >= 2")


def test_the_block_without_the_variables_that_the_equations_give() -> None:
    """Over (1, 0) the discs say nothing more; with a beside x the parameter is bound."""
    found = on_flat(("x", "y"), read(TOUCH), budget=Budget(60))
    assert found is not None and found[0] == [] and holds_at(found[1], {})
    outside, rest = on_flat(("x",), read(TOUCH.replace("y", "a")), budget=Budget(60)) or ([], FALSE)
    whole = conj((*outside, rest))
    assert set(whole.free) <= {"a"}
    for a in (Fraction(-1), Fraction(0), Fraction(1, 3)):
        assert holds_at(whole, {"a": a, "x": 0}) == (a == 0)


def test_blocks_that_are_not_reduced() -> None:
    budget = Budget(60)
    assert on_flat(("x",), read("x^2 + a^2 <= 1"), budget=budget) is None
    assert on_flat(("x",), read("x^2 - a^2 <= 1"), budget=budget) is None
    assert on_flat(("x",), read("x^2 + a^2 <= 1 and (x - 3)^2 + a^2 <= 1"), budget=budget) == ([], FALSE)
