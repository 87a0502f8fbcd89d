"""Formulas as they are written: one value for the engine, which gets polynomials, and for people, who get text.

A formula of the paper is built once, from names and exact numbers. Each part holds a tree of the engine's one language
of terms (``qe.io.surface``) and its text: ``Statement.formula`` is what the engine is asked and ``str`` is what a page
or a file shows of it, so what is shown is what was asked, and no number is ever read from text. Names have to be words
that the engine's language takes as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from fractions import Fraction
from functools import reduce
from math import comb

from qe.errors import InputError, InternalError
from qe.exact.ring import Poly
from qe.formula.syntax import Formula, Relation
from qe.io import lowering, surface


def _wrong(message: str, at: int) -> InputError:
    raise InternalError(f"a formula without a meaning: {message}")


# --- terms -----------------------------------------------------------------------------------------------------------


class Binding(IntEnum):
    """How a term holds together: what needs brackets as a part of what."""

    SUM = 0
    MINUS = 1
    PRODUCT = 2
    POWER = 3
    ATOM = 4


@dataclass(frozen=True, slots=True, eq=False)
class Term:
    """A polynomial over Q."""

    node: surface.Term
    text: str
    binding: Binding = Binding.ATOM

    def __str__(self) -> str:
        return self.text

    @property
    def polynomial(self) -> tuple[Poly, Fraction]:
        """A polynomial p over Z and a rational s with s p the meaning, in the ring of the names in their order."""
        value = lowering.lower_term(self.node, _wrong)
        return value.poly, Fraction(1, value.den)

    def within(self, least: Binding) -> str:
        """The text, in brackets where it holds together less than that."""
        return self.text if self.binding >= least else f"({self.text})"


def number(value: int | Fraction) -> Term:
    """An exact number."""
    return Term(surface.Number(value), str(value) if value.denominator == 1 and value >= 0 else f"({value})")


def name(variable: str) -> Term:
    """A variable or a parameter."""
    return Term(surface.Name(variable, -1), variable)


def names(listed: Iterable[str]) -> tuple[Term, ...]:
    """Several variables."""
    return tuple(map(name, listed))


def minus(part: Term) -> Term:
    """The negative of a term."""
    return Term(surface.Minus(part.node), f"-{part.within(Binding.PRODUCT)}", Binding.MINUS)


def total(parts: Sequence[Term]) -> Term:
    """The sum of at least one term."""
    first, *rest = (part.within(Binding.MINUS) for part in parts)
    signed = (f" - {t[1:]}" if p.binding is Binding.MINUS else f" + {t}" for p, t in zip(parts[1:], rest, strict=True))
    node = surface.Sum([part.node for part in parts]) if rest else parts[0].node
    return Term(node, first + "".join(signed), Binding.SUM)


def product(*factors: Term) -> Term:
    """The product of at least one term."""
    node = reduce(lambda a, b: surface.Product(a, b, -1), (factor.node for factor in factors))
    return Term(node, "*".join(factor.within(Binding.PRODUCT) for factor in factors), Binding.PRODUCT)


def power(base: Term, exponent: int) -> Term:
    """A natural power."""
    node = surface.Power(base.node, surface.Number(exponent), -1)
    return Term(node, f"{base.within(Binding.ATOM)}^{exponent}", Binding.POWER)


def bracketed(part: Term) -> Term:
    """The same term, written in brackets whatever is around it."""
    is_done = isinstance(part.node, surface.Number) and part.text.startswith("(")
    return Term(part.node, part.text if is_done else f"({part})")


def difference(first: Term, second: Term) -> Term:
    """first - second."""
    return total((first, minus(second)))


def combined(pairs: Iterable[tuple[Fraction, Term]]) -> Term:
    """The sum of coefficient * term; a coefficient of size one is not written."""
    parts: list[Term] = []
    for coefficient, term in pairs:
        size = abs(coefficient)
        part = term if size == 1 else product(number(size), term)
        parts.append(minus(part) if coefficient < 0 else part)
    return parts[0] if len(parts) == 1 else total(parts)


def squares(terms: Iterable[Term]) -> Term:
    """The sum of the squares."""
    return total([power(term, 2) for term in terms])


def bernstein(points: Sequence[Term], t: Term) -> Term:
    """The value at t of the polynomial with these Bernstein coefficients."""
    n, rest = len(points) - 1, difference(number(1), t)
    return total([product(number(comb(n, i)), power(t, i), power(rest, n - i), p) for i, p in enumerate(points)])


# --- statements ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Statement:
    """A formula, true or false for each choice of its free names."""

    node: surface.Node
    text: str
    parts: tuple[Statement, ...] = ()
    """Of a conjunction that is written without brackets."""

    def __str__(self) -> str:
        return self.text

    @property
    def formula(self) -> Formula:
        """The formula for the engine, in the ring of the names: free ones as they occur, then bound ones."""
        return lowering.lower(self.node, _wrong)

    @property
    def part(self) -> str:
        """The text, in brackets where it is a part of another statement and needs them."""
        needed = isinstance(self.node, surface.Quantification | surface.Implication)
        return f"({self.text})" if needed else self.text


def atomic(left: Term, relation: Relation, right: Term) -> Statement:
    """left relation right."""
    return Statement(surface.Comparison([left.node, right.node], [relation], -1), f"{left} {relation.value} {right}")


def equal(left: Term, right: Term) -> Statement:
    """left = right."""
    return atomic(left, Relation.EQ, right)


def at_most(left: Term, right: Term) -> Statement:
    """left <= right."""
    return atomic(left, Relation.LE, right)


def at_least(left: Term, right: Term) -> Statement:
    """left >= right."""
    return atomic(left, Relation.GE, right)


def below(left: Term, right: Term) -> Statement:
    """left < right."""
    return atomic(left, Relation.LT, right)


def every(*parts: Statement) -> Statement:
    """The conjunction; the parts of plain conjunctions among them are parts of it."""
    flat = tuple(inner for part in parts for inner in part.parts or (part,))
    return Statement(surface.Every([part.node for part in flat]), " and ".join(part.part for part in flat), flat)


def grouped(*parts: Statement) -> Statement:
    """The conjunction, written in brackets."""
    return Statement(surface.Every([part.node for part in parts]), f"({' and '.join(part.part for part in parts)})")


def some(*parts: Statement) -> Statement:
    """Some part holds."""
    return Statement(surface.Some([part.node for part in parts]), f"({' or '.join(part.part for part in parts)})")


def between(low: Term, middle: Term, high: Term) -> Statement:
    """low <= middle <= high."""
    return every(at_most(low, middle), at_most(middle, high))


def implies(left: Statement, right: Statement) -> Statement:
    """left -> right."""
    return Statement(surface.Implication(left.node, right.node), f"{left.part} -> {right.part}")


def exists(listed: Sequence[str], body: Statement) -> Statement:
    """Some values of these variables satisfy the body."""
    return _quantified(False, listed, body)


def for_all(listed: Sequence[str], body: Statement) -> Statement:
    """All values of these variables satisfy the body."""
    return _quantified(True, listed, body)


def _quantified(universal: bool, listed: Sequence[str], body: Statement) -> Statement:
    node = surface.Quantification(universal, list(listed), body.node)
    return Statement(node, f"{'all' if universal else 'ex'} {', '.join(listed)}. {body}")
