"""Printing with infix operators: one ordering of terms and one bracket policy for every line format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum

from qe.exact.digits import digits as digits
from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom

Monomial = tuple[int, tuple[tuple[str, int], ...]]


class Level(IntEnum):
    """How tightly a construct binds, loosest first."""

    OPEN = 0
    OR = 1
    AND = 2
    NOT = 3


def monomials(poly: Poly) -> list[Monomial]:
    """(coefficient, ((name, exponent), …)) by falling total degree, then in ring order."""
    names = poly.ring.names
    ordered = sorted(poly.terms(), key=lambda term: (sum(term[0]), term[0]), reverse=True)
    return [(c, tuple((names[i], k) for i, k in enumerate(e) if k)) for e, c in ordered]


def oriented(atom: Atom) -> tuple[list[Monomial], Relation]:
    """The monomials of an atom and its relation, with the sign that makes the first coefficient positive."""
    parts = monomials(atom.poly)
    return (parts, atom.relation) if parts[0][0] > 0 else (positive(atom.poly), atom.relation.flipped)


def positive(poly: Poly) -> list[Monomial]:
    """The monomials of ``poly`` or ``-poly`` (which has the same roots), the first coefficient positive."""
    parts = monomials(poly)
    return [(-c, powers) for c, powers in parts] if parts and parts[0][0] < 0 else parts


@dataclass(frozen=True, slots=True, kw_only=True)
class Notation:
    """The tokens of a line format. ``quantifier(universal, names)`` gives a prefix; ``root`` prints a
    root atom. ``scope``: brackets around the body of a quantifier (None: the body runs on to the right).
    ``strict``: what follows a negation is bracketed, and so is ``and`` inside ``or``."""

    name: Callable[[str], str]
    relation: Callable[[Relation], str]
    quantifier: Callable[[bool, tuple[str, ...]], str]
    root: Callable[[RootAtom], str]
    conjunction: str
    disjunction: str
    negation: str
    true: str
    false: str
    times: str = "*"
    power: Callable[[str, int], str] = "{}^{}".format
    brackets: tuple[str, str] = ("(", ")")
    scope: tuple[str, str] | None = None
    strict: bool = False


def polynomial(parts: list[Monomial], notation: Notation) -> str:
    """Text such as ``x^2 - 2*x*y + 1``."""
    pieces: list[str] = []
    for coefficient, powers in parts:
        factors = [notation.power(notation.name(n), k) if k > 1 else notation.name(n) for n, k in powers]
        magnitude = abs(coefficient)
        if magnitude != 1 or not factors:
            factors.insert(0, digits(magnitude))
        sign = ("-" if coefficient < 0 else "") if not pieces else ("- " if coefficient < 0 else "+ ")
        pieces.append(sign + notation.times.join(factors))
    return " ".join(pieces) or "0"


def formula_text(formula: Formula, notation: Notation) -> str:
    """The whole formula, with no more brackets than reading it back needs."""
    return _write(formula, Level.OPEN, True, notation)


def _write(formula: Formula, level: Level, last: bool, notation: Notation) -> str:
    """``level``: the construct around it; ``last``: nothing follows, so that a quantifier may stay open."""
    match formula:
        case Atom():
            parts, relation = oriented(formula)
            return f"{polynomial(parts, notation)} {notation.relation(relation)} 0"
        case RootAtom():
            return notation.root(formula)
        case Constant(value):
            return notation.true if value else notation.false
        case And(args):
            return _chain(args, notation.conjunction, Level.AND, level, last, notation)
        case Or(args):
            return _chain(args, notation.disjunction, Level.OR, level, last, notation)
        case Not(arg):
            if isinstance(arg, RootAtom) or notation.strict:
                return notation.negation + _bracketed(arg, notation.brackets, notation)
            return notation.negation + _write(arg, Level.NOT, last, notation)
        case Exists(variables, body) | ForAll(variables, body):
            prefix = notation.quantifier(isinstance(formula, ForAll), variables)
            if notation.scope is not None:
                return prefix + _bracketed(body, notation.scope, notation)
            if not last:
                return _bracketed(formula, notation.brackets, notation)
            return prefix + _write(body, Level.OPEN, True, notation)
    raise TypeError(f"not a formula: {formula!r}")


def _bracketed(formula: Formula, brackets: tuple[str, str], notation: Notation) -> str:
    return brackets[0] + _write(formula, Level.OPEN, True, notation) + brackets[1]


def _chain(args: tuple[Formula, ...], operator: str, own: Level, around: Level, last: bool, notation: Notation) -> str:
    if around >= own or (notation.strict and around is not Level.OPEN):
        return notation.brackets[0] + _chain(args, operator, own, Level.OPEN, True, notation) + notation.brackets[1]
    ends = [last and i == len(args) - 1 for i in range(len(args))]
    return operator.join(_write(arg, own, end, notation) for arg, end in zip(args, ends, strict=True))
