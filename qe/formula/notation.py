"""Printing with infix operators: one ordering of terms and one bracket policy for every line format."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from operator import attrgetter
from typing import Protocol

from qe.exact.ring import Poly
from qe.exact.sparse_text import digits as digits
from qe.exact.sparse_text import in_order, sum_text
from qe.formula.relation import Relation
from qe.services import Service, service

Monomial = tuple[int, tuple[tuple[str, int], ...]]


class Level(IntEnum):
    """How tightly a construct binds, loosest first."""

    OPEN = 0
    OR = 1
    AND = 2
    NOT = 3


def monomials(poly: Poly) -> list[Monomial]:
    """(coefficient, ((name, exponent), …)), in the order in which people write them."""
    names = poly.ring.names
    return [(c, tuple((names[i], k) for i, k in powers)) for powers, c in in_order(poly.sparse_terms())]


def oriented(poly: Poly, relation: Relation) -> tuple[list[Monomial], Relation]:
    """The monomials and the relation of ``poly relation 0``, signed so that the first coefficient is positive."""
    parts = monomials(poly)
    return (parts, relation) if parts[0][0] > 0 else (positive(poly), relation.flipped)


def positive(poly: Poly) -> list[Monomial]:
    """The monomials of ``poly`` or ``-poly`` (which has the same roots), the first coefficient positive."""
    parts = monomials(poly)
    return [(-c, powers) for c, powers in parts] if parts and parts[0][0] < 0 else parts


@dataclass(frozen=True, slots=True, kw_only=True)
class Notation:
    """The tokens of a line format. ``quantifier(universal, names)`` gives a prefix, ``root(variable, relation, poly,
    k)`` a root atom. ``scope``: brackets around the body of a quantifier (None: it runs on to the right). ``strict``:
    brackets after a negation, and around ``and`` inside ``or``. ``customary``: as in ``qe.formula.comparison``."""

    name: Callable[[str], str]
    quantifier: Callable[[bool, tuple[str, ...]], str]
    root: Callable[[str, Relation, Poly, int], str]
    relation: Callable[[Relation], str] = attrgetter("value")
    conjunction: str = " and "
    disjunction: str = " or "
    negation: str = "not "
    true: str = "true"
    false: str = "false"
    times: str = "*"
    power: Callable[[str, int], str] = "{}^{}".format
    brackets: tuple[str, str] = ("(", ")")
    scope: tuple[str, str] | None = None
    quotient: Callable[[str, str], str] = "{}/{}".format
    strict: bool = False
    customary: bool = False


class Written(Protocol):
    """What prints itself in a notation; see ``qe.formula.syntax.Formula.written``."""

    def written(self, notation: Notation, level: Level = ..., last: bool = ...) -> str: ...


def polynomial(parts: list[Monomial], notation: Notation) -> str:
    """Text such as ``x^2 - 2*x*y + 1``."""
    power, name = notation.power, notation.name
    return sum_text(
        ((c, [power(name(n), k) if k > 1 else name(n) for n, k in used]) for c, used in parts), notation.times
    )


def comparison(poly: Poly, relation: Relation, notation: Notation) -> str:
    """``poly relation 0``; first coefficients are positive."""
    if notation.customary:
        return str(service(Service.COMPARISON).written(poly, relation, notation))
    parts, relation = oriented(poly, relation)
    return f"{polynomial(parts, notation)} {notation.relation(relation)} 0"


def bracketed(part: Written, brackets: tuple[str, str], notation: Notation) -> str:
    """The part, which needs no brackets of its own then, between these brackets."""
    return brackets[0] + part.written(notation) + brackets[1]


def chain(parts: Sequence[Written], own: Level, around: Level, last: bool, notation: Notation) -> str:
    """A conjunction (``own`` is ``Level.AND``) or disjunction of the parts, bracketed where ``around`` asks for it."""
    operator = notation.conjunction if own is Level.AND else notation.disjunction
    enclosed = around >= own or (notation.strict and around is not Level.OPEN)
    if notation.customary and own is Level.AND:
        parts = service(Service.COMPARISON).ranges(parts)
    text = operator.join(part.written(notation, own, (last or enclosed) and part is parts[-1]) for part in parts)
    return notation.brackets[0] + text + notation.brackets[1] if enclosed else text
