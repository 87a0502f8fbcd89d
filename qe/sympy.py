"""Questions of SymPy users with answers as SymPy objects, exact and complete: what ``sympy.solvers`` does for one
variable and many special cases is decided here for every semialgebraic problem.

Expressions and conditions are SymPy's (relations, ``And Or Not``, ``Contains``, ``Piecewise``, ``Abs``, roots); what
is assumed to be positive, nonnegative, ... is taken at its word. All take ``timeout`` in seconds and raise
``qe.Unable`` at the limit, ``qe.InputError`` for what is not semialgebraic.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import qe.api.decide as api_decide
import qe.api.eliminate as api
from qe import arguments
from qe.cells.pieces import RootFunction
from qe.errors import InputError, Unable
from qe.formula.build import conj, forall
from qe.formula.syntax import Formula
from qe.formula.traverse import free_variables
from qe.io.substitution import over_one_ring
from qe.io.sympy import Exists, ForAll, from_sympy, to_sympy
from qe.io.sympy_numbers import number_to_sympy

Condition = Any
"""A SymPy Boolean, or a list of them, which hold together."""


def reduce_inequalities(
    inequalities: Condition, symbols: Iterable[Any] | Any = (), *, timeout: float | None = None
) -> Any:
    """An equivalent condition on the other symbols: some real values of ``symbols`` satisfy the inequalities.

    Without ``symbols`` the inequalities are simplified. The result is a SymPy Boolean. Note that in SymPy's function of
    this name ``symbols`` are those to solve for; for one symbol use ``solve_region``.
    """
    listed = _listed(symbols)
    given = _together(inequalities)
    formula = Exists(listed, given).formula() if listed else given
    return _quantifier_free(formula, _symbols_of(inequalities), timeout)


def solve_region(condition: Condition, symbol: Any = None, *, timeout: float | None = None) -> Any:
    """The set of all real values of the only free symbol that satisfy the condition, as a SymPy set.

    Intervals and points with exact ends. Raises ``InputError`` where there are several free symbols.
    """
    formula = _together(condition)
    free = free_variables(formula)
    names = () if symbol is None else (arguments.name(symbol, "symbol"),)
    others = [name for name in free if name not in names]
    if (names and others) or len(free) > 1:
        raise InputError(f"one free symbol expected, {', '.join(free)} found")
    return _set_of(formula, next(iter((*names, *free)), "x"), timeout)


def function_range(
    function: Any, symbols: Iterable[Any] | Any = None, condition: Condition = True, *, timeout: float | None = None
) -> Any:
    """The set of all values of an expression in real ``symbols`` (all it has) under a condition, as a SymPy set.

    For one symbol the condition may be its domain, a SymPy set.
    """
    import sympy

    function = sympy.sympify(function)
    names = _listed(symbols) if symbols is not None else sorted(function.free_symbols, key=str)
    if isinstance(condition, sympy.Set):
        if len(names) != 1:
            raise InputError(f"condition: a domain goes with one symbol, {len(names)} found")
        condition = sympy.Contains(names[0], condition)
    value = sympy.Dummy("value").name
    while value in {symbol.name for symbol in function.free_symbols}:
        value += "_"
    equation = sympy.Eq(sympy.Symbol(value, real=True), function, evaluate=False)
    parts = [equation] if condition is True else [equation, *_conditions(condition)]
    given = _together(parts)
    return _set_of(Exists(names, given).formula() if names else given, value, timeout)


def minimum(
    function: Any, symbols: Iterable[Any] | Any = None, condition: Condition = True, *, timeout: float | None = None
) -> Any:
    """The greatest lower bound of an expression under a condition; oo where nothing satisfies it."""
    import sympy

    found = function_range(function, symbols, condition, timeout=timeout)
    return sympy.oo if found is sympy.S.EmptySet else found.inf


def maximum(
    function: Any, symbols: Iterable[Any] | Any = None, condition: Condition = True, *, timeout: float | None = None
) -> Any:
    """The least upper bound of an expression under a condition; -oo where nothing satisfies it."""
    import sympy

    found = function_range(function, symbols, condition, timeout=timeout)
    return -sympy.oo if found is sympy.S.EmptySet else found.sup


def is_true_for_all(condition: Condition, *, timeout: float | None = None) -> bool:
    """Whether the condition holds for all real values of its symbols that fit their assumptions."""
    import sympy

    symbols, parts = _symbols_of(condition), [_boolean(part) for part in _conditions(condition)]
    whole = sympy.And(*parts, evaluate=False) if len(parts) > 1 else parts[0]
    formula = ForAll(list(symbols.values()), whole).formula() if symbols else from_sympy(whole)
    return api_decide.decide(forall(free_variables(formula), formula), timeout=timeout)


def _conditions(given: Condition) -> list[Any]:
    return list(given) if isinstance(given, list | tuple | set | frozenset) else [given]


def _listed(symbols: Any) -> list[Any]:
    if symbols is None:
        return []
    return list(symbols) if isinstance(symbols, Iterable) and not isinstance(symbols, str) else [symbols]


def _together(given: Condition) -> Formula:
    parts = [from_sympy(_boolean(part)) for part in _conditions(given)]
    return conj(over_one_ring(*parts))


def _boolean(part: Any) -> Any:
    import sympy

    if isinstance(part, bool):  # what SymPy's own functions return for a relation that is decided
        return sympy.true if part else sympy.false
    return part


def _symbols_of(given: Condition) -> dict[str, Any]:
    return {s.name: s for part in _conditions(given) for s in getattr(part, "free_symbols", ())}


def _quantifier_free(formula: Formula, symbols: dict[str, Any], timeout: float | None) -> Any:
    answer = api.eliminate(formula, timeout=timeout)
    if answer.formula is None:
        raise Unable(answer.reason or "no answer")
    return to_sympy(answer.formula, symbols=symbols)


def _set_of(formula: Formula, name: str, timeout: float | None) -> Any:
    """The solutions of a formula in one variable."""
    import sympy

    region = api.region(formula, order=(name,), timeout=timeout)
    parts = []
    for piece in region.cells:
        within = piece.ranges[0]
        low, high = _end(within.lower, -sympy.oo), _end(within.upper, sympy.oo)
        parts.append(sympy.Interval(low, high, not within.lower_closed, not within.upper_closed))
    return sympy.Union(*parts) if parts else sympy.S.EmptySet


def _end(root: RootFunction | None, unbounded: Any) -> Any:
    """An end of a piece of a line."""
    if root is None:
        return unbounded
    assert root.value is not None  # there are no variables before the first
    return number_to_sympy(root.value)
