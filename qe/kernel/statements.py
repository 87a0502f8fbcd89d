"""Statements as text: theorems with letters, as files in ``qe/theorems`` hold them.

Terms and conditions are written as in Python, with ``^`` for powers, ``=`` and ``/=`` for equations and inequations,
and ``exists(x, y, F)`` or ``forall(x, F)`` for quantifiers. A file has a ``family``, a ``source`` and a list
``theorem``. Each has a ``name``, the quantified ``block``, what is ``given``, the ``answer``, and ``proof`` (a file
with a derivation of it) or ``axiom`` (why it is believed). ``let`` names terms, each of which may use those before
it. ``for`` has words for marks such as {low}: there is one theorem for each choice, with ``fixed`` terms for letters
that are not needed in it.
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import product
from typing import Any

from qe.errors import InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation

RELATIONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=", ast.NotEq: "/="}


@dataclass(frozen=True, slots=True)
class Theorem:
    """Where ``given`` holds, ``block`` <-> ``answer``, whatever real numbers the ``letters`` stand for.

    ``variables`` are those that the block or the answer binds; the formulas are over one ring of both. ``axiom``: why
    it is believed; empty where a derivation, ``proof``, shows it.
    """

    name: str
    words: tuple[str, ...]
    family: str
    letters: tuple[str, ...]
    variables: tuple[str, ...]
    block: Formula
    given: Formula
    answer: Formula
    source: str
    axiom: str
    proof: str


@dataclass(frozen=True, slots=True)
class Row:
    """A theorem of a file before words for its marks are chosen; ``let``: terms that all theorems of the file share;
    ``size``: how many variables and conditions its block has."""

    name: str
    family: str
    data: Mapping[str, Any]
    let: Mapping[str, str]
    source: str
    size: tuple[int, int]

    @property
    def parameters(self) -> int:
        """The least number of parameters with which the engine uses it: decomposition gives short answers with few."""
        return int(self.data.get("parameters", 0))

    @property
    def choices(self) -> Iterator[tuple[str, ...]]:
        """All choices of words for its marks."""
        yield from product(*self.data.get("for", {}).values())


@cache
def rows() -> Mapping[str, Row]:
    """The theorems of all files, by name."""
    listed = [row for text in _files() for row in _rows(tomllib.loads(text))]
    found = {row.name: row for row in listed}
    if len(found) < len(listed):
        raise InputError("theorems: a name is given twice")
    return found


def _files() -> Iterator[str]:
    for file in sorted(files("qe").joinpath("theorems").iterdir(), key=lambda f: f.name):
        if file.name.endswith(".toml"):
            yield file.read_text("utf-8")


def _rows(data: Mapping[str, Any]) -> Iterator[Row]:
    for row in data["theorem"]:
        source = row.get("source", data.get("source", ""))
        yield Row(row["name"], data["family"], row, data.get("let", {}), source, _size(row))


def _size(row: Mapping[str, Any]) -> tuple[int, int]:
    block = _tree(_filled(row["block"], {mark: words[0] for mark, words in row.get("for", {}).items()}))
    if not isinstance(block, ast.Call):
        raise InputError(f"theorems: {row['name']}: a block expected")
    body = block.args[-1]
    return len(block.args) - 1, len(body.values) if isinstance(body, ast.BoolOp) else 1


@cache
def theorem(name: str, words: tuple[str, ...] = ()) -> Theorem | None:
    """The theorem of this name with these words for its marks, if there is one."""
    row = rows().get(name)
    if row is None or words not in row.choices:
        return None
    marks = dict(zip(row.data.get("for", {}), words, strict=True))
    texts = [_filled(row.data.get(part, "true"), marks) for part in ("block", "given", "answer")]
    let = {**row.data.get("fixed", {}), **row.let, **row.data.get("let", {})}
    trees, terms = [_tree(text) for text in texts], {key: _tree(_filled(text, marks)) for key, text in let.items()}
    bound = tuple(dict.fromkeys(name for tree in trees for name in _bound(tree)))
    used = dict.fromkeys(name for tree in (*trees, *terms.values()) for name in _names(tree))
    ring = Ring.of((*(name for name in used if name not in bound and name not in terms), *bound))
    known: dict[str, Poly] = {name: ring.var(name) for name in ring.names}
    for key, tree in terms.items():
        known[key] = _term(tree, known, ring)
    block, given, answer = (_formula(tree, known, ring) for tree in trees)
    free = {*block.free, *given.free, *answer.free}
    letters = tuple(name for name in ring.names if name in free)
    rest = (row.source, row.data.get("axiom", ""), row.data.get("proof", ""))
    return Theorem(name, words, row.family, letters, bound, block, given, answer, *rest)


def _filled(text: str, marks: Mapping[str, str]) -> str:
    for mark, word in marks.items():
        text = text.replace(f"{{{mark}}}", word)
    return text


# --- text ------------------------------------------------------------------------------------------


def _tree(text: str) -> ast.expr:
    text = re.sub(r"(?<![<>!=/])=(?!=)", "==", text.replace("/=", "!=").replace("^", "**"))
    return ast.parse(" ".join(text.split()), mode="eval").body


def _bound(tree: ast.expr) -> Iterator[str]:
    """The names that quantifiers bind."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            yield from (arg.id for arg in node.args[:-1] if isinstance(arg, ast.Name))


def _names(tree: ast.expr) -> Iterator[str]:
    """All names of variables and letters."""
    words = {node.func for node in ast.walk(tree) if isinstance(node, ast.Call)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node not in words and node.id not in ("true", "false"):
            yield node.id


def _formula(tree: ast.expr, known: Mapping[str, Poly], ring: Ring) -> Formula:
    match tree:
        case ast.Name("true" | "false" as word):
            return TRUE if word == "true" else FALSE
        case ast.BoolOp(op, values):
            join = conj if isinstance(op, ast.And) else disj
            return join(_formula(value, known, ring) for value in values)
        case ast.UnaryOp(ast.Not(), operand):
            return neg(_formula(operand, known, ring))
        case ast.Call(ast.Name("exists" | "forall" as word), args):
            names = [arg.id for arg in args[:-1] if isinstance(arg, ast.Name)]
            return (exists if word == "exists" else forall)(names, _formula(args[-1], known, ring))
        case ast.Compare(left, ops, comparators):
            sides = [_term(side, known, ring) for side in (left, *comparators)]
            relations = [Relation(RELATIONS[type(op)]) for op in ops]
            return conj(atom(p - q, rel) for p, q, rel in zip(sides, sides[1:], relations, strict=False))
    raise InputError(f"theorems: not a formula: {ast.unparse(tree)}")


def _term(tree: ast.expr, known: Mapping[str, Poly], ring: Ring) -> Poly:
    match tree:
        case ast.Constant(int() as value):
            return ring.constant(value)
        case ast.Name(name) if name in known:
            return known[name]
        case ast.UnaryOp(ast.USub(), operand):
            return -_term(operand, known, ring)
        case ast.BinOp(left, ast.Pow(), ast.Constant(int() as exponent)):
            return _term(left, known, ring) ** exponent
        case ast.BinOp(left, ast.Add() | ast.Sub() | ast.Mult() as op, right):
            p, q = _term(left, known, ring), _term(right, known, ring)
            return p + q if isinstance(op, ast.Add) else p - q if isinstance(op, ast.Sub) else p * q
    raise InputError(f"theorems: not a term: {ast.unparse(tree)}")
