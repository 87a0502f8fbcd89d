"""What is left for the next variable: the intervals over a point, against the formula."""

from fractions import Fraction

import pytest

from qe.decomposition.extended_tarski import extended_formula
from qe.decomposition.fibres import fibre_of
from qe.decomposition.interval import Interval, Number
from qe.decomposition.sampled_cells import any_true
from qe.exact.algebraic import RealAlgebraic
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE
from qe.io.text import read
from qe.options import Budget, Projection
from qe.proof.cells import CellTable
from tests.certificates.producing import cell_table, table_in
from tests.tables import each


def table(text: str, order: str, projection: Projection = Projection.BROWN_MCCALLUM) -> CellTable:
    return table_in(cell_table(text, order, projection=projection))


def fibre(text: str, *values: Number, projection: Projection = Projection.BROWN_MCCALLUM) -> list[Interval]:
    return fibre_of(table(text, "x y", projection), values, budget=Budget(60))


ROOT = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@pytest.mark.parametrize("projection", Projection)
@each(
    ("x^2 + y^2 <= 4", (), [(-2, 2, True, True)]),
    ("x^2 + y^2 < 4", (), [(-2, 2, False, False)]),
    ("x^2 + y^2 <= 4", (Fraction(0),), [(-2, 2, True, True)]),
    ("x^2 + y^2 <= 4", (ROOT,), [(-ROOT, ROOT, True, True)]),
    ("x^2 + y^2 <= 4", (Fraction(2),), [(0, 0, True, True)]),
    ("x^2 + y^2 <= 4", (Fraction(3),), []),
    ("x^2 + y^2 < 4 and y /= 0", (Fraction(0),), [(-2, 0, False, False), (0, 2, False, False)]),
    ("y^2 > x", (Fraction(4),), [(None, -2, False, False), (2, None, False, False)]),
    ("y^2 > x", (Fraction(-1),), [(None, None, False, False)]),
    ("y^2 = x", (), [(0, None, True, False)]),
    ("x = 1 or y > 0 and y <= x", (), [(0, None, False, False)]),
    ("x = 1 or y > 0 and y <= x", (Fraction(1),), [(None, None, False, False)]),
)
def test_intervals(
    text: str, values: tuple[Number, ...], ends: list[tuple[object, ...]], projection: Projection
) -> None:
    found = fibre(text, *values, projection=projection)
    assert [(i.lower, i.upper, i.lower_closed, i.upper_closed) for i in found] == ends


def test_whether_a_cell_has_a_true_one_over_it() -> None:
    assert any_true(table("x^2 + y^2 < 1", "x y").root) and not any_true(table("x^2 + y^2 < 0 and x = 1", "x y").root)


@each("x^2 + y^2 <= 4 and x < y", "y^2 > x and y < 3", "x*y = 1", "x = 1 and y > 0 or x > 2 and y^2 <= x")
def test_the_extended_formula_says_the_same(text: str) -> None:
    found = extended_formula(table(text, "x y"))
    for x in range(-5, 6):
        for y in range(-5, 6):
            point = {"x": Fraction(x, 2), "y": Fraction(y, 2)}
            assert holds_at(found, point) == holds_at(read(text), point)


def test_nothing_and_everything() -> None:
    assert extended_formula(table("x^2 + y^2 < 0", "x y")) == FALSE
    assert extended_formula(table("x^2 + y^2 >= 0", "x y")) == TRUE
    assert str(extended_formula(table("-2*x < 1 and y = x", "x y"))) == "x > -1/2 and x = y"
