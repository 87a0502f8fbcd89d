"""SymPy Booleans in and out.

A ``Float`` is read as the decimal number that it prints. SymPy has no quantifiers: ``Exists`` and ``ForAll`` here wrap
an expression and can be combined with ``& | ~ >>``. A symbol may be assumed real, and to have a sign, which becomes a
condition; assumptions that say more (integer) are refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sp

from qe import arguments
from qe.errors import InputError, NoTruthValue
from qe.exact.algebraic import real_roots
from qe.exact.field import FieldElement
from qe.formula.build import JOINS, conj, exists, forall, implies
from qe.formula.operators import Connected
from qe.formula.syntax import TRUE, Formula
from qe.io import surface as s
from qe.io.lowering import lower, lower_term
from qe.io.names import bound_names
from qe.io.substitution import over_one_ring
from qe.io.sympy_reader import boolean, number_to_sympy, numbers_in, real, shown, signs, symbol_of

_FUNCTIONS = {"abs": "Abs", "sign": "sign", "sqrt": "sqrt", "min": "Min", "max": "Max"}


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Wrapped(Connected):
    """A formula made of SymPy Booleans and formulas by quantifiers and ``& | ~ >>``.

    ``raw`` is the formula as it is written, ``assumed`` what its symbols are assumed to be, by name: conditions that
    stay outside of all connectives, and inside the quantifier of their variable. ``block``: whether the outermost
    quantifier is universal, and its names; None without one.
    """

    raw: Formula
    assumed: Mapping[str, Formula]
    block: tuple[bool, tuple[str, ...]] | None = None

    def formula(self) -> Formula:
        """The formula that this stands for."""
        return conj(over_one_ring(*self.assumed.values(), self.raw))

    def _connect(self, way: str, *parts: object) -> Wrapped:
        formulas, known = zip(*map(_parts, parts), strict=True)
        return Wrapped(JOINS[way](*over_one_ring(*formulas)), {n: sign for one in known for n, sign in one.items()})

    def __bool__(self) -> bool:
        """Python's ``and``, ``or`` and ``not`` ask for it and would drop a part of the formula without a word."""
        raise NoTruthValue(
            "a formula has no truth value here; connect formulas with & | ~ >>, decide them with qe.decide"
        )

    def __str__(self) -> str:
        return str(self.formula())

    __repr__ = __str__


def Exists(variables: object, body: object) -> Wrapped:
    """``Exists(x, body)`` or ``Exists((x, y), body)``: there are real values with ``body``.

    Variables are SymPy symbols or names; ``body`` is a SymPy Boolean, a formula, or wrapped itself. What a symbol is
    assumed to be (positive, nonnegative, ...) is a condition on it. Raises ``InputError`` for any other ``body``.
    """
    return _quantified(False, variables, body)


def ForAll(variables: object, body: object) -> Wrapped:
    """``ForAll(x, body)`` or ``ForAll((x, y), body)``: ``body`` holds for all real values; see ``Exists``."""
    return _quantified(True, variables, body)


def _quantified(universal: bool, variables: Any, body: object) -> Wrapped:
    if isinstance(variables, set | frozenset):  # the order within a block means nothing
        variables = sorted(variables, key=str)
    listed = variables if isinstance(variables, Iterable) and not isinstance(variables, str) else (variables,)
    given = _assumptions(symbol for symbol in listed if isinstance(symbol, sp.Symbol))
    names = bound_names(variables)
    raw, assumed = _parts(body)
    assumed = {**assumed, **given}
    *conditions, kept = over_one_ring(*(assumed[name] for name in names if name in assumed), raw)
    made = forall(names, implies(conj(conditions), kept)) if universal else exists(names, conj((*conditions, kept)))
    return Wrapped(made, {name: sign for name, sign in assumed.items() if name not in names}, (universal, names))


def _assumptions(symbols: Iterable[Any]) -> dict[str, Formula]:
    return {name: lower(node, _failing("assumptions")) for name, node in signs(symbols).items()}


def assumed_of(expression: Any) -> Iterable[Formula]:
    """What the symbols of an expression are assumed to be."""
    return _assumptions(sorted(expression.free_symbols, key=str)).values()


def _failing(whole: object) -> s.Fail:
    return lambda message, _: InputError(f"{shown(whole)}: {message}")


def from_sympy(expression: object) -> Formula:
    """The formula of a SymPy Boolean, a wrapped or a finished formula, with the signs that symbols are assumed to have.
    Raises ``InputError`` for a Python truth value, which is what ``x**2 == b`` makes, and whatever else is no
    Boolean."""
    raw, known = posed_from_sympy(expression)
    return conj((known, raw))


def posed_from_sympy(expression: object) -> tuple[Formula, Formula]:
    """As ``from_sympy``, the formula and what its free symbols are assumed to be by themselves, over one ring."""
    raw, assumed = _parts(expression)
    if not assumed:
        return raw, TRUE
    raw, *known = over_one_ring(raw, *assumed.values())
    return raw, conj(known)


def _parts(expression: object) -> tuple[Formula, Mapping[str, Formula]]:
    """The formula of an expression, and what its symbols are assumed to be."""
    if isinstance(expression, Formula):
        return expression, {}
    if isinstance(expression, Wrapped):
        return expression.raw, expression.assumed
    if isinstance(held := getattr(expression, "formula", None), Formula):  # an answer, or a region
        return held, {}
    if isinstance(expression, str):
        raise InputError("a SymPy Boolean expected, text found")
    if isinstance(expression, bool):
        hint = "== compares SymPy expressions at once, an equation is written Eq(left, right)"
        raise InputError(f"a SymPy Boolean expected, Python's {expression} found; {hint}")
    whole = _basic(expression, "formula: text, a Formula or a SymPy Boolean")
    symbols = sorted(getattr(whole, "free_symbols", ()), key=str)
    try:
        node = boolean(whole)
        names = dict.fromkeys((*numbers_in(whole), *(symbol.name for symbol in symbols)))
        return lower(node, _failing(whole), names=names), _assumptions(symbols)
    except RecursionError:
        raise InputError("the expression is nested too deeply") from None


def term_from_sympy(expression: object) -> s.Term:
    """The surface tree of a SymPy expression."""
    try:
        return real(_basic(expression, "a SymPy expression"))
    except RecursionError:
        raise InputError("the expression is nested too deeply") from None


def term_to_sympy(term: s.Term) -> Any:
    """The SymPy expression of a surface tree. Raises ``InputError`` for parts that SymPy has no function for."""
    match term:
        case s.Name(name):
            return symbol_of(name)
        case s.Number(value):
            return sp.Rational(value.numerator, value.denominator)
        case s.Algebraic(number):
            return number_to_sympy(number)
        case s.Polynomial(terms):
            return sp.Add(*(sp.Mul(sp.Rational(c), *map(symbol_of, names)) for names, c in terms.items()))
        case s.Sum(parts):
            return sp.Add(*map(term_to_sympy, parts))
        case s.Product(left, right):
            return term_to_sympy(left) * term_to_sympy(right)
        case s.Quotient(left, right):
            return term_to_sympy(left) / term_to_sympy(right)
        case s.Power(base, exponent):
            return term_to_sympy(base) ** term_to_sympy(exponent)
        case s.Minus(part):
            return -term_to_sympy(part)
        case s.Infinity():
            return sp.oo
        case s.Apply("cbrt", [part]):
            return sp.sign(inner := term_to_sympy(part)) * sp.Abs(inner) ** sp.Rational(1, 3)
        case s.Apply(function, parts) if function in _FUNCTIONS:
            return getattr(sp, _FUNCTIONS[function])(*map(term_to_sympy, parts))
        case s.Root(s.Number(k), part, variable):
            poly = lower_term(part, s.unplaced, numbers=True).poly
            if len(poly.variables) != 1 or variable not in (None, poly.ring.names[poly.level]):
                raise InputError("SymPy has no form for a root of a polynomial with parameters")
            place = int(k)
            if 1 <= abs(place) <= len(roots := real_roots(poly.to_univariate(poly.level))):
                return number_to_sympy(roots[place - (place > 0)])  # from the end where it is negative
    raise InputError("SymPy has no form for this term")


def _node_to_sympy(node: s.Node) -> Any:
    """The SymPy Boolean of a surface tree without quantifiers."""
    match node:
        case s.Truth(value):
            return sp.true if value else sp.false
        case s.Every(parts):
            return sp.And(*map(_node_to_sympy, parts))
        case s.Some(parts):
            return sp.Or(*map(_node_to_sympy, parts))
        case s.Comparison(given, relations):
            terms = [term_to_sympy(side) for side in given]
            pairs = zip(terms, relations, terms[1:], strict=False)
            said = [getattr(sp, r.name.title())(left, right, evaluate=False) for left, r, right in pairs]
            turned = [one.lhs.is_number or (one.rhs.is_Symbol and not one.lhs.is_Symbol) for one in said]  # as 0 < x
            return sp.And(*(one.reversed if turn else one for one, turn in zip(said, turned, strict=True)))
        case s.Negation(part):
            return sp.Not(_node_to_sympy(part))
    raise InputError("SymPy has no quantifiers; eliminate them first")


def expression_from(given: object) -> Any:
    """The SymPy expression that is given, as an object or a number, not as text."""
    expression = _basic(given, "a SymPy expression")
    if not isinstance(expression, sp.Expr):
        raise InputError(f"a SymPy expression expected, {shown(expression)} found")
    return expression


def _basic(given: object, expected: str) -> Any:
    """The SymPy object that is given, or that something of this package stands for (``_sympy_``)."""
    if isinstance(given, sp.Basic):
        return given
    if not hasattr(given, "_sympy_") and not isinstance(given, int | Fraction):
        raise InputError(f"{expected} expected, {arguments.shown(given)} found")
    return sp.sympify(given)


def sympy_form(value: Any) -> Any:
    """What SymPy takes a value for: the Boolean of a formula, of a set that has one, of solutions as they are printed;
    the values of a point by their symbols; the number that equals a number or an optimum (None: there is none), a
    ``Piecewise`` where it depends on parameters."""
    if isinstance(value, Formula):
        return to_sympy(value)
    if hasattr(value, "lines"):
        return said(" or ".join(value.lines) or "false")
    if hasattr(value, "branches"):
        pieces = [(said(best, term=True), said(where)) for best, where in value.branches]
        return sp.Piecewise(*pieces) if pieces else sp.nan
    if hasattr(value, "least"):
        return sp.Tuple(*map(sympy_form, value))
    if hasattr(value, "formula"):
        return to_sympy(value.formula)
    if isinstance(value, dict):
        return sp.Dict({sp.Symbol(name): sp.sympify(number) for name, number in value.items()})
    if hasattr(value, "attained"):
        return None if value.value is None else sp.sympify(value.value)
    return number_to_sympy(value.to_algebraic() if isinstance(value, FieldElement) else value)


def said(text: str, *, term: bool = False) -> Any:
    """The SymPy Boolean, or term, of a text as it is written."""
    from qe.io.text import read_node, read_term  # the parser, which reading SymPy does not need

    return term_to_sympy(read_term(text)) if term else _node_to_sympy(read_node(text))


def to_sympy(formula: Formula, *, symbols: Mapping[str, Any] | None = None) -> Any:
    """The SymPy Boolean of a quantifier-free formula, as it is printed; ``symbols`` gives the symbols to use for names
    (default: ``Symbol(name)``). SymPy may simplify as it builds. Raises ``InputError`` for quantifiers, and for roots
    of polynomials with parameters."""
    return said(str(formula)).xreplace({sp.Symbol(name): symbol for name, symbol in (symbols or {}).items()})
