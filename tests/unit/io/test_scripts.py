"""Scripts of other systems: what they ask, and what is refused in them."""

from __future__ import annotations

import pytest

import qe
from qe.io import formats
from qe.io.scripts import last_command
from tests.tables import each


@each(
    ("Clear[x, y];\neq = x^2 + y^2;\nReduce[{eq < 1, 0 < x}, {x, y}, Reals]", "x^2 + y^2 < 1 and 0 < x"),
    ("x = Real('x'); y = Real('y')\nsolve(x**2 > 3, x + y < 5)", "x^2 > 3 and x + y < 5"),
    (
        "#!python\nfrom z3 import *  # all\nx, y = Reals('x y')\ns = Solver()\ns.add(x > y,\n      y > 0)\n"
        "s.add(x*y == 2)\nprint s.check()\nprint(s.model())",
        "x > y and y > 0 and x*y = 2",
    ),
    ("u = Real('x')\nsolve(u > 1)", "x > 1"),
    ("x = symbols('x', real=True)\nfs = [(x > 1), (x < 3)]\nprint(reduce_inequalities((fs), x))", "1 < x < 3"),
    ("x = symbols('x', positive=True)\nsolve(x**2 - a, x)", "x > 0 and x^2 = a"),
    ("fs := {x + y < 1, x > y}\ns := SolveTools:-SemiAlgebraic(fs, [x, y]);", "x + y < 1 and x > y"),
    ("load_package redlog; rlset ofsf; phi := ex(x, a*x^2 + 1 = 0); rlqe phi;", "a < 0"),
    ("[ a comment ]\n(x,y)\n1\n(Ey)[ x = y^2 ].\nfinish", "x >= 0"),
    (">>> var('w',real=1)\nw\n>>> solve(abs(w) +\n... 6>12)\nOr(w < -6, w > 6)", "w^2 > 36"),
    ("a = 1 + b; Reduce[2 a > 0]", "2*(1 + b) > 0"),
    (
        "f[x_, a_] := x^2 - a; g[x_] = 3 f[x, 2]\nb = f[y, x]\nReduce[g[x + 1] < Sqrt[4] f[x, 1] && b > 0]",
        "3*((x+1)^2 - 2) < 2*(x^2 - 1) and y^2 > x",
    ),
    (
        "var('x')\nvar('a')\nqf = qepcad_formula\nf = ((Rational(1/2)*x) < a)\ng = qf.and_(f, x > 1)\nh = qepcad("
        "qf.exists(x, g), memcells='1000')\nprint(h)",
        "a > 1/2",
    ),
    ("In [1]: x = symbols('x', real=True)\nIn [2]: sympy.solvers.solve(abs(1/(x-1)) > 1)", "0 < x < 2 and x /= 1"),
    ("s, t = var('s, t')\nassume(s > 0, t > s)\nprint(bool(t > 0))", "all s, t. s > 0 and t > s -> t > 0"),
    ("solve((3*x + 1)/(x + 4) >= 1, x, assume=Q.real(x), relational=False)", "x < -4 or 2*x >= 3"),
    ("restart;\nRealDomain:-simplify(forall([a, b], a > b implies a > 0));", "false"),
    ("restart; # no logic\nA:-B:-QuantifierElimination(&A [b, a], (a > b) &implies ((a > 0) &or (b < 0)));", "true"),
)
def test_what_is_read(typed: str, meant: str) -> None:
    assert qe.equivalent(formats.read(typed), meant)


@each(
    ("x = Int('x')\nsolve(x > 2)", "x: all variables are real, Int cannot be asked for"),
    ("x = symbols('x', integer=True)\nsolve(x > 2)", "integer=True cannot be asked for"),
    ("x, y = Reals('x')\nsolve(x > 2)", "a name for each variable"),
    ("f := x^2; g := x; solve(f > 1)", "and a use of g"),
    ("f[x_, y_] := x^2\nReduce[f[2] > y]", "a value for each of x, y"),
    ("x = var('x')\nassume(x > 0)\nbool(x > 1)\nbool(x > 2)", "one question at the end"),
    ("x = Real('x')\nfor k in range(3):\n    solve(x > k)", "one question at the end"),
    ("from z3 import *\ns.add(x > 1)\nsolve(x < 0)", "one question at the end"),
    ("from z3 import *", "one question at the end"),
)
def test_what_is_refused(typed: str, said: str) -> None:
    with pytest.raises(qe.InputError) as refused:
        formats.read(typed)
    assert said in str(refused.value) and "\n" not in str(refused.value)


@each("x = 1; y = 2", "x == 1", "ex x. x > y", "Reduce[x > 1]", "f := x^2" + " + x" * 2000)
def test_what_is_no_script_stays_as_it_is(typed: str) -> None:
    assert last_command(typed) == typed


def test_the_answer_of_a_script_with_assumptions() -> None:
    """It is right where they hold and does not repeat them."""
    assert str(qe.eliminate("Assuming[m > 0, ex x. 0 < x < m and x*y = 1]").formula) == "m*y > 1"
    assert qe.solve("x = symbols('x', positive=True)\nsolve(x**2 - 4, x)").lines == ("x = 2",)


@each(
    "y = symbols('y', positive=True)\nprove(ForAll(y, y > 0))",
    "y = symbols('y', positive=True)\nForAll(y, y > 0)",
    "Assuming[y > 0, Resolve[ForAll[y, y > x], Reals]]",
    "Simplify[Exists[y, y < 0], y > 0]",
    "let y be positive. prove that ex y. y < 0",
    "let y be positive. prove that there are exactly two y such that y^2 = 4",
    "find x such that x = -a for some a where a is positive",
)
def test_a_condition_on_a_variable_that_a_quantifier_binds_again_is_refused(typed: str) -> None:
    """Read beside the quantifier it says nothing: of two numbers whose square is 4 only one is positive."""
    with pytest.raises(qe.InputError, match=r"(y|a)\b.* bound"):
        qe.eliminate(typed)


def test_a_quantifier_as_a_function_binds_its_first_name_alone() -> None:
    assert qe.decide("x = symbols('x', positive=True)\nprove(ForAll(y, x + y**2 > 0))")
    assert not qe.decide("prove(ForAll(y, x + y**2 > 0))")
    assert qe.decide("prove(ForAll([y, x], x**2 + y**2 >= 0))")
