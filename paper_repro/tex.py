"""LaTeX to MathML, for the notation this package uses: what a browser draws without script or font from elsewhere."""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|:=|\S")
_OPERATORS = {
    **dict(zip((r"\le", r"\leq", r"\ge", r"\geq", r"\ne", r"\neq", r"\in", "-", "<", ">"), "≤≤≥≥≠≠∈−<>")),
    **dict(zip((r"\land", r"\lor", r"\exists", r"\forall", r"\colon", r"\sum", r"\|"), "∧∨∃∀:∑‖")),
    **dict(zip((r"\dots", r"\cdot", r"\times", r"\mp"), "…·×∓")),
}
_FENCES = {"(": "prefix", ")": "postfix", "[": "prefix", "]": "postfix", r"\{": "prefix", r"\}": "postfix"}
_BEFORE_A_SIGN = ("(", "[", "{", ",", "=", "<", ">", r"\le", r"\ge")
_TIGHT = ("/", "|", r"\|")
_LETTERS = {r"\top": "true", r"\bot": "false", r"\max": "max", r"\min": "min", r"\varrho": "ϱ", r"\beta": "β"}
_SPACES = {r"\,": "0.17em", r"\;": "0.28em", r"\quad": "1em", r"\ ": "0.3em"}


def math(source: str, *, display: bool = False) -> str:
    """A ``<math>`` element. Raises ``ValueError`` for notation outside the subset."""
    tokens = _TOKEN.findall(_texts(source))
    reader = _Reader(tokens, _quoted(source))
    body = reader.row(None)
    kind = "block" if display else "inline"
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML" display="{kind}">{body}</math>'


_TEXT = re.compile(r"\\(?:text|mathrm|operatorname)\{((?:[^{}]|\\[{}])*)\}")


def _texts(source: str) -> str:
    """The source with running text replaced by a marker, so that its spaces survive."""
    return _TEXT.sub(r"\\text", source)


def _quoted(source: str) -> list[str]:
    return [re.sub(r"\\(.)", r"\1", text) for text in _TEXT.findall(source)]


def inline(text: str) -> str:
    """Running text as HTML: LaTeX between dollar signs, code between backticks, everything else escaped."""
    out = []
    for piece in re.split(r"(\$[^$]+\$|`[^`]+`)", text):
        if piece.startswith("$") and len(piece) > 1:
            out.append(math(piece[1:-1]))
        elif piece.startswith("`") and len(piece) > 1:
            out.append(f"<code>{escape(piece[1:-1])}</code>")
        else:
            out.append(escape(piece))
    return "".join(out)


@dataclass(slots=True)
class _Reader:
    """A reader of tokens. ``texts``: the pieces of running text still to come."""

    tokens: list[str]
    texts: list[str]
    at: int = 0

    def _peek(self) -> str | None:
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def _next(self) -> str:
        token = self._peek()
        if token is None:
            raise ValueError("the formula ends too early")
        self.at += 1
        return token

    def row(self, *ends: str | None) -> str:
        """Everything up to one of ``ends`` (which is read, None being the end of the text)."""
        out = []
        while (token := self._peek()) not in ends:
            if token is None:
                raise ValueError(f"{ends[0]} expected")
            out.append(self._scripted())
        if token is not None:
            self.at += 1
        return f"<mrow>{''.join(out)}</mrow>"

    def _scripted(self) -> str:
        token = self._peek()
        base, below, above = self._atom(), "", ""
        while (mark := self._peek()) in ("_", "^", "'"):
            self.at += 1
            if mark == "'":
                above += "<mo>′</mo>"
            elif mark == "_":
                below = self._atom()
            else:
                above += self._atom()
        if above.count("<mo>′</mo>") > 1:
            above = f"<mrow>{above}</mrow>"
        if below and above:
            kind = "munderover" if token == r"\sum" else "msubsup"
            return f"<{kind}>{base}{below}{above}</{kind}>"
        return f"<msub>{base}{below}</msub>" if below else f"<msup>{base}{above}</msup>" if above else base

    def _atom(self) -> str:
        before = self.tokens[self.at - 1] if self.at else "("
        token = self._next()
        if token == "-" and before in _BEFORE_A_SIGN:
            return '<mo form="prefix">−</mo>'
        if token == "{":
            return self.row("}")
        if token in (r"\left", r"\right"):
            return f'<mo stretchy="true">{escape(self._next())}</mo>'
        if token[0].isdigit():
            return f"<mn>{token}</mn>"
        if token.isalpha():
            return f"<mi>{token}</mi>"
        if token in _SPACES:
            return f'<mspace width="{_SPACES[token]}"/>'
        if token in _LETTERS:
            return f"<mi>{_LETTERS[token]}</mi>"
        if token in _FENCES:
            return f'<mo form="{_FENCES[token]}" stretchy="false">{token[-1]}</mo>'
        if token in _TIGHT:
            return f'<mo stretchy="false" lspace="0" rspace="0">{_OPERATORS.get(token, token)}</mo>'
        if token in _OPERATORS:
            return f"<mo>{escape(_OPERATORS[token])}</mo>"
        if token.startswith("\\"):
            return self._command(token)
        return f"<mo>{escape(token)}</mo>"

    def _command(self, token: str) -> str:
        match token:
            case r"\frac":
                return f"<mfrac>{self._atom()}{self._atom()}</mfrac>"
            case r"\binom":
                inner = f'<mfrac linethickness="0">{self._atom()}{self._atom()}</mfrac>'
                return f"<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>"
            case r"\sqrt":
                return f"<msqrt>{self._atom()}</msqrt>"
            case r"\hat":
                return f'<mover accent="true">{self._atom()}<mo>^</mo></mover>'
            case r"\text":
                return f"<mtext>{escape(self.texts.pop(0))}</mtext>"
            case r"\begin":
                return self._table()
        raise ValueError(f"unknown notation {token}")

    def _table(self) -> str:
        """``{array}{rl} a & b \\\\ c & d \\end{array}``."""
        self._atom(), self._atom()
        rows, cells = [], []
        while True:
            start = self.at
            cells.append(self.row("&", "\\\\", r"\end"))
            end = self.tokens[self.at - 1]
            if self.at == start:
                raise ValueError("a table does not end")
            if end != "&":
                rows.append("<mtr>" + "".join(f'<mtd style="text-align:left">{c}</mtd>' for c in cells) + "</mtr>")
                cells = []
            if end == r"\end":
                self._atom()
                return f"<mtable>{''.join(rows)}</mtable>"
