"""Terms and formulas as text, and what they mean once their letters stand for polynomials.

Terms and conditions are written as in Python, with ``^`` for powers, ``=`` and ``/=`` for equations and inequations,
and ``exists(x, y, F)`` or ``forall(x, F)`` for quantifiers.
What is let may depend on numbers: "a(i, j)". Beside it are ``dot(u, v)`` and ``det(rows)``; ``sum``, ``all`` and
``any`` of ``... for j in range(...)`` as in Python; and ``A if C else B``, where C is a comparison of numbers.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from qe.errors import InputError, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.kernel.limits import check_power

PRODUCTS = 1_000_000
"""The terms of two factors multiplied, at most."""

RELATIONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=", ast.NotEq: "/="}
QUANTIFIERS = {"exists": exists, "forall": forall}
JOINS = {"all": conj, "any": disj}

Tree = ast.expr
Value = Poly | Formula | tuple[Any, ...]
Numbers = Mapping[str, int]
"""What the names of numbers stand for."""

Let = tuple[tuple[str, ...], Tree]
"""The names of the numbers on which something depends, and the text that says what it is."""


@dataclass(frozen=True, slots=True)
class Language:
    """What is let, by its name, and how many components vectors have."""

    lets: Mapping[str, Let] = field(default_factory=dict)
    vectors: Mapping[str, int] = field(default_factory=dict)

    def parts(self, name: str) -> tuple[str, ...]:
        """The names of the components of a vector; the name itself where it is none."""
        return tuple(f"{name}{k}" for k in range(self.vectors[name])) if name in self.vectors else (name,)


def parsed(text: str, marks: Mapping[str, str]) -> Tree:
    """The tree of a text with words for its marks."""
    for mark, word in marks.items():
        text = text.replace(f"{{{mark}}}", word)
    return _tree(text)


@cache
def _tree(text: str) -> Tree:
    text = re.sub(r"(?<![<>!=/])=(?!=)", "==", text.replace("/=", "!=").replace("^", "**"))
    return ast.parse(" ".join(text.split()), mode="eval").body


class Reading:
    """The meaning of trees, where letters and variables stand for these polynomials, and variables have these names."""

    def __init__(self, language: Language, values: Mapping[str, Poly], names: Mapping[str, str], ring: Ring) -> None:
        self.language, self.values, self.names, self.ring = language, values, names, ring
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
        if name in self.language.lets and (name, at) not in self.known:
            params, tree = self.language.lets[name]
            self.known[name, at] = self.value(tree, dict(zip(params, at, strict=True)))
        if (name, at) in self.known:
            return self.known[name, at]
        if name in self.language.vectors:
            return tuple(self.values[part] for part in self.language.parts(name))
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
            case (("exists" | "forall"), [*binders, body]):
                names = [self.names[part] for b in binders for part in self.binder(b)]
                return QUANTIFIERS[name](names, self.formula(body, numbers))
            case (("all" | "any"), [listed]):
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
        if not isinstance(tree, ast.Name):
            raise _wrong("a variable", tree)
        return self.language.parts(tree.id)


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
