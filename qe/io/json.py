"""Formulas as JSON, exactly: ring, order of the arguments, root atoms. Numbers are strings of digits.

``{"format": "real formula", "version": 1, "ring": ["x", "y"], "formula": NODE}`` where NODE is one of
``{"atom": POLY, "relation": "<="}``, ``{"root": POLY, "variable": "x", "relation": "<", "k": 1}``,
``{"and": [NODE…]}``, ``{"or": [NODE…]}``, ``{"not": NODE}``, ``{"exists": ["x"], "body": NODE}``,
``{"forall": ["x"], "body": NODE}``, ``true`` and ``false``; POLY is ``[[coefficient, [exponents]], …]`` with one
exponent for every ring variable.
"""

from __future__ import annotations

import json
import re
from typing import Any, Never

from qe.errors import InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg, root_atom
from qe.formula.notation import digits
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.io.names import check_name, names_in
from qe.io.surface import MAX_DEPTH
from qe.io.terms import MAX_DEGREE, integer
from qe.spelling import NUMBERS

FORMAT, VERSION = "real formula", 1
_INTEGER = re.compile(r"-?[0-9]+")


def write(formula: Formula) -> str:
    """One line of JSON."""
    return json.dumps(encode(formula), ensure_ascii=False)


def read(text: str, *, source: str = "<text>") -> Formula:
    """The formula of a JSON text. Raises ``InputError`` naming what is wrong."""
    try:
        return decode(json.loads(text))
    except json.JSONDecodeError as error:
        raise InputError(f"{source}:{error.lineno}:{error.colno}: not JSON: {error.msg}") from None
    except (RecursionError, ValueError):
        raise InputError(f"{source}: not JSON of a formula") from None
    except InputError as error:
        raise InputError(f"{source}: {error}") from None


def encode(formula: Formula) -> dict[str, Any]:
    """The JSON value of a formula, for embedding in other documents."""
    ring = formula.ring
    names = ring.names if ring is not None else names_in(formula)
    return {"format": FORMAT, "version": VERSION, "ring": list(names), "formula": _encode(formula)}


def decode(data: object) -> Formula:
    """The inverse of ``encode``; the invariants of formulas are enforced, not believed."""
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise InputError(f'an object with "format": "{FORMAT}" expected')
    if data.get("version") != VERSION:
        raise InputError(f"version {VERSION} expected, {data.get('version')!r} found")
    if set(data) != {"format", "version", "ring", "formula"}:
        raise InputError("the keys format, version, ring and formula expected")
    names = _names(data["ring"])
    if len(set(names)) != len(names):
        raise InputError("a ring with distinct names expected")
    return _decode(data["formula"], Ring.of(names), 0)


def _encode(formula: Formula) -> object:
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return {"atom": _poly(poly), "relation": relation.value}
        case RootAtom(variable, relation, poly, k):
            return {"root": _poly(poly), "variable": variable, "relation": relation.value, "k": k}
        case And(args) | Or(args):
            return {"and" if isinstance(formula, And) else "or": [_encode(arg) for arg in args]}
        case Not(arg):
            return {"not": _encode(arg)}
        case Exists(variables, body) | ForAll(variables, body):
            return {"exists" if isinstance(formula, Exists) else "forall": list(variables), "body": _encode(body)}
        case _:
            unknown: Never = formula  # mypy holds the cases against all kinds
            raise InputError(f"not a formula: {unknown!r}")


def _poly(poly: Poly) -> list[list[object]]:
    return [[digits(c), list(e)] for e, c in poly.terms()]


def _decode(data: object, ring: Ring, depth: int) -> Formula:
    if isinstance(data, bool):
        return TRUE if data else FALSE
    if depth > MAX_DEPTH:
        raise InputError(f"nested more than {MAX_DEPTH} levels deep")
    match data:
        case {"atom": poly, "relation": relation, **rest} if not rest:
            return atom(_read_poly(poly, ring), _relation(relation))
        case {"root": poly, "variable": str(name), "relation": relation, "k": int(k), **rest} if not rest and k:
            if name not in ring.index:
                raise InputError(f"{name!r} is not in the ring")
            return root_atom(name, _relation(relation), _read_poly(poly, ring), k)
        case {"and": list(args), **rest} if not rest:
            return conj([_decode(arg, ring, depth + 1) for arg in args])
        case {"or": list(args), **rest} if not rest:
            return disj([_decode(arg, ring, depth + 1) for arg in args])
        case {"not": arg, **rest} if not rest:
            return neg(_decode(arg, ring, depth + 1))
        case {"exists": names, "body": body, **rest} if not rest:
            return exists(_names(names), _decode(body, ring, depth + 1))
        case {"forall": names, "body": body, **rest} if not rest:
            return forall(_names(names), _decode(body, ring, depth + 1))
    raise InputError(f"not the node of a formula: {json.dumps(data)[:60]}")


def _names(data: object) -> list[str]:
    if not isinstance(data, list):
        raise InputError("a list of names expected")
    return [name if name in NUMBERS else check_name(name) for name in data]


def _relation(data: object) -> Relation:
    try:
        return Relation(data)
    except ValueError:
        raise InputError(f"a relation expected, {str(data)[:20]!r} found") from None


def _read_poly(data: object, ring: Ring) -> Poly:
    if not isinstance(data, list):
        raise InputError("a list of terms expected")
    terms: dict[tuple[int, ...], int] = {}
    for term in data:
        match term:
            case [str(coefficient), list(exponents)] if _is_term(coefficient, exponents, ring):
                key = tuple(exponents)
                if key in terms:
                    raise InputError(f"the exponents {exponents} occur twice")
                terms[key] = integer(coefficient)
            case _:
                raise InputError(f'["coefficient", [exponents]] expected, {json.dumps(term)[:40]} found')
    return ring.from_terms(terms)


def _is_term(coefficient: str, exponents: list[object], ring: Ring) -> bool:
    natural = all(isinstance(k, int) and not isinstance(k, bool) and 0 <= k <= MAX_DEGREE for k in exponents)
    return _INTEGER.fullmatch(coefficient) is not None and len(exponents) == ring.size and natural
