"""Formulas of z3 and pySMT, which are imported when something of theirs is given: what their own printers write is read
as SMT-LIB. x/0 is some number, and a Boolean constant p becomes a real variable with ``p > 0``.
"""

from __future__ import annotations

from typing import Any

from qe.errors import InputError
from qe.formula.syntax import TRUE, Formula
from qe.io import smtlib


def from_solver(given: Any) -> Formula | None:
    """The formula of an object of z3 or pySMT; None for any other."""
    doors = {"z3": from_z3, "pysmt": _from_pysmt}
    door = doors.get(type(given).__module__.partition(".")[0])
    return None if door is None else door(given)


def graph_of(name: str, given: Any) -> Formula | None:
    """Where a variable of this name has the value of a term of z3; None for any other."""
    if type(given).__module__.partition(".")[0] != "z3":
        return None
    import z3

    return from_z3(z3.Real(name, given.ctx) == given)


def from_z3(given: Any) -> Formula:
    """The formula of a z3 expression of sort Bool, of a list of them (their conjunction), or of what a solver holds.

    Raises ``InputError`` for what is not about real numbers.
    """
    if hasattr(given, "assertions"):
        if hasattr(given, "to_smt2"):
            return smtlib.read(given.to_smt2(), source="<z3>")
        given = list(given.assertions())  # an optimiser
        if not given:
            return TRUE
    parts = list(given) if isinstance(given, list | tuple) else [given]
    if not parts or not all(hasattr(part, "sexpr") and hasattr(part, "ctx") for part in parts):
        raise InputError("from_z3: a Boolean expression of z3, a list of them, or a solver expected")
    import z3

    solver = z3.Solver(ctx=parts[0].ctx)
    try:
        solver.add(*parts)
    except z3.Z3Exception as error:
        raise InputError(f"from_z3: Boolean expressions expected: {str(error).splitlines()[0]}") from None
    return smtlib.read(solver.to_smt2(), source="<z3>")


def _from_pysmt(given: Any) -> Formula:
    from pysmt.smtlib.printers import to_smtlib
    from pysmt.utils import quote

    if not hasattr(given, "get_free_variables") or not given.get_type().is_bool_type():
        raise InputError("a pySMT formula expected, a term found")
    lines = []
    for symbol in sorted(given.get_free_variables(), key=lambda symbol: str(symbol.symbol_name())):
        lines.append(f"(declare-const {quote(symbol.symbol_name())} {symbol.symbol_type()})")
    return smtlib.read("\n".join([*lines, f"(assert {to_smtlib(given)})"]), source="<pysmt>")
