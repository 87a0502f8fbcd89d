"""The text syntax beyond operators: quantifiers and what they range over, sets, lists, cases. LaTeX has the same."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import reduce
from itertools import chain
from typing import Any, ClassVar, TypeAlias

from qe.formula.relation import Relation
from qe.io import parser, text_lexer
from qe.io import surface as s
from qe.io.conditions import SHARING, shared, together
from qe.io.functions import RELATIONS
from qe.io.parser import (
    BODY,
    BRACKET,
    CLOSES,
    EITHER,
    ELSE,
    FORMULA,
    NOT,
    PRIMARY,
    RELATION,
    TERM,
    Infix,
    Parser,
    Prefix,
    Waiting,
    counted,
)
from qe.io.text_errors import SyntaxFailure
from qe.io.tokens import END, Token

_UNIVERSAL = frozenset(("all", "forall", "All", "A", "∀", "ForAll", "Forall", "FORALL", "\\[ForAll]"))


Within: TypeAlias = Callable[[s.Term, int], s.Node]
"""A set: the formula that a term, at an offset, is in it."""


class TextParser(Parser):
    """Reads a text that is not LaTeX."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.conditions: list[s.Node] = []
        self.behind: Callable[[s.Node], s.Node] | None = None

    def lexed(self, text: str) -> Iterator[Token]:
        return text_lexer.tokens(text)

    def waiting_on(self, value: Any, kind: str) -> int:
        return super().waiting_on(value, kind if kind != "BAR" else self.bar(value))

    def bar(self, value: Any) -> str:
        """The kind of a bar behind an operand: it ends an absolute value, else means "or", as two of them do."""
        at, bracket = self.token.at, next(waiting for waiting in reversed(self.stack) if waiting.level == BRACKET)
        kind = next((kind for kind in ("CLOSEBAR", "ALSO") if kind in bracket.closing), "OR")
        if kind == "OR":
            if not super().waiting_on(value, kind):
                message = "this | can be neither 'or' nor the end of an absolute value; write a product as 2*|x|"
                raise SyntaxFailure(message, at)
            behind = next(self.tokens)
            if (behind.kind, behind.at) != ("BAR", at + 1):
                self.tokens = chain((behind,), self.tokens)
        self.token = Token(kind, "|", at)
        return kind

    def joined(self, left: Any, operator: Infix) -> Any:
        if operator.level != RELATION or self.token.kind == "RELATION":
            return super().joined(left, operator)
        token = self.advance()
        return operator.make(left, self.set(), token)

    # --- the whole -------------------------------------------------------------------------------------------
    def whole(self, wants: int = FORMULA) -> Any:
        if wants != FORMULA:
            return super().whole(wants)
        ends = END, "COMMA", "QUANTIFIER"
        self.conditions.append(self.expression(FORMULA, *ends))
        start = self.token.at
        while self.token.kind != END:
            if (comma := self.token.kind == "COMMA") and re.match(r"\d,\d", self.text[self.token.at - 1 :]):
                raise self.unexpected(("AND",))  # a decimal number, perhaps
            at = self.advance().at if comma else self.token.at
            part = self.expression(FORMULA, *ends)
            if self.behind is not None:
                return self.behind(together(self.conditions, start, quantified=True))
            self.conditions.append(part)
            if not comma:
                raise SyntaxFailure("a quantifier stands in front of its formula: all x. x^2 >= 0", at)
        return together(self.conditions, start)

    def name_or_call(self) -> s.Term | None:
        """A name, or several with commas between them, which share the comparison that follows."""
        waiting, at = self.stack[-1], self.token.at
        closing = next(bracket.closing for bracket in reversed(self.stack) if bracket.level == BRACKET)
        is_apart = bool(waiting.wants & FORMULA) and (END in closing or "COMMA" not in closing)
        sharing = SHARING.match(self.text, at) if is_apart else None
        if sharing is None:
            return super().name_or_call()
        names = []
        for _ in range(sharing[0].count(",")):
            names.append(s.Name(*self.take("NAME")[1:]))
            self.take("COMMA")
        before = self.conditions[-1] if self.conditions and len(self.stack) == 1 else None
        self.stack.append(Waiting(NOT, FORMULA, FORMULA, lambda node: shared(names, node, before, at)))
        return None

    def command(self) -> s.Node:
        """``Reduce[f, {x, y}, Reals]``: the formula."""
        self.advance()
        self.take("LEFT")
        node: s.Node = self.expression(FORMULA, "COMMA", "RIGHT")
        if self.token.kind == "COMMA" and self.advance() and self.token.kind != "REALS":
            self.names_or_name()
            if self.token.kind == "COMMA":
                self.advance()
                self.refuse_others()
        if self.token.kind == "REALS":
            self.advance()
        self.take("RIGHT")
        return node

    # --- quantifiers -----------------------------------------------------------------------------------------
    def quantifier(self) -> s.Node | None:
        """One or more quantifiers, to the dot or the bracket that their body stands in, or behind it to the end."""
        token = self.advance()
        if self.token.kind in ("OPEN", "LEFT"):
            self.quantified_call(token)
            return None
        headers = [(token, *self.bound())]
        while self.token.kind == "QUANTIFIER":
            headers.append((self.advance(), *self.bound()))

        def make(body: s.Node) -> s.Node:
            for header in reversed(headers):
                body = _quantified(*header, body)
            return body

        if (kind := self.advance().kind) == "DOT":
            self.stack.append(Waiting(BODY, FORMULA, FORMULA, make))
        elif kind == END:
            self.behind = make
            return s.Truth(True)
        else:
            self.open(FORMULA, CLOSES[kind], lambda parts: make(parts[0]))
        return None

    def bound(self) -> tuple[list[str], Within | None]:
        """The variables of a quantifier and what they range over, up to the token that has to follow them."""
        ends = ("DOT", "QUANTIFIER", "OPEN", "LEFT", *([END] if self.conditions and len(self.stack) == 1 else []))
        names, within = self.names(), None
        if self.token.kind == "IN":
            self.advance()
            within = self.set()
        elif self.token.kind == "RELATION":
            relation = RELATIONS[self.advance().text]
            bound = self.expression(TERM, *ends)
            within = lambda term, at: s.Comparison([term, bound], [relation], at)  # noqa: E731
        if self.token.kind not in ends:
            raise self.unexpected(ends if within else {*ends, "COMMA", "NAME", "IN", "RELATION"})
        return names, within

    def names(self) -> list[str]:
        """Names with commas or nothing between them."""
        names = [self.take("NAME").text]
        while self.token.kind in ("COMMA", "NAME"):
            if self.token.kind == "COMMA":
                self.advance()
            names.append(self.take("NAME").text)
        return names

    def names_or_name(self) -> list[str]:
        """Names in brackets, or one."""
        first = self.take("NAME", *CLOSES)
        if first.kind == "NAME":
            return [first.text]
        names = self.names()
        self.take(CLOSES[first.kind], "COMMA", "NAME")
        return names

    def quantified_call(self, token: Token) -> None:
        """``ForAll[{x, y}, condition, formula]``."""
        closing = CLOSES[self.advance().kind]
        names = self.names_or_name()
        self.take("COMMA")
        universal = token.text in _UNIVERSAL

        def make(formulas: list[s.Node]) -> s.Node:
            if len(formulas) > 2:
                usage = "a quantifier takes variables, perhaps a condition, and a formula"
                raise SyntaxFailure(f"{usage}: ForAll[{{x, y}}, x > y, x^3 > y^3]", token.at)
            *conditions, body = formulas
            return s.Quantification(universal, names, _under(universal, conditions, body))

        self.open(FORMULA, closing, make, many=True)

    # --- sets ------------------------------------------------------------------------------------------------
    def set(self) -> Within:
        """Intersections, then from the left unions and differences."""
        value = self.intersection()
        while self.token.kind in ("UNION", "WITHOUT") or self.token.text in ("union", "Union"):
            combine = _difference if self.advance().kind == "WITHOUT" else _union
            value = combine(value, self.intersection())
        return value

    def intersection(self) -> Within:
        value = self.simple_set()
        while self.token.kind == "COMMON":
            self.advance()
            value = _intersection(value, self.simple_set())
        return value

    def refuse_others(self) -> None:
        """Refuse a set of numbers that are not all real ones."""
        if self.token.text in text_lexer.NOT_REAL:
            raise SyntaxFailure(
                f"all variables are real (as in ex x. …), {self.token.text} cannot be asked for", self.token.at
            )

    def simple_set(self) -> Within:
        self.refuse_others()
        if self.token.text in text_lexer.ALSO_REALS:
            self.token = self.token._replace(kind="REALS")
        kind = self.take("OPEN", "LEFT", "BEGIN", "REALS").kind
        if kind == "REALS":
            return lambda term, at: s.Comparison([term, term], [Relation.EQ], at)
        if kind == "BEGIN":
            values = self.arguments("END")
            return lambda term, at: s.Some([s.Comparison([term, value], [Relation.EQ], at) for value in values])
        left = self.expression(TERM, "COMMA")
        self.advance()
        right = self.expression(TERM, "CLOSE", "RIGHT")
        end = left.part if isinstance(left, s.Minus) else left
        low = Relation.GE if kind == "LEFT" and not isinstance(end, s.Infinity) else Relation.GT
        high = Relation.LE if self.advance().kind == "RIGHT" and not isinstance(right, s.Infinity) else Relation.LT
        bounds = (left, low), (right, high)  # behind the term, whose names stand in front of theirs
        return lambda term, at: s.Every([s.Comparison([term, end], [relation], at) for end, relation in bounds])

    def arguments(self, closing: str) -> list[s.Term]:
        """Terms with commas between them, and the bracket behind them."""
        values = [self.expression(TERM, "COMMA", closing)]
        while self.advance().kind == "COMMA":
            values.append(self.expression(TERM, "COMMA", closing))
        return values

    def element(self) -> s.Node:
        """``Element[x | y, Reals]``."""
        at = self.advance().at
        closing = CLOSES[self.take("OPEN", "LEFT").kind]
        if self.token.kind == "BEGIN":
            self.advance()
            members = self.arguments("END")
        else:
            members = [self.expression(TERM, "ALSO", "COMMA")]
            while self.token.kind == "ALSO":
                self.advance()
                members.append(self.expression(TERM, "ALSO", "COMMA"))
        self.take("COMMA")
        within = self.set()
        self.take(closing)
        return _all_within(members, within, at)

    # --- lists and cases -------------------------------------------------------------------------------------
    def listed(self) -> None:
        """Formulas that hold together."""
        kind = self.advance().kind
        self.open(FORMULA, CLOSES[kind], lambda parts: s.Every(parts) if len(parts) > 1 else parts[0], many=True)

    def connective(self) -> None:
        token = self.advance()
        closing = CLOSES[self.take("OPEN", "LEFT").kind]
        self.open(FORMULA, closing, lambda parts: _connected(token, parts), many=True)

    def compared(self) -> None:
        token = self.advance()
        closing = CLOSES[self.take("OPEN", "LEFT").kind]
        self.open(TERM, closing, lambda parts: _compared(token, parts), many=True)

    def cases(self) -> None:
        """``if f then a else b``, of formulas or of terms."""
        last, at = self.stack[-1], self.advance().at
        condition = self.expression(FORMULA, "THEN")
        self.advance()
        then = self.expression(EITHER if last.wants & FORMULA else TERM, "ELSE")
        self.advance()
        if isinstance(then, s.Node):
            make: Callable[[Any], Any] = lambda other: s.connected("ITE", [condition, then, other])  # noqa: E731
            self.stack.append(Waiting(BODY, FORMULA, FORMULA, make))
        else:
            self.stack.append(Waiting(ELSE, TERM, TERM, lambda other: s.Choice(condition, then, other, at)))

    def cases_call(self) -> s.Term:
        """``If[f, a, b]``."""
        at = self.advance().at
        closing = CLOSES[self.take("OPEN", "LEFT").kind]
        condition = self.expression(FORMULA, "COMMA")
        self.advance()
        then = self.expression(TERM, "COMMA")
        self.advance()
        other = self.expression(TERM, closing)
        self.advance()
        return s.Choice(condition, then, other, at)

    def piecewise(self) -> s.Term:
        """SymPy's ``Piecewise((a, f), (b, True))``; no value where no condition holds."""
        at = self.advance().at
        rows: list[tuple[s.Node, s.Term]] = []
        while not rows or self.token.kind == "COMMA":
            self.take("COMMA" if rows else "OPEN")
            self.take("OPEN")
            value = self.expression(TERM, "COMMA")
            self.advance()
            rows.append((self.expression(FORMULA, "CLOSE"), value))
            self.advance()
        self.take("CLOSE")
        none: s.Term | None = None
        chosen = reduce(lambda other, row: s.Choice(row[0], row[1], other, at), reversed(rows), none)
        assert chosen is not None
        return chosen

    # --- terms -----------------------------------------------------------------------------------------------
    def infinity(self) -> s.Term:
        return s.Infinity(self.advance().at)

    def absolute(self) -> None:
        at = self.advance().at
        self.open(TERM, "CLOSEBAR", lambda parts: s.Apply("abs", parts, at))

    def radical(self) -> None:
        _, sign, at = self.advance()
        function = "cbrt" if sign == "∛" else "sqrt"
        self.stack.append(Waiting(PRIMARY, TERM, TERM | parser.SIMPLE, lambda part: s.Apply(function, [part], at)))

    infix = {  # noqa: RUF012
        **parser.INFIX,
        "IN": Infix(RELATION, RELATION, TERM, TERM, FORMULA, lambda left, within, token: within(left, token.at)),
        "NOTIN": Infix(
            RELATION, RELATION, TERM, TERM, FORMULA, lambda left, within, token: s.Negation(within(left, token.at))
        ),
    }
    prefix = {  # noqa: RUF012
        **parser.PREFIX,
        "NAME": Prefix(TERM, PRIMARY, name_or_call),
        "QUANTIFIER": Prefix(FORMULA, NOT, quantifier),
        "LEFT": Prefix(FORMULA, NOT, listed),
        "BEGIN": Prefix(FORMULA, NOT, listed),
        "ELEMENT": Prefix(FORMULA, NOT, element),
        "CONNECTIVE": Prefix(FORMULA, NOT, connective),
        "COMPARE": Prefix(FORMULA, NOT, compared),
        "IF": Prefix(EITHER, ELSE, cases),
        "CHOICE": Prefix(TERM, PRIMARY, cases_call),
        "PIECEWISE": Prefix(TERM, PRIMARY, piecewise),
        "COMMAND": Prefix(FORMULA, NOT, command),
        "INFINITY": Prefix(TERM, PRIMARY, infinity),
        **dict.fromkeys(("OPENBAR", "BAR"), Prefix(TERM, PRIMARY, absolute)),
        "RADICAL": Prefix(TERM, PRIMARY, radical),
    }


def parser_of(text: str) -> type[TextParser]:
    """The parser of a text, which may be LaTeX."""
    return LatexParser if is_latex(text) else TextParser


class LatexParser(TextParser):
    """Reads the same syntax in LaTeX."""

    calls: ClassVar = {"NAME": ("LEFT",), "FUNCTION": ("OPEN", "LEFT")}
    infix: ClassVar = {
        **TextParser.infix,
        **dict.fromkeys(("NAME", "NUMBER", "OPEN", "RADICAL", "OPENBAR", "FUNCTION"), parser.JUXTAPOSED),
    }
    prefix: ClassVar = {**TextParser.prefix, "FUNCTION": parser.PREFIX["NAME"]}

    def lexed(self, text: str) -> Iterator[Token]:
        from qe.io import latex_lexer

        return latex_lexer.tokens(text)


def is_latex(text: str) -> bool:
    """Whether a text is read as LaTeX."""
    if "\\" in text or "{" in text or "$" in text:
        from qe.io import latex_lexer

        return latex_lexer.is_latex(text)
    return False


def _quantified(quantifier: Token, names: list[str], within: Within | None, body: s.Node) -> s.Node:
    """A quantifier over names, which may be bounded by a set."""
    if quantifier.text.partition(" ")[0] in s.QUANTITIES:
        return _quantity(quantifier, names, within, body)
    universal = quantifier.text in _UNIVERSAL
    if within is None:
        return s.Quantification(universal, names, body)
    condition = _all_within([s.Name(name, quantifier.at) for name in names], within, quantifier.at)
    return s.Quantification(universal, names, _under(universal, [condition], body))


def _quantity(quantifier: Token, names: list[str], within: Within | None, body: s.Node) -> s.Node:
    """How many values of one variable, which may be bounded by a set."""
    kind, _, number = quantifier.text.partition(" ")
    if len(names) != 1:
        raise SyntaxFailure(f"{s.QUANTITIES[kind]}: one variable expected, {', '.join(names)} found", quantifier.at)
    conditions = [] if within is None else [within(s.Name(names[0], quantifier.at), quantifier.at)]
    return s.Quantity(
        kind, counted(number, quantifier.at), names[0], _under(kind == "G", conditions, body), quantifier.at
    )


def _under(universal: bool, conditions: list[s.Node], body: s.Node) -> s.Node:
    """The body of a quantifier that ranges over what has at most one condition."""
    if not conditions:
        return body
    return s.Implication(conditions[0], body) if universal else s.Every([*conditions, body])


def _all_within(terms: list[Any], within: Within, at: int) -> s.Node:
    inside = [within(term, at) for term in terms]
    return inside[0] if len(inside) == 1 else s.Every(inside)


def _union(one: Within, other: Within) -> Within:
    return lambda term, at: s.Some([one(term, at), other(term, at)])


def _difference(one: Within, other: Within) -> Within:
    return lambda term, at: s.Every([one(term, at), s.Negation(other(term, at))])


def _intersection(one: Within, other: Within) -> Within:
    return lambda term, at: s.Every([one(term, at), other(term, at)])


def _connected(token: Token, parts: list[s.Node]) -> s.Node:
    name = token.text
    node = None if name == "Implies" and len(parts) != 2 else s.connected(name, parts)
    if node is None:
        raise SyntaxFailure(f"{name} takes {'one formula' if name == 'Not' else 'two formulas'}", token.at)
    return node


def _compared(token: Token, sides: list[s.Term]) -> s.Node:
    _, name, at = token
    if len(sides) < 2:
        raise SyntaxFailure(f"{name} compares two terms", at)
    if name == "Inequality":
        named = [RELATIONS.get(part.name) if isinstance(part, s.Name) else None for part in sides[1::2]]
        relations = [relation for relation in named if relation is not None]
        if len(relations) < len(named) or len(sides) % 2 == 0:
            raise SyntaxFailure("Inequality takes terms and relations: Inequality[0, Less, x, LessEqual, 1]", at)
        return s.Comparison(sides[::2], relations, at)
    return s.Comparison(sides, [RELATIONS[name]] * (len(sides) - 1), at)
