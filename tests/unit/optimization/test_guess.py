"""Optima by a guess: classics with their sources, agreement with elimination, guesses that are wrong."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_objective
from qe.exact.algebraic import real_roots
from qe.exact.number import point_text, simplest
from qe.exact.radicals import radical_text
from qe.formula.evaluate import holds_at
from qe.io.text import read
from qe.optimization import global_optimum
from qe.optimization.guess import guess
from qe.optimization.values import Goal
from qe.options import Budget
from qe.rules import lift
from tests.tables import each

SHAPIRO = "a/(b + c) + b/(c + d) + c/(d + a) + d/(a + b)"
"""H. S. Shapiro, Advanced problem 4603, American Mathematical Monthly 61 (1954), with four numbers."""

CYCLIC = "a^3*b + b^3*c + c^3*a"
"""V. Cirtoaje, (a^2 + b^2 + c^2)^2 >= 3*(a^3*b + b^3*c + c^3*a), Gazeta Matematica B 97 (1992)."""

SHAPIRO_OF_FIVE = "a/(b + c) + b/(c + d) + c/(d + e) + d/(e + a) + e/(a + b)"

SHORTLIST_1990 = "a^3/(b + c + d) + b^3/(c + d + a) + c^3/(d + a + b) + d^3/(a + b + c)"
"""Problem 24 of the shortlist of the International Mathematical Olympiad 1990."""

IMO_2006_3 = "a*b*(a^2 - b^2) + b*c*(b^2 - c^2) + c*a*(c^2 - a^2)"

TANGENT = "a/(1 + b^2) + b/(1 + c^2) + c/(1 + a^2)"
TANGENT_OF_FOUR = "a/(1 + b^2) + b/(1 + c^2) + c/(1 + d^2) + d/(1 + a^2)"
"""P. K. Hung, Secrets in Inequalities 1 (2007), ch. 1: inequalities where 1 + b^2 >= 2*b is used below the line."""


@each(
    (qe.minimize, SHAPIRO, "a > 0 and b > 0 and c > 0 and d > 0", "2"),
    (qe.minimize, SHAPIRO_OF_FIVE, "a > 0 and b > 0 and c > 0 and d > 0 and e > 0", "5/2"),
    (qe.minimize, SHORTLIST_1990, "a > 0 and b > 0 and c > 0 and d > 0 and (a + c)*(b + d) = 1", "1/3"),
    (qe.maximize, CYCLIC, "a^2 + b^2 + c^2 = 1", "1/3"),
    (qe.maximize, CYCLIC, "a^2 + b^2 + c^2 = 1 and a >= 0 and b >= 0 and c >= 0", "1/3"),
    (qe.minimize, TANGENT, "a > 0 and b > 0 and c > 0 and a + b + c = 3", "3/2"),
    (qe.minimize, TANGENT_OF_FOUR, "a > 0 and b > 0 and c > 0 and d > 0 and a + b + c + d = 4", "2"),
)
def test_optima_of_the_literature(find: Any, objective: str, where: str, value: str) -> None:
    found = find(objective, where, check=True)
    assert (str(found.value), found.attained, found.guarantee) == (value, True, qe.Guarantee.CHECKED)
    assert [member.label for member in found.certificate.payload] == ["bound", "point"]
    assert qe.verify(found.certificate).accepted
    assert qe.equivalent(found.values, f"value {'<=' if find is qe.maximize else '>='} {value}")


def guessed(objective: str, where: str, sign: int) -> tuple[str, str]:
    found = guess(sign, Goal.of(read_objective(objective, ()), read(where)), Budget())
    return ("", "") if found is None else (str(found[0]), point_text(found[1]))


@each(
    (IMO_2006_3, "a^2 + b^2 + c^2 = 1", -1, "9*sqrt(2)/32", "b = -sqrt(3)/6"),
    ("x*y*z", "x^2 + 2*y^2 + 3*z^2 <= 1", 1, "-sqrt(2)/18", "y = sqrt(6)/6, z = 1/3"),
    ("x*y*z", "x + y + z = 1 and x >= 0 and y >= 0 and z >= 0", -1, "1/27", "x = 1/3, y = 1/3, z = 1/3"),
    (SHAPIRO, "a > 0 and b > 0 and c > 0 and d > 0", 1, "2", ""),
    ("x/y", "x > 1 and y > 0 and y < 3", 1, "", ""),
    ("x", "x > 1 or y > 2", 1, "", ""),
)
def test_guesses(objective: str, where: str, sign: int, value: str, point: str) -> None:
    """The first is problem 3 of the International Mathematical Olympiad 2006."""
    found = guessed(objective, where, sign)
    assert found[0] == value and point in found[1]


@settings(max_examples=5, deadline=None)
@given(st.lists(st.integers(-3, 3), min_size=5, max_size=5), st.booleans())
def test_a_guessed_optimum_is_the_one_by_elimination(c: list[int], least: bool) -> None:
    objective = f"({c[0]})*x^2*y + ({c[1]})*x*y + ({c[2]})*y^3 + ({c[3]})*x + ({c[4]})*y"
    find, where = qe.minimize if least else qe.maximize, "x^2 + y^2 <= 1 and x + y >= 0"
    with pytest.MonkeyPatch.context() as changed:
        known = find(objective, where, method="elimination", process=False)
        changed.setattr(global_optimum, "FIRST_WORK", 0)
        found = find(objective, where, method="elimination", process=False)
    assert (found.value, found.attained) == (known.value, known.attained)
    assert qe.equivalent(found.minimisers, known.minimisers)


@pytest.mark.parametrize("wrong", ["-1", "1", "2/3"])
def test_a_guess_that_is_wrong_is_not_believed(monkeypatch: pytest.MonkeyPatch, wrong: str) -> None:
    """Too small, so that no point has it; too large, so that points are below."""
    monkeypatch.setattr(global_optimum, "FIRST_WORK", 0)
    monkeypatch.setattr("qe.optimization.guess.guess", lambda *given: (Fraction(wrong), {}))
    found = qe.minimize("x^4 + y^4", "x + y >= 1", method="elimination", process=False)
    assert (str(found.value), found.attained) == ("1/8", True)
    assert found.values == qe.minimize("x^4 + y^4", "x + y >= 1", method="elimination").values


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.integers(-5, 5), min_size=2, max_size=5).filter(lambda c: any(c[1:])),
    st.integers(0, 4),
    st.fractions(-4, 4, max_denominator=9),
    st.sampled_from((1, -1)),
)
def test_beyond_an_algebraic_number(coefficients: list[int], k: int, at: Fraction, sign: int) -> None:
    goal = Goal.of(read_objective("x", ()), read("x > 0"))
    for root in real_roots(fmpz_poly(coefficients))[k : k + 1]:
        value = simplest(root)
        better = global_optimum._beyond(sign, goal, value, Budget())
        assert holds_at(better, {goal.value: at}) == (at < value if sign > 0 else at > value)


@each(
    ("x*y + y*z + z*w", "x^2 + y^2 + z^2 + w^2 = 1", "(-1 - sqrt(5))/4", 4),
    (CYCLIC, "a^2 + b^2 + c^2 = 1", "-sqrt(7)/8", 12),
)
def test_a_point_whose_coordinates_are_not_recognised(objective: str, where: str, value: str, degree: int) -> None:
    """It is one of the finitely many points that meet the theorem: "no point that has it", and none in 60 s."""
    found = qe.minimize(objective, where, timeout=60)
    assert radical_text(found.value) == value
    assert max(len(x.minimal_polynomial) for x in found.point.values() if not isinstance(x, Fraction)) > degree
    assert lift.holds_at(read(where), found.point)
