"""Statements as text: theorems with letters, as files in ``qe/theorems`` hold them.

Terms and conditions are written as in Python, with ``^`` for powers, ``=`` and ``/=`` for equations and inequations,
and ``exists(x, y, F)`` or ``forall(x, F)`` for quantifiers. A file has a ``family``, a ``source`` and a list
``theorem``. Each has a ``name``, the quantified ``block``, what is ``given``, the ``answer``, and ``proof`` (a file
with a derivation of it) or ``axiom`` (why it is believed). ``for`` has words for marks such as {low}: there is one
theorem for each choice. A key of several marks has words for each of them; "2-12" stands for the numbers from 2 to 12.
``vectors`` says how many components a letter or variable has: c[0], c[1], …; a quantifier binds them all.

``let`` names terms and formulas, each of which may use the others: "D" or, for numbers i and j, "a(i, j)". Beside it
are ``dot(u, v)`` and ``det(rows)``; ``sum``, ``all`` and ``any`` of ``… for j in range(…)`` as in Python; and
``A if C else B``, where C is a comparison of numbers. ``fixed`` has terms for letters that are not needed.
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from itertools import product
from typing import Any

from qe.certify.limits import check_power
from qe.errors import InputError, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation

PRODUCTS = 1_000_000
"""The terms of two factors multiplied, at most."""

RELATIONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=", ast.NotEq: "/="}
QUANTIFIERS = {"exists": exists, "forall": forall}
JOINS = {"all": conj, "any": disj}
RESERVED = {"true", "false", "range", "dot", "det", "sum", *QUANTIFIERS, *JOINS}

Tree = ast.expr
Value = Poly | Formula | tuple[Any, ...]
Numbers = Mapping[str, int]
"""What the names of numbers stand for."""


@dataclass(frozen=True, slots=True)
class Row:
    """A theorem of a file before words for its marks are chosen, with what all theorems of the file share."""

    name: str
    family: str
    data: Mapping[str, Any]
    shared: Mapping[str, Any]

    def table(self, key: str) -> Mapping[str, Any]:
        """A table of the file, with what the theorem has of it."""
        return {**self.shared.get(key, {}), **self.data.get(key, {})}

    def choices(self, size: frozenset[int] | None = None) -> Iterator[tuple[str, ...]]:
        """All choices of words for its marks; ``size``: those of which {n} may be one, if there is such a mark."""
        words = []
        for key, listed in self.data.get("for", {}).items():
            span = isinstance(listed, str) and re.fullmatch(r"(\d+)-(\d+)", listed)
            numbers = map(str, range(int(span[1]), int(span[2]) + 1)) if span else listed
            words.append([w for w in numbers if key != "n" or size is None or int(w) in size])
        yield from product(*words)

    def marks(self, words: Sequence[str]) -> dict[str, str]:
        """The word of each mark."""
        pairs = [zip(key.split(), word.split(), strict=True) for key, word in zip(self.data.get("for", {}), words)]
        return {mark: word for pair in pairs for mark, word in pair}


@cache
def rows() -> Mapping[str, Row]:
    """The theorems of all files, by name."""
    listed = [Row(row["name"], data["family"], row, data) for data in _files() for row in data["theorem"]]
    by_name = {row.name: row for row in listed}
    if len(by_name) < len(listed):
        raise InputError("theorems: a name is given twice")
    return by_name


def _files() -> Iterator[dict[str, Any]]:
    for file in sorted(files("qe").joinpath("theorems").iterdir(), key=lambda f: f.name):
        if file.name.endswith(".toml"):
            yield tomllib.loads(file.read_text("utf-8"))


@dataclass(frozen=True, slots=True)
class Theorem:
    """Where ``given`` holds, ``block`` <-> ``answer``, whatever real numbers the ``letters`` stand for.

    ``bound``: the names that a part binds. ``trees``: the parts; ``lets``: what is named, by its name, with the names
    of the numbers on which it depends. ``axiom``: why it is believed; empty where derivations, ``proof``, show it.
    """

    name: str
    words: tuple[str, ...]
    family: str
    letters: tuple[str, ...]
    bound: Mapping[str, tuple[str, ...]]
    trees: Mapping[str, Tree]
    lets: Mapping[str, tuple[tuple[str, ...], Tree]]
    vectors: Mapping[str, int]
    source: str
    axiom: str
    proof: str

    @property
    def variables(self) -> tuple[str, ...]:
        """Those that a part binds."""
        return tuple(dict.fromkeys(name for names in self.bound.values() for name in names))

    @property
    def ring(self) -> Ring:
        """Of the letters and variables themselves."""
        return Ring.of((*self.letters, *self.variables))

    def formula(self, part: str, letters: Mapping[str, Poly], variables: Mapping[str, str], ring: Ring) -> Formula:
        """The block, what is given, or the answer, with polynomials for letters and names for variables."""
        values = {**letters, **{name: ring.var(other) for name, other in variables.items()}}
        return _Reading(self, values, variables, ring).formula(self.trees[part], {})

    def term(self, tree: Tree, letters: Mapping[str, Poly], ring: Ring) -> Poly:
        """A term in the letters, with polynomials for them."""
        return _Reading(self, letters, {}, ring).term(tree, {})

    def generic(self, part: str) -> Formula:
        """A part with the letters and variables themselves."""
        ring = self.ring
        return self.formula(part, {name: ring.var(name) for name in self.letters}, {v: v for v in self.variables}, ring)

    def parts(self, name: str) -> tuple[str, ...]:
        """The names of the components of a vector; the name itself where it is none."""
        return tuple(f"{name}{k}" for k in range(self.vectors[name])) if name in self.vectors else (name,)


@cache
def theorem(name: str, words: tuple[str, ...] = ()) -> Theorem | None:
    """The theorem of this name with these words for its marks, if there is one."""
    row = rows().get(name)
    if row is None or words not in set(row.choices()):
        return None
    marks = row.marks(words)
    trees = {part: _tree(row.data.get(part, "true"), marks) for part in ("block", "given", "answer")}
    named = {**row.table("fixed"), **row.table("let")}
    lets: dict[str, tuple[tuple[str, ...], Tree]] = {}
    for key, text in named.items():
        head, *names = key.rstrip(")").split("(")
        lets[head] = (tuple(n.strip() for n in names[0].split(",")) if names else (), _tree(text, marks))
    vectors = {key: int(_value_of(text, marks)) for key, text in row.table("vectors").items()}
    plain = Theorem(
        name,
        words,
        row.family,
        (),
        {},
        trees,
        lets,
        vectors,
        row.data.get("source", row.shared.get("source", "")),
        row.data.get("axiom", ""),
        row.data.get("proof", ""),
    )
    return _with_names(plain)


def _with_names(used: Theorem) -> Theorem:
    """The theorem with its letters and variables, as they stand in the text."""
    reached = {part: list(_reached(((), tree), used.lets)) for part, tree in used.trees.items()}
    bound = {
        part: tuple(n for _, tree in trees for name in _binders(tree) for n in used.parts(name))
        for part, trees in reached.items()
    }
    variables = {name for names in bound.values() for name in names}
    occurring = dict.fromkeys(n for trees in reached.values() for params, tree in trees for n in _names(tree, params))
    letters = tuple(n for name in occurring if name not in used.lets for n in used.parts(name) if n not in variables)
    if len(set(letters)) < len(letters) or any(len(set(names)) < len(names) for names in bound.values()):
        raise InputError(f"theorems: {used.name}: a name is used twice")
    return replace(used, letters=letters, bound=bound)


def _reached(
    start: tuple[tuple[str, ...], Tree], lets: Mapping[str, tuple[tuple[str, ...], Tree]]
) -> Iterator[tuple[tuple[str, ...], Tree]]:
    """A tree and those that it names, with the names of numbers in them."""
    pending, seen = [start], set[str]()
    for params, tree in pending:
        yield params, tree
        names = [name for name in _names(tree, params) if name in lets and name not in seen]
        seen.update(names)
        pending += [lets[name] for name in dict.fromkeys(names)]


def _value_of(text: str, marks: Mapping[str, str]) -> int:
    """A number such as {n} + 1."""
    return _Reading(None, {}, {}, Ring.of(())).number(_tree(text, marks), {})


# --- text ------------------------------------------------------------------------------------------


def _tree(text: str, marks: Mapping[str, str]) -> Tree:
    for mark, word in marks.items():
        text = text.replace(f"{{{mark}}}", word)
    text = re.sub(r"(?<![<>!=/])=(?!=)", "==", text.replace("/=", "!=").replace("^", "**"))
    return ast.parse(" ".join(text.split()), mode="eval").body


def _binders(tree: Tree) -> Iterator[str]:
    """The names that quantifiers bind."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in QUANTIFIERS:
            yield from (arg.id for arg in node.args[:-1] if isinstance(arg, ast.Name))


def _names(tree: Tree, params: Sequence[str]) -> Iterator[str]:
    """The names of variables, letters and what is let, but not of numbers."""
    targets = (node.target for node in ast.walk(tree) if isinstance(node, ast.comprehension))
    numbers = {target.id for target in targets if isinstance(target, ast.Name)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id not in {*RESERVED, *numbers, *params}:
            yield node.id


class _Reading:
    """The meaning of trees, where letters and variables stand for these polynomials, and variables have these names."""

    def __init__(
        self, used: Theorem | None, values: Mapping[str, Poly], names: Mapping[str, str], ring: Ring
    ) -> None:
        self.used, self.values, self.names, self.ring = used, values, names, ring
        self.known: dict[tuple[str, tuple[int, ...]], Value] = {}

    def formula(self, tree: Tree, numbers: Numbers) -> Formula:
        value = self.value(tree, numbers)
        if not isinstance(value, Formula):
            raise _wrong("a formula", tree)
        return value

    def term(self, tree: Tree, numbers: Numbers) -> Poly:
        value = self.value(tree, numbers)
        if not isinstance(value, Poly):
            raise _wrong("a term", tree)
        return value

    def number(self, tree: Tree, numbers: Numbers) -> int:
        value = self.term(tree, numbers)
        if not value.is_constant:
            raise _wrong("a number", tree)
        return value.constant_value()

    def members(self, tree: Tree, numbers: Numbers) -> tuple[Any, ...]:
        """The components of a vector, or members of a list."""
        value = self.value(tree, numbers)
        if not isinstance(value, tuple):
            raise _wrong("a vector", tree)
        return value

    def value(self, tree: Tree, numbers: Numbers) -> Value:
        match tree:
            case ast.Constant(int() as number):
                return self.ring.constant(number)
            case ast.Name(name):
                return self.ring.constant(numbers[name]) if name in numbers else self.named(name, ())
            case ast.Subscript(base, index):
                return self.component(base, self.number(index, numbers), numbers)
            case ast.UnaryOp(ast.USub(), operand):
                return -self.term(operand, numbers)
            case ast.UnaryOp(ast.Not(), operand):
                return neg(self.formula(operand, numbers))
            case ast.BinOp(base, ast.Pow(), exponent):
                return self.power(self.term(base, numbers), self.number(exponent, numbers))
            case ast.BinOp(first, op, second):
                return self.combined(op, self.term(first, numbers), self.term(second, numbers), tree)
            case ast.BoolOp(op, parts):
                return self.joined(isinstance(op, ast.And), parts, numbers)
            case ast.Compare(first, ops, others):
                return self.compared([first, *others], ops, numbers)
            case ast.IfExp(test, first, second):
                return self.value(first if self.holds(test, numbers) else second, numbers)
            case ast.List(parts):
                return tuple(self.value(part, numbers) for part in parts)
            case ast.ListComp(part, [place]) | ast.GeneratorExp(part, [place]):
                return tuple(self.value(part, inner) for inner in self.places(place, numbers))
            case ast.Call(ast.Name(name), args):
                return self.called(name, args, numbers)
        raise _wrong("a term or formula", tree)

    def named(self, name: str, at: tuple[int, ...]) -> Value:
        """What a name stands for, at numbers where it depends on them."""
        if name in ("true", "false"):
            return TRUE if name == "true" else FALSE
        if self.used is not None and name in self.used.lets and (name, at) not in self.known:
            params, tree = self.used.lets[name]
            self.known[name, at] = self.value(tree, dict(zip(params, at, strict=True)))
        if (name, at) in self.known:
            return self.known[name, at]
        if self.used is not None and name in self.used.vectors:
            return tuple(self.values[part] for part in self.used.parts(name))
        if name not in self.values or at:
            raise InputError(f"theorems: {name} is nothing")
        return self.values[name]

    def component(self, base: Tree, index: int, numbers: Numbers) -> Value:
        parts = self.members(base, numbers)
        if not 0 <= index < len(parts):
            raise _wrong("an index of a component", base)
        part: Value = parts[index]
        return part

    def power(self, base: Poly, exponent: int) -> Poly:
        if exponent < 0:
            raise InputError("theorems: a negative exponent")
        check_power(base, exponent)
        return base**exponent

    def combined(self, op: ast.operator, p: Poly, q: Poly, tree: Tree) -> Poly:
        match op:
            case ast.Add():
                return p + q
            case ast.Sub():
                return p - q
            case ast.Mult():
                return _times(p, q)
        raise _wrong("a term", tree)

    def joined(self, conjunctive: bool, parts: Sequence[Tree], numbers: Numbers) -> Formula:
        """The conjunction or disjunction; what stands after a part that settles it is not looked at."""
        read: list[Formula] = []
        for part in parts:
            read.append(self.formula(part, numbers))
            if read[-1] == (FALSE if conjunctive else TRUE):
                break
        return (conj if conjunctive else disj)(read)

    def compared(self, parts: Sequence[Tree], ops: Sequence[ast.cmpop], numbers: Numbers) -> Formula:
        sides = [self.term(part, numbers) for part in parts]
        relations = [Relation(RELATIONS[type(op)]) for op in ops]
        return conj(atom(p - q, rel) for p, q, rel in zip(sides, sides[1:], relations, strict=False))

    def holds(self, test: Tree, numbers: Numbers) -> bool:
        """Whether a comparison of numbers holds."""
        value = self.formula(test, numbers)
        if value not in (TRUE, FALSE):
            raise _wrong("a comparison of numbers", test)
        return value == TRUE

    def places(self, place: ast.comprehension, numbers: Numbers) -> Iterator[Numbers]:
        """The numbers, with each that the one of a list takes."""
        match place:
            case ast.comprehension(ast.Name(name), ast.Call(ast.Name("range"), args), tests):
                for k in range(*(self.number(arg, numbers) for arg in args)):
                    inner = {**numbers, name: k}
                    if all(self.holds(test, inner) for test in tests):
                        yield inner
                return
        raise InputError("theorems: a range expected")

    def called(self, name: str, args: Sequence[Tree], numbers: Numbers) -> Value:
        match name, args:
            case ("exists" | "forall"), [*binders, body]:
                names = [self.names[part] for b in binders for part in self.binder(b)]
                return QUANTIFIERS[name](names, self.formula(body, numbers))
            case ("all" | "any"), [listed]:
                return JOINS[name](self.members(listed, numbers))
            case "sum", [listed]:
                return sum(self.members(listed, numbers), self.ring.constant(0))
            case "dot", [first, second]:
                pairs = zip(self.members(first, numbers), self.members(second, numbers), strict=True)
                return sum((_times(p, q) for p, q in pairs), self.ring.constant(0))
            case "det", [matrix]:
                return determinant(self.members(matrix, numbers), self.ring)
        return self.named(name, tuple(self.number(arg, numbers) for arg in args))

    def binder(self, tree: Tree) -> tuple[str, ...]:
        if not isinstance(tree, ast.Name) or self.used is None:
            raise _wrong("a variable", tree)
        return self.used.parts(tree.id)


def determinant(rows: Sequence[Sequence[Poly]], ring: Ring) -> Poly:
    """By expansion along the rows; the minors of the last rows are kept."""
    below: dict[tuple[int, ...], Poly] = {(): ring.constant(1)}
    for row in reversed(rows):
        wider: dict[tuple[int, ...], Poly] = {}
        for columns, minor in below.items():
            for j, entry in enumerate(row):
                if j not in columns and entry and minor:
                    taken = tuple(sorted((*columns, j)))
                    part = _times(entry, minor) * (-1 if taken.index(j) % 2 else 1)
                    wider[taken] = wider.get(taken, ring.constant(0)) + part
        below = wider
    return below.get(tuple(range(len(rows))), ring.constant(0))


def _times(p: Poly, q: Poly) -> Poly:
    if p.term_count() * q.term_count() > PRODUCTS:
        raise Unable("a product in a theorem has too many terms")
    return p * q


def _wrong(expected: str, tree: ast.AST) -> InputError:
    return InputError(f"theorems: {expected} expected, {ast.unparse(tree)} found")
