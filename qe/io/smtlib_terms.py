"""The meaning of SMT-LIB terms: scopes and sorts; macros and ``let`` are expanded here."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import reduce
from itertools import combinations, pairwise
from typing import NamedTuple, Never, TypeAlias, cast, get_args

from qe.errors import InputError, Unable
from qe.formula.relation import Relation
from qe.io import collected
from qe.io import surface as s
from qe.io.names import check_name
from qe.io.smtlib_parser import Expression, is_symbol, place, plain, show, words
from qe.io.terms import TermError, decimal
from qe.io.text_errors import way_out

Meaning: TypeAlias = s.Term | s.Node

MOST_STEPS = 1_000_000
"""Terms of one command, definitions written out."""

_RELATIONS = {"<": Relation.LT, "<=": Relation.LE, ">": Relation.GT, ">=": Relation.GE, "=": Relation.EQ}
_TERMS = frozenset(get_args(s.Term))
_CONNECTIVES = frozenset(("not", "and", "or", "xor", "=>", "implies"))
_ARITHMETIC = frozenset(("+", "-", "*", "/", "^"))
_INFIX = frozenset((*_RELATIONS, *_CONNECTIVES, *_ARITHMETIC))
_SIGNED = re.compile(r"(-?)([0-9]+\.?[0-9]*|\.[0-9]+)")
"""What most solvers take for a number: a symbol for the standard, which may be declared."""
_WITHOUT_ARGUMENTS = frozenset(("exists", "forall", "!"))
"""What says itself what it needs."""
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
    return meaning.__class__ in _TERMS


class Terms:
    """Reads terms. ``names``: the variables, declared ones first; bound variables get names of their own here, so
    nothing is captured when a definition is expanded. ``bound``: those. ``shared``: definitions, in order.

    ``lenient``: a value that is not read (of ``tanh``, of an integer or a declared function) gets a name of its own,
    which is free. ``fixed`` are such names where no variable stands inside, ``varying`` the others.
    """

    def __init__(self, fail: s.Fail, tick: Callable[[], None] = lambda: None) -> None:
        self.fail, self.tick = fail, tick
        self.steps, self.pause = 0, 0
        self.expanded: dict[tuple[object, ...], tuple[object, Meaning]] = {}
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

    # --- words -----------------------------------------------------------------------------
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

    def expect(self, meaning: Meaning, sort: str, at: Expression) -> Meaning:
        if is_real(meaning) is not (sort == "Real"):
            other = "Bool" if sort == "Real" else "Real"
            self.error(f"a term of sort {sort} expected, one of sort {other} found", at)
        return meaning

    # --- terms -----------------------------------------------------------------------------
    def formula(self, expression: Expression, scope: Scope) -> s.Node:
        return cast(s.Node, self.expect(self.meaning(expression, scope), "Bool", expression))

    def real(self, expression: Expression, scope: Scope) -> s.Term:
        return cast(s.Term, self.expect(self.meaning(expression, scope), "Real", expression))

    def reals(self, listing: list[Expression], scope: Scope) -> list[s.Term]:
        """Operands: names and numbers, most of them, which are looked up at once."""
        terms: list[s.Term] = []
        for expression in listing[1:]:
            term = scope.get(expression) or self.numbers.get(expression) if isinstance(expression, str) else None
            if term.__class__ not in _TERMS:
                term = self.real(expression, scope)
            terms.append(cast(s.Term, term))
        return terms

    def meaning(self, expression: Expression, scope: Scope) -> Meaning:
        inner: dict[str, Meaning | Macro | Foreign] | None = None
        while not isinstance(expression, str) and expression and expression[0] == "let":
            bindings = self.bindings(expression, scope)
            if inner is None:
                scope = inner = dict(scope)
            inner.update(bindings)  # nobody else has it
            expression = expression[2]
        if isinstance(expression, str):
            return self.word(expression, scope)
        self.steps += len(expression)
        if self.steps > self.pause:
            self.look()
        if not expression or not isinstance(head := expression[0], str):
            self.error("an operator expected after '('", expression)
        if (value := scope.get(head)) is not None:
            return self.applied(value, head, expression, scope)
        if len(expression) == 1 and head not in _WITHOUT_ARGUMENTS:
            self.error(f"{plain(head)} without arguments", expression)
        return _READERS.get(head, Terms.unknown)(self, head, expression, scope)

    def look(self) -> None:
        """Called from time to time. Raises ``Unable`` where there are too many terms."""
        self.tick()
        self.pause = self.steps + 256
        if self.steps > MOST_STEPS:
            raise Unable(f"definitions written out make this more than {MOST_STEPS:,} terms")

    def word(self, word: str, scope: Scope) -> Meaning:
        if not is_symbol(word):
            if not word[0].isdigit():
                self.error(f"unexpected {word[:40]}", word)
            return self.numbers.setdefault(str(word), self.number(word, word))
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
        if (number := _SIGNED.fullmatch(plain(word))) is None:
            self.error(f"the symbol {plain(word)} is not declared", word)
        value = self.number(number[2], word)
        return s.Number(-value.value) if number[1] else value

    def number(self, text: str, word: str) -> s.Number:
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

    def bindings(self, let: list[Expression], scope: Scope) -> dict[str, Meaning]:
        self.arity(let, 2)
        pairs = (
            self.items(item, "(name term) expected", 2) for item in self.items(let[1], "a list of bindings expected")
        )
        return {self.symbol(name): self.share(self.meaning(value, scope)) for name, value in pairs}

    def applied(self, value: Meaning | Macro | Foreign, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        """A list that begins with a symbol of this value."""
        if isinstance(value, Macro):
            return self.expand(value, listing, scope)
        if isinstance(value, Foreign):
            return self.unread(listing, scope, value.sort, f"the declaration of {plain(head)} was not read")
        operator = listing[1] if len(listing) > 1 and isinstance(listing[1], str) else ""
        hint = f"; an operator stands first: ({operator} {plain(head)} …)" if operator in _INFIX else ""
        return self.error(f"{plain(head)} takes no arguments{hint}", head)

    def unknown(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        """A function that is not read."""
        message = way_out(plain(head))
        if head in _INTEGERS:
            sort = "Bool" if head in ("is_int", "divisible") else "Real"
            return self.unread(listing, scope, sort, f"{head} needs integers; all numbers are real here")
        if "algebraic" in message:
            return self.unread(listing, scope, "Real", message)
        return self.error(f"the function {plain(head)} is not supported", head)

    # --- numbers ---------------------------------------------------------------------------
    def arithmetic(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        """A sum, product, quotient or power, from the left."""
        operands = self.reals(listing, scope)
        if head == "-":
            kept = operands[: len(operands) > 1]
            operands = [*kept, *(self.negated(part) for part in operands[len(kept) :])]
        if len(operands) == 1:
            return operands[0]
        if head in ("+", "-"):
            total = collected.total(operands)
            return self.share(total) if isinstance(total, s.Sum) else total
        if head == "*" and (short := collected.product(operands)) is not None:
            return short
        result, at = operands[0], place(head)
        for operand in operands[1:]:
            result = self.combined(head, result, operand, at)
        return result

    def combined(self, operator: str, left: s.Term, right: s.Term, at: int) -> s.Term:
        """The product, quotient or power of two terms."""
        short = None
        if isinstance(right, s.Number) and operator != "*":
            short = collected.quotient(left, right) if operator == "/" else collected.power(left, right)
        build = s.Product if operator == "*" else s.Quotient if operator == "/" else s.Power
        return cast(s.Term, self.share(build(left, right, at))) if short is None else short

    def negated(self, term: s.Term) -> s.Term:
        short = collected.negative(term)
        return cast(s.Term, self.share(s.Minus(term))) if short is None else short

    def apply(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        arguments = self.reals(listing, scope)
        least, most = s.FUNCTIONS[head]
        if not least <= len(arguments) <= most:
            self.error(f"{head} does not take {len(arguments)} arguments", head)
        return self.share(s.Apply(str(head), arguments, place(head)))

    def to_real(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        self.arity(listing, 1)
        return self.real(listing[1], scope)

    def root_object(self, head: str, listing: list[Expression], scope: Scope) -> s.Term:
        """``(root-obj p k)``, as models write an algebraic number: the k-th real root of p in x."""
        self.arity(listing, 2)
        at = place(listing)
        number = self.real(listing[2], scope)
        inner = {**scope, "x": s.Name("x", at)}
        if "x" not in self.names:
            self.names.append("x")
        return s.Root(number, self.real(listing[1], inner), "x", at)

    def expand(self, macro: Macro, listing: list[Expression], scope: Scope) -> Meaning:
        self.arity(listing, len(macro.parameters))
        inner = dict(macro.scope)
        values: list[Meaning] = []
        for (name, sort), argument in zip(macro.parameters, listing[1:], strict=True):
            inner[name] = self.expect(self.meaning(argument, scope), sort, argument)
            values.append(cast(Meaning, inner[name]))
        key = (id(macro.body), *map(_leaf, values))
        if key not in self.expanded:  # what the identities are of is kept with them
            meant = self.expect(self.meaning(macro.body, inner), macro.sort, listing)
            self.expanded[key] = (macro.body, values), meant
        return self.expanded[key][1]

    def annotated(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        if len(listing) == 1:
            self.error("a term expected", listing)
        meaning = self.meaning(listing[1], scope)
        for key, value in pairwise(listing[2:]):
            if key == ":named":
                self.globals[self.symbol(value)] = meaning
        return meaning

    # --- formulas --------------------------------------------------------------------------
    def quantified(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        self.arity(listing, 2)
        _, variables, body = listing
        inner, names = dict(scope), []
        for name, sort in self.parameters(variables):
            fresh = self.fresh(name)
            self.bound.add(fresh)
            names.append(fresh)
            inner[name] = self.variable(fresh, sort, place(variables))
        if not names:
            self.error("a quantifier without variables", variables)
        self.inside += 1
        try:
            return s.Quantification(head == "forall", names, self.formula(body, inner))
        finally:
            self.inside -= 1

    def ite(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        self.arity(listing, 3)
        condition = self.formula(listing[1], scope)
        then, other = self.meaning(listing[2], scope), self.meaning(listing[3], scope)
        self.expect(other, "Real" if is_real(then) else "Bool", listing[3])
        if is_real(then):
            return self.share(s.Choice(condition, cast(s.Term, then), cast(s.Term, other), place(listing)))
        yes, no = cast(s.Node, then), cast(s.Node, other)
        return s.Every([s.Implication(condition, yes), s.Some([condition, no])])

    def relation(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        arguments = listing[1:]
        if len(arguments) < 2:
            self.error(f"{head} needs two arguments", head)
        meanings = [self.meaning(a, scope) for a in arguments]
        boolean = head in ("=", "distinct") and not is_real(meanings[0])
        for meaning, argument in zip(meanings, arguments, strict=True):
            self.expect(meaning, "Bool" if boolean else "Real", argument)
        links: list[s.Node] = []
        for left, right in combinations(meanings, 2) if head == "distinct" else pairwise(meanings):
            if boolean:
                same: s.Node = s.Equivalence(cast(s.Node, left), cast(s.Node, right))
                links.append(s.Negation(same) if head == "distinct" else same)
            else:
                sides = collected.sides(cast(s.Term, left), cast(s.Term, right))
                links.append(s.Comparison(sides, [_RELATIONS.get(head, Relation.NE)], place(head)))
        return self.once(links[0] if len(links) == 1 else s.Every(links))

    def connective(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        return self.once(self.joined(head, [self.formula(expression, scope) for expression in listing[1:]]))

    def joined(self, operator: str, parts: list[s.Node]) -> s.Node:
        match operator:
            case "not":
                if len(parts) != 1:
                    self.error("not takes one argument", operator)
                return s.Negation(parts[0])
            case "and":
                return s.Every(parts)
            case "or":
                return s.Some(parts)
            case "xor":
                return reduce(lambda result, part: s.Negation(s.Equivalence(result, part)), parts)
        return reduce(lambda result, part: s.Implication(part, result), reversed(parts))


def _leaf(field: object) -> object:
    """A part of a form: names, numbers and polynomials by what they are, what is made of others by its identity."""
    match field:
        case s.Name(name):
            return name
        case s.Number(value):
            return value
        case s.Polynomial(terms):
            return _leaf(terms)
        case dict():
            return tuple(field.items())
        case list():
            return tuple(map(_leaf, field))
    return id(field) if isinstance(field, tuple) else field


_READERS: Mapping[str, Callable[[Terms, str, list[Expression], Scope], Meaning]] = {
    **dict.fromkeys(_ARITHMETIC, Terms.arithmetic),
    **dict.fromkeys(_CONNECTIVES, Terms.connective),
    **dict.fromkeys((*_RELATIONS, "distinct"), Terms.relation),
    **dict.fromkeys(("exists", "forall"), Terms.quantified),
    **dict.fromkeys(s.FUNCTIONS, Terms.apply),
    "!": Terms.annotated,
    "ite": Terms.ite,
    "to_real": Terms.to_real,
    "root-obj": Terms.root_object,
}
"""How the applications of operators and functions of the language itself are read."""
