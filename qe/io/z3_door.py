"""Formulas from z3: what its own printer writes is read as SMT-LIB. z3 is imported when something of it is given."""

from __future__ import annotations

from typing import Any

from qe.errors import InputError
from qe.formula.syntax import TRUE, Formula
from qe.io import smtlib


def from_z3(given: Any) -> Formula:
    """The formula of a z3 expression of sort Bool, of a list of them (their conjunction), or of what a solver holds.

    A Boolean constant p becomes a real variable with ``p > 0``, as in SMT-LIB; x/0 is some number. Raises
    ``InputError`` for what is not about real numbers.
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
