"""Exact values on the way back: polynomials at algebraic points, quotients, roots, perturbations."""

from fractions import Fraction
from functools import reduce
from operator import mul

import pytest
from flint import fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from qe.api.eliminate import eliminate
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.number import simplest
from qe.exact.ring import Ring
from qe.formula.syntax import TRUE
from qe.io.text import read
from qe.rules.lift import Solve, holds_at, perturb, root, sign_at, value_at
from tests.tables import each

RING = Ring.of(("x", "y"))
x, y = RING.gen(0), RING.gen(1)
SQRT2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def test_signs_and_values_at_algebraic_points() -> None:
    at = {"x": SQRT2, "y": Fraction(3, 2)}
    assert sign_at(x**2 - 2, at) == 0
    assert sign_at(x - y, at) == -1
    assert value_at(x**2 * y - 1, at) == 2
    assert isinstance(value_at(x**2 * y - 1, at), Fraction)
    assert value_at(x + y, {"x": Fraction(1)}) == 1  # a variable without a value counts as 0


def test_quotients() -> None:
    rule = Solve("z", x * 3, y, Fraction(7))
    assert rule.value({"x": SQRT2, "y": SQRT2}) == 3
    assert rule.value({"x": SQRT2, "y": Fraction(0)}) == 7
    with pytest.raises(Unable):
        Solve("z", x, y).value({"x": Fraction(1), "y": Fraction(0)})


@each(1, -1)
def test_roots_pick_the_right_conjugate(sign: int) -> None:
    lo, hi = (5, 6) if sign > 0 else (0, 1)
    value = RealAlgebraic.from_root([4, -6, 1], lo, hi)  # 3 + sqrt(5) and 3 - sqrt(5), both positive
    found = root(value, 2)
    assert found > 0 and found**2 == value


def test_rational_and_odd_roots() -> None:
    assert root(Fraction(4, 9), 2) == Fraction(2, 3)
    assert root(Fraction(-8), 3) == -2
    assert root(Fraction(2), 2) == SQRT2
    assert root(-SQRT2, 3) ** 3 == -SQRT2
    assert root(Fraction(0), 4) == 0
    with pytest.raises(Unable):
        root(Fraction(-1), 2)


@given(st.lists(st.integers(-6, 6), min_size=2, max_size=5), st.integers(2, 4))
def test_powers_are_repeated_products_and_roots_undo_them(coefficients: list[int], degree: int) -> None:
    for value in real_roots(fmpz_poly([*coefficients, 1])):
        product = reduce(mul, [value] * degree)
        assert value**degree == product
        assert value.sign() == 0 or value**-degree == product.inverse()
        if degree % 2 or value.sign() >= 0:
            assert root(simplest(product), degree) == simplest(value)


def test_a_tower_of_square_roots_without_signs_has_a_witness() -> None:
    """The way back squares a number of degree 32 and takes roots of its powers: no resultant of degree 32 by 32."""
    parts = ["a^2 = 2", "b^2 = 3 + a", "c^2 = 5 + b", "d^2 = 7 + c", "e^2 = 11 + d"]
    answer = eliminate("ex a, b, c, d, e: " + " and ".join(parts), method="cad", timeout=60)
    assert answer.formula == TRUE and answer.witness is not None
    assert isinstance(answer.witness["e"], RealAlgebraic) and answer.witness["e"].degree == 32


def test_nudges_stay_in_the_open_part() -> None:
    body = read("x > 0 and x < 1/1000 and x - y /= 0 and x*y /= 0")
    start = {"x": Fraction(1, 2000), "y": Fraction(0)}
    moved = perturb(("x", "y"), body, start)
    assert holds_at(body, moved) and moved != start
    assert perturb(("x",), body, moved) == moved
    with pytest.raises(Unable):
        perturb(("x",), read("x <= 0 and x /= 0 and x >= 0"), {"x": Fraction(0)})


def test_quantifiers_cannot_be_evaluated() -> None:
    with pytest.raises(Unable):
        holds_at(read("ex y. x > y^3 + y"), {"x": Fraction(1)})


def test_values_of_several_irrational_variables() -> None:
    ring = Ring.of(("x", "y", "z"))
    a, b = (RealAlgebraic.from_root(c, 1, 2) for c in ((-2, 0, 1), (1, -3, 0, 1)))
    poly = ring.var("x") ** 2 * ring.var("y") - 3 * ring.var("z") * ring.var("x") * ring.var("y") ** 2 + 1
    assert value_at(poly, {"x": a, "y": b, "z": Fraction(1)}) == 2 * b - 3 * a * b * b + 1
    assert value_at(poly, {"x": a, "y": a, "z": Fraction(1, 3)}) == 1
    assert value_at(poly - 1 - poly, {"x": a, "y": b}) == -1


def test_a_value_in_a_field_of_large_degree_is_refused() -> None:
    ring = Ring.of(("x", "y"))
    a = RealAlgebraic.from_root((-2, *[0] * 19, 1), 1, 2)
    b = RealAlgebraic.from_root((-3, *[0] * 18, 1), 1, 2)
    with pytest.raises(Unable):
        value_at(ring.var("x") + ring.var("y"), {"x": a, "y": b})


def test_variables_without_a_value_are_zero() -> None:
    ring = Ring.of(("x", "y"))
    x, y = ring.var("x"), ring.var("y")
    assert [sign_at(poly, {"x": Fraction(1)}) for poly in (x + y, y, x * y - 1, y**2 - x)] == [1, 0, -1, -1]
