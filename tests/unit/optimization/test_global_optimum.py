"""Global optima: finitely many candidates, their values, what callers get."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import qe
from qe.cli.app import main
from qe.convex.optimum import OptimumStatus
from qe.exact.number import point_text
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Relation
from qe.io.text import read
from qe.optimization.finite import listed
from qe.optimization.values import Goal, Objective, first_answer, new_name
from qe.options import Budget
from tests.tables import each

CASES = [
    ("x^4 - x^2", "x^2 <= 4", "-1/4", True),
    ("(1 - x)^2 + 100*(y - x^2)^2", "true", "0", True),
    ("x*y", "x^2 + y^2 <= 1", "-1/2", True),
    ("(x*y - 1)^2 + x^2", "true", "0", False),
    ("x^3", "x > 1", "1", False),
    ("x + y", "x^2 + y^2 = 1 or x*y >= 3 and x > 0", "-sqrt(2)", True),
    ("x", "ex y. y^2 = x^3 - x", "-1", True),
    ("7", "x^3 > 2", "7", True),
    ("x/(x^2 + 1)", "true", "-1/2", True),
    ("x/y", "x > 1 and y > 0 and y < 3", "1/3", False),
    ("max(x, 1 - x)", "x >= 0", "1/2", True),
    ("abs(x) + 2/x", "x > 0", "2*sqrt(2)", True),
    ("sqrt(x) + x", "x >= 1", "2", True),
    ("x*y*z", "x^2 + 2*y^2 + 3*z^2 <= 1", "-sqrt(2)/18", True),
]


@each(*CASES)
def test_known_minima(objective, constraints, value, attained):
    found = qe.minimize(objective, constraints)
    assert (str(found.value), found.attained, found.status) == (value, attained, OptimumStatus.OPTIMAL)
    if found.certificate is not None:
        assert qe.verify(found.certificate).accepted


@each(*CASES)
def test_a_maximum_is_minus_the_minimum_of_the_negative(objective, constraints, value, attained):
    found = qe.maximize(f"-({objective})", constraints)
    assert (str(found.value), found.attained) == (str(-qe.minimize(objective, constraints).value), attained)


@each(
    ("x^3", "true", OptimumStatus.UNBOUNDED),
    ("x*y", "x > 0", OptimumStatus.UNBOUNDED),
    ("x^3", "x^4 < 0", OptimumStatus.INFEASIBLE),
    ("x^4", "y^4 + 1 = 0", OptimumStatus.INFEASIBLE),
)
def test_no_minimum(objective, constraints, status):
    found = qe.minimize(objective, constraints)
    assert (found.status, found.value, found.attained) == (status, None, None)
    assert not found.is_optimal


def test_all_minimisers():
    found = qe.minimize("x^4 - x^2", "x^2 <= 4")
    points = [p["x"] for p in qe.region(found.minimisers).sample_points()]
    assert [str(p) for p in points] == ["-sqrt(2)/2", "sqrt(2)/2"]
    assert qe.equivalent(qe.minimize("x*y", "x^2 + y^2 <= 1").minimisers, "2*x*y = -1 and x = -y")
    assert str(qe.minimize("x^3", "x > 1").minimisers) == "false"
    assert str(qe.minimize("x^4 - 3*x", "x >= b").minimisers) == "x >= b and 4*x^3 = 3"


def test_the_points_of_a_term_that_is_no_polynomial():
    found = qe.minimize("abs(x) + 2/x", "x > 0")
    assert str(found.point["x"]) == "sqrt(2)"
    assert qe.equivalent(str(found.minimisers), "x^2 = 2 and x > 0")
    assert qe.equivalent(str(qe.maximize("min(x, 1 - x, 1/4)").minimisers), "4*x >= 1 and 4*x <= 3")


def test_values_of_a_maximum_are_the_values():
    assert qe.equivalent(str(qe.maximize("x^3", "x^4 <= 1").values), "value^2 <= 1")


@each("x > 0", "x^4 < 2")
@each("sin(x)", "floor(x)", "1/0", "", "x +", "x = 1", "nan*x", b"x", ["x"], None, True, float("nan"))
def test_objectives_that_are_no_terms(given, constraints):
    with pytest.raises(qe.InputError, match=r"^objective: [^\n]*$"):
        qe.minimize(given, constraints)


def test_an_irrational_value_is_told_from_its_conjugates():
    """x^3 - 2 has one real root; x^2 - 2 two, of which the value is the smaller."""
    found = qe.minimize("x", "x^2 = 2 and x^3 < 100")
    assert str(found.value) == "-sqrt(2)"
    assert qe.equivalent(found.minimisers, "x^2 = 2 and x < 0")


@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(-4, 4), min_size=2, max_size=5), st.integers(-3, 2), st.integers(1, 3), st.booleans())
def test_no_value_on_a_grid_is_smaller_and_the_point_has_it(coefficients, low, width, strict):
    assume(any(coefficients[1:]))
    text = " + ".join(f"({c})*x^{k}" for k, c in enumerate(coefficients))
    sign = "<" if strict else "<="
    found = qe.minimize(f"({text})/3 + 0*y", f"{low} {sign} x and x {sign} {low + width} and x^4 >= -1")

    def f(x):
        return sum(c * x**k for k, c in enumerate(coefficients)) / Fraction(3)

    inside = [low + width * Fraction(k, 16) for k in range(1, 16)]
    ends = [] if strict else [Fraction(low), Fraction(low + width)]
    assert all(found.value <= f(x) for x in [*inside, *ends])
    if found.attained:
        assert qe.decide(f"ex x. {found.minimisers}".replace("ex x. ", "ex x, y. "))
        assert qe.find_instance(found.minimisers) is not None
        x = found.point["x"]
        assert low <= x <= low + width
        if isinstance(x, Fraction):
            assert f(x) == found.value
    else:
        assert strict


def test_a_limit_holds():
    with pytest.raises(qe.BudgetExceeded):
        qe.minimize("x^6*y + y^5*z - x*z^7 + x*y*z", "x^4*y + z^3 = x*y + 5 and y^7 > x*z^3 + 1", timeout=0.3)


def test_the_point_of_a_value_of_high_degree():
    """The six-hump camel function: stationary points of degree 14, the least value of degree 7."""
    found = qe.minimize("4*x^2 - 21/10*x^4 + x^6/3 + x*y - 4*y^2 + 4*y^4", timeout=60)
    assert float(found.value) == pytest.approx(-1.0316284534898774, abs=1e-12)
    assert abs(float(found.point["x"])) == pytest.approx(0.08984201310031806, abs=1e-9)
    assert abs(float(found.point["y"])) == pytest.approx(0.7126564030207396, abs=1e-9)


@each(
    ("x^2 = 1 and y^2 = 2 and x*y > 0", ["x = -1, y = -sqrt(2)", "x = 1, y = sqrt(2)"]),
    ("x^2 + y^2 <= 0", ["x = 0, y = 0"]),
    ("x^2 + y^2 <= 1", []),
    (
        "x*y = 0 and x^2 = x and y >= 0 and y <= 1 and y^2 = y*x^2 + y",
        ["x = 0, y = 0", "x = 0, y = 1", "x = 1, y = 0"],
    ),
    ("x = 0 and y >= 0", []),
    ("x = 0", []),
    ("x = y and ex z. z^2 + x^2 = 0", ["x = 0, y = 0"]),
    ("x = y and x^2 < 0", []),
)
def test_points_of_a_set(text: str, points: list[str]) -> None:
    assert list(map(point_text, listed(read(text), ("x", "y"), Budget()))) == points


def test_little_work_is_spent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("qe.optimization.finite.MOST_WORK", 1)
    assert listed(read("x^2 = 1 and y^2 = x"), ("x", "y"), Budget()) == ()
    monkeypatch.undo()
    monkeypatch.setattr("qe.optimization.finite.MOST_POINTS", 1)
    assert listed(read("x^2 = 1 and y^2 = x"), ("x", "y"), Budget()) == ()


@each(
    ("x^4 - x^2", "x^2 <= 4", "-1/4 at x = -sqrt(2)/2 or x = sqrt(2)/2"),
    ("x^4 + y^4 - 4*x*y", "true", "-2 at x = -1, y = -1 or x = 1, y = 1"),
    ("abs(x - 1) + abs(x + 1)", "true", "2 at x = 1, for example"),
    ("(x*y - 1)^2 + x^2", "true", "0, not attained"),
    ("x", "ex y. y^2 = x - 1", "1 at x = 1"),
)
def test_all_minimisers_are_shown(objective: str, where: str, shown: str) -> None:
    found: Any = qe.minimize(objective, where)
    assert repr(found) == f"GlobalOptimum({shown})"
    assert ("or" in found._repr_latex_()) is (len(found.points) > 1)


def test_at_numbers_for_the_parameters() -> None:
    found = qe.minimize("x^4 - a*x^2", parameters="a").at({"a": 2})
    assert repr(found) == "GlobalOptimum(-1 at x = -1 or x = 1)"


def test_the_command_prints_all_points(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["minimize", "x^4 - x^2", "x^2 <= 4"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(" (")[0] for line in lines[1:4]] == [
        "at x = -sqrt(2)/2",
        "at x = sqrt(2)/2",
        "attained nowhere else",
    ]


RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


def goal_of(poly: Poly, scale: Fraction | int, conditions: str, parameters: Iterable[str] = ()) -> Goal:
    read_conditions = read(conditions)
    return Goal.of(Objective.of(poly, scale, new_name(RING.names, read_conditions.free)), read_conditions, parameters)


def test_names_come_into_one_ring() -> None:
    goal = goal_of(X * Y, Fraction(1, 3), "x > a and z = 1", ["a"])
    assert goal.parameters == ("a",) and goal.value == "value" and set(goal.variables) == {"x", "y", "z"}
    assert goal.ring.names[:2] == ("a", "value")
    value, x, y = map(goal.ring.var, ("value", "x", "y"))
    assert goal.graph == atom(3 * value - x * y, Relation.EQ)


def test_a_taken_name_is_avoided() -> None:
    goal = goal_of(X, 1, "value > x and value_ < 1")
    assert goal.value == "value__" and "value" in goal.variables


@each(["b"], ["a", "a"], ["x", "q"])
def test_strange_parameters(parameters: list[str]) -> None:
    with pytest.raises(qe.InputError, match="parameters: "):
        qe.minimize("x", "x > a", parameters=parameters)


@each(
    (X, 1, "0 < x and x <= 3", "0 < value and value <= 3"),
    (X * X, -2, "-1 <= x and x < 2", "-8 < value and value <= 0"),
    (X + Y, Fraction(1, 2), "x^2 + y^2 <= 2", "-1 <= value and value <= 1"),
    (X, 1, "x > 0 and x < 0", "false"),
)
def test_the_values_that_are_taken(objective: Poly, scale: Fraction, conditions: str, values: str) -> None:
    goal = goal_of(objective, scale, conditions)
    found, answer = first_answer(goal.taken, Budget(60), check=False)
    assert qe.equivalent(found.formula, values) and answer.formula == found.formula


def test_with_parameters() -> None:
    found, _ = first_answer(goal_of(X, 1, "x^2 <= a", ["a"]).taken, Budget(60), check=False)
    assert qe.equivalent(found.formula, "value^2 <= a")
