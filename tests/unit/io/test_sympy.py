"""The SymPy door."""

import subprocess
import sys
from collections.abc import Callable

import pytest
import sympy as sp
from sympy.abc import x, y

import qe
from qe.errors import InputError
from qe.formula.syntax import TRUE
from qe.io.sympy import Exists, ForAll, from_sympy, to_sympy
from qe.io.text import read
from tests.tables import each

HALF = sp.Rational(1, 2)


@each(
    (sp.And(x > HALF, sp.Ne(y, x)), "x > 1/2 and x /= y"),
    (sp.Eq(x**2, 2), "x^2 = 2"),
    (x < sp.Float(0.1), "x < 1/10"),
    (x + 0.25 * y < 0.1 + 0.2, "20*x + 5*y < 6"),
    (x < -sp.Float("1.5e-3"), "x < -3/2000"),
    (x > sp.Float("1e30"), "x > 1000000000000000000000000000000"),
    (x < sp.Float("0.1", 60), "x < 1/10"),
    (sp.Abs(x) <= 1, "-1 <= x <= 1"),
    (sp.Implies(x > 0, y > 0), "x <= 0 or y > 0"),
    (sp.Xor(x > 0, y > 0), "not ((x <= 0 or y > 0) and (y <= 0 or x > 0))"),
    (sp.Equivalent(x > 0, y > 0), "(x <= 0 or y > 0) and (y <= 0 or x > 0)"),
    (sp.ITE(x > 0, y > 0, y < 0), "(x <= 0 or y > 0) and (x > 0 or y < 0)"),
    (sp.Piecewise((x, x > 0), (y, True)) > 1, "x > 0 and x > 1 or x <= 0 and y > 1"),
    (sp.Symbol("x", real=True) > 0, "x > 0"),
    (Exists(x, sp.Eq(x**2, y)), "ex x. y = x^2"),
    (Exists([x, "y"], x > y), "ex x, y. x > y"),
    (ForAll(x, Exists(y, y > x)), "all x. ex y. x < y"),
    ((x > 0) & Exists(y, y > x), "x > 0 and ex y. x < y"),
    (Exists(y, y > x) & (x > 0), "(ex y. x < y) and x > 0"),
    ((x > 0) | ForAll(y, y > x), "x > 0 or all y. x < y"),
    (~Exists(y, y > x), "not ex y. x < y"),
    ((x > 0) >> Exists(y, y > x), "x <= 0 or ex y. x < y"),
    (Exists(y, read("y > x")), "ex y. y > x"),
    (sp.true, "true"),
    (sp.Symbol("x^*") > 0, "`x^*` > 0"),
)
def test_reading(given: object, printed: str) -> None:
    assert str(from_sympy(given)) == printed


@each(
    (lambda: x**y > 1, "exponents"),
    (lambda: sp.log(x) > 1, "log is not algebraic"),
    (lambda: sp.sin(x) > 0, "sin"),
    (lambda: sp.pi**sp.pi > x, "pi"),
    (lambda: sp.And(sp.Symbol("p"), x > 0), "p found"),
    (lambda: x, "Boolean combination"),
    (lambda: "x > 0", "text found"),
    (lambda: True, "Eq"),
    (lambda: x**2 == y, "Eq"),
    (lambda: Exists(x, x**2 == y), "Eq"),
    (lambda: sp.Dummy("x") > 0, "Dummy"),
    (lambda: 1.5, "1.5 found"),
    (lambda: x**99999999 > 0, "limit"),
    (lambda: sp.Symbol("n", integer=True) < 1, "integer"),
    (lambda: sp.Symbol("a|b") > 0, "name of a variable"),
    (lambda: Exists([], x > 0).formula(), "at least one"),
)
def test_what_is_not_polynomial_is_refused(make: Callable[[], object], part: str) -> None:
    with pytest.raises(InputError, match=part) as caught:
        from_sympy(make())
    assert "\n" not in str(caught.value)


def test_minimum_and_maximum() -> None:
    formula = from_sympy(sp.Max(x, y, 1) - sp.Min(x, y) > 2)
    from qe.formula.evaluate import holds_at

    for a in range(-3, 4):
        for b in range(-3, 4):
            assert holds_at(formula, {"x": a, "y": b}) is (max(a, b, 1) - min(a, b) > 2)


def test_writing_uses_the_symbols_given() -> None:
    real = sp.Symbol("x", real=True)
    written = to_sympy(read("x^2 > 2"), symbols={"x": real})
    assert written.free_symbols == {real}
    assert to_sympy(TRUE) is sp.true
    assert to_sympy(read("x^2 > 2 and not x < 0")).subs({sp.Symbol("x"): 2}) is sp.true


@each(
    ("x^2 < 2", "(x < sqrt(2)) & (x > -sqrt(2))"),
    ("a*x = 1", "Ne(a, 0) & Eq(x, 1/a)"),
    ("x^2 = a", "(a >= 0) & (Eq(x, sqrt(a)) | Eq(x, -sqrt(a)))"),
    ("x^5 - x - 1 = 0", "Eq(x, CRootOf(x**5 - x - 1, 0))"),
    ("x^2 < 0", "False"),
    ("x^2 >= 0", "True"),
)
def test_solutions_are_written_as_their_text_says_them(text: str, written: str) -> None:
    """They were written as formulas in which each sign at each root is a condition, or refused (x^2 = a)."""
    assert str(qe.solve(text, variables=["x"]).to_sympy()) == written


def test_the_real_cube_root() -> None:
    assert qe.solve("x^3 = a", variables=["x"]).to_sympy().subs("a", -8).subs("x", -2) == sp.true


def test_roots_with_parameters_are_refused() -> None:
    with pytest.raises(InputError, match="root of a polynomial with parameters"):
        qe.solve("x^3 + a*x + b = 0", variables=["x"]).to_sympy()


@each(
    ("x < root(1, x^2 - 2)", x < -sp.sqrt(2)),
    ("x < root(-1, x^2 - 2)", x < sp.sqrt(2)),
    ("x < root(3, x^2 - 2)", sp.false),
    ("1 < x and x <= root(2, x^2 - 3)", sp.And(x > 1, x <= sp.sqrt(3))),
    ("3*x + y + 5 <= 0", 3 * x + y + 5 <= 0),  # a long linear term, which is read at once
)
def test_root_atoms_without_parameters_are_numbers_and_sums_are_sums(text: str, written: object) -> None:
    assert to_sympy(read(text)) == written


@each("ex x. x > y", "x < root(1, x^2 - y)")
def test_what_sympy_cannot_say_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        to_sympy(read(text))


def test_questions_without_sympy_do_not_load_it_and_its_door_no_parser() -> None:
    code = (
        "import sys, qe; x, a = qe.variables('x a'); disc = qe.region('x^2 + y^2 <= 1'); f = qe.exists(x, x**2 < a)\n"
        "qe.eliminate(f); qe.eliminate(disc); qe.minimize(x**2, x > 1); qe.eliminate('ex x. x > a'); qe.witnesses(f)\n"
        "f & disc.formula; print('sympy' in sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False"]
    code = "import sys, qe.io.sympy; print('sympy' in sys.modules, 'qe.io.parser' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "False"]


def test_words_of_python_do_not_connect_formulas() -> None:
    """``Exists(…) and Exists(…)`` is its second operand in Python: half of the question would be lost."""
    a = sp.Symbol("a")
    left, right = Exists(x, x > a), Exists(x, x**2 < a)
    with pytest.raises(TypeError, match="&"):
        left and right
    with pytest.raises(TypeError, match="&"):
        not (left & right)
