"""What the words of SMT-LIB terms stand for: names, sorts and numbers, in their scopes; and what is said twice."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple, Never, TypeAlias, cast

from qe.errors import InputError
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.smtlib_parser import Expression, is_symbol, place, plain, show, words

Meaning: TypeAlias = s.Term | s.Node

_SIGNED = re.compile(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)")
"""What most solvers take for a number: a symbol for the standard, which may be declared."""


class Macro(NamedTuple):
    """A ``define-fun`` with arguments: their names and sorts, the sort of the body, the body, and its scope."""

    parameters: list[tuple[str, str]]
    sort: str
    body: Expression
    scope: Scope


class Foreign(NamedTuple):
    """A symbol that was declared, but not read: only the sort of its values is known."""

    sort: str


Scope: TypeAlias = Mapping[str, "Meaning | Macro | Foreign"]


def is_real(meaning: Meaning) -> bool:
    """Whether a term is one of sort Real; else it is a formula."""
    return meaning.__class__ in s.TERMS


class Words:
    """``names``: the variables, declared ones first; bound variables get names of their own here, so nothing is
    captured when a definition is expanded. ``bound``: those. ``shared``: definitions, in order.

    ``lenient``: a value that is not read (of ``tanh``, of an integer or a declared function) gets a name of its own,
    which is free. ``fixed`` are such names where no variable stands inside, ``varying`` the others.
    """

    def __init__(self, fail: s.Fail) -> None:
        self.fail = fail
        self.names: list[str] = []
        self.bound: set[str] = set()
        self.taken: set[str] = set()
        self.reserved: set[str] = set()
        self.sorts: dict[str, str] = {}  # names of sorts that are defined
        self.shared: list[s.Part] = []
        self.forms: dict[object, Meaning] = {}
        self.globals: dict[str, Meaning | Macro | Foreign] = {}
        self.numbers: dict[str, s.Number] = {}  # by their words
        self.lenient = False
        self.inside = 0
        self.fixed: set[str] = set()
        self.varying: set[str] = set()

    def error(self, message: str, at: Expression) -> Never:
        raise self.fail(message, place(at))

    def items(self, expression: Expression, message: str, count: int | None = None) -> list[Expression]:
        """The items of what must be a list, of so many; ``message`` says what was expected where it is none."""
        if isinstance(expression, str) or count not in (None, len(expression)):
            self.error(message, expression)
        return expression

    def parameters(self, listing: Expression) -> list[tuple[str, str]]:
        pairs = (
            self.items(item, "(name sort) expected", 2)
            for item in self.items(listing, "a list of sorted variables expected")
        )
        return [(self.symbol(name), self.sort(sort)) for name, sort in pairs]

    def symbol(self, word: Expression) -> str:
        if isinstance(word, str) and is_symbol(word):
            return str(word)
        return self.error("a symbol expected", word)

    def sort(self, word: Expression) -> str:
        name = show(word)[:40]
        name = self.sorts.get(name, name)
        if name not in ("Real", "Bool"):
            hint = "; all numbers are real here" if name == "Int" else ""
            self.error(f"sort Real or Bool expected, {name} found{hint}", word)
        return name

    def fresh(self, symbol: str) -> str:
        """A name of its own for a variable, its symbol where that is free and a possible name."""
        from qe.io.names import check_name

        try:
            name = base = check_name(plain(symbol))
        except InputError:
            name = base = "v"
        k = 0
        while name in self.taken or name in self.reserved:
            k += 1
            name = f"{base}_{k}"
        self.taken.add(name)
        self.names.append(name)
        return name

    def arity(self, listing: list[Expression], count: int) -> None:
        if len(listing) != count + 1:
            self.error(f"{count} arguments expected, {len(listing) - 1} found", listing)

    def variable(self, name: str, sort: str, at: int) -> Meaning:
        real = s.Name(name, at)
        return real if sort == "Real" else s.Comparison([real, s.Number(0)], [Relation.GT], at)

    def share(self, meaning: Meaning, form: tuple[object, ...] = ()) -> Meaning:
        """Remember a definition, so that its value is computed once and before its uses; what was said before in the
        same words is the same object. ``form``: what it is made of, all but its place."""
        if self.shared and meaning is self.shared[-1]:
            return meaning
        if not form:
            form = (meaning.__class__, *map(leaf, meaning[:-1] if meaning._fields[-1] == "at" else meaning))
        known = self.forms.setdefault(form, meaning)
        if known is meaning:
            self.shared.append(meaning)
        return known

    def expect(self, meaning: Meaning, sort: str, at: Expression) -> Meaning:
        if is_real(meaning) is not (sort == "Real"):
            other = "Bool" if sort == "Real" else "Real"
            self.error(f"a term of sort {sort} expected, one of sort {other} found", at)
        return meaning

    def word(self, word: str, scope: Scope) -> Meaning:
        if not is_symbol(word):
            if not word[0].isdigit():
                self.error(f"unexpected {word[:40]}", word)
            if (number := self.numbers.get(word)) is None:
                number = self.numbers[str(word)] = self.number(word, word)
            return number
        value = scope.get(word)
        if value is None:
            return self.constant(word)
        if isinstance(value, Macro):
            self.error(f"{plain(word)} needs {len(value.parameters)} arguments", word)
        if isinstance(value, Foreign):
            return self.unread(word, scope, value.sort, f"the declaration of {plain(word)} was not read")
        return value

    def constant(self, word: str) -> Meaning:
        """What a symbol that nobody has declared means."""
        if word in ("true", "false"):
            return s.Truth(word == "true")
        if _SIGNED.fullmatch(plain(word)) is None:
            self.error(f"the symbol {plain(word)} is not declared", word)
        return self.number(plain(word), word)

    def number(self, text: str, word: str) -> s.Number:
        from qe.io.terms import TermError, decimal

        try:
            value = decimal(text)
        except TermError as error:
            self.error(str(error), word)
        return s.Number(value.numerator if value.denominator == 1 else value)

    def unread(self, expression: Expression, scope: Scope, sort: str, message: str) -> Meaning:
        """A value that is not read: a name of its own, the same for the same text, where that is allowed."""
        head = expression if isinstance(expression, str) else expression[0]
        inside = [word for word in words(expression) if word in scope and not isinstance(scope[word], Foreign)]
        if not self.lenient or any(scope[word] is not self.globals.get(word) for word in inside):
            self.error(message, head)
        key = f"||{show(expression)}||"  # no symbol begins with two bars and goes on
        if (known := self.globals.get(key)) is None:
            name = self.fresh("unread")
            (self.varying if inside else self.fixed).add(name)
            known = self.globals[key] = self.variable(name, sort, place(expression))
        return cast(Meaning, known)


def leaf(field: object) -> object:
    """A part of a form: names, numbers and polynomials by what they are, what is made of others by its identity."""
    match field:
        case s.Name(name):
            return name
        case s.Number(value):
            return value
        case s.Polynomial(terms):
            return leaf(terms)
        case dict():
            return tuple(field.items())
        case list():
            return tuple(map(leaf, field))
    return id(field) if isinstance(field, tuple) else field
