"""Formulas in Python without text: ``x, y = qe.variables("x y")``, ``(x**2 + y <= 1) & (y > x)``, ``qe.exists(x, f)``.

An ``Expression`` is a term, made of variables and exact numbers by ``+ - * / **`` and ``abs``; comparing two makes a
``Statement``, which is connected by ``& | ^ ~ >>`` and accepted wherever a formula is. The meaning is that of the text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, NoReturn

from qe import arguments
from qe.errors import InputError, NoTruthValue
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement
from qe.formula import build
from qe.formula.operators import Connected
from qe.formula.syntax import Formula, Relation
from qe.formula.traverse import atoms
from qe.io import surface as s
from qe.io.lowering import lower, lower_term
from qe.io.names import bound_names, check_name
from qe.io.substitution import over_one_ring, substitute
from qe.io.terms import Value
from qe.spelling import quoted

Operation = Callable[["Expression", object], "Expression"]


def _operator(build_term: Callable[[s.Term, s.Term], s.Term]) -> tuple[Operation, Operation]:
    """An operator of terms, and the same where the expression stands on its right."""

    def operation(self: Expression, other: object) -> Expression:
        return Expression(build_term(self.term, _term(other)))

    def reflected(self: Expression, other: object) -> Expression:
        return Expression(build_term(_term(other), self.term))

    return operation, reflected


def _comparison(relation: Relation) -> Callable[[Expression, object], Statement]:
    return lambda self, other: _compared(self, relation, other)


class Expression:
    """A term; ``str`` shows it as text."""

    __slots__ = ("term",)
    __array_ufunc__ = None  # numpy's scalars leave the operators to this class

    def __init__(self, term: s.Term) -> None:
        self.term: s.Term = term

    @property
    def is_Symbol(self) -> bool:
        """Whether it is a variable, which may be given where a name is asked for (as SymPy's symbols may)."""
        return isinstance(self.term, s.Name)

    @property
    def name(self) -> str:
        """The name of a variable."""
        if not isinstance(self.term, s.Name):
            raise InputError(f"a variable expected, {self} found")
        return self.term.name

    def polynomial(self) -> Value:
        """The polynomial that it is. Raises ``InputError`` where it is none."""
        return lower_term(self.term, s.unplaced)

    __add__, __radd__ = _operator(lambda a, b: s.Sum([a, b]))
    __sub__, __rsub__ = _operator(lambda a, b: s.Sum([a, s.Minus(b)]))
    __mul__, __rmul__ = _operator(lambda a, b: s.Product(a, b, -1))
    __truediv__, __rtruediv__ = _operator(lambda a, b: s.Quotient(a, b, -1))
    __pow__ = _operator(lambda a, b: s.Power(a, b, -1))[0]

    def __neg__(self) -> Expression:
        return Expression(s.Minus(self.term))

    def __pos__(self) -> Expression:
        return self

    def __abs__(self) -> Expression:
        return Expression(s.Apply("abs", [self.term], -1))

    __lt__, __le__ = _comparison(Relation.LT), _comparison(Relation.LE)
    __gt__, __ge__ = _comparison(Relation.GT), _comparison(Relation.GE)

    def equals(self, other: object) -> Statement:
        """The equation ``self = other``."""
        return _compared(self, Relation.EQ, other)

    def differs(self, other: object) -> Statement:
        """``self /= other``."""
        return _compared(self, Relation.NE, other)

    def __eq__(self, other: object) -> NoReturn:
        raise InputError("== and != compare objects; an equation is written x.equals(y), its negation x.differs(y)")

    __hash__ = object.__hash__

    def __bool__(self) -> NoReturn:
        raise NoTruthValue("a term has no truth value")

    def __repr__(self) -> str:
        return _shown(self.term)

    def _sympy_(self) -> Any:
        from qe.io.sympy import term_to_sympy

        return term_to_sympy(self.term)


class Statement(Connected):
    """A formula that Python's operators connect: ``f & g``, ``f | g``, ``~f``, ``f >> g`` (implication)."""

    __slots__ = ("formula",)
    __array_ufunc__ = None

    def __init__(self, formula: Formula) -> None:
        self.formula: Formula = formula

    @property
    def free(self) -> tuple[str, ...]:
        """The names of the free variables."""
        return self.formula.free

    @property
    def atoms(self) -> tuple[Statement, ...]:
        """The distinct atoms, from left to right."""
        return tuple(Statement(a) for a in dict.fromkeys(atoms(self.formula)))

    def substitute(self, values: Mapping[Any, object]) -> Statement:
        """The statement with numbers or terms in the place of free variables, all at once."""
        return Statement(substituted(self.formula, values))

    def __eq__(self, other: object) -> bool:
        if isinstance(other, bool):
            raise InputError("== compares formulas as they are written; their truth is asked with qe.decide")
        return isinstance(other, Statement) and self.formula == other.formula

    def __hash__(self) -> int:
        return hash(self.formula)

    def __bool__(self) -> NoReturn:
        """Python's ``and``, ``or``, ``not`` and chains ask for it and would drop a part without a word."""
        raise NoTruthValue(
            "a formula has no truth value here: connect formulas with & | ~ >> (and x < y < z as (x < y) & (y < z)), "
            "decide them with qe.decide"
        )

    def __str__(self) -> str:
        return str(self.formula)

    def __repr__(self) -> str:
        return f"Statement({self.formula})"

    def _repr_latex_(self) -> str | None:
        return self.formula._repr_latex_()

    def _sympy_(self) -> Any:
        return self.formula._sympy_()


def variables(names: object) -> Any:
    """Variables with these names (``"x y"``, ``"x, y"`` or a list) as a tuple; one alone comes without it. Typed as
    ``Any``, since what unpacks it says how many there are."""
    listed = arguments.names(names, "variables")
    if not listed:
        raise InputError("variables: at least one name expected")
    made = tuple(Expression(s.Name(check_name(name), -1)) for name in listed)
    return made[0] if len(made) == 1 and isinstance(names, str) and "," not in names else made


def exists(variables: object, body: object) -> Statement:
    """There are real values of the variables such that ``body``."""
    return Statement(build.exists(bound_names(variables), _formula(body)))


def forall(variables: object, body: object) -> Statement:
    """``body`` holds for all real values of the variables."""
    return Statement(build.forall(bound_names(variables), _formula(body)))


def _formula(given: object) -> Formula:
    if isinstance(given, Formula):
        return given
    if isinstance(given, Statement):
        return given.formula
    if isinstance(given, Expression):
        raise InputError(f"a formula expected, the term {given} found")
    if isinstance(given, str):
        from qe.io.text import read

        return read(given)
    from qe.io.smtlib import from_solver

    if (formula := from_solver(given)) is not None:
        return formula
    from qe.io.sympy import from_sympy

    return from_sympy(given)


def substituted(formula: Formula, values: Mapping[Any, object]) -> Formula:
    """The formula with numbers or terms in the place of free variables, all at once."""
    given = arguments.by_name(values, "values")
    return substitute(formula, {name: _term(value) for name, value in given.items()})


def connected(way: str, *parts: object) -> Formula | Statement:
    """The formula that ``and``, ``or``, ``xor``, ``implies`` or ``not`` makes; a ``Statement`` where one takes part."""
    made = build.JOINS[way](*over_one_ring(*map(_formula, parts)))
    return Statement(made) if any(isinstance(part, Statement) for part in parts) else made


def _compared(left: Expression, relation: Relation, right: object) -> Statement:
    return Statement(lower(s.Comparison([left.term, _term(right)], [relation], -1), s.unplaced))


def graph_of(name: str, given: object) -> Formula:
    """Where a variable of this name has the value of a term; what has no value has none."""
    from qe.io import smtlib

    if (graph := smtlib.graph_of(name, given)) is not None:
        return graph
    return lower(s.Comparison([s.Name(name, -1), _term(given)], [Relation.EQ], -1), s.unplaced)


def _term(given: object) -> s.Term:
    """A number, an expression, text, or a SymPy expression as a term."""
    if isinstance(given, Expression):
        return given.term
    if isinstance(given, RealAlgebraic | FieldElement):
        return s.Algebraic(given if isinstance(given, RealAlgebraic) else given.to_algebraic(), -1)
    if isinstance(given, bool):
        raise arguments.wrong("term", "a number or an expression", given)
    if isinstance(given, str):
        from qe.io.text import read_term

        return read_term(given)
    if hasattr(given, "free_symbols"):  # SymPy's own
        from qe.io.sympy import term_from_sympy

        return term_from_sympy(given)
    return s.Number(arguments.rational(given, "term", "a number or an expression"))


def _shown(term: s.Term) -> str:
    """The term as text."""
    match term:
        case s.Name(name):
            return quoted(name)
        case s.Number(value):
            shown = str(Fraction(value))
            return shown if shown.isdigit() else f"({shown})"
        case s.Algebraic(number):
            return f"({number})"
        case s.Sum(parts):
            return f"({' + '.join(map(_shown, parts))})".replace("+ -", "- ")
        case s.Product(left, right):
            return f"{_shown(left)}*{_shown(right)}"
        case s.Quotient(left, right):
            return f"{_shown(left)}/({_shown(right)})"
        case s.Power(base, exponent):
            return f"({_shown(base)})^{_shown(exponent)}"
        case s.Minus(part):
            return f"-{_shown(part)}"
        case s.Apply(function, parts):
            return f"{function}({', '.join(map(_shown, parts))})"
    return "…"
