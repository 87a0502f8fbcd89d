"""Formulas as they are written: one tree for the engine, which gets polynomials, and for people, who get text.

A formula of the paper is built once, from names and exact numbers. ``Statement.formula`` is what the engine is asked
and ``str`` is what a page or a file shows of it, so what is shown is what was asked, and no number is ever read from
text. Names have to be words that the engine's language takes as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm, prod

from qe.exact.ring import Poly, Ring
from qe.formula import build
from qe.formula.syntax import Formula, Relation


class Term:
    """A polynomial over Q."""

    __slots__ = ()

    def __str__(self) -> str:
        return _written(self)

    @property
    def polynomial(self) -> tuple[Poly, Fraction]:
        """A polynomial p over Z and a rational s with s p the meaning, in the ring of the names in their order."""
        poly, below = _value(self, _ring(self))
        return poly, Fraction(1, below)


class Statement:
    """A formula, true or false for each choice of its free names."""

    __slots__ = ()

    def __str__(self) -> str:
        return _stated(self)

    @property
    def formula(self) -> Formula:
        """The formula for the engine, in the ring of the names: free ones as they occur, then bound ones."""
        return _lowered(self, _ring(self))


# --- terms -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Number(Term):
    """An exact number."""

    value: Fraction


@dataclass(frozen=True, slots=True)
class Name(Term):
    """A variable or a parameter."""

    name: str


@dataclass(frozen=True, slots=True)
class Minus(Term):
    """The negative of a term."""

    part: Term


@dataclass(frozen=True, slots=True)
class Sum(Term):
    """A sum of at least one term."""

    parts: tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class Product(Term):
    """A product of at least one term."""

    factors: tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class Power(Term):
    """A natural power."""

    base: Term
    exponent: int


@dataclass(frozen=True, slots=True)
class Bracketed(Term):
    """The same term, written in brackets whatever is around it."""

    part: Term


def number(value: int | Fraction) -> Number:
    """An exact number."""
    return Number(Fraction(value))


def names(listed: Iterable[str]) -> tuple[Name, ...]:
    """Several variables."""
    return tuple(map(Name, listed))


def difference(first: Term, second: Term) -> Term:
    """first - second."""
    return Sum((first, Minus(second)))


def combined(pairs: Iterable[tuple[Fraction, Term]]) -> Term:
    """The sum of coefficient * term; a coefficient of size one is not written."""
    parts: list[Term] = []
    for coefficient, term in pairs:
        size = abs(coefficient)
        part = term if size == 1 else Product((number(size), term))
        parts.append(Minus(part) if coefficient < 0 else part)
    return parts[0] if len(parts) == 1 else Sum(tuple(parts))


def squares(terms: Iterable[Term]) -> Term:
    """The sum of the squares."""
    return Sum(tuple(Power(term, 2) for term in terms))


def _value(term: Term, ring: Ring) -> tuple[Poly, int]:
    """A polynomial over Z and a positive integer whose quotient the term is."""
    match term:
        case Number(value):
            return ring.constant(value.numerator), value.denominator
        case Name(name):
            return ring.var(name), 1
        case Minus(part):
            poly, below = _value(part, ring)
            return -poly, below
        case Sum(parts):
            values = [_value(part, ring) for part in parts]
            common = lcm(*(below for _, below in values))
            return sum((poly * (common // below) for poly, below in values), ring.constant(0)), common
        case Product(factors):
            values = [_value(factor, ring) for factor in factors]
            return prod((poly for poly, _ in values), start=ring.constant(1)), prod(below for _, below in values)
        case Power(base, exponent):
            poly, below = _value(base, ring)
            return poly**exponent, below**exponent
        case Bracketed(part):
            return _value(part, ring)
    raise TypeError(f"no term: {term!r}")


def _written(term: Term) -> str:
    match term:
        case Number(value):
            return str(value) if value.denominator == 1 and value >= 0 else f"({value})"
        case Name(name):
            return name
        case Minus(part):
            return f"-{_factor(part)}"
        case Sum(parts):
            first, *rest = parts
            signed = (f" - {_summand(p.part)}" if isinstance(p, Minus) else f" + {_summand(p)}" for p in rest)
            return _summand(first) + "".join(signed)
        case Product(factors):
            return "*".join(map(_factor, factors))
        case Power(base, exponent):
            return f"({base})^{exponent}" if isinstance(base, Product | Power) else f"{_factor(base)}^{exponent}"
        case Bracketed(Number(value)):
            return f"({value})"
        case Bracketed(part):
            return f"({part})"
    raise TypeError(f"no term: {term!r}")


def _summand(term: Term) -> str:
    return f"({term})" if isinstance(term, Sum) else str(term)


def _factor(term: Term) -> str:
    return f"({term})" if isinstance(term, Sum | Minus) else str(term)


# --- statements ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Atomic(Statement):
    """left relation right."""

    left: Term
    relation: Relation
    right: Term


@dataclass(frozen=True, slots=True)
class Every(Statement):
    """All parts hold; ``bracketed``: the conjunction is written in brackets."""

    parts: tuple[Statement, ...]
    bracketed: bool = False


@dataclass(frozen=True, slots=True)
class Some(Statement):
    """Some part holds."""

    parts: tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Implies(Statement):
    """left -> right."""

    left: Statement
    right: Statement


@dataclass(frozen=True, slots=True)
class Quantified(Statement):
    """All or some values of these variables satisfy the body."""

    universal: bool
    names: tuple[str, ...]
    body: Statement


def equal(left: Term, right: Term) -> Atomic:
    """left = right."""
    return Atomic(left, Relation.EQ, right)


def at_most(left: Term, right: Term) -> Atomic:
    """left <= right."""
    return Atomic(left, Relation.LE, right)


def at_least(left: Term, right: Term) -> Atomic:
    """left >= right."""
    return Atomic(left, Relation.GE, right)


def below(left: Term, right: Term) -> Atomic:
    """left < right."""
    return Atomic(left, Relation.LT, right)


def between(low: Term, middle: Term, high: Term, *, bracketed: bool = False) -> Every:
    """low <= middle <= high."""
    return Every((at_most(low, middle), at_most(middle, high)), bracketed)


def every(*parts: Statement) -> Every:
    """The conjunction; the parts of plain conjunctions among them are parts of it."""
    flat: list[Statement] = []
    for part in parts:
        flat += part.parts if isinstance(part, Every) and not part.bracketed else (part,)
    return Every(tuple(flat))


def exists(listed: Sequence[str], body: Statement) -> Quantified:
    """Some values of these variables satisfy the body."""
    return Quantified(False, tuple(listed), body)


def for_all(listed: Sequence[str], body: Statement) -> Quantified:
    """All values of these variables satisfy the body."""
    return Quantified(True, tuple(listed), body)


def _lowered(statement: Statement, ring: Ring) -> Formula:
    match statement:
        case Atomic(left, relation, right):
            return build.atom(_value(difference(left, right), ring)[0], relation)
        case Every(parts):
            return build.conj([_lowered(part, ring) for part in parts])
        case Some(parts):
            return build.disj([_lowered(part, ring) for part in parts])
        case Implies(left, right):
            return build.implies(_lowered(left, ring), _lowered(right, ring))
        case Quantified(universal, listed, body):
            return (build.forall if universal else build.exists)(listed, _lowered(body, ring))
    raise TypeError(f"no statement: {statement!r}")


def _stated(statement: Statement) -> str:
    match statement:
        case Atomic(left, relation, right):
            return f"{left} {relation.value} {right}"
        case Every(parts, bracketed):
            text = " and ".join(_part(part) for part in parts)
            return f"({text})" if bracketed else text
        case Some(parts):
            return f"({' or '.join(_part(part) for part in parts)})"
        case Implies(left, right):
            return f"{_part(left)} -> {_part(right)}"
        case Quantified(universal, listed, body):
            return f"{'all' if universal else 'ex'} {', '.join(listed)}. {body}"
    raise TypeError(f"no statement: {statement!r}")


def _part(part: Statement) -> str:
    return f"({part})" if isinstance(part, Quantified | Implies) else str(part)


# --- names -----------------------------------------------------------------------------------------------------------


def _ring(whole: Term | Statement) -> Ring:
    """Free names in the order in which they occur, then the bound ones in the order of their quantifiers."""
    free: dict[str, None] = {}
    bound: dict[str, None] = {}

    def visit(part: Term | Statement, scope: frozenset[str]) -> None:
        match part:
            case Name(name):
                if name not in scope:
                    free[name] = None
            case Minus(inner) | Bracketed(inner) | Power(inner, _):
                visit(inner, scope)
            case Sum(parts) | Product(parts) | Every(parts) | Some(parts):
                for each in parts:
                    visit(each, scope)
            case Atomic(left, _, right) | Implies(left, right):
                visit(left, scope)
                visit(right, scope)
            case Quantified(_, listed, body):
                bound.update(dict.fromkeys(listed))
                visit(body, scope.union(listed))

    visit(whole, frozenset())
    return Ring.of([*free, *(name for name in bound if name not in free)])
