"""Obstacles given as formulas in x, y, z: any semialgebraic set, with or without quantifiers."""

from __future__ import annotations

import itertools
from fractions import Fraction
from typing import Any

import qe
from bezier.input.numbers import describe, shorten
from bezier.input.toml_table import Table
from bezier.obstacles.obstacle import Constraint, Exponents, Piece
from qe.errors import InputError, Unable
from qe.formula.normal import nnf
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.formula.traverse import is_quantifier_free
from qe.io.text import read

NAMES = ("x", "y", "z")
MAX_PIECES = 200
ELIMINATION_SECONDS = 20.0
Constraints = tuple[Constraint, ...]


def formula_pieces(table: Table) -> tuple[tuple[Piece, ...], Any]:
    """The pieces of the obstacle ``formula = "..."``. Raises ``InputError`` naming the key.

    Quantifiers are eliminated first (the answer is the second result, None without any); then the disjunctive normal
    form gives the pieces.
    """
    raw = table.required("formula", "a formula in x, y, z")
    if not isinstance(raw, str):
        raise table.error("formula", "a formula in x, y, z", describe(raw))
    try:
        formula = read(raw, source="formula")
    except InputError as error:
        raise table.error("formula", "a formula in x, y, z", str(error)) from None
    others = [name for name in formula.free if name not in NAMES]
    if others:
        raise table.error("formula", "no free variables but x, y, z", shorten(", ".join(others)))
    try:
        answer = None if is_quantifier_free(formula) else _answer(formula)
        pieces = _pieces(nnf(formula if answer is None else answer.formula))
    except (InputError, Unable) as error:
        raise table.error("formula", "a formula that can be used", str(error)) from None
    if not pieces:
        raise table.error("formula", "a set that is not empty", "one that no point satisfies")
    return tuple(Piece(piece) for piece in pieces), answer


def _answer(formula: Formula) -> Any:
    answer = qe.eliminate(formula, timeout=ELIMINATION_SECONDS)
    if answer.formula is None:
        raise Unable(answer.reason or "its quantifiers were not eliminated")
    return answer


def _pieces(formula: Formula) -> list[Constraints]:
    """The disjunctive normal form; at most ``MAX_PIECES`` conjunctions."""
    match formula:
        case Constant(value):
            return [()] if value else []
        case Atom():
            return _of_atom(formula)
        case Or(args):
            found = [piece for arg in args for piece in _pieces(arg)]
        case And(args):
            found = [()]
            for arg in args:
                pairs = itertools.product(found, _pieces(arg))
                found = list(dict.fromkeys(tuple(dict.fromkeys((*a, *b))) for a, b in pairs))
                _check_number(found)
        case _:
            raise InputError("root expressions cannot be part of an obstacle")
    _check_number(found)
    return found


def _check_number(pieces: list[Constraints]) -> None:
    if len(pieces) > MAX_PIECES:
        raise InputError(f"the formula has more than {MAX_PIECES} pieces")


def _of_atom(atom: Atom) -> list[Constraints]:
    up = _terms(atom)
    down = {e: -c for e, c in up.items()}
    match atom.relation:
        case Relation.GE | Relation.GT:
            return [(Constraint.of(up, atom.relation is Relation.GT),)]
        case Relation.LE | Relation.LT:
            return [(Constraint.of(down, atom.relation is Relation.LT),)]
        case Relation.EQ:
            return [(Constraint.of(up), Constraint.of(down))]
    return [(Constraint.of(up, True),), (Constraint.of(down, True),)]


def _terms(atom: Atom) -> dict[Exponents, Fraction]:
    names = atom.poly.ring.names
    found: dict[Exponents, Fraction] = {}
    for exponents, coefficient in atom.poly.terms():
        powers = dict(zip(names, exponents, strict=True))
        key = powers.get("x", 0), powers.get("y", 0), powers.get("z", 0)
        found[key] = found.get(key, Fraction(0)) + coefficient
    return found
