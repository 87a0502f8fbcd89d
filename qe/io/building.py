"""Terms as most formats write them, and the actions that build surface trees for all of them."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from typing import Any
from unicodedata import normalize

from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.terms import TermError, decimal
from qe.io.text_errors import SyntaxFailure, UnknownFunction

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
    **{name: name for name in s.FUNCTIONS},
    **{name.capitalize(): name for name in s.FUNCTIONS},
    **{name.upper(): name for name in s.FUNCTIONS},
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

SIGNS = {"+": "PLUS", "-": "MINUS", "*": "TIMES", "/": "OVER", "^": "POWER", "(": "OPEN", ")": "CLOSE"}
"""The terminals of the signs that terms have in every format."""

ARITHMETIC = """
?sum: product | sum PLUS product -> plus
     | sum MINUS product        -> minus
?product: factor | product TIMES factor -> times
     | product OVER factor      -> over
?factor: power | MINUS factor   -> negative
     | PLUS factor              -> positive
?power: primary | primary POWER exponent -> to_power
?exponent: primary | MINUS primary -> negative
"""
"""The rules of terms by precedence, above ``primary``."""

TERMS = f"""
comparison: sum RELATION sum | comparison RELATION sum
{ARITHMETIC}
?primary: NUMBER                -> number
     | NAME                     -> name
     | NAME OPEN arguments CLOSE -> call
     | OPEN sum CLOSE           -> brackets
arguments: sum | arguments COMMA sum
"""

CONNECTIVES = """
?formula: c3 | formula IFF c3   -> iff
?c3: c2 | c2 IMPLIES c3         -> implies
     | c2 REPL c3               -> replied
?c2: c1 | c2 OR c1              -> some
?c1: c0 | c1 AND c0             -> every
?c0: base | NOT c0              -> negation
"""
"""The rules of formulas by precedence, above ``base``, with the implication that is written backwards, too."""


class Builder:
    """The actions of the grammar that other formats share."""

    def names(self, c: list[Any]) -> list[str]:
        if len(c) == 1:
            return [str(c[0])]
        return [*c[0], str(c[2])]

    def iff(self, c: list[Any]) -> s.Node:
        return s.Equivalence(c[0], c[2])

    def implies(self, c: list[Any]) -> s.Node:
        return s.Implication(c[0], c[2])

    def replied(self, c: list[Any]) -> s.Node:
        return s.Implication(c[2], c[0])

    def some(self, c: list[Any]) -> s.Node:
        if isinstance(c[0], s.Some):
            c[0].parts.append(c[2])
            return c[0]
        return s.Some([c[0], c[2]])

    def every(self, c: list[Any]) -> s.Node:
        if isinstance(c[0], s.Every):
            c[0].parts.append(c[2])
            return c[0]
        return s.Every([c[0], c[2]])

    def negation(self, c: list[Any]) -> s.Node:
        return c[1].part if isinstance(c[1], s.Negation) else s.Negation(c[1])

    def true(self, c: list[Any]) -> s.Node:
        return s.Truth(True)

    def false(self, c: list[Any]) -> s.Node:
        return s.Truth(False)

    def brackets(self, c: list[Any]) -> Any:
        return c[1]

    def comparison(self, c: list[Any]) -> s.Comparison:
        relation = RELATIONS[c[1]]
        if isinstance(c[0], s.Comparison):
            c[0].relations.append(relation)
            c[0].sides.append(c[2])
            return c[0]
        return s.Comparison([c[0], c[2]], [relation], c[1].start_pos)

    def plus(self, c: list[Any]) -> s.Term:
        if isinstance(c[0], s.Sum):
            c[0].parts.append(c[2])
            return c[0]
        return s.Sum([c[0], c[2]])

    def minus(self, c: list[Any]) -> s.Term:
        return self.plus([c[0], c[1], s.Minus(c[2])])

    def times(self, c: list[Any]) -> s.Term:
        return s.Product(c[0], c[2], c[1].start_pos)

    def over(self, c: list[Any]) -> s.Term:
        return s.Quotient(c[0], c[2], c[1].start_pos)

    def negative(self, c: list[Any]) -> s.Term:
        return c[1].part if isinstance(c[1], s.Minus) else s.Minus(c[1])

    def positive(self, c: list[Any]) -> Any:
        return c[1]

    def to_power(self, c: list[Any]) -> s.Term:
        return s.Power(c[0], c[2], c[1].start_pos)

    def number(self, c: list[Any]) -> s.Term:
        if not c[0].isascii():  # ½ and its kind
            return s.Number(Fraction(normalize("NFKC", c[0]).replace("⁄", "/")))
        try:
            value = decimal(c[0])
        except TermError as error:
            raise SyntaxFailure(str(error), c[0].start_pos) from None
        return s.Number(value)

    def name(self, c: list[Any]) -> s.Term:
        return s.Name(str(c[0]), c[0].start_pos)

    def arguments(self, c: list[Any]) -> list[s.Term]:
        if len(c) == 1:
            return [c[0]]
        return [*c[0], c[2]]

    def call(self, c: list[Any]) -> s.Term:
        name, arguments = c[0], c[2]
        function = FUNCTIONS.get(str(name))
        if function is not None:
            least, most = s.FUNCTIONS[function]
            if not least <= len(arguments) <= most:
                raise SyntaxFailure(f"{name} takes {least} argument{'s' if least > 1 else ''}", name.start_pos)
            return s.Apply(function, arguments, name.start_pos)
        if (operation := OPERATIONS.get(str(name))) is not None and (len(arguments) == 2 or name in ("Plus", "Times")):
            made: s.Term = reduce(lambda left, right: operation(left, right, name.start_pos), arguments)
            return made
        if name not in ("root", "Root"):
            raise UnknownFunction(str(name), name.start_pos)
        variable = arguments[2] if len(arguments) == 3 else None
        if len(arguments) not in (2, 3) or not (variable is None or isinstance(variable, s.Name)):
            usage = "root takes a number, a polynomial and perhaps a variable: root(2, x^2 - y, x)"
            raise SyntaxFailure(usage, name.start_pos)
        number, poly = arguments[:2]
        if isinstance(poly, s.Name) and isinstance(number, s.Number) and number.value > 1:
            radical = f"{poly.name}^(1/{number.value})"
            raise SyntaxFailure(f"root(k, p) is the k-th root of a polynomial; a radical is {radical}", name.start_pos)
        if isinstance(poly, s.Number):
            usage = f"root takes a number, then a polynomial; a radical is t^(1/{poly.value})"
            raise SyntaxFailure(usage, name.start_pos)
        return s.Root(number, poly, variable.name if variable else None, name.start_pos)
