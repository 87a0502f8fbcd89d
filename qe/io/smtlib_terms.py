"""The meaning of SMT-LIB terms; macros and ``let`` are expanded here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import combinations, pairwise
from typing import Any, cast

from qe.errors import Unable
from qe.formula.relation import Relation
from qe.io import collected
from qe.io import surface as s
from qe.io.smtlib_parser import Expression, place, plain
from qe.io.smtlib_words import Foreign, Macro, Meaning, Scope, Words, is_real, leaf
from qe.io.text_errors import way_out

MOST_STEPS = 1_000_000
"""Terms of one command, definitions written out."""

_RELATIONS = {"<": Relation.LT, "<=": Relation.LE, ">": Relation.GT, ">=": Relation.GE, "=": Relation.EQ}
_CONNECTIVES = {"not": "Not", "and": "And", "or": "Or", "xor": "Xor", "=>": "Implies", "implies": "Implies"}
_ARITHMETIC = frozenset(("+", "-", "*", "/", "^"))
_INFIX = frozenset((*_RELATIONS, *_CONNECTIVES, *_ARITHMETIC))
_WITHOUT_ARGUMENTS = frozenset(("exists", "forall", "!"))
"""What says itself what it needs."""
_INTEGERS = frozenset(("div", "mod", "rem", "to_int", "is_int", "divisible"))


class Terms(Words):
    """Reads terms; calls ``tick`` from time to time."""

    def __init__(self, fail: s.Fail, tick: Callable[[], None] = lambda: None) -> None:
        super().__init__(fail)
        self.tick, self.steps, self.pause = tick, 0, 0
        self.expanded: dict[tuple[object, ...], tuple[object, Meaning]] = {}

    # --- terms -----------------------------------------------------------------------------
    def formula(self, expression: Expression, scope: Scope) -> s.Node:
        return self.expect(self.meaning(expression, scope), "Bool", expression)  # type: ignore[return-value]

    def real(self, expression: Expression, scope: Scope) -> s.Term:
        return self.expect(self.meaning(expression, scope), "Real", expression)  # type: ignore[return-value]

    def reals(self, listing: list[Expression], scope: Scope) -> list[s.Term]:
        """Operands."""
        return [self.operand(expression, scope) for expression in listing[1:]]

    def operand(self, expression: Expression, scope: Scope) -> s.Term:
        """A term: names and numbers, most of them, are looked up at once."""
        term: Any
        if isinstance(expression, str):
            term = scope.get(expression) or self.numbers.get(expression) or self.meaning(expression, scope)
        else:
            term = self.meaning(expression, scope)
        if term.__class__ not in s.TERMS:
            return self.real(expression, scope)
        return term  # type: ignore[no-any-return]

    def meaning(self, expression: Expression, scope: Scope) -> Meaning:
        if isinstance(expression, str):
            return self.word(expression, scope)
        if expression and expression[0] == "let":
            expression, scope = self.behind_lets(expression, scope)
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

    def behind_lets(self, expression: Expression, scope: Scope) -> tuple[Expression, Scope]:
        """The first expression inside that is no ``let``, and its scope."""
        inner = dict(scope)
        while not isinstance(expression, str) and expression and expression[0] == "let":
            inner.update(self.bindings(expression, inner))
            expression = expression[2]
        return expression, inner

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
        if len(listing) > 2 and head in ("+", "-"):
            return self.sum(head, listing, scope)
        operands = self.reals(listing, scope)
        if len(operands) == 1:
            return self.negated(operands[0]) if head == "-" else operands[0]
        return self.folded(head, operands)

    def sum(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        """A sum or difference: multiples of names, most of them, are added up as they are read."""
        terms: collected.Coefficients = {}
        others: list[s.Term] = []
        scale, usual = 1, "*" not in scope
        for expression in listing[1:]:
            if usual and len(expression) == 3 and expression[0] == "*" and not isinstance(expression, str):
                self.steps += 3
                operands = self.reals(expression, scope)
                added = collected.add_multiple(terms, operands[0], operands[1], scale)
                part = None if added else self.folded(expression[0], operands)
            else:
                part = self.operand(expression, scope)
            if part is not None and not collected.add(terms, part, scale):
                others.append(part if scale == 1 else self.negated(part))
            if head == "-":
                scale = -1
        total = collected.joined(terms, others)
        return self.share(total) if isinstance(total, s.Sum) else total

    def folded(self, head: str, operands: list[s.Term]) -> s.Term:
        """The product, quotient or power of at least two terms, from the left."""
        if head == "*" and (short := collected.product(operands)) is not None:
            return short
        result, at = operands[0], place(head)
        for operand in operands[1:]:
            result = self.combined(head, result, operand, at)
        return result

    def combined(self, operator: str, first: s.Term, second: s.Term, at: int) -> s.Term:
        """The product, quotient or power of two terms."""
        short = None
        if isinstance(second, s.Number) and operator != "*":
            short = collected.quotient(first, second) if operator == "/" else collected.power(first, second)
        build = s.Product if operator == "*" else s.Quotient if operator == "/" else s.Power
        return cast(s.Term, self.share(build(first, second, at))) if short is None else short

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
        key = (id(macro.body), *map(leaf, values))
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
        return cast(s.Node, s.connected("ITE", [condition, cast(s.Node, then), cast(s.Node, other)]))

    def relation(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        arguments = listing[1:]
        if len(arguments) < 2:
            self.error(f"{head} needs two arguments", head)
        meanings = [self.meaning(a, scope) for a in arguments]
        boolean = head in ("=", "distinct") and not is_real(meanings[0])
        for meaning, argument in zip(meanings, arguments):
            if is_real(meaning) is boolean:
                self.expect(meaning, "Bool" if boolean else "Real", argument)
        links: list[s.Node] = []
        form: tuple[object, ...] = ()
        for left, right in combinations(meanings, 2) if head == "distinct" else pairwise(meanings):
            if boolean:
                same: s.Node = s.Equivalence(cast(s.Node, left), cast(s.Node, right))
                links.append(s.Negation(same) if head == "distinct" else same)
            else:
                sides = collected.sides(cast(s.Term, left), cast(s.Term, right))
                links.append(s.Comparison(sides, [_RELATIONS.get(head, Relation.NE)], place(head)))
                if isinstance(sides[0], s.Polynomial) and sides[1] is collected.ZERO:
                    form = (head, *sides[0].terms.items())
        return self.once(links[0], form) if len(links) == 1 else self.once(s.Every(links))

    def connective(self, head: str, listing: list[Expression], scope: Scope) -> Meaning:
        parts = [self.formula(expression, scope) for expression in listing[1:]]
        if (node := s.connected(_CONNECTIVES[head], parts)) is None:
            self.error("not takes one argument", head)
        return self.once(node, (head, *map(id, parts)))

    def once(self, node: s.Node, form: tuple[object, ...] = ()) -> Meaning:
        """A formula that is shared, unless it may have bound variables."""
        return node if self.inside else self.share(node, form)


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
