"""What readers know by name: relations, functions, Mathematica's operations, and roots."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce

from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.text_errors import SyntaxFailure, unknown_function
from qe.io.tokens import Token

RELATIONS = {
    **{relation.value: relation for relation in Relation},
    **dict.fromkeys(("==", "\\[Equal]", "Eq", "Equal"), Relation.EQ),
    **dict.fromkeys(("!=", "~=", "<>", "=/=", "=!=", "≠", "\\[NotEqual]", "Ne", "Unequal"), Relation.NE),
    **dict.fromkeys(("=<", "≤", "⩽", "\\[LessEqual]", "Le", "LessEqual"), Relation.LE),
    **dict.fromkeys(("≥", "⩾", "\\[GreaterEqual]", "Ge", "GreaterEqual"), Relation.GE),
    **dict.fromkeys(("Lt", "Less"), Relation.LT),
    **dict.fromkeys(("Gt", "Greater"), Relation.GT),
}
FUNCTIONS = {
    **{spelt: name for name in s.FUNCTIONS for spelt in (name, name.capitalize(), name.upper())},
    **dict.fromkeys(("sgn", "Sgn"), "sign"),
    "CubeRoot": "cbrt",
}
OPERATIONS: dict[str, Callable[[s.Term, s.Term, int], s.Term]] = {
    "Plus": lambda a, b, at: s.Sum([a, b]),
    "Times": s.Product,
    "Power": s.Power,
    "Rational": s.Quotient,
    "Divide": s.Quotient,
    "Subtract": lambda a, b, at: s.Sum([a, s.Minus(b)]),
}
"""Mathematica's names for the signs of operations."""


def applied(text: str, token: Token, arguments: list[s.Term]) -> s.Term:
    """What the name ``token`` means in front of arguments. Raises ``SyntaxFailure`` where that is nothing."""
    name, at = token.text, token.at
    function = FUNCTIONS.get(name)
    if function is not None:
        least, most = s.FUNCTIONS[function]
        if not least <= len(arguments) <= most:
            raise SyntaxFailure(f"{name} takes {least} argument{'s' if least > 1 else ''}", at)
        return s.Apply(function, arguments, at)
    if (operation := OPERATIONS.get(name)) is not None and (len(arguments) == 2 or name in ("Plus", "Times")):
        made: s.Term = reduce(lambda left, right: operation(left, right, at), arguments)
        return made
    if name not in ("root", "Root"):
        raise unknown_function(text, name, at)
    variable = arguments[2] if len(arguments) == 3 else None
    if len(arguments) not in (2, 3) or not (variable is None or isinstance(variable, s.Name)):
        raise SyntaxFailure("root takes a number, a polynomial and perhaps a variable: root(2, x^2 - y, x)", at)
    number, poly = arguments[:2]
    if isinstance(poly, s.Name) and isinstance(number, s.Number) and number.value > 1:
        radical = f"{poly.name}^(1/{number.value})"
        raise SyntaxFailure(f"root(k, p) is the k-th root of a polynomial; a radical is {radical}", at)
    if isinstance(poly, s.Number):
        raise SyntaxFailure(f"root takes a number, then a polynomial; a radical is t^(1/{poly.value})", at)
    return s.Root(number, poly, variable.name if variable else None, at)
