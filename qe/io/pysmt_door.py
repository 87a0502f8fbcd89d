"""pySMT formulas: what its own printer writes is read as SMT-LIB. pySMT is imported when something of it is given."""

from __future__ import annotations

from typing import Any

from qe.errors import InputError
from qe.formula.syntax import Formula
from qe.io import smtlib


def from_pysmt(given: Any) -> Formula:
    """The formula of a pySMT formula over the reals; a Boolean symbol p becomes a real variable with ``p > 0``.

    Raises ``InputError`` for terms, and for what is not about real numbers.
    """
    from pysmt.smtlib.printers import to_smtlib
    from pysmt.utils import quote

    if not hasattr(given, "get_free_variables") or not given.get_type().is_bool_type():
        raise InputError("a pySMT formula expected, a term found")
    lines = []
    for symbol in sorted(given.get_free_variables(), key=lambda symbol: str(symbol.symbol_name())):
        lines.append(f"(declare-const {quote(symbol.symbol_name())} {symbol.symbol_type()})")
    return smtlib.read("\n".join([*lines, f"(assert {to_smtlib(given)})"]), source="<pysmt>")
