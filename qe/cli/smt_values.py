"""Values in SMT-LIB: numbers as models print them, and terms at a point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import pairwise
from math import prod
from typing import Any

from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.sparse_text import digits
from qe.io import surface as s

Number = Any
"""``int``, ``Fraction`` or ``RealAlgebraic``."""
Outside = Callable[[str, Number], Number]
"""The value of a function at an argument outside its domain."""


def written(number: Number) -> str:
    """A number: a decimal, a quotient, or ``(root-obj p k)`` for the k-th real root of p."""
    if isinstance(number, RealAlgebraic):
        if not number.is_rational:
            return _root_object(number)
        number = number.as_fraction()
    value = Fraction(number)
    top = f"{digits(abs(value.numerator))}.0"
    size = top if value.denominator == 1 else f"(/ {top} {digits(value.denominator)}.0)"
    return f"(- {size})" if value < 0 else size


def _root_object(number: RealAlgebraic) -> str:
    terms = []
    for k, c in reversed(list(enumerate(number.minimal_polynomial))):
        if c:
            power = "x" if k == 1 else f"(^ x {k})"
            whole = digits(c) if c > 0 else f"(- {digits(-c)})"
            terms.append(whole if k == 0 else power if c == 1 else f"(* {whole} {power})")
    return f"(root-obj (+ {' '.join(terms)}) {number.index + 1})"


class Evaluation:
    """Terms and formulas without quantifiers at one point; ``point`` gives the values by name in formulas."""

    def __init__(self, point: Mapping[str, Number], outside: Outside) -> None:
        self.point, self.outside = point, outside
        # what an identity is of is kept with it: that of a term that is gone may be given to another
        self.known: dict[int, tuple[object, Number]] = {}

    def term(self, term: s.Term) -> Number:
        """The value of a term."""
        if (known := self.known.get(id(term))) is None:
            known = self.known[id(term)] = term, self._term(term)
        return known[1]

    def _term(self, term: s.Term) -> Number:
        match term:
            case s.Number(value):
                return Fraction(value)
            case s.Name(name):
                return self.point.get(name, Fraction(0))
            case s.Polynomial(terms):
                values = (prod((self.point.get(name, 0) for name in names), start=c) for names, c in terms.items())
                return sum(values, Fraction(0))
            case s.Sum(parts):
                return sum((self.term(part) for part in parts), Fraction(0))
            case s.Product(left, right):
                return self.term(left) * self.term(right)
            case s.Quotient(left, right):
                top, bottom = self.term(left), self.term(right)
                return self.outside("/", top) if bottom == 0 else top / bottom
            case s.Minus(part):
                return -self.term(part)
            case s.Power(base, s.Number(k)) if Fraction(k).denominator == 1 and k >= 0:
                return self.term(base) ** int(k)
            case s.Choice(condition, then, other) if other is not None:
                return self.term(then if self.truth(condition) else other)
            case s.Apply(function, arguments):
                return self.apply(function, [self.term(argument) for argument in arguments])
        raise InputError("this term cannot be evaluated")

    def apply(self, function: str, values: list[Number]) -> Number:
        match function:
            case "min" | "max":
                return min(values) if function == "min" else max(values)
            case "abs":
                return values[0] if values[0] >= 0 else -values[0]
            case "sign":
                return Fraction((values[0] > 0) - (values[0] < 0))
            case "sqrt" if values[0] < 0:
                return self.outside("sqrt", values[0])
        degree, value = (2 if function == "sqrt" else 3), values[0]
        if isinstance(value, RealAlgebraic) and not value.is_rational:
            raise InputError("roots of irrational numbers cannot be evaluated")
        exact = value.as_fraction() if isinstance(value, RealAlgebraic) else Fraction(value)
        size = abs(exact)
        root = RealAlgebraic.from_root([-size.numerator, *[0] * (degree - 1), size.denominator], 0, size + 1)
        return root if exact >= 0 else -root

    def truth(self, node: s.Node) -> bool:
        """Whether a formula holds."""
        if (known := self.known.get(id(node))) is None:
            known = self.known[id(node)] = node, self._truth(node)
        return bool(known[1])

    def _truth(self, node: s.Node) -> bool:
        match node:
            case s.Truth(value):
                return value
            case s.Comparison(sides, relations):
                values = [self.term(side) for side in sides]
                pairs = zip(pairwise(values), relations, strict=True)
                return all(relation.holds((a > b) - (a < b)) for (a, b), relation in pairs)
            case s.Every(parts):
                return all(self.truth(part) for part in parts)
            case s.Some(parts):
                return any(self.truth(part) for part in parts)
            case s.Negation(part):
                return not self.truth(part)
            case s.Implication(left, right):
                return not self.truth(left) or self.truth(right)
            case s.Equivalence(left, right):
                return self.truth(left) is self.truth(right)
        raise InputError("a formula with quantifiers cannot be evaluated")
