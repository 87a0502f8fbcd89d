"""SymPy Booleans in and out. SymPy is imported when a function of this module is called, never before.

Read: relations, ``And Or Not Implies Equivalent Xor ITE``, polynomials with rational coefficients, ``Abs``, ``Min``,
``Max`` and ``Piecewise`` (by cases). A SymPy ``Float`` is read as the decimal number that it prints: ``0.1*x`` means
x/10, as in text. Written: formulas, and real algebraic numbers as ``Rational``, square roots or ``CRootOf``. SymPy has
no quantifiers, so ``Exists`` and ``ForAll`` here wrap an expression and can
be combined with ``& | ~ >>`` among themselves and with SymPy expressions. A symbol may be assumed real; assumptions
that say more (positive, integer) would be lost and are refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from qe import arguments
from qe.errors import InputError, NoTruthValue
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, convert, disj, exists, forall, implies, neg
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or, Relation
from qe.formula.traverse import ring_of
from qe.io import surface as s
from qe.io.cases import Cases, choose, combine, compare, plain
from qe.io.names import check_name, names_in
from qe.io.sympy_numbers import decimal_of, number_to_sympy
from qe.io.terms import TermError

if TYPE_CHECKING:
    import sympy

_RELATIONS = {**{relation.value: relation for relation in Relation}, "==": Relation.EQ, "!=": Relation.NE}
_SIGNS = ("positive", "negative", "integer", "rational")
_CLASSES = {
    Relation.EQ: "Eq",
    Relation.NE: "Ne",
    Relation.LT: "Lt",
    Relation.LE: "Le",
    Relation.GT: "Gt",
    Relation.GE: "Ge",
}


class _Operators:
    """Connectives between wrapped formulas, SymPy Booleans and formulas."""

    __slots__ = ()

    def formula(self) -> Formula:
        """The formula that this stands for."""
        raise TypeError(f"{type(self).__name__} holds no formula")

    def __and__(self, other: object) -> Combined:
        return Combined(conj(_together(self, other)))

    def __rand__(self, other: object) -> Combined:
        return Combined(conj(_together(other, self)))

    def __or__(self, other: object) -> Combined:
        return Combined(disj(_together(self, other)))

    def __ror__(self, other: object) -> Combined:
        return Combined(disj(_together(other, self)))

    def __rshift__(self, other: object) -> Combined:
        return Combined(implies(*_together(self, other)))

    def __rrshift__(self, other: object) -> Combined:
        return Combined(implies(*_together(other, self)))

    def __invert__(self) -> Combined:
        return Combined(neg(self.formula()))

    def __bool__(self) -> bool:
        """Python's ``and``, ``or`` and ``not`` ask for it and would drop a part of the formula without a word."""
        raise NoTruthValue(
            "a formula has no truth value here; connect formulas with & | ~ >>, decide them with qe.decide"
        )

    def __str__(self) -> str:
        return str(self.formula())


@dataclass(frozen=True, slots=True, eq=False)
class Combined(_Operators):
    """A formula made of wrapped ones by ``& | ~ >>``."""

    value: Formula

    def formula(self) -> Formula:
        """The formula that this stands for."""
        return self.value


class _Quantified(_Operators):
    __slots__ = ("body", "names")

    def __init__(self, variables: object, body: object) -> None:
        self.names = _variables(variables)
        self.body = from_sympy(body)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(self.names)}; {self.body})"


class Exists(_Quantified):
    """``Exists(x, body)`` or ``Exists((x, y), body)``: there are real values with ``body``.

    Variables are SymPy symbols or names; ``body`` is a SymPy Boolean, a formula, or wrapped itself. Raises
    ``InputError`` where ``body`` is not built from polynomial relations.
    """

    __slots__ = ()

    def formula(self) -> Formula:
        """The formula that this stands for."""
        return exists(self.names, self.body)


class ForAll(_Quantified):
    """``ForAll(x, body)`` or ``ForAll((x, y), body)``: ``body`` holds for all real values; see ``Exists``."""

    __slots__ = ()

    def formula(self) -> Formula:
        """The formula that this stands for."""
        return forall(self.names, self.body)


def outermost(given: object) -> tuple[bool, tuple[str, ...]] | None:
    """Whether a wrapped formula begins with a universal quantifier, and its names; None where it begins with none."""
    return (isinstance(given, ForAll), given.names) if isinstance(given, _Quantified) else None


def _together(*parts: object) -> tuple[Formula, ...]:
    """Formulas of the parts, over one ring."""
    formulas = tuple(from_sympy(part) for part in parts)
    names = [name for f in formulas if (ring := ring_of(f)) is not None for name in ring.names]
    ring = Ring.of(dict.fromkeys(names))
    return tuple(convert(f, ring) for f in formulas)


def _variables(variables: object) -> tuple[str, ...]:
    import sympy

    if isinstance(variables, set | frozenset):  # the order within a block means nothing
        variables = sorted(variables, key=str)
    for symbol in variables if isinstance(variables, Iterable) and not isinstance(variables, str) else (variables,):
        if isinstance(symbol, sympy.Symbol):
            _symbol(symbol)
    names = arguments.names(variables, "variables")
    if not names:
        raise InputError("a quantifier needs at least one variable")
    return tuple(check_name(name) for name in names)


def _symbol(symbol: sympy.Symbol) -> str:
    import sympy

    if isinstance(symbol, sympy.Dummy | sympy.Wild):
        raise InputError(f"{symbol} is a {type(symbol).__name__}, which is no variable with a name; use a Symbol")
    known = sympy.Symbol("x", real=True).assumptions0
    extra = [key for key, value in symbol.assumptions0.items() if known.get(key) is not value]
    extra.sort(key=lambda key: ("_" in key, not symbol.assumptions0[key], key not in _SIGNS, key))
    if extra:
        raise InputError(f"the symbol {symbol} is assumed to be more than real ({extra[0]}); say it in the formula")
    return check_name(symbol.name)


def from_sympy(expression: object) -> Formula:
    """The formula of a SymPy Boolean, a wrapped or a finished formula.

    Raises ``InputError`` for what is not a Boolean combination of polynomial relations over Q, a Python truth value
    among them: it is what ``x**2 == b`` makes.
    """
    if isinstance(expression, Formula):
        return expression
    if isinstance(expression, _Operators):
        return expression.formula()
    if isinstance(held := getattr(expression, "formula", None), Formula):  # an answer, or a region
        return held
    import sympy

    if isinstance(expression, str):
        raise InputError("a SymPy Boolean expected, text found")
    if isinstance(expression, bool):
        hint = "== compares SymPy expressions at once, an equation is written Eq(left, right)"
        raise InputError(f"a SymPy Boolean expected, Python's {expression} found; {hint}")
    whole = _basic(expression, "a formula (text, Formula, or a SymPy Boolean)")
    names = sorted(str(symbol) for symbol in getattr(whole, "free_symbols", ()))
    try:
        node = _Reader(sympy).boolean(whole)
        return s.lower(node, lambda message, _: InputError(f"{_shown(whole)}: {message}"), names=dict.fromkeys(names))
    except TermError as error:
        raise InputError(f"{_shown(whole)}: {error}") from None
    except RecursionError:
        raise InputError("the expression is nested too deeply") from None


def polynomial_from_sympy(expression: object) -> tuple[Poly, Fraction]:
    """A polynomial p and a rational s: the expression is s*p.

    Raises ``InputError`` for what is no polynomial over Q.
    """
    import sympy

    whole = _basic(expression, "a SymPy expression")
    (guards, term), *others = _Reader(sympy).real(whole)
    if guards or others:
        raise InputError(f"{_shown(whole)} distinguishes cases")
    try:
        value = s.lower_term(term, lambda message, _: InputError(f"{_shown(whole)}: {message}"))
    except RecursionError:
        raise InputError("the expression is nested too deeply") from None
    return value.poly, Fraction(1, value.den)


def _basic(given: object, expected: str) -> Any:
    """The SymPy object that is given, or that something of this package stands for (``_sympy_``)."""
    import sympy

    if isinstance(given, sympy.Basic):
        return given
    if not hasattr(given, "_sympy_") and not isinstance(given, int | Fraction):
        raise InputError(f"{expected} expected, {type(given).__name__} found")
    return sympy.sympify(given)


def _shown(expression: object) -> str:
    try:
        text = str(expression)
    except ValueError:  # SymPy prints numbers by str, which Python bounds
        return "an expression with a long number"
    return text if len(text) <= 60 else f"{text[:57]}…"


class _Reader:
    """SymPy trees to surface trees."""

    def __init__(self, module: Any) -> None:
        self.sympy = module

    def boolean(self, e: Any) -> s.Node:
        sp = self.sympy
        if e in (sp.true, sp.false):
            return s.Truth(e is sp.true)
        if isinstance(e, sp.core.relational.Relational):
            return compare(self.real(e.lhs), _RELATIONS[e.rel_op], self.real(e.rhs), -1)
        if isinstance(e, sp.And):
            return s.Every([self.boolean(a) for a in e.args])
        if isinstance(e, sp.Or):
            return s.Some([self.boolean(a) for a in e.args])
        if isinstance(e, sp.Not):
            return s.Negation(self.boolean(e.args[0]))
        if isinstance(e, sp.Implies):
            return s.Implication(self.boolean(e.args[0]), self.boolean(e.args[1]))
        if isinstance(e, sp.Equivalent):
            parts = [self.boolean(a) for a in e.args]
            return s.Every([s.Equivalence(parts[0], part) for part in parts[1:]])
        if isinstance(e, sp.Xor):
            return self.odd([self.boolean(a) for a in e.args])
        if isinstance(e, sp.ITE):
            condition, then, other = (self.boolean(a) for a in e.args)
            return s.Every([s.Implication(condition, then), s.Some([condition, other])])
        raise InputError(f"a Boolean combination of relations expected, {_shown(e)} found")

    def odd(self, parts: list[s.Node]) -> s.Node:
        """Whether an odd number of parts holds."""
        result: s.Node = s.Truth(False)
        for part in parts:
            result = s.Negation(s.Equivalence(result, part))
        return result

    def real(self, e: Any) -> Cases:
        sp = self.sympy
        if isinstance(e, sp.Symbol):
            return plain(s.Name(_symbol(e), -1))
        if isinstance(e, sp.Rational):
            return plain(s.Number(Fraction(int(e.p), int(e.q))))
        if isinstance(e, sp.Float):
            return plain(s.Number(self.exact_float(e)))
        if isinstance(e, sp.Add):
            return combine([self.real(a) for a in e.args], lambda terms: s.Sum(terms))
        if isinstance(e, sp.Mul):
            return combine([self.real(a) for a in e.args], _product)
        if isinstance(e, sp.Pow):
            return self.power(e)
        if isinstance(e, sp.Abs):
            inner = self.real(e.args[0])
            positive = compare(inner, Relation.GE, plain(s.Number(0)), -1)
            return choose(positive, inner, combine([inner], lambda terms: s.Minus(terms[0])))
        if isinstance(e, sp.Max | sp.Min):
            return self.extremum([self.real(a) for a in e.args], Relation.GE if isinstance(e, sp.Max) else Relation.LE)
        if isinstance(e, sp.Piecewise):
            return self.piecewise(e)
        raise InputError(f"only polynomials with rational coefficients are allowed, {_shown(e)} found")

    def exact_float(self, e: Any) -> Fraction:
        if not e.is_finite:
            raise InputError(f"a finite number expected, {e} found")
        return decimal_of(e)

    def power(self, e: Any) -> Cases:
        if not e.exp.is_Integer or e.exp < 0:
            reason = "division by a term" if e.exp.is_Integer else "an exponent that is no natural number"
            raise InputError(f"{reason}: {_shown(e)}; only polynomials are allowed")
        exponent = s.Number(int(e.exp))
        return combine([self.real(e.base)], lambda terms: s.Power(terms[0], exponent, -1))

    def extremum(self, parts: list[Cases], relation: Relation) -> Cases:
        best = parts[0]
        for part in parts[1:]:
            best = choose(compare(best, relation, part, -1), best, part)
        return best

    def piecewise(self, e: Any) -> Cases:
        *pairs, last = [(value, condition) for value, condition in e.args]
        if last[1] != self.sympy.true:
            raise InputError(f"the cases of {_shown(e)} must end with True")
        result = self.real(last[0])
        for value, condition in reversed(pairs):
            result = choose(self.boolean(condition), self.real(value), result)
        return result


def _product(terms: list[s.Term]) -> s.Term:
    result = terms[0]
    for term in terms[1:]:
        result = s.Product(result, term, -1)
    return result


def sympy_form(value: Formula | RealAlgebraic | FieldElement) -> Any:
    """What SymPy takes a value for: the Boolean of a formula, the number that equals a number."""
    if isinstance(value, Formula):
        return to_sympy(value)
    return number_to_sympy(value.to_algebraic() if isinstance(value, FieldElement) else value)


def to_sympy(formula: Formula, *, symbols: Mapping[str, Any] | None = None) -> Any:
    """The SymPy Boolean of a quantifier-free formula; ``subs`` with numbers for all variables decides it.

    ``symbols`` gives the symbols to use for names (default: ``Symbol(name)``). SymPy may simplify as it builds. Raises
    ``InputError`` for quantifiers and root atoms, which SymPy cannot express.
    """
    import sympy

    table = {name: sympy.Symbol(name) for name in names_in(formula)}
    table.update(symbols or {})
    return _boolean(formula, table, sympy)


def _boolean(formula: Formula, symbols: Mapping[str, Any], sp: Any) -> Any:
    match formula:
        case Constant(value):
            return sp.true if value else sp.false
        case Atom(poly, relation):
            columns = [symbols[name] for name in poly.ring.names]
            terms = [
                sp.Mul(sp.Integer(c), *(x**k for x, k in zip(columns, exponents) if k)) for exponents, c in poly.terms()
            ]
            return getattr(sp, _CLASSES[relation])(sp.Add(*terms), 0)
        case And(args):
            return sp.And(*(_boolean(arg, symbols, sp) for arg in args))
        case Or(args):
            return sp.Or(*(_boolean(arg, symbols, sp) for arg in args))
        case Not(arg):
            return sp.Not(_boolean(arg, symbols, sp))
    raise InputError("SymPy has no quantifiers and no root atoms; eliminate the quantifiers first")
