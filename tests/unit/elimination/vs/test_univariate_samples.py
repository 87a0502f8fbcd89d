"""Solutions on a line over fixed values of the other variables."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.elimination.vs.univariate_samples import solution
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.formula.evaluate import holds_at
from qe.io.text import read
from tests.tables import each

ROOT2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    ("x > a and x < a + 3", {"a": Fraction(-1)}, 0),
    ("x^2 = 2 and x < 0", {}, -ROOT2),
    ("x = a", {"a": ROOT2}, ROOT2),
    ("x^2 = a and x > 0 and a > 0", {"a": Fraction(4)}, 2),
    ("x^2 = a and x > 0 and a < 0", {"a": Fraction(4)}, None),
    ("x^2 < 0", {}, None),
    ("a*x > 1 and a*x < 1", {"a": ROOT2}, None),
    ("a*x^2 >= 0 and x > 0 and a^2 = 2", {"a": ROOT2}, 1),
    ("a*x^2 >= 0 and a^2 /= 2", {"a": ROOT2}, None),
    ("x > a and x < b", {"a": ROOT2, "b": ROOT2 + Fraction(1, 10**12)}, "between"),
    ("x = 5", {"x": Fraction(7)}, 5),
)
def test_solutions(text: str, values: dict[str, Fraction | RealAlgebraic], found: object) -> None:
    value = solution(read(text), "x", values)
    if found == "between":
        assert isinstance(value, Fraction) and ROOT2 < value < values["b"]
    else:
        assert value == found


def test_simple_numbers_come_first() -> None:
    assert solution(read("x > 1/3 and x < 7/2 or x > 100"), "x", {}) in (1, 2, 3)


def test_root_atoms_are_refused() -> None:
    with pytest.raises(Unable):
        solution(read("x < root(1, x^2 - a)"), "x", {"a": Fraction(1)})


NUMBERS = st.fractions(-3, 3, max_denominator=4)


@given(
    st.lists(st.tuples(st.integers(-2, 2), st.integers(-3, 3), NUMBERS, st.sampled_from("<>")), min_size=1, max_size=3),
    NUMBERS,
)
def test_a_solution_solves_and_none_means_none(parts, a):
    text = " and ".join(f"{p}*x^2 + {q}*x*a - ({c}) {r} 0" for p, q, c, r in parts)
    formula = read(text)
    value = solution(formula, "x", {"a": a})
    if value is None:
        assert not any(holds_at(formula, {"a": a, "x": Fraction(k, 3)}) for k in range(-12, 13))
    else:
        assert isinstance(value, Fraction) and holds_at(formula, {"a": a, "x": value})
