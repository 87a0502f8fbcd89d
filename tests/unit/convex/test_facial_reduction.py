"""Linear equations that hold on a convex set without interior points."""

from __future__ import annotations

from fractions import Fraction

from qe.convex.facial_reduction import implied_equations, on_flat
from qe.exact.ring import format_poly
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE
from qe.io.text import read
from qe.options import Budget
from tests.tables import each

TOUCH = "x^2 + y^2 <= 1 and (x - 2)^2 + y^2 <= 1"  # at (1, 0)


def equations(text: str) -> list[str] | None:
    found = implied_equations(read(text), budget=Budget(60))
    return None if found is None else sorted(format_poly(p.normal()[1]) for p in found)


def holding(text: str, at: dict[str, int]) -> bool:
    return all(
        p.evaluate([at[n] for n in p.ring.names]) == 0 for p in implied_equations(read(text), budget=Budget(60)) or ()
    )


def test_discs_that_touch() -> None:
    found = equations(TOUCH)
    assert found and holding(TOUCH, {"x": 1, "y": 0})
    assert not holding(TOUCH, {"x": 1, "y": 1}) and not holding(TOUCH, {"x": 0, "y": 0})


def test_a_slab_of_no_width() -> None:
    text = "x + y <= 1 and x + y >= 1 and x^2 <= 4"
    assert holding(text, {"x": 2, "y": -1}) and holding(text, {"x": 0, "y": 1})
    assert not holding(text, {"x": 0, "y": 0}) and equations(text)


@each("x^2 + y^2 <= 1", "x^2 + y^2 <= 1 and x >= 0", "x^2 < 1", "x = 1", "true")
def test_no_equations_of_what_has_interior_points_or_is_not_weak(text: str) -> None:
    assert equations(text) == []


def test_a_contradiction() -> None:
    assert equations("x^2 + y^2 <= 1 and (x - 3)^2 + y^2 <= 1") is None


def test_a_line_that_touches() -> None:
    assert equations("x^2 + y^2 <= 2 and x + y >= 2") and equations("x^2 + y^2 <= 1 and (x - y)^2 <= 1") == []
    assert equations("x^2 + y^2 <= 1 and x^2 - 3*x + y^2 - 3*y + 4 <= 0") is None


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
