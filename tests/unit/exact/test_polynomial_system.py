"""Real solutions of systems with finitely many complex ones: counts, multiplicities, constants, degenerate cases."""

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.groebner import Limits
from qe.exact.polynomial_system import solve_system
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, Ring

RING = Ring.of(("w", "z", "y", "x"))
w, z, y, x = (RING.gen(i) for i in range(4))
ROOT_2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)
ROOT_3 = RealAlgebraic.from_root([-3, 0, 1], 1, 2)


def test_a_circle_and_a_hyperbola() -> None:
    found = solve_system([x**2 + y**2 - 4, x * y - 1])
    assert len(found) == 4
    for zero in found:
        a, b = zero.values["x"], zero.values["y"]
        assert (a * a + b * b - 4).sign() == 0 and (a * b - 1).sign() == 0 and zero.multiplicity == 1


def test_a_tangent_line_has_one_double_solution() -> None:
    (zero,) = solve_system([x**2 + y**2 - 1, y - 1])
    assert zero.multiplicity == 2
    assert zero.values["x"].sign() == 0 and zero.values["y"] == 1


def test_no_complex_solution_and_no_real_one() -> None:
    assert solve_system([x**2 + y**2 - 1, x - y, x + y, x * y - 5]) == []
    assert solve_system([x**2 + 1, y - x]) == []


def test_solutions_that_share_every_coordinate_but_one() -> None:
    found = solve_system([x**2 - 1, y**2 - 1, z**2 - 1])
    points = {tuple(int(zero.values[name].as_fraction()) for name in ("x", "y", "z")) for zero in found}
    assert points == set(product((-1, 1), repeat=3))


def test_a_constant_is_the_number_itself_and_not_its_conjugate() -> None:
    found = solve_system([x**2 - w], constants={0: ROOT_2})
    assert [round(float(zero.values["x"]), 6) for zero in found] == [-1.189207, 1.189207]
    assert solve_system([x**2 + w], constants={0: ROOT_2}) == []
    assert len(solve_system([x**2 + w], constants={0: -ROOT_2})) == 2


def test_two_dependent_constants() -> None:
    # sqrt(2) * sqrt(3) = sqrt(6) is seen although w and z join the system as independent variables
    six = RealAlgebraic.from_root([-6, 0, 1], 2, 3)
    found = solve_system([x - w * z, x**2 - 6], constants={0: ROOT_2, 1: ROOT_3})
    assert len(found) == 1 and found[0].values["x"] == six


def test_close_solutions_are_kept_apart() -> None:
    tiny = 10**40
    found = solve_system([(tiny * x - 1) * (tiny * x - 2), y - x])
    assert [zero.values["y"].as_fraction() for zero in found] == [Fraction(1, tiny), Fraction(2, tiny)]


def test_infinitely_many_solutions_are_named() -> None:
    with pytest.raises(PositiveDimensional) as caught:
        solve_system([x * y, z - 1])
    assert caught.value.free in (("x",), ("y",))
    with pytest.raises(PositiveDimensional):
        solve_system([x**2 - 2], variables=[3, 2])


def test_bad_input_and_limits() -> None:
    with pytest.raises(InputError, match="at least one equation"):
        solve_system([x - x])
    with pytest.raises(Unable, match="limits"):
        solve_system([x**5 + y**4 + z - 1, x**3 * y - z**2, y**5 - x * z + 3], limits=Limits(4, 10, 20))


@st.composite
def grids(draw: st.DrawFn) -> tuple[list[Poly], set[tuple[int, int]]]:
    """A sheared grid of known points: the product of two sets, and a double column."""
    columns = draw(st.sets(st.integers(-4, 4), min_size=1, max_size=3))
    rows = draw(st.sets(st.integers(-4, 4), min_size=1, max_size=3))
    shear = draw(st.integers(-3, 3))
    first = second = RING.constant(1)
    for a in columns:
        first = first * (x - a)
    for b in rows:
        second = second * (y + shear * x - b)
    power = draw(st.integers(1, 2))
    return [first**power, second], {(a, b - shear * a) for a in columns for b in rows}


@given(grids())
def test_exactly_the_points_of_a_grid(case: tuple[list[Poly], set[tuple[int, int]]]) -> None:
    equations, points = case
    found = solve_system(equations)
    assert {(int(p.values["x"].as_fraction()), int(p.values["y"].as_fraction())) for p in found} == points
    assert len(found) == len(points)
