"""LaTeX source as tokens of the text syntax: ``\\forall x\\colon x^{2} \\geq \\frac{1}{2} \\lor \\sqrt{x} < 2 a b``.

As in print, one letter is a variable (with an index, if it has one), words stand in ``\\mathrm{...}`` and the like, and
things side by side are multiplied.
"""

from __future__ import annotations

import re
from collections.abc import Generator, Iterator

from qe.io.lalr import Token
from qe.io.text_errors import SyntaxFailure
from qe.io.text_lexer import OPERAND_ENDS, Make, State
from qe.spelling import visible

_COMMANDS = {
    **dict.fromkeys(("land", "wedge"), ("AND", "and")),
    **dict.fromkeys(("lor", "vee"), ("OR", "or")),
    **dict.fromkeys(("lnot", "neg"), ("NOT", "not")),
    **dict.fromkeys(("implies", "Rightarrow", "rightarrow", "to", "Longrightarrow"), ("IMPLIES", "->")),
    **dict.fromkeys(("iff", "Leftrightarrow", "leftrightarrow", "Longleftrightarrow"), ("IFF", "<->")),
    **dict.fromkeys(("le", "leq", "leqslant"), ("RELATION", "<=")),
    **dict.fromkeys(("ge", "geq", "geqslant"), ("RELATION", ">=")),
    **dict.fromkeys(("ne", "neq"), ("RELATION", "/=")),
    **dict.fromkeys(("cdot", "times"), ("TIMES", "*")),
    **dict.fromkeys(("{", "lbrace"), ("BEGIN", "{")),
    **dict.fromkeys(("}", "rbrace"), ("END", "}")),
    **dict.fromkeys(("colon",), ("DOT", ".")),
    "lt": ("RELATION", "<"),
    "gt": ("RELATION", ">"),
    "exists": ("QUANTIFIER", "ex"),
    "forall": ("QUANTIFIER", "all"),
    "in": ("IN", "in"),
    "notin": ("NOTIN", "∉"),
    "cup": ("UNION", "∪"),
    "infty": ("INFINITY", "oo"),
    "top": ("TRUE", "true"),
    "bot": ("FALSE", "false"),
    "div": ("OVER", "/"),
    "lvert": ("OPENBAR", "|"),
    "rvert": ("CLOSEBAR", "|"),
    "vert": ("BAR", "|"),
}
_SIGNS = {
    **dict.fromkeys("=<>", "RELATION"),
    "+": "PLUS",
    "-": "MINUS",
    "*": "TIMES",
    "/": "OVER",
    "^": "POWER",
    "(": "OPEN",
    ")": "CLOSE",
    "[": "LEFT",
    "]": "RIGHT",
    ",": "COMMA",
    ".": "DOT",
    ":": "DOT",
    "|": "BAR",
}
_SPACES = frozenset((",", ";", ":", "!", " ", "quad", "qquad", "thinspace"))
_SKIPPED = frozenset(("left", "right", "big", "Big", "bigl", "bigr", "Bigl", "Bigr", "displaystyle", "limits", "\\"))
_FONTS = frozenset(("mathrm", "mathit", "mathbf", "operatorname", "textrm", "textit"))
_WORDS = {"and": "AND", "or": "OR", "not": "NOT", "implies": "IMPLIES", "iff": "IFF", "if": "IF"}
_FUNCTIONS = frozenset(("min", "max", "sin", "cos", "tan", "exp", "log", "ln", "arctan", "arcsin", "arccos"))
_TOKEN = re.compile(
    r"(?P<SPACE>[\s&~$]+|%[^\n]*)"
    r"|\\(?:begin|end)\{(?P<FRAME>[a-z]+\*?)\}(?:\{[a-z|]*\})?"
    r"|\\(?P<COMMAND>[A-Za-z]+|.)"
    r"|(?P<NUMBER>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)"
    r"|(?P<LETTER>[^\W\d_])"
    r"|(?P<GROUP>\{)"
    r"|(?P<SIGN>[-+*/^()\[\],.:|=<>])"
)
_INDEX = re.compile(r"_(?:\{([A-Za-z0-9]+)\}|([A-Za-z0-9]))")
_MARK = re.compile(
    r"(?<!/)\\(?:"
    + "|".join((*(c for c in _COMMANDS if c.isalpha()), *_FUNCTIONS, *_SKIPPED - {"\\"}, "frac", "sqrt", "mathbb"))
    + r")\b"
)


def is_latex(text: str) -> bool:
    """Whether commands or groups of LaTeX occur that nothing else can be."""
    if "\\" in text and _MARK.search(text) is not None:
        return True
    return "`" not in text and re.search(r"[_^]\{", text) is not None


def tokens(text: str, token: Make) -> Iterator[Token]:
    """The tokens of a source. Raises ``SyntaxFailure`` where there is none."""
    yield from _Source(text, token).between(0, len(text))


class _Source:
    def __init__(self, text: str, token: Make) -> None:
        self.text, self.state = text, State(text, token)

    def put(self, kind: str, value: str, at: int) -> Iterator[Token]:
        """The token, with the sign of a product in front where two factors stand side by side."""
        last, state = self.state.last, self.state
        factor = kind in ("NAME", "NUMBER", "OPEN", "RADICAL", "OPENBAR")
        if factor and last in ("NAME", "NUMBER", "CLOSE", "CLOSEBAR") and not state.header:
            yield from self.plain("TIMES", "*", at)
        yield from self.plain(kind, value, at)

    def plain(self, kind: str, value: str, at: int) -> Iterator[Token]:
        if kind == "BAR":
            yield from self.state.bar(at)
            return
        self.state.note(kind)
        yield self.state.token(kind, value, at)

    def between(self, at: int, end: int) -> Iterator[Token]:
        """The tokens from one offset to another."""
        while at < end:
            found = _TOKEN.match(self.text, at, end)
            if found is None:
                raise SyntaxFailure(f"'{visible(self.text[at])}' cannot be read in LaTeX", at)
            kind, value, after = found.lastgroup, found.group(), found.end()
            match kind:
                case "COMMAND":
                    after = yield from self.command(found["COMMAND"], at, after)
                case "LETTER":
                    after = yield from self.name(value, at, after)
                case "NUMBER":
                    yield from self.put("NUMBER", value, at)
                case "GROUP":
                    after = yield from self.group(at)
                case "SIGN":
                    yield from self.put(_SIGNS[value], value, at)
            at = after

    def command(self, name: str, at: int, after: int) -> Generator[Token, None, int]:
        """The tokens of a command; returns the offset behind it."""
        if name in _SPACES:
            if (
                self.state.header
                and self.state.last == "NAME"
                and not re.match(r"\s*(,|\\in\b|\\(exists|forall))", self.text[after:])
            ):
                yield from self.plain("DOT", ".", at)
        elif name in _COMMANDS:
            yield from self.put(*_COMMANDS[name], at)
        elif name in ("frac", "dfrac", "tfrac"):
            yield from self.put("OPEN", "(", at)
            after = yield from self.group(after)
            yield from self.plain("OVER", "/", at)
            after = yield from self.group(after)
            yield from self.plain("CLOSE", ")", at)
        elif name == "sqrt":
            after = yield from self.root(at, after)
        elif name in _FONTS or name in ("text", "mathbb"):
            after = yield from self.word(name, at, after)
        elif name in _FUNCTIONS:
            yield from self.put("NAME", name, at)
            self.state.last = "FUNCTION"
        elif name not in _SKIPPED and name not in "()[]":
            after = yield from self.name(name, at, after)
        return after

    def closing(self, at: int) -> tuple[int, int]:
        """The offsets inside the braces, or around the one character, at this place."""
        while at < len(self.text) and self.text[at].isspace():
            at += 1
        if not self.text.startswith("{", at):
            return at, at + 1
        depth = 0
        for k in range(at, len(self.text)):
            depth += {"{": 1, "}": -1}.get(self.text[k], 0) if self.text[k - 1 : k] != "\\" else 0
            if depth == 0:
                return at + 1, k
        raise SyntaxFailure("unbalanced brackets: this '{' is never closed", at)

    def group(self, at: int) -> Generator[Token, None, int]:
        """What stands in braces, in brackets of its own; returns the offset behind it."""
        inner, end = self.closing(at)
        yield from self.put("OPEN", "(", at)
        yield from self.between(inner, min(end, len(self.text)))
        yield from self.plain("CLOSE", ")", at)
        return end + 1 if self.text[inner - 1 : inner] == "{" else end

    def root(self, at: int, after: int) -> Generator[Token, None, int]:
        """``\\sqrt{t}`` or ``\\sqrt[n]{t}``, the power with exponent 1/n."""
        degree = re.compile(r"\s*\[\s*([0-9]+)\s*\]").match(self.text, after)
        if self.state.last in OPERAND_ENDS:
            yield from self.plain("TIMES", "*", at)
        after = yield from self.group(after if degree is None else degree.end())
        yield from self.plain("POWER", "^", at)
        for kind, value in (
            ("OPEN", "("),
            ("NUMBER", "1"),
            ("OVER", "/"),
            ("NUMBER", "2" if degree is None else degree[1]),
        ):
            yield from self.plain(kind, value, at)
        yield from self.plain("CLOSE", ")", at)
        return after

    def word(self, font: str, at: int, after: int) -> Generator[Token, None, int]:
        """A name of several letters, or a connective written as a word."""
        inner, end = self.closing(after)
        word = self.text[inner:end].strip()
        behind = end + 1 if self.text[inner - 1 : inner] == "{" else end
        if font == "mathbb" and word == "R":
            yield from self.plain("REALS", "Reals", at)
        elif font == "mathbb" and self.state.last == "IN":
            yield from self.plain(self.state.set_named(word, at), word, at)
        elif font == "text" and word in _WORDS:
            yield from self.plain(_WORDS[word], word, at)
        elif not re.fullmatch(r"[^\W\d_]\w*", word):
            raise SyntaxFailure(f"'{visible(word)}' cannot be read in LaTeX", at)
        else:
            behind = yield from self.name(word, at, behind)
        return behind

    def name(self, name: str, at: int, after: int) -> Generator[Token, None, int]:
        """A variable with its index and primes; returns the offset behind it."""
        index = _INDEX.match(self.text, after)
        if index is not None:
            digits = index[1] or index[2]
            name += digits if digits.isdigit() else f"_{digits}"
            after = index.end()
        while self.text.startswith("'", after):
            name, after = name + "'", after + 1
        yield from self.put("NAME", name, at)
        return after
