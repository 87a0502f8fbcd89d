"""What people type who know other systems: each of these gets the answer that was meant, or one line that helps."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest
import sympy

import qe
from tests.tables import each

X, Y = sympy.symbols("x y")
QE = Path(sys.executable).with_name("qe")


@each(
    ("x == 1", "x = 1"),
    ("x**2 = 4", "x^2 = 4"),
    ("x² < 2 && y > 0", "x^2 < 2 and y > 0"),
    ("x > 0 & y > 0 | y < 1", "x > 0 and y > 0 or y < 1"),
    ("x > 0 || y > 0", "x > 0 or y > 0"),
    ("|x| < 1 | y > 0", "-1 < x < 1 or y > 0"),
    ("||x| - 1| < 2", "-3 < x < 3"),
    ("!(x > 0) && x != -1", "x <= 0 and x /= -1"),
    (".5*x > .25", "x > 1/2"),
    ("2x + 3(y - 1) > 5.", "2*x + 3*y > 8"),
    ("x in [0,1) && y in {1, 2}", "0 <= x and x < 1 and (y = 1 or y = 2)"),
    ("x > 0 AND NOT y > 0 OR FALSE", "x > 0 and y <= 0"),
    ("forall x: x^2 >= y", "y <= 0"),
    ("∃x: x² = y", "y >= 0"),
    ("exists x (x > 0 and x < y) and y < 3", "0 < y < 3"),
    ("∀x∈[0,1]: x*y <= 1", "y <= 1"),
    ("∃x∀y: x + y² > z", "true"),
    ("ForAll[{x}, x > 0, x y > 0]".replace("x y", "x*y"), "y > 0"),
    ("Exists[x, x^2 == y && Element[x, Reals]]", "y >= 0"),
    ("Implies[x > 0, Sqrt[x] < 2]", "x < 4"),
    ("And(x > 0, Or(y > 0, Not(x > 1)))", "x > 0 and (y > 0 or x <= 1)"),
    ("ex(x, a*x^2 + 1 = 0)", "a < 0"),
    (r"\exists x\colon x^2 = y", "y >= 0"),
    ("x implies y > 0".replace("x implies", "x > 0 implies"), "x <= 0 or y > 0"),
    ("x <> 1", "x /= 1"),
    ("1/x > 0", "x > 0"),
    ("x^(1/2) > 1", "x > 1"),
    ("√x > 1", "x > 1"),
    ("0.1 + 0.2 = x", "10*x = 3"),
    ("-oo < x < oo", "true"),
    ("i*k = 1", "k /= 0 and i = 1/k"),
    ("(E x)(A y)[x + y^2 >= b /\\ x < 1].", "b < 1"),
    ("(Ex)(x^2 = y) and x > 0", "y >= 0 and x > 0"),
    ("(∃x)(∀y)(x + y² > z)", "true"),
    ("all({x,y}, x**2 + y**2 >= a);", "a <= 0"),
    ("exists x in R. x^2 = a", "a >= 0"),
    ("∃ x ∈ ℝ, x² = a", "a >= 0"),
    ("∀ x > 0. x*a > 0", "a > 0"),
    ("forall x > 0, x*a > 0", "a > 0"),
    ("exists x >= .5: x = y", "2*y >= 1"),
    ("exists x >= 2. x = y", "y >= 2"),
    ("∀x∈[0,1], x*y <= 1", "y <= 1"),
    ("∀x∈[0,1] ∪ {3}: x*y <= 1", "3*y <= 1"),
    ("forall x, y, x + y > z", "false"),
    ("forall x, exists y, x + y = z", "true"),
    ("forall x, sqrt(x) >= y or x < 0", "y <= 0"),
    ("forall x, y (x^2 + y^2 >= z)", "z <= 0"),
    ("exists x such that x^2 = a", "a >= 0"),
    ("exists x s.t. x^2 = a", "a >= 0"),
    ("for all x: x^2 >= a", "a <= 0"),
    ("there exists x. x^2 = a", "a >= 0"),
    ("∀ε>0 ∃δ>0 ∀x (|x-a|<δ → |x²-a²|<ε)", "true"),
    ("∀ε>0 ∃δ>0 ∀x (|x|<δ → |x + b|<ε)", "b = 0"),
    ("x^2 < y => x < 3", "not x^2 < y or x < 3"),
    ("x not in [0,1]", "x < 0 or x > 1"),
    ("x ∉ (0,1]", "x <= 0 or x > 1"),
    ("x in [0,1] ∪ [2,3)", "0 <= x <= 1 or 2 <= x < 3"),
    ("[x >= 0, y >= 0]", "x >= 0 and y >= 0"),
    ("x =/= 1 and y =< 2", "x /= 1 and y <= 2"),
    (r"\[ x^2 \geq 1 \]", "x^2 >= 1"),
    ("x_{1}^{2} > 0", "x1 /= 0"),
    (r"x \notin [0, 1] \cup [2, 3]", "x < 0 or 1 < x < 2 or x > 3"),
    ("ABS(x) < MAX(1, y)", "abs(x) < max(1, y)"),
    ("∛x > 2", "x > 8"),
    ("x < inf", "true"),
    ("x > 0.", "x > 0"),
    ("x ≠ ½ and ⅓x < ¾", "2*x /= 1 and 4*x < 9"),
    ("¬(x<1 ∨ y≥2) ∧ ⊤", "x >= 1 and y < 2"),
    ("x > 0 ⟹ y > 0", "x <= 0 or y > 0"),
    ("x ∈ {1, 2, 3} ∖ {2}", "x = 1 or x = 3"),
    ("x ∈ [0,2] ∩ [1,3] ∪ {5}", "1 <= x <= 2 or x = 5"),
    ("exists x > 0, y > 0: x*y = a and x + y = b", "a > 0 and b > 0 and b^2 >= 4*a"),
    ("∃ x, y > 0: x*y = a ∧ x + y = b", "a > 0 and b > 0 and b^2 >= 4*a"),
    ("∀ x ∈ [0,1], y ∈ [0,1]: x + y ≤ a", "a >= 2"),
    ("there is x with x^2 = a", "a >= 0"),
    ("∄x: x² = a", "a < 0"),
    ("Inequality[0, Less, x, LessEqual, 1]", "0 < x <= 1"),
    ("Power[x, 2] < Times[2, y, z] + Plus[x, Rational[1, 2]]", "2*x^2 < 4*y*z + 2*x + 1"),
    ("all x. |x| >= 0", "true"),
    ("ex x. |x| < 0", "false"),
    ("|x - 1| < 2", "-1 < x < 3"),
    ("x > 0 | y > 0", "x > 0 or y > 0"),
    ("||x| - 1| > 0", "x /= 1 and x /= -1"),
    ("Element[a | b, Reals] && a > 0", "a > 0"),
    ("Element[{x, y}, {1, 2}]", "(x = 1 or x = 2) and (y = 1 or y = 2)"),
    ("Element[|x| | y, [0, 1]]", "|x| <= 1 and 0 <= y <= 1"),
    ("Element[x, Reals] | y > 0 && x/x = 1", "true"),
)
def test_the_answer_that_was_meant(typed: str, meant: str) -> None:
    assert qe.equivalent(typed, meant)


def test_a_list_holds_together() -> None:
    assert qe.equivalent(sympy.real_root(sympy.Symbol("x", real=True), 3) <= -1, "x <= -1")
    assert qe.equivalent([X > 0, sympy.Eq(X + Y, 1)], "x > 0 and x + y = 1")
    assert qe.equivalent(("x > 0", X < Y), "0 < x and x < y")
    assert qe.find_instance(["x > 2", "x < 3", ["x^2 = 5"]]) is not None
    assert str(qe.solve([X + Y > 0, Y < 1], X)) == "y < 1 and -y < x"
    assert qe.region(["x > 0", "x < 1"]).volume(0.5)
    for wrong in ([], [[]], ["x > 0", 3], [None]):
        with pytest.raises(qe.InputError):
            qe.eliminate(wrong)


@each(
    (lambda: qe.eliminate("x = pi"), "coefficients are rational"),
    (lambda: qe.eliminate("sin(x) = 0"), "c^2 + s^2 = 1"),
    (lambda: qe.eliminate("exp(x) > 1"), "new variable"),
    (lambda: qe.eliminate("2^x > 1"), "rational number"),
    (lambda: qe.eliminate("x => 1"), ">="),
    (lambda: qe.eliminate("1/2x > 1"), "1/(2*x)"),
    (lambda: qe.eliminate("a x > 1"), "a*x"),
    (lambda: qe.eliminate("x(y + 1) > 1"), "x*(…)"),
    (lambda: qe.eliminate("2|x| > 1"), "2*|x|"),
    (lambda: qe.eliminate("x = y = "), "too early"),
    (lambda: qe.eliminate("2½ < x"), "one fraction: 5/2"),
    (lambda: qe.eliminate("xⁿ > 0"), "an exponent is a rational number"),
    (lambda: qe.eliminate("x ∈ ]0,1["), "(0, 1)"),
    (lambda: qe.eliminate("x^2 + a > 0 for all x"), "stands in front"),
    (lambda: qe.eliminate("Inequality[0, Less, x, 1]"), "Inequality[0, Less, x, LessEqual, 1]"),
    (lambda: qe.eliminate("UnitStep[x] = 1"), "unknown function UnitStep"),
    (lambda: qe.eliminate("x^2^3 = 1"), "brackets"),
    (lambda: qe.eliminate("Resolve[Exists[x, x^2 == y], Reals]"), "Resolve is a command"),
    (lambda: qe.eliminate("y = Piecewise((x, x > 0), (-x, True))"), "if c then a else b"),
    (lambda: qe.eliminate("exists n in Z. n = x"), "all variables are real"),
    (lambda: qe.eliminate(r"\exists n \in \mathbb{Z} : n = x"), "all variables are real"),
    (lambda: qe.eliminate("x > 0; y > 0"), "joined by and"),
    (lambda: qe.eliminate("x > 0, y > 0"), "joined by and"),
    (lambda: qe.eliminate("∃!x. x^2 = a"), "there is no ∃!"),
    (lambda: qe.eliminate("if x > 0 then x > -1"), "p -> q"),
    (lambda: qe.eliminate("0x10 < x"), "decimal"),
    (lambda: qe.eliminate("x = NaN"), "no number"),
    (lambda: qe.eliminate("Pi*x > 1"), "no number"),
    (lambda: qe.eliminate("x > 0 xor y > 0"), "Xor(p, q)"),
    (lambda: qe.eliminate("let y = x^2 in y > 1"), "definitions are not read"),
    (lambda: qe.eliminate("x > 0 // why"), "a comment starts with #"),
    (lambda: qe.eliminate("x.y > 1"), "`a.b`"),
    (lambda: qe.eliminate("x[1] > 0"), "`x[1]`"),
    (lambda: qe.eliminate("(x + 1)(x - 1) > 0"), "(…)*(…)"),
    (lambda: qe.eliminate("'x > 0'"), "without quotes"),
    (lambda: qe.eliminate("f(x\n, y) = 1"), "unknown function f"),
    (lambda: qe.eliminate("floor(x) = 1"), "integers"),
    (lambda: qe.eliminate("x mod 2 = 1"), "an operator is missing"),
    (lambda: qe.eliminate("ex x x > 1"), "'.'"),
    (lambda: qe.eliminate(""), "empty"),
    (lambda: qe.eliminate("x + 1"), "a relation"),
    (lambda: qe.eliminate(X**2 == Y), "Eq"),
    (lambda: qe.eliminate(X + 1), "Boolean combination"),
    (lambda: qe.eliminate(sympy.sin(X) > 0), "not algebraic"),
    (lambda: qe.eliminate(sympy.Symbol("n", integer=True) > 0), "integer"),
    (lambda: qe.eliminate(3), "Boolean combination"),
    (lambda: qe.eliminate(None), "a formula"),
    (lambda: qe.eliminate("x > 0", format="maple"), "unknown format"),
    (lambda: qe.eliminate("x > 0", order="z"), "variables of the formula"),
    (lambda: qe.decide("x > 0"), "a sentence expected; free: x"),
    (lambda: qe.minimize("x^2 > 0", "true"), "a term expected"),
    (lambda: qe.solve("x < 1", "x x"), "variables: each name once"),
    (lambda: qe.eliminate("x < y", order="x x"), "order: each name once"),
    (lambda: qe.find_instance("x < 1", workers=-1), "workers: a natural number"),
    (lambda: qe.decide("ex x. x > 1", race="fastest"), "race: "),
    (lambda: qe.equivalent("x > 1", "x > 1", cluster="here"), "cluster: "),
    (lambda: qe.region("x > 0").contains({"y": 1}), "x"),
    (lambda: qe.variables("x") ** 2 == Fraction(1), "x.equals"),
    (lambda: qe.verify("abc"), "a Certificate expected"),
    (lambda: qe.eliminate("x > 0", timeout="10"), "timeout"),
    (lambda: qe.eliminate("x > 0", timeout=math.nan), "timeout"),
    (lambda: qe.decide("true", timeout=-1), "timeout"),
    (lambda: qe.decide("true", memory=math.inf), "memory"),
    (lambda: qe.region("x > 0", timeout=math.inf), "timeout"),
    (lambda: qe.region("x > 0").contains({"x": math.inf}), "exact number"),
    (lambda: qe.region("x > 0").contains(5), ""),
    (lambda: qe.eliminate("x^2 + y^2 < 1", order=(X, 5)), "order"),
    (lambda: qe.Certificate.from_json(5), ""),
    (lambda: qe.parametric_witnesses("true"), ""),
    (lambda: qe.RealAlgebraic.from_root([-2.5, 1], 0, 5), ""),
)
def test_one_line_that_helps(misuse: Callable[[], object], hint: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        misuse()
    assert any(part in str(caught.value) for part in hint.split("|")), str(caught.value)
    assert "\n" not in str(caught.value)


@each(
    (("--version",), 0, "qe 0"),
    ((), 0, "Usage"),
    (("eliminate", "x > 0", "--timeot", "3"), 2, "did you mean --timeout"),
    (("eliminate", "--ordr=x", "x > 0"), 2, "did you mean --order"),
    (("eliminat", "x > 0"), 2, "eliminate"),
    (("eliminate", "1/x > 0 and y = 1", "--total-division"), 0, "x >= 0"),
    (("decide", "all x. |x| >= 0"), 0, "true"),
    (("decide", "x > 0"), 2, "a sentence expected"),
)
def test_the_command(arguments: tuple[str, ...], code: int, part: str) -> None:
    run = subprocess.run([QE, *arguments], capture_output=True, text=True, timeout=120)
    assert run.returncode == code and part in run.stdout + run.stderr, (run.stdout, run.stderr)
    assert "Traceback" not in run.stderr
