"""Questions of SymPy users with answers as SymPy objects, exact and complete: what ``sympy.solvers`` does for one
variable and many special cases is decided here for every semialgebraic problem.

Expressions and conditions are SymPy's (relations, ``And Or Not``, ``Contains``, ``Piecewise``, ``Abs``, roots); what
is assumed to be positive, nonnegative, ... is taken at its word. All take ``timeout`` in seconds and raise
``qe.Unable`` at the limit, ``qe.InputError`` for what is not semialgebraic.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import sympy
from sympy.logic.boolalg import Boolean

import qe.api.decide as api_decide
import qe.api.eliminate as api
import qe.api.optimum as api_optimum
import qe.api.solve as api_solve
from qe import arguments
from qe.api.limits import read_under
from qe.errors import InputError, Unable
from qe.formula.build import conj, forall
from qe.formula.numbers import unknowns
from qe.formula.syntax import Formula
from qe.io.substitution import over_one_ring
from qe.io.sympy import Exists, ForAll, expression_from, from_sympy, to_sympy
from qe.optimization.values import new_name
from qe.processes.limits import Limits

__all__ = ["function_range", "is_true_for_all", "maximum", "minimum", "reduce_inequalities", "solve_region"]

Condition = Any
"""A SymPy Boolean, or a list of them, which hold together."""


def reduce_inequalities(
    inequalities: Condition, symbols: Iterable[Any] | Any = (), *, timeout: float | None = None
) -> Boolean:
    """The same condition, solved for ``symbols`` (without them: for all): what SymPy's function of this name does.

    An ``Or`` of cases, each an ``And`` of relations that put a symbol between ends in terms of the other symbols and of
    those of ``symbols`` before it; relations with infinities are left out. Where an end is no term of SymPy (a root
    with parameters that is no radical), the conditions are simplified only. Equations, ``Ne``, ``And``, ``Or`` and
    parameters are taken, too; constants such as ``pi`` may occur wherever symbols may.
    """
    question = _Question.of(inequalities, timeout)
    free = question.free
    wanted = [name for name in _names(symbols) if name in free] or free
    found = question.solved(wanted, timeout)
    if found is not None:
        return found
    answer = api.eliminate(question.formula, timeout=timeout)
    if answer.formula is None:
        raise Unable(answer.reason or "no answer")
    return to_sympy(answer.formula, symbols=question.symbols)


def solve_region(condition: Condition, symbol: Any = None, *, timeout: float | None = None) -> sympy.Set:
    """The set of all real values of the only free symbol that satisfy the condition, as a SymPy set.

    Intervals and points with exact ends. Raises ``InputError`` where there are several free symbols.
    """
    question = _Question.of(condition, timeout)
    free = question.free
    names = _names(() if symbol is None else symbol)
    others = [name for name in free if name not in names]
    if (names and others) or len({*free, *names}) > 1:
        found = ", ".join(dict.fromkeys((*free, *names)))
        raise InputError(f"one free symbol expected, {found} found; reduce_inequalities takes several")
    return _set_of(question, next(iter((*names, *free)), "x"), timeout)


def function_range(
    function: Any, symbols: Iterable[Any] | Any = None, condition: Condition = True, *, timeout: float | None = None
) -> sympy.Set:
    """The set of all values of an expression in real ``symbols`` (all it has) under a condition, as a SymPy set.

    For one symbol the condition may be its domain, a SymPy set.
    """
    function, names, parts = _posed(function, symbols, condition)
    if others := {*_symbols_of([function, *parts])} - {*_names(names)}:
        raise InputError(f"symbols: all of the expression expected ({', '.join(sorted(others))}); minimum takes others")
    return _set_of(*_values(function, names, parts, timeout), timeout)


def minimum(
    function: Any, symbols: Iterable[Any] | Any = None, condition: Condition = True, *, timeout: float | None = None
) -> sympy.Expr:
    """The greatest lower bound of an expression under a condition; oo where nothing satisfies it.

    With symbols that are none of ``symbols`` it is a ``Piecewise`` of them, which has no value where nothing does.
    """
    return _bound("minimize", function, symbols, condition, timeout)


def maximum(
    function: Any, symbols: Iterable[Any] | Any = None, condition: Condition = True, *, timeout: float | None = None
) -> sympy.Expr:
    """The least upper bound of an expression under a condition, as in ``minimum``; -oo where nothing satisfies it."""
    return _bound("maximize", function, symbols, condition, timeout)


def is_true_for_all(condition: Condition, *, timeout: float | None = None) -> bool:
    """Whether the condition holds for all real values of its symbols that fit their assumptions."""
    question, symbols = _Question.of(condition, timeout), _symbols_of(condition)
    parts = question.parts
    whole = parts[0] if len(parts) == 1 else sympy.And(*parts, evaluate=False)
    formula = ForAll(list(symbols.values()), whole).formula() if symbols else question.formula
    return api_decide.decide(forall(unknowns(formula.free), formula), timeout=timeout)


def _posed(function: Any, symbols: Any, condition: Condition) -> tuple[Any, list[Any], list[Any]]:
    """The expression, the symbols over which it ranges, and the conditions."""
    function = expression_from(function)
    names = _listed(symbols) if symbols is not None else sorted(function.free_symbols, key=str)
    if isinstance(condition, sympy.Set):
        if len(names) != 1:
            raise InputError(f"condition: a domain goes with one symbol, {len(names)} found")
        condition = sympy.Contains(names[0], condition)
    return function, names, [] if condition is True else _conditions(condition)


def _values(function: Any, names: list[Any], parts: list[Any], timeout: float | None) -> tuple[_Question, str]:
    """The question which values are taken, and the variable for them."""
    value = new_name(symbol.name for symbol in function.free_symbols)
    equation = sympy.Eq(sympy.Symbol(value, real=True), function, evaluate=False)
    question = _Question.of([equation, *parts], timeout)
    return replace(question, formula=Exists(names, question.formula).formula()) if names else question, value


def _bound(way: str, function: Any, symbols: Any, condition: Condition, timeout: float | None) -> Any:
    function, names, parts = _posed(function, symbols, condition)
    known, given = _names(names), _symbols_of([function, *parts])
    if parameters := [name for name in given if name not in known]:
        conditions = [from_sympy(sympy.sympify(part) if isinstance(part, bool) else part) for part in parts]
        found = getattr(api_optimum, way)(function, conditions, parameters=parameters, timeout=timeout)
        return found.to_sympy().xreplace({sympy.Symbol(name): symbol for name, symbol in given.items()})
    least, values = way == "minimize", _set_of(*_values(function, names, parts, timeout), timeout)
    if values is sympy.S.EmptySet:
        return sympy.oo if least else -sympy.oo
    return values.inf if least else values.sup


def _conditions(given: Condition) -> list[Any]:
    return list(given) if isinstance(given, list | tuple | set | frozenset) else [given]


def _listed(symbols: Any) -> list[Any]:
    if symbols is None:
        return []
    return list(symbols) if isinstance(symbols, Iterable) and not isinstance(symbols, str) else [symbols]


def _names(symbols: Any) -> list[str]:
    return [arguments.name(symbol, "symbols") for symbol in _listed(symbols)]


def _symbols_of(given: Condition) -> dict[str, Any]:
    return {s.name: s for part in _conditions(given) for s in getattr(part, "free_symbols", ())}


@dataclass(frozen=True, slots=True)
class _Question:
    """A condition as a formula, and its ``parts`` as they are read, which hold together. ``symbols``: by name."""

    formula: Formula
    symbols: Mapping[str, Any]
    parts: tuple[Any, ...]

    @staticmethod
    def of(given: Condition, timeout: float | None = None) -> _Question:
        """The conditions together, read within the time."""
        return read_under(Limits(arguments.seconds(timeout)), partial(_Question._of, given), *_conditions(given))

    @staticmethod
    def _of(given: Condition) -> _Question:
        parts = [sympy.sympify(part) if isinstance(part, bool) else part for part in _conditions(given)]
        return _Question(conj(over_one_ring(*map(from_sympy, parts))), _symbols_of(given), tuple(parts))

    @property
    def free(self) -> list[str]:
        """The free variables."""
        return unknowns(self.formula.free)

    def solved(self, wanted: list[str], timeout: float | None) -> Any:
        """The cases, solved for these variables; None where SymPy has no term for an end."""
        terms = {sympy.Symbol(name): symbol for name, symbol in self.symbols.items()}
        solutions = api_solve.solve(self.formula, wanted, timeout=timeout)
        try:
            return solutions.to_sympy().xreplace(terms)
        except InputError:
            return None


def _set_of(question: _Question, name: str, timeout: float | None) -> Any:
    """The solutions of a condition in one variable."""
    try:
        found = api_solve.solve(question.formula, [name], timeout=timeout).to_sympy()
    except InputError:
        raise Unable("an end of the set is no term of SymPy") from None
    return sympy.S.Reals if found is sympy.true else found.as_set()
