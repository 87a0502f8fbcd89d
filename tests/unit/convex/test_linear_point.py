"""Points of linear conditions, strict ones included."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.convex.linear_point import linear_point
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.io.substitution import over_one_ring
from qe.io.text import read
from qe.options import Budget
from tests.tables import each


def point(text: str | Formula) -> dict[str, Fraction] | None:
    return linear_point(read(text) if isinstance(text, str) else text, budget=Budget(60))


@each(
    "x > 1 and x < 2",
    "x >= 1 and x <= 1",
    "2*x = 3 and y < x",
    "-3*x > 2 and -3*x < 3",
    "x + y > 1 and x - y > 1 and x + 2*y < 2",
    "x + y = 1 and x - y = 1/3 and z > x",
    "x < 10^40 and x > 10^40 - 1/10^40",
    "-2*x - 2*y >= 4 and x >= -1 and y >= -1",
    "3 - x > 0",
)
def test_points_satisfy_the_conditions(text: str) -> None:
    found = point(text)
    assert found is not None and holds_at(read(text), found)


@each(
    "x > 1 and x < 1",
    "x >= 1 and x < 1",
    "x > 1 and x <= 1",
    "2*x = 3 and x > 2",
    "x + y > 2 and x <= 1 and y <= 1",
    "x + y = 1 and x + y = 2",
    "x < y and y < z and z < x",
    "x <= y and y <= z and z <= x and x < z",
    "x^2 < 1",
    "x /= 1",
    "x > 1 or x < 0",
    "true",
    "false",
)
def test_no_point_or_not_linear(text: str) -> None:
    assert point(text) is None


ROWS = st.tuples(*[st.integers(-3, 3)] * 4, st.sampled_from(("<", "<=", "=", ">=", ">")))


@given(st.lists(ROWS, min_size=1, max_size=5), st.tuples(*[st.fractions(-4, 4, max_denominator=4)] * 3))
def test_conditions_that_a_known_point_satisfies(rows: list[tuple], at: tuple[Fraction, ...]) -> None:  # type: ignore[type-arg]
    """Every form is compared with its value at the point as the relation says, so a point is found."""
    parts = []
    for a, b, c, gap, relation in rows:
        value = a * at[0] + b * at[1] + c * at[2]
        shift = {"<": abs(gap) + 1, "<=": abs(gap), "=": 0, ">=": -abs(gap), ">": -abs(gap) - 1}[relation]
        parts.append(read(f"{a}*x + {b}*y + {c}*z {relation} {value + shift}"))
    conditions = conj(over_one_ring(*parts))
    found = point(conditions)
    if conditions.free:
        assert found is not None and holds_at(conditions, {**dict.fromkeys("xyz", Fraction(0)), **found})
