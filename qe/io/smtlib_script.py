"""The meaning of an SMT-LIB script: commands, scopes and sorts; macros and ``let`` are expanded here."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from itertools import combinations, pairwise
from typing import NamedTuple, Never, TypeAlias, cast

from qe.errors import InputError
from qe.formula.syntax import Relation
from qe.io import surface as s
from qe.io.cases import Cases, choose, combine, compare, plain
from qe.io.names import check_name
from qe.io.smtlib_parser import Expression, Listing, Word
from qe.io.terms import TermError, decimal

Meaning: TypeAlias = Cases | s.Node

_PASSED_OVER = re.compile(
    r"set-(logic|info|option)|get-(info|option|model|value|assertions|assignment|proof|unsat-core|unsat-assumptions)|echo"
)
_RELATIONS = {"<": Relation.LT, "<=": Relation.LE, ">": Relation.GT, ">=": Relation.GE, "=": Relation.EQ}
_CONNECTIVES = frozenset(("not", "and", "or", "xor", "=>"))
_ARITHMETIC = frozenset(("+", "-", "*", "/", "^"))


class Macro(NamedTuple):
    """A ``define-fun`` with arguments: their names and sorts, the sort of the body, the body, and its scope."""

    parameters: list[tuple[str, str]]
    sort: str
    body: Expression
    scope: Scope


Scope: TypeAlias = Mapping[str, "Meaning | Macro"]


def _is_real(meaning: Meaning) -> bool:
    """Cases are a plain tuple of cases; formulas are named tuples."""
    return type(meaning) is tuple


class Script:
    """One pass over the commands. ``names``: the variables, declared ones first; bound variables get names of
    their own here, so nothing is captured when a definition is expanded. ``shared``: definitions, in order."""

    def __init__(self, fail: s.Fail) -> None:
        self.fail = fail
        self.names: list[str] = []
        self.taken: set[str] = set()
        self.shared: list[s.Part] = []
        self.globals: dict[str, Meaning | Macro] = {}
        self.assertions: list[s.Node] = []
        self.checked = False

    def error(self, message: str, at: int) -> Never:
        raise self.fail(message, at)

    # --- commands --------------------------------------------------------------------------
    def run(self, commands: list[Expression]) -> s.Node:
        """The conjunction of all assertions."""
        bound_later: list[Listing] = []
        for command in commands:
            if not isinstance(command, Listing) or not command.items or not isinstance(command.items[0], Word):
                self.error("a command in brackets expected", command.at)
            if command.items[0].text == "exit":
                break
            bound_later.append(command)
        for command in bound_later:
            self.declare_if_declaration(command)
        for command in bound_later:
            self.command(command)
        return s.Every(list(self.assertions))

    def declare_if_declaration(self, command: Listing) -> None:
        """Reserve declared names first, so that no bound variable takes one of them."""
        head, *rest = command.items
        if head[1] in ("declare-const", "declare-fun") and rest and isinstance(rest[0], Word):
            self.taken.add(rest[0].text)

    def command(self, command: Listing) -> None:
        head = cast(Word, command.items[0])
        rest = command.items[1:]
        match head.text:
            case "assert":
                self.arity(command, 1)
                if self.checked:
                    self.error("an assert after check-sat is not supported: one question per script", command.at)
                self.assertions.append(self.formula(rest[0], self.globals))
            case "declare-const":
                self.arity(command, 2)
                self.declare(rest[0], rest[1])
            case "declare-fun":
                self.arity(command, 3)
                if not isinstance(rest[1], Listing) or rest[1].items:
                    self.error("only functions without arguments can be declared", rest[1].at)
                self.declare(rest[0], rest[2])
            case "define-const":
                self.arity(command, 3)
                self.define(rest[0], [], rest[1], rest[2])
            case "define-fun":
                self.arity(command, 4)
                self.define(rest[0], self.parameters(rest[1]), rest[2], rest[3])
            case "check-sat":
                self.checked = True
            case name if _PASSED_OVER.fullmatch(name):
                return
            case "push" | "pop" | "reset" | "reset-assertions" | "check-sat-assuming":
                self.error(f"{head.text} is not supported: one question per script", head.at)
            case _:
                self.error(f"the command {head.text} is not supported", head.at)

    def declare(self, name: Expression, sort: Expression) -> None:
        symbol = self.symbol(name)
        self.fresh_global(symbol, name.at)
        self.names.append(symbol)
        self.globals[symbol] = self.variable(symbol, self.sort(sort), name.at)

    def define(self, name: Expression, parameters: list[tuple[str, str]], sort: Expression, body: Expression) -> None:
        symbol = self.symbol(name)
        self.fresh_global(symbol, name.at)
        wanted = self.sort(sort)
        if parameters:
            self.globals[symbol] = Macro(parameters, wanted, body, dict(self.globals))
        else:
            self.globals[symbol] = self.share(self.expect(self.meaning(body, self.globals), wanted, body.at))

    def fresh_global(self, name: str, at: int) -> None:
        if name in self.globals:
            self.error(f"{name} is declared twice", at)

    def parameters(self, listing: Expression) -> list[tuple[str, str]]:
        if not isinstance(listing, Listing):
            self.error("a list of sorted variables expected", listing.at)
        found: list[tuple[str, str]] = []
        for item in listing.items:
            if not isinstance(item, Listing) or len(item.items) != 2:
                self.error("(name sort) expected", item.at)
            found.append((self.symbol(item.items[0]), self.sort(item.items[1])))
        return found

    # --- words -----------------------------------------------------------------------------
    def symbol(self, word: Expression) -> str:
        if not isinstance(word, Word) or word.kind != "SYMBOL":
            self.error("a symbol expected", word.at)
        try:
            return check_name(word.text)
        except InputError as error:
            self.error(str(error), word.at)

    def sort(self, word: Expression) -> str:
        name = word.text if isinstance(word, Word) else "…"
        if name not in ("Real", "Bool"):
            self.error(f"sort Real or Bool expected, {name} found", word.at)
        return name

    def arity(self, listing: Listing, count: int) -> None:
        if len(listing.items) != count + 1:
            self.error(f"{count} arguments expected, {len(listing.items) - 1} found", listing.at)

    def variable(self, name: str, sort: str, at: int) -> Meaning:
        real = s.Name(name, at)
        return plain(real) if sort == "Real" else s.Comparison([real, s.Number(0)], [Relation.GT], at)

    def share(self, meaning: Meaning) -> Meaning:
        """Remember a definition, so that its value is computed once and before its uses."""
        parts = [case.term for case in cast(Cases, meaning)] if _is_real(meaning) else [cast(s.Node, meaning)]
        self.shared.extend(parts)
        return meaning

    def expect(self, meaning: Meaning, sort: str, at: int) -> Meaning:
        if _is_real(meaning) is not (sort == "Real"):
            other = "Bool" if sort == "Real" else "Real"
            self.error(f"a term of sort {sort} expected, one of sort {other} found", at)
        return meaning

    # --- terms -----------------------------------------------------------------------------
    def formula(self, expression: Expression, scope: Scope) -> s.Node:
        return cast(s.Node, self.expect(self.meaning(expression, scope), "Bool", expression.at))

    def real(self, expression: Expression, scope: Scope) -> Cases:
        return cast(Cases, self.expect(self.meaning(expression, scope), "Real", expression.at))

    def meaning(self, expression: Expression, scope: Scope) -> Meaning:
        while isinstance(expression, Listing) and expression.items and expression.items[0][:2] == ("SYMBOL", "let"):
            expression, scope = self.let(expression, scope)
        try:
            if isinstance(expression, Word):
                return self.word(expression, scope)
            return self.application(expression, scope)
        except TermError as error:
            self.error(str(error), expression.at)

    def word(self, word: Word, scope: Scope) -> Meaning:
        if word.kind == "NUMBER":
            return plain(s.Number(decimal(word.text)))
        if word.kind != "SYMBOL":
            self.error(f"unexpected {word.text[:40]}", word.at)
        if word.text in ("true", "false") and word.text not in scope:
            return s.Truth(word.text == "true")
        found = scope.get(word.text)
        if found is None:
            self.error(f"unknown symbol {word.text}", word.at)
        if isinstance(found, Macro):
            self.error(f"{word.text} needs {len(found.parameters)} arguments", word.at)
        return found

    def let(self, expression: Listing, scope: Scope) -> tuple[Expression, Scope]:
        self.arity(expression, 2)
        bindings, body = expression.items[1:]
        if not isinstance(bindings, Listing):
            self.error("a list of bindings expected", bindings.at)
        inner = dict(scope)
        for item in bindings.items:
            if not isinstance(item, Listing) or len(item.items) != 2:
                self.error("(name term) expected", item.at)
            inner[self.symbol(item.items[0])] = self.share(self.meaning(item.items[1], scope))
        return body, inner

    def application(self, listing: Listing, scope: Scope) -> Meaning:
        if not listing.items or not isinstance(listing.items[0], Word):
            self.error("an operator expected after '('", listing.at)
        head, arguments = listing.items[0], listing.items[1:]
        macro = scope.get(head.text)
        if isinstance(macro, Macro):
            return self.expand(macro, listing, scope)
        if macro is not None:
            self.error(f"{head.text} takes no arguments", head.at)
        if head.text in ("exists", "forall"):
            self.arity(listing, 2)
            return self.quantified(head.text == "forall", arguments[0], arguments[1], scope)
        if head.text == "!":
            return self.annotated(arguments, listing, scope)
        if not arguments:
            self.error(f"{head.text} without arguments", listing.at)
        if head.text == "ite":
            return self.ite(listing, scope)
        if head.text in _CONNECTIVES:
            return _connective(head.text, [self.formula(a, scope) for a in arguments], self.fail, head.at)
        if head.text in _ARITHMETIC:
            return self.share(_arithmetic(head.text, [self.real(a, scope) for a in arguments], head.at))
        if head.text in _RELATIONS or head.text == "distinct":
            return self.relation(head, arguments, scope)
        return self.error(f"unknown function {head.text}", head.at)

    def expand(self, macro: Macro, listing: Listing, scope: Scope) -> Meaning:
        self.arity(listing, len(macro.parameters))
        inner = dict(macro.scope)
        for (name, sort), argument in zip(macro.parameters, listing.items[1:], strict=True):
            inner[name] = self.expect(self.meaning(argument, scope), sort, argument.at)
        return self.expect(self.meaning(macro.body, inner), macro.sort, listing.at)

    def annotated(self, arguments: list[Expression], listing: Listing, scope: Scope) -> Meaning:
        if not arguments:
            self.error("a term expected", listing.at)
        meaning = self.meaning(arguments[0], scope)
        for key, value in pairwise(arguments[1:]):
            if key[:2] == ("KEYWORD", ":named"):
                self.globals[self.symbol(value)] = meaning
        return meaning

    def quantified(self, universal: bool, variables: Expression, body: Expression, scope: Scope) -> s.Node:
        inner, names = dict(scope), []
        for name, sort in self.parameters(variables):
            fresh, k = name, 0
            while fresh in self.taken:
                k += 1
                fresh = f"{name}_{k}"
            self.taken.add(fresh)
            self.names.append(fresh)
            names.append(fresh)
            inner[name] = self.variable(fresh, sort, variables.at)
        if not names:
            self.error("a quantifier without variables", variables.at)
        return s.Quantification(universal, names, self.formula(body, inner))

    def ite(self, listing: Listing, scope: Scope) -> Meaning:
        self.arity(listing, 3)
        condition = self.formula(listing.items[1], scope)
        then, other = self.meaning(listing.items[2], scope), self.meaning(listing.items[3], scope)
        self.expect(other, "Real" if _is_real(then) else "Bool", listing.items[3].at)
        if _is_real(then):
            return choose(condition, cast(Cases, then), cast(Cases, other))
        yes, no = cast(s.Node, then), cast(s.Node, other)
        return s.Every([s.Implication(condition, yes), s.Some([condition, no])])

    def relation(self, head: Word, arguments: list[Expression], scope: Scope) -> s.Node:
        if len(arguments) < 2:
            self.error(f"{head.text} needs two arguments", head.at)
        meanings = [self.meaning(a, scope) for a in arguments]
        boolean = head.text in ("=", "distinct") and not _is_real(meanings[0])
        for meaning, argument in zip(meanings, arguments, strict=True):
            self.expect(meaning, "Bool" if boolean else "Real", argument.at)
        pairs = combinations(meanings, 2) if head.text == "distinct" else pairwise(meanings)
        links: list[s.Node] = []
        for left, right in pairs:
            if boolean:
                same: s.Node = s.Equivalence(cast(s.Node, left), cast(s.Node, right))
                links.append(s.Negation(same) if head.text == "distinct" else same)
            else:
                relation = _RELATIONS.get(head.text, Relation.NE)
                links.append(compare(cast(Cases, left), relation, cast(Cases, right), head.at))
        return links[0] if len(links) == 1 else s.Every(links)


def _connective(operator: str, parts: list[s.Node], fail: s.Fail, at: int) -> s.Node:
    if operator == "not":
        if len(parts) != 1:
            raise fail("not takes one argument", at)
        return s.Negation(parts[0])
    if operator == "and":
        return s.Every(parts)
    if operator == "or":
        return s.Some(parts)
    if operator == "xor":
        result = parts[0]
        for part in parts[1:]:
            result = s.Negation(s.Equivalence(result, part))
        return result
    result = parts[-1]
    for part in reversed(parts[:-1]):
        result = s.Implication(part, result)
    return result


def _arithmetic(operator: str, operands: list[Cases], at: int) -> Cases:
    if operator == "-" and len(operands) == 1:
        return combine(operands, lambda terms: s.Minus(terms[0]))
    if operator == "+":
        return combine(operands, lambda terms: s.Sum(terms))
    if operator == "-":
        return combine(operands, lambda terms: s.Sum([terms[0], *(s.Minus(t) for t in terms[1:])]))
    build: Callable[[s.Term, s.Term, int], s.Term]
    build = s.Product if operator == "*" else s.Quotient if operator == "/" else s.Power

    def chain(terms: list[s.Term]) -> s.Term:
        result = terms[0]
        for term in terms[1:]:
            result = build(result, term, at)
        return result

    return combine(operands, chain)
