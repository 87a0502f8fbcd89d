"""SymPy trees to surface trees. SymPy is imported when a function of this module is called, never before."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from fractions import Fraction
from functools import reduce
from typing import Any

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
    import sympy

    if isinstance(symbol, sympy.Dummy | sympy.Wild):
        raise InputError(f"{symbol} is a {type(symbol).__name__}, which is no variable with a name; use a Symbol")
    assumed = symbol.assumptions0
    known = sympy.Symbol("x", real=True, **{key: True for key in _ASSUMED if assumed.get(key)}).assumptions0
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


class Reader:
    """SymPy trees to surface trees."""

    def __init__(self, module: Any) -> None:
        self.sympy = module

    # --- formulas --------------------------------------------------------------------------------------------
    def boolean(self, e: Any) -> s.Node:
        sp = self.sympy
        if e in (sp.true, sp.false):
            return s.Truth(e is sp.true)
        if isinstance(e, sp.Eq) and isinstance(e.lhs, sp.MatrixBase) and e.lhs.shape == getattr(e.rhs, "shape", None):
            return s.Every([self.boolean(sp.Eq(a, b, evaluate=False)) for a, b in zip(e.lhs, e.rhs)])
        if isinstance(e, sp.core.relational.Relational):
            return s.Comparison([self.real(e.lhs), self.real(e.rhs)], [_RELATIONS[e.rel_op]], -1)
        if isinstance(e, sp.logic.boolalg.BooleanFunction):
            node = s.connected(type(e).__name__, [self.boolean(a) for a in e.args])
            if node is not None:
                return node
        if isinstance(e, sp.Contains):
            element, within = e.args
            if isinstance(element, sp.Tuple) and isinstance(within, sp.ProductSet) and len(element) == len(within.args):
                return s.Every([self.member(self.real(a), part) for a, part in zip(element, within.args)])
            return self.member(self.real(element), within)
        if isinstance(e, sp.assumptions.AppliedPredicate):
            relation = _ASSUMED.get(str(e.function).removeprefix("Q."))
            if relation is not None and len(e.arguments) == 1:
                return s.Comparison([self.real(e.arguments[0]), s.Number(0)], [relation], -1)
        if isinstance(e, sp.Expr | sp.Poly) and not isinstance(e, sp.Symbol) and e.free_symbols:
            return s.Comparison([self.real(e), s.Number(0)], [Relation.EQ], -1)  # as solve reads it
        hint = f"; a truth value may be written {shown(e)} > 0" if isinstance(e, sp.Symbol) else ""
        raise InputError(f"formula: a Boolean combination of relations expected, {shown(e)} found{hint}")

    def member(self, term: s.Term, e: Any) -> s.Node:
        """``term in e`` for a set of real numbers."""
        sp = self.sympy
        if isinstance(e, sp.Interval):
            low = Relation.LT if e.left_open or e.start is sp.S.NegativeInfinity else Relation.LE
            high = Relation.LT if e.right_open or e.end is sp.S.Infinity else Relation.LE
            return s.Comparison([self.real(e.start), term, self.real(e.end)], [low, high], -1)
        if isinstance(e, sp.FiniteSet):
            return s.Some([s.Comparison([term, self.real(a)], [Relation.EQ], -1) for a in e.args])
        if isinstance(e, sp.Union):
            return s.Some([self.member(term, a) for a in e.args])
        if isinstance(e, sp.Intersection):
            return s.Every([self.member(term, a) for a in e.args])
        if isinstance(e, sp.Complement):
            return s.Every([self.member(term, e.args[0]), s.Negation(self.member(term, e.args[1]))])
        if e is sp.S.EmptySet:
            return s.Truth(False)
        if e is sp.S.Reals:
            return s.Comparison([term, term], [Relation.EQ], -1)
        if isinstance(e, sp.ConditionSet) and isinstance(e.sym, sp.Symbol) and isinstance(term, s.Name):
            condition = e.condition.subs(e.sym, sp.Symbol(term.name, real=True))
            return s.Every([self.member(term, e.base_set), self.boolean(condition)])
        raise InputError(f"a set of real numbers made of intervals and points expected, {shown(e)} found")

    # --- terms -----------------------------------------------------------------------------------------------
    def real(self, e: Any) -> s.Term:
        sp = self.sympy
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
            return self.real(e.as_expr())
        if isinstance(e, sp.Add):
            return s.Sum([self.real(a) for a in e.args])
        if isinstance(e, sp.Mul):
            return reduce(lambda left, right: s.Product(left, right, -1), map(self.real, e.args))
        if isinstance(e, sp.Pow) and isinstance(e.exp, sp.Rational | sp.Float):
            return s.Power(self.real(e.base), self.real(e.exp), -1)
        if isinstance(e, sp.Abs | sp.sign | sp.Max | sp.Min):
            return s.Apply(type(e).__name__.lower(), [self.real(a) for a in e.args], -1)
        if isinstance(e, sp.Piecewise):
            return self.piecewise(e)
        if isinstance(e, sp.Heaviside):
            x, zero = self.real(e.args[0]), s.Number(0)
            at_most = s.Choice(s.Comparison([x, zero], [Relation.EQ], -1), self.real(e.args[1]), zero, -1)
            return s.Choice(s.Comparison([x, zero], [Relation.GT], -1), s.Number(1), at_most, -1)
        if isinstance(e, sp.re | sp.im | sp.conjugate) and _is_polynomial(e.args[0]):
            return s.Number(0) if isinstance(e, sp.im) else self.real(e.args[0])
        if self.is_to_be_done(e):
            return self.real(e.doit())
        if isinstance(e, sp.NumberSymbol) and (names := numbers_in(e)):
            return s.Name(names[0], -1)
        if e.is_number and (number := number_from_sympy(e)) is not None:
            return s.Algebraic(number, -1)
        raise InputError(self.refusal(e))

    def is_to_be_done(self, e: Any) -> bool:
        """Whether SymPy has left something undone that has one polynomial for its value, whatever the variables are."""
        sp = self.sympy
        if isinstance(e, sp.UnevaluatedExpr):
            return True
        if isinstance(e, sp.Determinant):
            return isinstance(e.arg, sp.MatrixBase) and all(map(_is_polynomial, e.arg))
        if isinstance(e, sp.Sum | sp.Integral):
            ends = (
                [end for limit in e.limits for end in limit[1:]] if all(len(limit) == 3 for limit in e.limits) else []
            )
            fits = all(end.is_Integer for end in ends) if isinstance(e, sp.Sum) else all(map(_is_polynomial, ends))
            return bool(ends) and fits and not any(end.is_infinite for end in ends) and _is_polynomial(e.args[0])
        return isinstance(e, sp.Derivative) and _is_polynomial(e.args[0])

    def refusal(self, e: Any) -> str:
        """Why an expression is no term, and what to write instead where that is known."""
        sp = self.sympy
        if e is sp.I:
            return "all numbers are real here, I is not; a complex number is written as its real and imaginary part"
        if isinstance(e, sp.Pow):
            return f"powers whose exponents are no rational numbers are not algebraic: {shown(e)}"
        message = way_out(type(e).__name__)
        if "algebraic" in message or "integers" in message:
            return f"{shown(e)}: {message}"
        hint = "terms are made of + - * /, rational powers, Abs, Min, Max, sign and Piecewise"
        return f"{shown(e)} cannot be read: {hint}"

    def piecewise(self, e: Any) -> s.Term:
        """The first case whose condition holds; no value where none does."""
        result: s.Term | None = None
        for value, condition in reversed(e.args):
            if condition == self.sympy.true:
                result = self.real(value)
            else:
                result = s.Choice(self.boolean(condition), self.real(value), result, -1)
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
    import sympy

    return getattr(sympy, _SYMBOLS[name]) if name in _SYMBOLS else sympy.Symbol(name)


def numbers_in(expression: Any) -> list[str]:
    """The names of the numbers that are not algebraic in a SymPy expression."""
    import sympy

    return [name for name in _SYMBOLS if symbol_of(name) in expression.atoms(sympy.NumberSymbol)]


def decimal_of(number: Any) -> Fraction:
    """The decimal number that a finite SymPy ``Float`` prints: all digits it holds to be known, in base ten."""
    return decimal(str(number))


def number_to_sympy(number: RealAlgebraic) -> Any:
    """The SymPy number that equals ``number``: a ``Rational``, ``(p + q*sqrt(d))/r``, or a ``CRootOf``."""
    import sympy

    if number.is_rational:
        value = number.as_fraction()
        return sympy.Rational(value.numerator, value.denominator)
    coefficients = [sympy.Integer(c) for c in reversed(number.minimal_polynomial)]
    if number.degree == 2:
        a, b, c = coefficients
        root = sympy.sqrt(b**2 - 4 * a * c) / (2 * a)
        return -b / (2 * a) + (root if number.index else -root)
    # SymPy, too, numbers the real roots of an irreducible polynomial from the smallest, before the complex ones
    return sympy.CRootOf(sympy.Poly(coefficients, sympy.Symbol("x")), number.index, radicals=False)


def number_from_sympy(number: object) -> RealAlgebraic | None:
    """The real algebraic number that a SymPy expression without symbols is; None for any other object.

    It is the root of its minimal polynomial that its decimal digits tell from the others.
    """
    import sympy

    if not isinstance(number, sympy.Expr) or not number.is_number or number.is_real is not True:
        return None
    try:
        minimal = sympy.minimal_polynomial(number, sympy.Symbol("x"), polys=True)
    except (sympy.polys.polyerrors.BasePolynomialError, RuntimeError):  # not algebraic, or SymPy cannot tell
        return None
    coefficients = [int(c) for c in reversed(minimal.clear_denoms(convert=True)[1].all_coeffs())]
    for digits in (30, 120, 480, 1920):
        value = decimal_of(number.evalf(digits))
        error = Fraction(1 + abs(value), 10 ** (digits - 5))
        with suppress(InputError):  # more than one root there
            return RealAlgebraic.from_root(coefficients, value - error, value + error)
    return None
