"""The meaning of SMT-LIB terms: scopes and sorts; macros and ``let`` are expanded here."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from itertools import combinations, pairwise
from typing import NamedTuple, Never, TypeAlias, cast

from qe.errors import InputError, Unable
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.names import check_name
from qe.io.smtlib_parser import Expression, Listing, Word, show, symbols
from qe.io.terms import TermError, decimal
from qe.io.text_errors import way_out

Meaning: TypeAlias = s.Term | s.Node

MOST_STEPS = 1_000_000
"""Terms of one command, definitions written out."""

_RELATIONS = {"<": Relation.LT, "<=": Relation.LE, ">": Relation.GT, ">=": Relation.GE, "=": Relation.EQ}
_CONNECTIVES = frozenset(("not", "and", "or", "xor", "=>", "implies"))
_ARITHMETIC = frozenset(("+", "-", "*", "/", "^"))
_INFIX = frozenset((*_RELATIONS, *_CONNECTIVES, *_ARITHMETIC))
_SIGNED = re.compile(r"(-?)([0-9]+\.?[0-9]*|\.[0-9]+)")
"""What most solvers take for a number: a symbol for the standard, which may be declared."""
_INTEGERS = frozenset(("div", "mod", "rem", "to_int", "is_int", "divisible"))


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
    return not isinstance(meaning, s.Node)


class Terms:
    """Reads terms. ``names``: the variables, declared ones first; bound variables get names of their own here, so
    nothing is captured when a definition is expanded. ``bound``: those. ``shared``: definitions, in order.

    ``lenient``: a value that is not read (of ``tanh``, of an integer or a declared function) gets a name of its own,
    which is free. ``fixed`` are such names where no variable stands inside, ``varying`` the others.
    """

    def __init__(self, fail: s.Fail, tick: Callable[[], None] = lambda: None) -> None:
        self.fail, self.tick, self.steps = fail, tick, 0
        self.expanded: dict[tuple[int, ...], tuple[object, Meaning]] = {}
        self.names: list[str] = []
        self.bound: set[str] = set()
        self.taken: set[str] = set()
        self.reserved: set[str] = set()
        self.sorts: dict[str, str] = {}  # names of sorts that are defined
        self.shared: list[s.Part] = []
        self.forms: dict[object, Meaning] = {}
        self.globals: dict[str, Meaning | Macro | Foreign] = {}
        self.lenient = False
        self.inside = 0
        self.fixed: set[str] = set()
        self.varying: set[str] = set()

    def error(self, message: str, at: int) -> Never:
        raise self.fail(message, at)

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
        return word.text

    def sort(self, word: Expression) -> str:
        name = show(word)[:40]
        name = self.sorts.get(name, name)
        if name not in ("Real", "Bool"):
            hint = "; all numbers are real here" if name == "Int" else ""
            self.error(f"sort Real or Bool expected, {name} found{hint}", word.at)
        return name

    def fresh(self, symbol: str) -> str:
        """A name of its own for a variable, its symbol where that is free and a possible name."""
        try:
            name = base = check_name(symbol)
        except InputError:
            name = base = "v"
        k = 0
        while name in self.taken or name in self.reserved:
            k += 1
            name = f"{base}_{k}"
        self.taken.add(name)
        self.names.append(name)
        return name

    def arity(self, listing: Listing, count: int) -> None:
        if len(listing.items) != count + 1:
            self.error(f"{count} arguments expected, {len(listing.items) - 1} found", listing.at)

    def variable(self, name: str, sort: str, at: int) -> Meaning:
        real = s.Name(name, at)
        return real if sort == "Real" else s.Comparison([real, s.Number(0)], [Relation.GT], at)

    def share(self, meaning: Meaning) -> Meaning:
        """Remember a definition, so that its value is computed once and before its uses; what was said before in the
        same words is the same object."""
        form = (type(meaning), *(_leaf(field) for name, field in zip(meaning._fields, meaning) if name != "at"))
        known = self.forms.setdefault(form, meaning)
        if known is meaning:
            self.shared.append(meaning)
        return known

    def once(self, node: s.Node) -> Meaning:
        """A formula that is shared, unless it may have bound variables."""
        return node if self.inside else self.share(node)

    def expect(self, meaning: Meaning, sort: str, at: int) -> Meaning:
        if is_real(meaning) is not (sort == "Real"):
            other = "Bool" if sort == "Real" else "Real"
            self.error(f"a term of sort {sort} expected, one of sort {other} found", at)
        return meaning

    # --- terms -----------------------------------------------------------------------------
    def formula(self, expression: Expression, scope: Scope) -> s.Node:
        return cast(s.Node, self.expect(self.meaning(expression, scope), "Bool", expression.at))

    def real(self, expression: Expression, scope: Scope) -> s.Term:
        return cast(s.Term, self.expect(self.meaning(expression, scope), "Real", expression.at))

    def meaning(self, expression: Expression, scope: Scope) -> Meaning:
        self.steps += 1
        if self.steps % 256 == 0:
            self.tick()
        if self.steps > MOST_STEPS:
            raise Unable(f"definitions written out make this more than {MOST_STEPS:,} terms")
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
            return s.Number(decimal(word.text))
        if word.kind != "SYMBOL":
            self.error(f"unexpected {word.text[:40]}", word.at)
        if word.text in ("true", "false") and word.text not in scope:
            return s.Truth(word.text == "true")
        found = scope.get(word.text)
        if found is None:
            if (number := _SIGNED.fullmatch(word.text)) is None:
                self.error(f"the symbol {word.text} is not declared", word.at)
            value = s.Number(decimal(number[2]))
            return s.Minus(value) if number[1] else value
        if isinstance(found, Macro):
            self.error(f"{word.text} needs {len(found.parameters)} arguments", word.at)
        if isinstance(found, Foreign):
            return self.unread(word, scope, found.sort, f"the declaration of {word.text} was not read")
        return found

    def unread(self, expression: Expression, scope: Scope, sort: str, message: str) -> Meaning:
        """A value that is not read: a name of its own, the same for the same text, where that is allowed."""
        head = expression.items[0] if isinstance(expression, Listing) else expression
        inside = [text for text in symbols(expression) if text in scope and not isinstance(scope[text], Foreign)]
        if not self.lenient or any(scope[text] is not self.globals.get(text) for text in inside):
            self.error(message, head.at)
        key = f"|{show(expression)}|"  # no symbol contains a bar
        if (known := self.globals.get(key)) is None:
            name = self.fresh("unread")
            (self.varying if inside else self.fixed).add(name)
            known = self.globals[key] = self.variable(name, sort, expression.at)
        return cast(Meaning, known)

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
        if isinstance(macro, Foreign):
            return self.unread(listing, scope, macro.sort, f"the declaration of {head.text} was not read")
        if macro is not None:
            operator = arguments[0].text if arguments and isinstance(arguments[0], Word) else ""
            hint = f"; an operator stands first: ({operator} {head.text} …)" if operator in _INFIX else ""
            self.error(f"{head.text} takes no arguments{hint}", head.at)
        return self.known(listing, head, arguments, scope)

    def known(self, listing: Listing, head: Word, arguments: list[Expression], scope: Scope) -> Meaning:
        """The meaning of an application of an operator or function of the language itself."""
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
            return self.once(_connective(head.text, [self.formula(a, scope) for a in arguments], self.fail, head.at))
        if head.text in _ARITHMETIC:
            return self.arithmetic(head.text, [self.real(a, scope) for a in arguments], head.at)
        if head.text == "to_real":
            self.arity(listing, 1)
            return self.real(arguments[0], scope)
        if head.text in s.FUNCTIONS:
            return self.share(self.apply(head, [self.real(a, scope) for a in arguments]))
        if head.text == "root-obj":
            return self.root_object(listing, scope)
        if head.text in _RELATIONS or head.text == "distinct":
            return self.once(self.relation(head, arguments, scope))
        if head.text in _INTEGERS:
            sort = "Bool" if head.text in ("is_int", "divisible") else "Real"
            return self.unread(listing, scope, sort, f"{head.text} needs integers; all numbers are real here")
        message = way_out(head.text)
        if "algebraic" in message:
            return self.unread(listing, scope, "Real", message)
        return self.error(f"the function {head.text} is not supported", head.at)

    def arithmetic(self, operator: str, operands: list[s.Term], at: int) -> Meaning:
        """A sum, product, quotient or power, from the left."""
        if operator == "-" and len(operands) == 1:
            return self.share(s.Minus(operands[0]))
        if len(operands) == 1:
            return operands[0]
        if operator == "+":
            return self.share(s.Sum(operands))
        if operator == "-":
            return self.share(s.Sum([operands[0], *(cast(s.Term, self.share(s.Minus(term))) for term in operands[1:])]))
        build: Callable[[s.Term, s.Term, int], s.Term]
        build = s.Product if operator == "*" else s.Quotient if operator == "/" else s.Power
        result = operands[0]
        for term in operands[1:]:
            result = cast(s.Term, self.share(build(result, term, at)))
        return result

    def apply(self, head: Word, arguments: list[s.Term]) -> s.Term:
        least, most = s.FUNCTIONS[head.text]
        if not least <= len(arguments) <= most:
            self.error(f"{head.text} does not take {len(arguments)} arguments", head.at)
        return s.Apply(head.text, arguments, head.at)

    def root_object(self, listing: Listing, scope: Scope) -> s.Term:
        """``(root-obj p k)``, as models write an algebraic number: the k-th real root of p in x."""
        self.arity(listing, 2)
        number = self.real(listing.items[2], scope)
        inner = {**scope, "x": s.Name("x", listing.at)}
        if "x" not in self.names:
            self.names.append("x")
        return s.Root(number, self.real(listing.items[1], inner), "x", listing.at)

    def expand(self, macro: Macro, listing: Listing, scope: Scope) -> Meaning:
        self.arity(listing, len(macro.parameters))
        inner = dict(macro.scope)
        values: list[Meaning] = []
        for (name, sort), argument in zip(macro.parameters, listing.items[1:], strict=True):
            inner[name] = self.expect(self.meaning(argument, scope), sort, argument.at)
            values.append(cast(Meaning, inner[name]))
        key = (id(macro.body), *map(id, values))
        if key not in self.expanded:  # what the identities are of is kept with them
            meant = self.expect(self.meaning(macro.body, inner), macro.sort, listing.at)
            self.expanded[key] = (macro.body, values), meant
        return self.expanded[key][1]

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
            fresh = self.fresh(name)
            self.bound.add(fresh)
            names.append(fresh)
            inner[name] = self.variable(fresh, sort, variables.at)
        if not names:
            self.error("a quantifier without variables", variables.at)
        self.inside += 1
        try:
            return s.Quantification(universal, names, self.formula(body, inner))
        finally:
            self.inside -= 1

    def ite(self, listing: Listing, scope: Scope) -> Meaning:
        self.arity(listing, 3)
        condition = self.formula(listing.items[1], scope)
        then, other = self.meaning(listing.items[2], scope), self.meaning(listing.items[3], scope)
        self.expect(other, "Real" if is_real(then) else "Bool", listing.items[3].at)
        if is_real(then):
            return self.share(s.Choice(condition, cast(s.Term, then), cast(s.Term, other), listing.at))
        yes, no = cast(s.Node, then), cast(s.Node, other)
        return s.Every([s.Implication(condition, yes), s.Some([condition, no])])

    def relation(self, head: Word, arguments: list[Expression], scope: Scope) -> s.Node:
        if len(arguments) < 2:
            self.error(f"{head.text} needs two arguments", head.at)
        meanings = [self.meaning(a, scope) for a in arguments]
        boolean = head.text in ("=", "distinct") and not is_real(meanings[0])
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
                links.append(s.Comparison([cast(s.Term, left), cast(s.Term, right)], [relation], head.at))
        return links[0] if len(links) == 1 else s.Every(links)


def _leaf(field: object) -> object:
    """A part of a form: names and numbers by what they are, what is made of others by its identity."""
    match field:
        case s.Name(name):
            return name
        case s.Number(value):
            return value
        case list():
            return tuple(map(_leaf, field))
    return id(field) if isinstance(field, tuple) else field


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
