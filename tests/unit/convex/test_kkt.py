"""Proved minima: the conditions hold exactly, whatever was proposed."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.convex.kkt import Kkt, kkt_point, sign
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import NumberField
from qe.exact.quadratic_form import Quadratic
from qe.options import Budget
from tests.tables import each
from tests.unit.convex.quadratics import ball, diagonal, line


def least(objective: Quadratic, *forms: Quadratic) -> Kkt | None:
    return kkt_point(objective, forms, budget=Budget(60))


def proves(objective: Quadratic, forms: tuple[Quadratic, ...], found: Kkt) -> bool:
    """The theorem's conditions, with everything recomputed."""
    slope = objective.slope(found.point)
    for i, m in found.multipliers.items():
        slope = [a + m * b for a, b in zip(slope, forms[i].slope(found.point))]
    complementary = all(not sign(forms[i].value(found.point)) for i in found.multipliers)
    return (
        all(sign(m) > 0 for m in found.multipliers.values())
        and complementary
        and not any(map(sign, slope))
        and all(sign(g.value(found.point)) <= 0 for g in forms)
    )


def test_signs() -> None:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    assert [sign(v) for v in (Fraction(-1, 3), Fraction(0), Fraction(2))] == [-1, 0, 1]
    assert [sign(v) for v in (root - 2, root - root, root - 1)] == [-1, 0, 1]


@each(
    (ball((3, 0), 0), (), 0, True),
    (ball((3, 0), 0), (ball((0, 0), 1),), 4, True),
    (line(1, 1), (ball((0, 0), 2),), -2, True),
    (line(1, 0), (line(-1, 0, constant=2),), 2, False),  # a whole line of minima
    (diagonal(1, 0), (line(0, 1, constant=-5),), 0, False),
    (line(1, 1), (line(-1, 0), line(0, -1)), 0, True),
    (line(1, 0), (line(-1, 0), line(-1, -1), line(-1, 1)), 0, None),  # three lines through the minimum
)
def test_least_values(objective: Quadratic, forms: tuple[Quadratic, ...], value: int, unique: bool | None) -> None:
    found = least(objective, *forms)
    assert found is not None and objective.value(found.point) == value
    assert proves(objective, forms, found)
    assert found.unique is unique or unique is None


def test_an_irrational_minimum() -> None:
    found = least(line(1, 1), ball((0, 0), 1))
    assert found is not None and found.field.degree == 2 and proves(line(1, 1), (ball((0, 0), 1),), found)
    value = line(1, 1).value(found.point).to_algebraic()  # type: ignore[union-attr]
    assert value == -RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    (line(1, 0), ()),  # unbounded
    (line(1, 0), (ball((0, 0), 1), ball((5, 0), 1))),  # infeasible
    (line(0, 1), (ball((0, 0), 1), ball((2, 0), 1))),  # one point, without multipliers
)
def test_what_has_no_multipliers(objective: Quadratic, forms: tuple[Quadratic, ...]) -> None:
    assert least(objective, *forms) is None


@settings(max_examples=15)
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(1, 9), st.integers(-3, 3), st.integers(-3, 3))
def test_the_nearest_point_of_a_disc(x: int, y: int, square: int, a: int, b: int) -> None:
    objective, disc = ball((a, b), 0), ball((x, y), square)
    found = least(objective, disc)
    assert found is not None and proves(objective, (disc,), found) and found.unique is True
    inside = sign(disc.value((Fraction(a), Fraction(b)))) <= 0
    assert (not found.multipliers) is inside or sign(disc.value((Fraction(a), Fraction(b)))) == 0
