"""The text syntax beyond operators and quantifiers: conditions with commas, lists, cases. LaTeX has the same."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from functools import reduce
from itertools import chain
from typing import Any, ClassVar

from qe.io import parser as p
from qe.io import surface as s
from qe.io import text_lexer
from qe.io.collected import Coefficients
from qe.io.parser import RELATIONS
from qe.io.text_errors import SyntaxFailure
from qe.io.text_quantifiers import SHARING, QuantifiedParser, shared, together
from qe.io.tokens import END, Token
from qe.spelling import WORD

_COMPARED = re.compile(rf"\{{\s*{WORD}(?:\s*,\s*{WORD})*\s*\}}(?=\s*(?:[<>=≤≥≠]|!=|/=))")
"""A list of variables that are compared, as Mathematica does."""
_BUILT = re.compile(
    rf"\\?\{{\s*(?:{WORD}|\(\s*{WORD}(?:\s*,\s*{WORD})*\s*\))\s*(?:(?:∈|\\?in\b)[^|<>=]*?)?(?:\|(?!\|)|\\mid\b|:(?!=))"
)
"""The beginning of ``{x ∈ [0, 1] | x^2 < a}``: the set of the points with what follows."""

_MULTIPLES = re.compile(r"([-+]?[0-9]*)([A-Za-z][A-Za-z0-9_]*|)")
_UNITS, _IDLE = {"": 1, "+": 1, "-": -1}, str.maketrans("", "", "()*")


_IN = p.Infix(p.RELATION, p.RELATION, p.TERM, p.TERM, p.FORMULA, lambda left, within, token: within(left, token.at))


class TextParser(QuantifiedParser):
    """Reads a text that is not LaTeX. ``asked``: the variables of the command that the whole text is."""

    asked: tuple[str, ...] = ()

    def lexed(self, text: str) -> Iterator[Token]:
        return text_lexer.tokens(text)

    def waiting_on(self, value: Any, kind: str) -> int:
        return super().waiting_on(value, kind if kind != "BAR" else self.bar(value))

    def bar(self, value: Any) -> str:
        """The kind of a bar behind an operand: it ends an absolute value, else means "or", as two of them do."""
        at, bracket = self.token.at, next(waiting for waiting in reversed(self.stack) if waiting.level == p.BRACKET)
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

    def joined(self, left: Any, operator: p.Infix) -> Any:
        if operator.level != p.RELATION or self.token.kind == "RELATION":
            return super().joined(left, operator)
        token = self.advance()
        return operator.make(left, self.set(), token)

    # --- the whole -------------------------------------------------------------------------------------------
    def whole(self, wants: int = p.FORMULA) -> Any:
        if wants != p.FORMULA:
            return super().whole(wants)
        ends = END, "COMMA", "QUANTIFIER"
        self.conditions.append(self.expression(p.FORMULA, *ends))
        start = self.token.at
        while self.token.kind != END:
            if (comma := self.token.kind == "COMMA") and re.match(r"\d,\d", self.text[self.token.at - 1 :]):
                raise self.unexpected(("AND",))  # a decimal number, perhaps
            at = self.advance().at if comma else self.token.at
            part = self.expression(p.FORMULA, *ends)
            if self.behind is not None:
                return self.behind(together(self.conditions, start, quantified=True))
            self.conditions.append(part)
            if not comma:
                raise SyntaxFailure("a quantifier stands in front of its formula: all x. x^2 >= 0", at)
        return together(self.conditions, start)

    def terms(self) -> list[s.Term]:
        """Terms with commas between them, perhaps in brackets, to the end of the text."""
        if self.token.kind in p.CLOSES and self.text.rstrip("; \t\r\n")[-1:] in (")", "]", "}"):
            with suppress(SyntaxFailure):
                terms = self.arguments(p.CLOSES[self.advance().kind])
                self.take(END)
                return terms
            return type(self)(self.text).arguments(END)
        return self.arguments(END)

    def name_or_call(self) -> s.Term | None:
        """A name, or several with commas between them, which share the comparison that follows."""
        waiting, at = self.stack[-1], self.token.at
        closing = next(bracket.closing for bracket in reversed(self.stack) if bracket.level == p.BRACKET)
        is_apart = bool(waiting.wants & p.FORMULA) and (END in closing or "COMMA" not in closing)
        sharing = SHARING.match(self.text, at) if is_apart else None
        if sharing is None:
            return super().name_or_call()
        names = []
        for _ in range(sharing[0].count(",")):
            names.append(s.Name(*self.take("NAME")[1:]))
            self.take("COMMA")
        before = self.conditions[-1] if self.conditions and len(self.stack) == 1 else None
        self.stack.append(p.Waiting(p.NOT, p.FORMULA, p.FORMULA, lambda node: shared(names, node, before, at)))
        return None

    def command(self) -> s.Node:
        """``Reduce[f, {x, y}, Reals]``: the formula."""
        _, name, at = self.advance()
        listed: list[str] = []
        self.take("LEFT")
        node: s.Node = self.expression(p.FORMULA, "COMMA", "RIGHT")
        if self.skip("COMMA") and self.token.kind != "REALS":
            if name in text_lexer.SIMPLIFIERS:
                raise SyntaxFailure(f"what {name} assumes is given with assuming= or --assuming", self.token.at)
            listed = self.names_or_name()
            if self.skip("COMMA"):
                self.refuse_others()
        self.skip("REALS")
        while self.token.kind in ("COMMA", "NAME"):  # Backsubstitution -> True
            if self.advance().kind == "NAME":
                self.take("IMPLIES")
                self.take("TRUE", "FALSE")
        self.take("RIGHT")
        self.asked = tuple(listed) if self.token.kind == END and not self.text[:at].strip() else ()
        return node

    # --- lists and cases -------------------------------------------------------------------------------------
    def listed(self) -> s.Name | None:
        """Formulas that hold together, or variables with one comparison behind them, or all of a set."""
        if _COMPARED.match(self.text, self.token.at):  # {a, b} >= 0
            at = self.advance().at
            *others, last = [s.Name(name, at) for name in self.names()]
            self.take("END")
            self.stack.append(p.Waiting(p.NOT, p.FORMULA, p.FORMULA, lambda node: shared(others, node, None, at)))
            return last
        built, kind = _BUILT.match(self.text, self.token.at), self.advance().kind
        known = self.members() if built else []
        make = lambda parts: s.Every([*known, *parts]) if known or len(parts) > 1 else parts[0]  # noqa: E731
        self.open(p.FORMULA, p.CLOSES[kind], make, many=True)
        return None

    def members(self) -> list[s.Node]:
        """What ``(x, y) ∈ ℝ²`` says in front of the conditions of a set."""
        at, names, within = self.token.at, self.names_or_name(), None
        if self.skip("IN"):
            within = self.set()
        if self.skip("POWER") and self.take("NUMBER").text != str(len(names)):
            raise SyntaxFailure(f"a point of {len(names)} coordinates lies in no set to this power", at)
        self.take("BAR", "DOT")
        return [within(s.Name(name, at), at) for name in names] if within else []

    def called(self, wants: int, make: Callable[[Token, list[Any]], s.Node]) -> None:
        """``Or[f, g]``, ``Less[a, b]``."""
        token = self.advance()
        self.open(wants, p.CLOSES[self.take("OPEN", "LEFT").kind], lambda parts: make(token, parts), many=True)

    def cases(self) -> None:
        """``if f then a else b``, of formulas or of terms."""
        last, at = self.stack[-1], self.advance().at
        condition = self.part(p.FORMULA, "THEN")
        if last.wants & p.FORMULA and not re.search(r"\belse\b", self.text[self.token.at :]):
            self.stack.append(p.Waiting(p.BODY, p.FORMULA, p.FORMULA, lambda body: s.Implication(condition, body)))
            return
        then = self.part(p.EITHER if last.wants & p.FORMULA else p.TERM, "ELSE")
        if isinstance(then, s.Node):
            make: Callable[[Any], Any] = lambda other: s.connected("ITE", [condition, then, other])  # noqa: E731
            self.stack.append(p.Waiting(p.BODY, p.FORMULA, p.FORMULA, make))
        else:
            self.stack.append(p.Waiting(p.ELSE, p.TERM, p.TERM, lambda other: s.Choice(condition, then, other, at)))

    def cases_call(self) -> s.Term:
        """``If[f, a, b]``."""
        at = self.advance().at
        closing = p.CLOSES[self.take("OPEN", "LEFT").kind]
        condition, then = self.part(p.FORMULA, "COMMA"), self.part(p.TERM, "COMMA")
        return s.Choice(condition, then, self.part(p.TERM, closing), at)

    def piecewise(self) -> s.Term:
        """SymPy's ``Piecewise((a, f), (b, True))``; no value where no condition holds."""
        at = self.advance().at
        rows: list[tuple[s.Node, s.Term]] = []
        while not rows or self.token.kind == "COMMA":
            self.take("COMMA" if rows else "OPEN")
            self.take("OPEN")
            value = self.part(p.TERM, "COMMA")
            rows.append((self.part(p.FORMULA, "CLOSE"), value))
        self.take("CLOSE")
        none: s.Term | None = None
        chosen = reduce(lambda other, row: s.Choice(row[0], row[1], other, at), reversed(rows), none)
        assert chosen is not None
        return chosen

    # --- terms -----------------------------------------------------------------------------------------------
    def linear(self) -> s.Term:
        """A sum of multiples of names: wide systems have a million of them, so their tokens are not read alone."""
        _, text, at = self.advance()
        bare = "".join(text.split()).translate(_IDLE).replace("+-", "-").replace("--", "+")
        parts = _MULTIPLES.split(bare)[1:-3]
        names, written = parts[1::3], parts[::3]
        numbers = [*map(int, map(_UNITS.get, written, written))]
        terms: Coefficients = dict(zip([(name,) if name else () for name in names], numbers))
        if len(terms) == len(numbers) and all(numbers):
            return s.Polynomial(terms)
        # a name that cancels is a name all the same
        return s.Sum([s.Product(s.Number(c), s.Name(x, at), at) if x else s.Number(c) for c, x in zip(numbers, names)])

    def absolute(self) -> None:
        at = self.advance().at
        self.open(p.TERM, "CLOSEBAR", lambda parts: s.Apply("abs", parts, at))

    def radical(self) -> None:
        _, sign, at = self.advance()
        function = "cbrt" if sign == "∛" else "sqrt"
        self.stack.append(p.Waiting(p.PRIMARY, p.TERM, p.TERM | p.SIMPLE, lambda part: s.Apply(function, [part], at)))

    infix = {  # noqa: RUF012
        **p.INFIX,
        "IN": _IN,
        "NOTIN": _IN._replace(make=lambda left, within, token: s.Negation(within(left, token.at))),
    }
    prefix = {  # noqa: RUF012
        **p.PREFIX,
        "NAME": p.Prefix(p.TERM, p.PRIMARY, name_or_call),
        "QUANTIFIER": p.Prefix(p.FORMULA, p.NOT, QuantifiedParser.quantifier),
        "LEFT": p.Prefix(p.FORMULA, p.NOT, listed),
        "BEGIN": p.Prefix(p.FORMULA, p.NOT, listed),
        "ELEMENT": p.Prefix(p.FORMULA, p.NOT, QuantifiedParser.element),
        "CONNECTIVE": p.Prefix(p.FORMULA, p.NOT, lambda self: self.called(p.FORMULA, _connected)),
        "COMPARE": p.Prefix(p.FORMULA, p.NOT, lambda self: self.called(p.TERM, _compared)),
        "IF": p.Prefix(p.EITHER, p.ELSE, cases),
        "CHOICE": p.Prefix(p.TERM, p.PRIMARY, cases_call),
        "PIECEWISE": p.Prefix(p.TERM, p.PRIMARY, piecewise),
        "COMMAND": p.Prefix(p.FORMULA, p.NOT, command),
        "INFINITY": p.Prefix(p.TERM, p.PRIMARY, lambda self: s.Infinity(self.advance().at)),
        "LINEAR": p.Prefix(p.TERM, p.PRIMARY, linear),
        **dict.fromkeys(("OPENBAR", "BAR"), p.Prefix(p.TERM, p.PRIMARY, absolute)),
        "RADICAL": p.Prefix(p.TERM, p.PRIMARY, radical),
    }


def parser_of(text: str) -> type[TextParser]:
    """The parser of a text, which may be LaTeX."""
    return LatexParser if is_latex(text) else TextParser


class LatexParser(TextParser):
    """Reads the same syntax in LaTeX."""

    calls: ClassVar = {"NAME": ("LEFT",), "FUNCTION": ("OPEN", "LEFT")}
    infix: ClassVar = {
        **TextParser.infix,
        **dict.fromkeys(("NAME", "NUMBER", "OPEN", "RADICAL", "OPENBAR", "FUNCTION"), p.JUXTAPOSED),
    }
    prefix: ClassVar = {**TextParser.prefix, "FUNCTION": p.PREFIX["NAME"]}

    def lexed(self, text: str) -> Iterator[Token]:
        from qe.io import latex_lexer

        return latex_lexer.tokens(text)


def is_latex(text: str) -> bool:
    """Whether a text is read as LaTeX."""
    if "\\" in text or "{" in text or "$" in text:
        from qe.io import latex_lexer

        return latex_lexer.is_latex(text)
    return False


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


def products(text: str, letters: Collection[str] = ()) -> set[str]:
    """The words that are read as products, ``letters`` being variables that are solved for; none in what is wrong."""
    state = lexed(text, letters)
    return state.products if state.is_read else set()


def lexed(text: str, letters: Collection[str] = ()) -> text_lexer.State:
    """What the tokens of a text say of its words, up to where it goes wrong."""
    state = text_lexer.State(text)
    state.letters.update(letters)
    with suppress(SyntaxFailure):
        deque(() if is_latex(text) else text_lexer.tokens(text, state), maxlen=0)
    return state
