"""SymPy trees to surface trees."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from fractions import Fraction
from functools import reduce
from typing import Any

import sympy as sp

from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.names import check_name
from qe.io.terms import decimal
from qe.io.text_errors import way_out
from qe.spelling import NUMBERS

_RELATIONS = {**{relation.value: relation for relation in Relation}, "==": Relation.EQ, "!=": Relation.NE}
_ASSUMED = {
    "zero": Relation.EQ,
    "positive": Relation.GT,
    "negative": Relation.LT,
    "nonzero": Relation.NE,
    "nonnegative": Relation.GE,
    "nonpositive": Relation.LE,
}
"""What a symbol may be assumed to be besides real; the first that is true says all."""


def symbol_name(symbol: Any) -> str:
    """The name of a symbol. Raises ``InputError`` for one that no real variable can stand for."""
    if isinstance(symbol, sp.Dummy | sp.Wild):
        raise InputError(f"{symbol} is a {type(symbol).__name__}, which is no variable with a name; use a Symbol")
    assumed = symbol.assumptions0
    known = sp.Symbol("x", real=True, **{key: True for key in _ASSUMED if assumed.get(key)}).assumptions0
    refused = [key for key, value in assumed.items() if known.get(key) is not value]  # what no sign implies
    if refused:
        refused.sort(key=lambda key: (key not in ("integer", "rational"), not assumed[key], key))
        hint = "all variables are real here; only signs can be assumed of them"
        raise InputError(f"the symbol {symbol} is assumed to be more than real ({refused[0]}): {hint}")
    return check_name(symbol.name)


def shown(expression: object) -> str:
    """An expression in a message."""
    try:
        text = str(expression)
    except ValueError:  # SymPy prints numbers by str, which Python bounds
        return "an expression with a long number"
    return text if len(text) <= 60 else f"{text[:57]}…"


# --- formulas --------------------------------------------------------------------------------------------
def boolean(e: Any) -> s.Node:
    """A SymPy Boolean, or a term that is an equation with zero."""
    if e in (sp.true, sp.false):
        return s.Truth(e is sp.true)
    if isinstance(e, sp.Eq) and isinstance(e.lhs, sp.MatrixBase) and e.lhs.shape == getattr(e.rhs, "shape", None):
        return s.Every([boolean(sp.Eq(a, b, evaluate=False)) for a, b in zip(e.lhs, e.rhs)])
    if isinstance(e, sp.core.relational.Relational):
        return s.Comparison([real(e.lhs), real(e.rhs)], [_RELATIONS[e.rel_op]], -1)
    if isinstance(e, sp.logic.boolalg.BooleanFunction):
        node = s.connected(type(e).__name__, [boolean(a) for a in e.args])
        if node is not None:
            return node
    if isinstance(e, sp.Contains):
        element, within = e.args
        if isinstance(element, sp.Tuple) and isinstance(within, sp.ProductSet) and len(element) == len(within.args):
            return s.Every([member(real(a), part) for a, part in zip(element, within.args)])
        return member(real(element), within)
    if isinstance(e, sp.assumptions.AppliedPredicate):
        relation = _ASSUMED.get(str(e.function).removeprefix("Q."))
        if relation is not None and len(e.arguments) == 1:
            return s.Comparison([real(e.arguments[0]), s.Number(0)], [relation], -1)
    if isinstance(e, sp.Expr | sp.Poly) and not isinstance(e, sp.Symbol) and e.free_symbols:
        return s.Comparison([real(e), s.Number(0)], [Relation.EQ], -1)  # as solve reads it
    hint = f"; a truth value may be written {shown(e)} > 0" if isinstance(e, sp.Symbol) else ""
    raise InputError(f"formula: a Boolean combination of relations expected, {shown(e)} found{hint}")


def member(term: s.Term, e: Any) -> s.Node:
    """``term in e`` for a set of real numbers."""
    if isinstance(e, sp.Interval):
        low = Relation.LT if e.left_open or e.start is sp.S.NegativeInfinity else Relation.LE
        high = Relation.LT if e.right_open or e.end is sp.S.Infinity else Relation.LE
        return s.Comparison([real(e.start), term, real(e.end)], [low, high], -1)
    if isinstance(e, sp.FiniteSet):
        return s.Some([s.Comparison([term, real(a)], [Relation.EQ], -1) for a in e.args])
    if isinstance(e, sp.Union):
        return s.Some([member(term, a) for a in e.args])
    if isinstance(e, sp.Intersection):
        return s.Every([member(term, a) for a in e.args])
    if isinstance(e, sp.Complement):
        return s.Every([member(term, e.args[0]), s.Negation(member(term, e.args[1]))])
    if e is sp.S.EmptySet:
        return s.Truth(False)
    if e is sp.S.Reals:
        return s.Comparison([term, term], [Relation.EQ], -1)
    if isinstance(e, sp.ConditionSet) and isinstance(e.sym, sp.Symbol) and isinstance(term, s.Name):
        condition = e.condition.subs(e.sym, sp.Symbol(term.name, real=True))
        return s.Every([member(term, e.base_set), boolean(condition)])
    raise InputError(f"a set of real numbers made of intervals and points expected, {shown(e)} found")


# --- terms -----------------------------------------------------------------------------------------------
def real(e: Any) -> s.Term:
    """A term."""
    if isinstance(e, sp.Symbol):
        return s.Name(symbol_name(e), -1)
    if isinstance(e, sp.Rational):
        return s.Number(Fraction(int(e.p), int(e.q)))
    if isinstance(e, sp.Float):
        if not e.is_finite:
            raise InputError(f"a finite number expected, {e} found")
        return s.Number(decimal_of(e))
    if e in (sp.S.Infinity, sp.S.NegativeInfinity):
        return s.Infinity(-1) if e is sp.S.Infinity else s.Minus(s.Infinity(-1))
    if isinstance(e, sp.Poly):
        return real(e.as_expr())
    if isinstance(e, sp.Add):
        return s.Sum([real(a) for a in e.args])
    if isinstance(e, sp.Mul):
        return reduce(lambda left, right: s.Product(left, right, -1), map(real, e.args))
    if isinstance(e, sp.Pow) and isinstance(e.exp, sp.Rational | sp.Float):
        return s.Power(real(e.base), real(e.exp), -1)
    if isinstance(e, sp.Abs | sp.sign | sp.Max | sp.Min):
        return s.Apply(type(e).__name__.lower(), [real(a) for a in e.args], -1)
    if isinstance(e, sp.Piecewise):
        return piecewise(e)
    if isinstance(e, sp.Heaviside):
        x, zero = real(e.args[0]), s.Number(0)
        at_most = s.Choice(s.Comparison([x, zero], [Relation.EQ], -1), real(e.args[1]), zero, -1)
        return s.Choice(s.Comparison([x, zero], [Relation.GT], -1), s.Number(1), at_most, -1)
    if isinstance(e, sp.re | sp.im | sp.conjugate) and _is_polynomial(e.args[0]):
        return s.Number(0) if isinstance(e, sp.im) else real(e.args[0])
    if is_to_be_done(e):
        return real(e.doit())
    if isinstance(e, sp.NumberSymbol) and (names := numbers_in(e)):
        return s.Name(names[0], -1)
    if e.is_number and (number := number_from_sympy(e)) is not None:
        return s.Algebraic(number, -1)
    raise InputError(refusal(e))


def is_to_be_done(e: Any) -> bool:
    """Whether SymPy has left something undone that has one polynomial for its value, whatever the variables are."""
    if isinstance(e, sp.UnevaluatedExpr):
        return True
    if isinstance(e, sp.Determinant):
        return isinstance(e.arg, sp.MatrixBase) and all(map(_is_polynomial, e.arg))
    if isinstance(e, sp.Sum | sp.Integral):
        ends = [end for limit in e.limits for end in limit[1:]] if all(len(limit) == 3 for limit in e.limits) else []
        fits = all(end.is_Integer for end in ends) if isinstance(e, sp.Sum) else all(map(_is_polynomial, ends))
        return bool(ends) and fits and not any(end.is_infinite for end in ends) and _is_polynomial(e.args[0])
    return isinstance(e, sp.Derivative) and _is_polynomial(e.args[0])


def refusal(e: Any) -> str:
    """Why an expression is no term, and what to write instead where that is known."""
    if e is sp.I:
        return "all numbers are real here, I is not; a complex number is written as its real and imaginary part"
    if isinstance(e, sp.Pow):
        return f"powers whose exponents are no rational numbers are not algebraic: {shown(e)}"
    message = way_out(type(e).__name__)
    if "algebraic" in message or "integers" in message:
        return f"{shown(e)}: {message}"
    hint = "terms are made of + - * /, rational powers, Abs, Min, Max, sign and Piecewise"
    return f"{shown(e)} cannot be read: {hint}"


def piecewise(e: Any) -> s.Term:
    """The first case whose condition holds; no value where none does."""
    result: s.Term | None = None
    for value, condition in reversed(e.args):
        if condition == sp.true:
            result = real(value)
        else:
            result = s.Choice(boolean(condition), real(value), result, -1)
    assert result is not None
    return result


def _is_polynomial(e: Any) -> bool:
    """Whether an expression is a polynomial in all its symbols, of which none is an exponent."""
    return bool(e.is_polynomial(*e.free_symbols))


def signs(symbols: Iterable[Any]) -> dict[str, s.Node]:
    """What the assumptions of symbols say about their signs, by name."""
    nodes: dict[str, s.Node] = {}
    for symbol in symbols:
        name = s.Name(symbol_name(symbol), -1)
        relation = next((r for key, r in _ASSUMED.items() if getattr(symbol, f"is_{key}") is True), None)
        if relation is not None:
            nodes[symbol.name] = s.Comparison([name, s.Number(0)], [relation], -1)
    return nodes


_SYMBOLS = dict(zip(NUMBERS, ("pi", "E", "EulerGamma", "Catalan")))


def symbol_of(name: str) -> Any:
    """The SymPy symbol of a variable, the number where the name is that of one (``qe.formula.numbers``)."""
    return getattr(sp, _SYMBOLS[name]) if name in _SYMBOLS else sp.Symbol(name)


def numbers_in(expression: Any) -> list[str]:
    """The names of the numbers that are not algebraic in a SymPy expression."""
    return [name for name in _SYMBOLS if symbol_of(name) in expression.atoms(sp.NumberSymbol)]


def decimal_of(number: Any) -> Fraction:
    """The decimal number that a finite SymPy ``Float`` prints: all digits it holds to be known, in base ten."""
    return decimal(str(number))


def number_to_sympy(number: RealAlgebraic) -> Any:
    """The SymPy number that equals ``number``: a ``Rational``, ``(p + q*sqrt(d))/r``, or a ``CRootOf``."""
    if number.is_rational:
        value = number.as_fraction()
        return sp.Rational(value.numerator, value.denominator)
    coefficients = [sp.Integer(c) for c in reversed(number.minimal_polynomial)]
    if number.degree == 2:
        a, b, c = coefficients
        root = sp.sqrt(b**2 - 4 * a * c) / (2 * a)
        return -b / (2 * a) + (root if number.index else -root)
    # SymPy, too, numbers the real roots of an irreducible polynomial from the smallest, before the complex ones
    return sp.CRootOf(sp.Poly(coefficients, sp.Symbol("x")), number.index, radicals=False)


def number_from_sympy(number: object) -> RealAlgebraic | None:
    """The real algebraic number that a SymPy expression without symbols is, the root of its minimal polynomial that its
    digits tell from the others; None for any other object."""
    if not isinstance(number, sp.Expr) or not number.is_number or number.is_real is not True:
        return None
    try:
        minimal = sp.minimal_polynomial(number, sp.Symbol("x"), polys=True)
    except (sp.polys.polyerrors.BasePolynomialError, RuntimeError):  # not algebraic, or SymPy cannot tell
        return None
    coefficients = [int(c) for c in reversed(minimal.clear_denoms(convert=True)[1].all_coeffs())]
    for digits in (30, 120, 480, 1920):
        value = decimal_of(number.evalf(digits))
        error = Fraction(1 + abs(value), 10 ** (digits - 5))
        with suppress(InputError):  # more than one root there
            return RealAlgebraic.from_root(coefficients, value - error, value + error)
    return None
