"""LaTeX source as tokens of the text syntax: ``\\forall x\\colon x^{2} \\geq \\frac{1}{2} \\lor \\sqrt{x} < 2 a b``.

As in print, one letter is a variable (with an index, if it has one), words stand in ``\\mathrm{...}`` and the like, and
things side by side are multiplied.
"""

from __future__ import annotations

import re
from collections.abc import Generator, Iterator

from qe.io.surface import FUNCTIONS
from qe.io.text_errors import SyntaxFailure, unknown_function, way_out
from qe.io.text_lexer import OPERAND_ENDS, State
from qe.io.tokens import SIGNS, Token, kinds
from qe.spelling import NUMERALS, PI, QUOTED, visible

_TABLE = kinds(r"""
AND:and land wedge
OR:or lor vee
NOT:not lnot neg
IMPLIES:-> implies Rightarrow rightarrow to Longrightarrow
IFF:<-> iff Leftrightarrow leftrightarrow Longleftrightarrow
RELATION:<= le leq leqslant
RELATION:>= ge geq geqslant
RELATION:/= ne neq
RELATION:< lt
RELATION:> gt
TIMES:* cdot times
OVER:/ div
BEGIN:{ { lbrace
END:} } rbrace
DOT:. colon
QUANTIFIER:ex exists
QUANTIFIER:all forall
IN:in in
NOTIN:∉ notin
UNION:∪ cup
COMMON:∩ cap
WITHOUT:∖ setminus
INFINITY:oo infty
TRUE:true top
FALSE:false bot
OPENBAR:| lvert
CLOSEBAR:| rvert
BAR:| vert
""")
_COMMANDS = {name: (token.partition(":")[0], token.partition(":")[2]) for name, token in _TABLE.items()}
_SIGNS = {**SIGNS, **kinds("RELATION = < >\nLEFT [\nRIGHT ]\nDOT . :\nBAR |")}
_NEGATED = {"=": "/=", "<": ">=", ">": "<=", "\\le": ">", "\\leq": ">", "\\ge": "<", "\\geq": "<", "\\in": "∉"}
_SPACES = frozenset((",", ";", ":", "!", " ", "quad", "qquad", "thinspace"))
_SKIPPED = frozenset(("left", "right", "big", "Big", "bigl", "bigr", "Bigl", "Bigr", "displaystyle", "limits", "\\"))
_FONTS = frozenset(("mathrm", "mathit", "mathbf", "operatorname", "textrm", "textit"))
_WORDS = {"and": "AND", "or": "OR", "not": "NOT", "implies": "IMPLIES", "iff": "IFF", "if": "IF"}
LETTERS = re.compile(
    r"(?:var)?(?:epsilon|theta|pi|rho|sigma|phi)|alpha|beta|gamma|delta|zeta|eta|iota|kappa|lambda|mu|nu|xi|omicron|tau"
    r"|upsilon|chi|psi|omega|Gamma|Delta|Theta|Lambda|Xi|Pi|Sigma|Upsilon|Phi|Psi|Omega|ell|hbar|imath|jmath|aleph"
)
_FUNCTIONS = frozenset(("min", "max", "sin", "cos", "tan", "exp", "log", "ln", "arctan", "arcsin", "arccos"))
_WHICH = re.compile(r"_\{(-?)([0-9]+)\}\s*(?:\\left\s*)?\(")
"""Which root of a polynomial."""
_TOKEN = re.compile(
    r"(?P<SPACE>[\s&~$]+|%[^\n]*)"
    r"|\\(?:begin|end)\{(?P<FRAME>[a-z]+\*?)\}(?:\{[a-z|]*\})?"
    r"|\\(?P<COMMAND>[A-Za-z]+|.)"
    r"|(?P<NUMBER>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)"
    rf"|(?P<LETTER>[^\W\d_{NUMERALS}])"
    r"|(?P<GROUP>\{)"
    r"|(?P<SIGN>[-+*/^()\[\],.:|=<>])"
)
_INDEX = re.compile(r"_(?:\{([A-Za-z0-9]+)\}|([A-Za-z0-9])|\{\\mathrm\{([0-9]+)\}\})")
_ESCAPED = re.compile(r"\\(?:([_#$%&{}])|(sim|char94|vert|backslash)\b ?)")
_MEANT = {"sim": "~", "char94": "^", "vert": "|", "backslash": "\\"}
_NUMBERED = re.compile(r"\\u\{([0-9a-f]{1,6})\}")
_NOT = re.compile(r"\s*(=|<|>|\\[A-Za-z]+)")
_MARK = re.compile(r"(?<!/)\\(?:[A-Za-z]|[},;!|])|\$|[_^]\{")
_BACKQUOTED = re.compile(QUOTED)
_GAP = r"(?:\s|\\[,;:! ]|\\q?quad\b)*"
_NEXT = re.compile(
    rf"{_GAP}(?:[^\W\d_]|\\(?:{LETTERS.pattern})\b|\\(?:{'|'.join(_FONTS)})\{{[^{{}}]*\}})"
    rf"(?:_(?:\{{(?:\w+|\\mathrm\{{\d+\}})\}}|\w))?'*{_GAP}"
    r"(?:[,.:(\[]|\\(?:in|colon|exists|forall|mid)\b|(?:[<>]|\\(?:le|ge)\w*)[^:\\]*(?::|\\(?:[;: ]|colon|q?quad))|$)"
)
"""Another variable of a quantifier behind a comma, not the body."""
_NEXT_HERE = re.compile(rf"{_GAP}([A-Za-z]){_GAP}(?:[<>]|\\(?:le|ge)\w*)\s*[-\w./]+{_GAP},")
"""The same with a condition that ends with a comma."""


def is_latex(text: str) -> bool:
    """Whether commands or groups of LaTeX occur that nothing else can be."""
    return _MARK.search(_BACKQUOTED.sub("", text) if "`" in text else text) is not None


def tokens(text: str) -> Iterator[Token]:
    """The tokens of a source. Raises ``SyntaxFailure`` where there is none."""
    yield from _Source(text).between(0, len(text))


def as_text(source: str) -> str:
    """What stands between dollars in a sentence as the text syntax has it; what is not known stays as it is."""
    text, before = "", ""
    try:
        listed = [*tokens(source)]
    except SyntaxFailure:
        return source
    is_term = not any(token.kind == "QUANTIFIER" for token in listed)
    for kind, written, _ in listed:
        product = is_term and before in ("NAME", "NUMBER", "CLOSE") and kind in ("NAME", "OPEN", "FUNCTION")
        is_word = kind in ("RELATION", "DOT") or (kind != "FUNCTION" and written[1:].isalpha())
        text += "*" if product else " " if text[-1:].isalnum() and written[:1].isalnum() else ""
        text += f" {written} " if is_word else written
        before = kind
    return re.sub(r" +", " ", text)


class _Source:
    def __init__(self, text: str) -> None:
        self.text, self.state = text, State(text)
        self.sets: list[bool] = []  # of the braces that are open: whether they stand around arguments
        self.rows = False  # inside cases, whose rows hold together

    def put(self, kind: str, value: str, at: int) -> Iterator[Token]:
        if kind == "COMMA" and self.state.header and not _NEXT.match(self.text, at + 1):
            here = _NEXT_HERE.match(self.text, at + 1) if self.state.last == "NAME" and self.state.level == 1 else None
            if here is None or here[1] in self.state.bound:
                kind = "DOT"
        if kind == "NAME" and self.state.header:
            self.state.bound.add(value)
        if (kind, self.state.last, self.state.word) == ("NAME", "NUMBER", "0"):
            raise SyntaxFailure(f"a product with zero is written 0 \\cdot {value}", at)
        if kind == "OPEN" and self.state.last == "NAME" and self.state.is_function(at):
            raise unknown_function(self.text, self.state.word, at - 1)
        self.state.note(kind)
        self.state.word = value
        yield Token(kind, value, at)

    def between(self, at: int, end: int) -> Iterator[Token]:
        """The tokens from one offset to another."""
        while at < end:
            token = _TOKEN.match(self.text, at, end)
            if token is None:
                raise SyntaxFailure(f"'{visible(self.text[at])}' cannot be read in LaTeX", at)
            kind, value, after = token.lastgroup, token.group(), token.end()
            match kind:
                case "FRAME":
                    self.rows = token["FRAME"] == "cases" and value.startswith("\\begin")
                case "SPACE" if "&" in value and self.rows:
                    raise SyntaxFailure("a choice between cases is written if c then a else b", at)
                case "COMMAND":
                    after = yield from self.command(token["COMMAND"], at, after)
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
            wide = self.state.last in OPERAND_ENDS and name not in (",", "!", "thinspace")
            goes_on = re.match(r"\s*([,.:]|\\(in|cup|cap|setminus|exists|forall)\b)", self.text[after:])
            if self.state.header and (wide or self.state.last == "NAME") and not goes_on:
                yield from self.put("DOT", ".", at)
        elif name in ("{", "lbrace") and (self.state.last == "FUNCTION" or any(self.sets[-1:])):
            self.sets.append(True)
            yield from self.put("OPEN", "(", at)
        elif name in ("}", "rbrace") and self.sets and self.sets.pop():
            yield from self.put("CLOSE", ")", at)
        elif name == "exists" and self.text.startswith("!", after):
            yield from self.put("QUANTIFIER", "X 1", at)
            after += 1
        elif name in _COMMANDS:
            if name in ("{", "lbrace"):
                self.sets.append(False)
            yield from self.put(*_COMMANDS[name], at)
        elif name == "not":
            after = yield from self.negated(at, after)
        elif name == "nexists":
            yield from self.put("NOT", "not", at)
            yield from self.put("QUANTIFIER", "ex", at)
        elif name == "mid" and (self.state.header or self.sets):
            yield from self.put("DOT", ".", at)
        elif name in ("frac", "dfrac", "tfrac"):
            yield from self.put("OPEN", "(", at)
            after = yield from self.group(after)
            yield from self.put("OVER", "/", at)
            after = yield from self.group(after)
            yield from self.put("CLOSE", ")", at)
        elif name == "sqrt":
            after = yield from self.root(at, after)
        elif name in _FONTS or name in ("text", "mathbb"):
            after = yield from self.word(name, at, after)
        elif name in _FUNCTIONS:
            if name not in FUNCTIONS:
                raise SyntaxFailure(f"\\{name}: {way_out(name)}", at)
            yield from self.put("FUNCTION", name, at)
        elif name == "\\" and self.rows and self.state.last in OPERAND_ENDS:
            if not re.match(r"\s*\\end\b", self.text[after:]):
                yield from self.put("AND", "and", at)
        elif LETTERS.fullmatch(name):
            after = yield from self.name(name, at, after)
        elif name not in _SKIPPED and name not in "()[]":
            raise SyntaxFailure(f"\\{visible(name)} cannot be read in LaTeX", at)
        return after

    def negated(self, at: int, after: int) -> Generator[Token, None, int]:
        """``\\not`` and the relation behind it; returns the offset behind both."""
        relation = _NOT.match(self.text, after)
        sign = "" if relation is None else relation[1]
        if sign in _NEGATED:
            yield from self.put("NOTIN" if sign == "\\in" else "RELATION", _NEGATED[sign], at)
        elif sign == "\\exists":
            yield from self.put("NOT", "not", at)
            yield from self.put("QUANTIFIER", "ex", at)
        else:
            raise SyntaxFailure("\\not cannot be read in LaTeX here", at)
        return after if relation is None else relation.end()

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
        yield from self.put("CLOSE", ")", at)
        return end + 1 if self.text[inner - 1 : inner] == "{" else end

    def root(self, at: int, after: int) -> Generator[Token, None, int]:
        """``\\sqrt{t}`` or ``\\sqrt[n]{t}``: the power with exponent 1/n; for odd n, as in print, of all numbers."""
        index = re.compile(r"\s*\[\s*([0-9]{1,4})\s*\]").match(self.text, after)
        degree, inside = ("2", after) if index is None else (index[1], index.end())
        if degree == "3":
            yield from self.put("FUNCTION", "cbrt", at)
            return (yield from self.group(inside))
        if int(degree) % 2:
            yield from self.put("FUNCTION", "sign", at)
            yield from self.group(inside)
            yield from self.put("TIMES", "*", at)
            yield from self.put("FUNCTION", "abs", at)
        after = yield from self.group(inside)
        yield from self.put("POWER", "^", at)
        for kind, value in (("OPEN", "("), ("NUMBER", "1"), ("OVER", "/"), ("NUMBER", degree), ("CLOSE", ")")):
            yield from self.put(kind, value, at)
        return after

    def word(self, font: str, at: int, after: int) -> Generator[Token, None, int]:
        """A name of several letters, or a connective written as a word."""
        inner, end = self.closing(after)
        word = self.text[inner:end].strip()
        behind = end + 1 if self.text[inner - 1 : inner] == "{" else end
        if font == "mathbb" and word == "R":
            yield from self.put("REALS", "Reals", at)
        elif font == "mathbb" and self.state.last == "IN":
            yield from self.put("NAME", word, at)
        elif font == "text" and word in _WORDS:
            yield from self.put(_WORDS[word], word, at)
        elif word == "root" and (number := _WHICH.match(self.text, behind)):
            sign = "MINUS" if number[1] else "PLUS"
            for kind, value in (("FUNCTION", word), ("OPEN", "("), (sign, ""), ("NUMBER", number[2]), ("COMMA", ",")):
                yield from self.put(kind, value, at)
            behind = number.end()
        elif font != "mathit" and word in _WORDS:
            raise SyntaxFailure(f"\\{font}{{{word}}} is a variable in LaTeX; the connective is \\text{{{word}}}", at)
        elif not re.fullmatch(r"[^\W\d_]\w*", word):
            behind = yield from self.name(_unescaped(word, at), at, behind)
        elif len(word) > 1 and re.match(r"\s*(\\left|\\bigl?)?\s*\(", self.text[behind:]):
            yield from self.put("FUNCTION", word, at)
        else:
            behind = yield from self.name(word, at, behind)
        return behind

    def name(self, name: str, at: int, after: int) -> Generator[Token, None, int]:
        """A variable with its index and primes; returns the offset behind it."""
        index = _INDEX.match(self.text, after)
        if index is not None:
            digits = index[1] or index[2] or f"_{index[3]}"
            name += digits if digits.isdigit() or index[3] else f"_{digits}"
            after = index.end()
        while self.text.startswith("'", after):
            name, after = name + "'", after + 1
        is_pi = self.state.means_pi(name) and re.match(r"\\pi\b|π", self.text[at:])
        yield from self.put("NAME", PI if is_pi else name, at)
        return after


def _unescaped(word: str, at: int) -> str:
    """The name that is written with escapes, as ``x\\_1``: nothing else in it but letters, digits and ``_``."""
    plain = _ESCAPED.sub("", word)
    name = _ESCAPED.sub(lambda escape: escape[1] or _MEANT[escape[2]], word)
    name = _NUMBERED.sub(lambda escape: chr(int(escape[1], 16)), name)
    if plain == word or not re.fullmatch(r"\w*", plain) or name.isdigit() or "\\" in name or "|" in name:
        raise SyntaxFailure(f"'{visible(word)}' cannot be read in LaTeX", at)
    return name
