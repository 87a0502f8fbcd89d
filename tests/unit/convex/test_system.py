"""Reading a convex system: which formulas are one, and what is read."""

from __future__ import annotations

from fractions import Fraction

import pytest

from qe.convex.feasible import feasible
from qe.convex.optimum import decide
from qe.convex.system import ConvexSystem, NotConvex, is_convex, read_system
from qe.exact.ring import Ring
from qe.formula.syntax import FALSE, TRUE, Atom, Relation
from qe.io.text import read
from qe.options import Budget
from qe.proof.multipliers import FormRelation
from tests.tables import each


def system(text: str) -> ConvexSystem:
    return read_system(read(text))


def test_every_relation_is_read_as_at_most_less_or_equal() -> None:
    found = system("x <= 1 and x < 2 and x >= -1 and x > -2 and x + y = 0")
    le, lt, eq = FormRelation.LE, FormRelation.LT, FormRelation.EQ
    assert found.names == ("x", "y") and found.relations == (le, lt, le, lt, eq)
    at = [form.value((Fraction(3), Fraction(5))) for form in found.forms]
    assert at == [2, 1, -4, -5, 8]
    assert not found.is_weak and system("x <= 1 and x^2 <= 2").is_weak
    assert not any(found.objective.gradient) and found.objective.constant == 0


def test_only_variables_that_occur_are_read() -> None:
    ring = Ring.of("abc")
    atom = Atom(ring.var("b") ** 2 - 2, Relation.LT)
    assert read_system(atom).names == ("b",)
    objective = Ring.of("zc").var("z")
    assert read_system(atom, objective, scale=3).objective.gradient == (3, 0)


def test_constants() -> None:
    assert read_system(TRUE).forms == ()
    impossible = read_system(FALSE, Ring.of("x").var("x"))
    assert impossible.forms[0].constant == 1 and impossible.relations == (FormRelation.LE,)
    assert decide(FALSE, budget=Budget()).values is None and decide(TRUE, budget=Budget()).values == {}


@each(
    ("x > 0 and x^3 < 1", "constraint 2 has degree above 2"),
    ("x^2 = 1", "constraint 1 is a nonlinear equation"),
    ("x^2 >= 1", "constraint 1 does not describe a convex set"),
    ("x < 1 and x*y <= 1", "constraint 2 does not describe a convex set"),
    ("x /= 1", "constraint 1 is a disequation"),
    ("x > 1 or x < 0", "not a conjunction"),
)
def test_what_is_not_convex(text: str, reason: str) -> None:
    with pytest.raises(NotConvex, match=reason):
        system(text)


def test_objectives_that_are_not_convex() -> None:
    x = Ring.of("x").var("x")
    for objective, scale in ((x**2, -1), (-(x**2), 1), (x**3, 1)):
        with pytest.raises(NotConvex, match="objective"):
            read_system(TRUE, objective, scale=scale)
    assert read_system(TRUE, -(x**2), scale=-1).objective.hessian == ((2,),)


def test_convexity_of_a_condition() -> None:
    flat, bowl, saddle = ((0, 0), (0, 0)), ((1, 1), (1, 1)), ((1, 2), (2, 1))
    assert is_convex(flat, FormRelation.EQ) and not is_convex(bowl, FormRelation.EQ)
    for relation in (FormRelation.LE, FormRelation.LT):
        assert is_convex(flat, relation) and is_convex(bowl, relation) and not is_convex(saddle, relation)


@each(
    ("x^2 + y^2 <= 1 and x + y >= 1", True),
    ("x^2 + y^2 <= 1 and x + y >= 3/2", False),
    ("x^2 + y^2 <= 1 and x = 1", True),
    ("x^2 + y^2 < 1 and x = 1", False),
    ("x^2 + y^2 <= 2 and x + y >= 2", True),
    ("x^2 + y^2 < 2 and x + y >= 2", False),
    ("x < 1 and x > 1 - 10^-30 and y = 0", True),
)
def test_feasible(text: str, true: bool) -> None:
    formula = read(text.replace("10^-30", "1/10^30"))
    found = read_system(formula)
    assert feasible(found.forms, found.relations, budget=Budget()) is true
    assert (decide(formula, budget=Budget()).values is not None) is true
