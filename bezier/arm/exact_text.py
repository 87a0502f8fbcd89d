"""Exact numbers from text, square roots included: ``44*sqrt(2) + 8*sqrt(293) + 120``."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from bezier.input.numbers import MAX_CHARACTERS, NotANumber, parse, shorten
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic

Exact = Fraction | RealAlgebraic

EXPECTED = 'an exact number such as 3/4, 0.75 or "44*sqrt(2) + 120"'
MOST_ROOTS = 4
_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def read_exact(text: str) -> Exact:
    """The number that the text stands for, also with the minus sign of printed pages. Raises ``InputError``."""
    text = text.replace("−", "-")
    try:
        return parse(text)
    except NotANumber as error:
        if "sqrt" not in text or len(text) > MAX_CHARACTERS:
            raise InputError(f"expected {EXPECTED}, found {error}") from None
    refused = InputError(f'expected {EXPECTED}, found "{shorten(text)}"')
    if text.count("sqrt") > MOST_ROOTS:
        raise InputError(f"expected at most {MOST_ROOTS} square roots in a number, found {text.count('sqrt')}")
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise refused from None
    value = _value(tree.body, text.strip(), refused)
    return value.as_fraction() if isinstance(value, RealAlgebraic) and value.is_rational else value


def _value(node: ast.expr, text: str, refused: InputError) -> Any:
    match node:
        case ast.Constant(value=int() | float()) if not isinstance(node.value, bool):
            try:
                return parse(ast.get_source_segment(text, node) or "")  # the digits as written, never a float
            except NotANumber:
                raise refused from None
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=inner):
            value = _value(inner, text, refused)
            return -value if isinstance(sign, ast.USub) else value
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            a, b = _value(left, text, refused), _value(right, text, refused)
            if isinstance(op, ast.Div) and b == 0:
                raise InputError(f'expected {EXPECTED}, found "{shorten(text)}", which divides by zero')
            return _BINARY[type(op)](a, b)
        case ast.Call(func=ast.Name(id="sqrt"), args=[inner], keywords=[]):
            return _root(_value(inner, text, refused), text)
    raise refused


def _root(value: Any, text: str) -> RealAlgebraic:
    if isinstance(value, RealAlgebraic) and value.is_rational:
        value = value.as_fraction()
    if not isinstance(value, Fraction):
        raise InputError(f'expected square roots of rational numbers, found "{shorten(text)}"')
    if value < 0:
        raise InputError(f'expected {EXPECTED}, found "{shorten(text)}", with the root of a negative number')
    return RealAlgebraic.from_root([-value.numerator, 0, value.denominator], 0, value + 1)
