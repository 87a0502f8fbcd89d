"""SymPy trees as surface trees."""

from fractions import Fraction
from typing import Any

import pytest
import sympy
from sympy import And, Contains, Eq, Ge, Implies, Interval, Ne, Not, Or, S, Xor

from qe.errors import InputError
from qe.formula.evaluate import holds_at
from qe.io import surface as s
from qe.io.lowering import lower
from qe.io.sympy_reader import boolean, member, real, shown, signs, symbol_name
from tests.tables import each

X, Y = sympy.symbols("x y", real=True)


def holds(expression: Any, x: Fraction, y: Fraction = Fraction(0)) -> bool:
    formula = lower(boolean(expression), lambda message, at: InputError(message))
    names = formula.ring.names if formula.ring else ()
    return holds_at(formula, {**dict.fromkeys(names, Fraction(0)), "x": x, "y": y})


@each(
    (And(X > 0, X < 2), lambda x: 0 < x < 2),
    (Or(X < 0, Eq(X, 1)), lambda x: x < 0 or x == 1),
    (Not(And(X > 0, X < 2)), lambda x: not 0 < x < 2),
    (Implies(X > 0, X > 1), lambda x: x <= 0 or x > 1),
    (sympy.Equivalent(X > 0, X < 2), lambda x: (x > 0) == (x < 2)),
    (Xor(X > 0, X > 1, X > 2), lambda x: ((x > 0) + (x > 1) + (x > 2)) % 2 == 1),
    (sympy.ITE(X > 0, X > 1, X < -1), lambda x: x > 1 if x > 0 else x < -1),
    (Ne(X, 1), lambda x: x != 1),
    (Ge(1 / X, 1), lambda x: x != 0 and 1 / x >= 1),
    (sympy.Abs(X) + sympy.sign(X) > 1, lambda x: abs(x) + ((x > 0) - (x < 0)) > 1),
    (sympy.Max(X, 1) - sympy.Min(X, 1) >= 1, lambda x: max(x, 1) - min(x, 1) >= 1),
    (sympy.Piecewise((X, X > 1), (2, X < 0), (0, True)) > 0, lambda x: (x if x > 1 else 2 if x < 0 else 0) > 0),
    (sympy.Piecewise((X, X > 0)) < 5, lambda x: 0 < x < 5),
    (Contains(X, Interval(0, 1), evaluate=False), lambda x: 0 <= x <= 1),
    (Contains(X, Interval.open(0, 1), evaluate=False), lambda x: 0 < x < 1),
    (Contains(X, Interval(1, sympy.oo), evaluate=False), lambda x: x >= 1),
    (Contains(X, sympy.FiniteSet(0, 2), evaluate=False), lambda x: x in (0, 2)),
    (Contains(X, Interval(-1, 2) - sympy.FiniteSet(0), evaluate=False), lambda x: -1 <= x <= 2 and x != 0),
    (sympy.true, lambda x: True),
    (X**0.5 < 1, lambda x: 0 <= x < 1),
    (X**2.5 > 1, lambda x: x > 1),
    (X**-2.0 >= 1, lambda x: x != 0 and x * x <= 1),
    (sympy.re(sympy.Symbol("x")) + sympy.conjugate(sympy.Symbol("x")) > 1, lambda x: x + x > 1),
    (sympy.im(sympy.Symbol("x") + 1) < 1, lambda x: True),
    (sympy.Heaviside(X) * 2 >= 1, lambda x: x >= 0),
    (sympy.Heaviside(X, 0) > 0, lambda x: x > 0),
    (sympy.Q.nonnegative(X) & ~sympy.Q.zero(X), lambda x: x > 0),
    (sympy.Derivative(X**3 - X, X) > 0, lambda x: 3 * x * x > 1),
    (sympy.Integral(X, (X, 0, 1)) < X, lambda x: x > Fraction(1, 2)),
    (sympy.Integral(Y, (Y, 0, X)) < X, lambda x: 0 < x < 2),
    (sympy.Poly(X**2 - X, X), lambda x: x in (0, 1)),
    (sympy.Sum(X * Y**0 * sympy.Symbol("n"), (sympy.Symbol("n"), 0, 3)) > 1, lambda x: 6 * x > 1),
    (sympy.Determinant(sympy.Matrix([[X, 1], [1, X]])) > 0, lambda x: x * x > 1),
    (Eq(sympy.Matrix([X, X**2]), sympy.Matrix([-1, 1])), lambda x: x == -1),
    (Contains((X, X), Interval(0, 1) * Interval(1, 2)), lambda x: x == 1),
    (sympy.UnevaluatedExpr(X) > 1, lambda x: x > 1),
)
def test_formulas(expression: Any, exact: Any) -> None:
    for x in map(Fraction, ("-2", "-1", "-1/2", "0", "1/2", "1", "3/2", "2", "3")):
        assert holds(expression, x) == exact(x), x


def test_sets() -> None:
    term = s.Name("x", -1)
    assert member(term, S.EmptySet) == s.Truth(False)
    condition = sympy.ConditionSet(Y, Y**2 > 1, S.Reals)
    formula = lower(member(term, condition), lambda message, at: InputError(message))
    assert str(formula) == "x^2 > 1"
    with pytest.raises(InputError, match="a set of real numbers"):
        member(term, S.Integers)


def test_terms() -> None:
    assert real(sympy.Rational(2, 3)) == s.Number(Fraction(2, 3))
    assert real(sympy.Float("0.1")) == s.Number(Fraction(1, 10))
    assert real(-sympy.oo) == s.Minus(s.Infinity(-1))
    assert isinstance(real(sympy.CRootOf(X**3 - X - 1, 0)), s.Algebraic)
    assert real(X ** sympy.Rational(1, 3)) == s.Power(s.Name("x", -1), s.Number(Fraction(1, 3)), -1)


@each(
    (2**sympy.pi, "not algebraic"),
    (sympy.sin(X), "put c and s"),
    (sympy.floor(X), "needs integers"),
    (2**X, "exponents are no rational numbers"),
    (sympy.Function("f")(X), "cannot be read"),
)
def test_what_is_no_term(expression: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        real(expression)
    with pytest.raises(InputError):
        boolean(X)


def test_symbols_and_their_assumptions() -> None:
    assert symbol_name(sympy.Symbol("a")) == "a"
    for made, relation in (
        ("positive", ">"),
        ("nonnegative", ">="),
        ("negative", "<"),
        ("nonzero", "/="),
        ("nonpositive", "<="),
        ("zero", "="),
    ):
        node = signs([sympy.Symbol("a", **{made: True})])["a"]
        assert isinstance(node, s.Comparison) and node.relations[0].value == relation
    assert list(signs([X, sympy.Symbol("p", positive=True)])) == ["p"]
    for bad in (
        sympy.Symbol("n", integer=True),
        sympy.Dummy("d"),
        sympy.Symbol("z", imaginary=True),
        sympy.Symbol("e", even=True, negative=True),
    ):
        with pytest.raises(InputError):
            symbol_name(bad)


def test_long_expressions_are_cut_in_messages() -> None:
    assert shown(X) == "x" and len(shown(sum(sympy.symbols("a0:40")))) == 58
