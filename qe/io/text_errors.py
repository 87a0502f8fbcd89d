"""Turns what the text parser met into one helpful line: what is wrong, and what was expected instead."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from qe.errors import ParseError
from qe.spelling import KEYWORDS, QUOTED

_CHARACTERS = {
    "`": "a name between backquotes needs both of them, on one line, and is not empty",
    **dict.fromkeys("\"'", "a formula is written without quotes"),
    "%": "a comment starts with #",
    "?": "a choice is written if c then a else b",
    **dict.fromkeys("⌊⌈", "all variables are real, integers cannot be asked for"),
    "$": "formulas are plain text",
    "\\": "'or' is written or, 'and' is written and",
    **dict.fromkeys("ⁱⁿ", "an exponent is a rational number, without variables"),
}
_SAID = re.compile(r"(?<![\\\w`.$({])[a-z]{2,}(?![\w(`\]}=])")
_SHOWN = {
    "RELATION": "a relation (= /= < <= > >=)",
    "CLOSE": "')'",
    "DOT": "'.'",
    "COMMA": "','",
}


class SyntaxFailure(Exception):
    """A message with an offset; the reader adds the source, line and column."""

    def __init__(self, message: str, at: int, expected: str = "") -> None:
        self.message, self.at, self.expected = message, at, expected


@dataclass(frozen=True, slots=True)
class Failing:
    """Makes errors about an offset of ``text``, which begins at this line and column (from 0) of ``source``."""

    text: str
    source: str
    line: int = 0
    column: int = 0

    def __call__(self, message: str, at: int, expected: str = "") -> ParseError:
        line, column = position(self.text, max(at, 0))
        column += self.column if line == 1 else 0
        return ParseError(message, source=self.source, line=line + self.line, column=column, expected=expected)


def position(text: str, at: int) -> tuple[int, int]:
    """Line and column, from 1, of an offset."""
    return text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)


def not_understood(error: ParseError, text: str) -> ParseError:
    """The error of a text that cannot be read; of a question in words as a whole, where a place alone says little."""
    if len(set(_SAID.findall(text)).difference(KEYWORDS)) < 5 or "[" in text or ":=" in text:
        return error
    hint = "ask in one sentence, as in: for which k does x^2 + k*x + 1 = 0 have two roots"
    if re.search(r"(?i)\b(?:least|minim|smallest|maxim|greatest|largest)", text):
        hint = "ask qe minimize in one sentence, as in: the least value of x + y subject to x*y = 1 and x > 0"
    message = f"the words of this question are not understood, so nothing of it is read; {hint}"
    return ParseError(message, source=error.source)


def unknown_function(text: str, name: str, at: int) -> SyntaxFailure:
    """A function that terms do not have, applied at this offset, with the whole application that cannot be read."""
    if _COMMANDS.fullmatch(name) and name != "Piecewise":
        return SyntaxFailure(_command_hint(name), at)
    message = way_out(name)
    applied = text[at:]
    name = applied.partition("[")[0].rstrip()
    is_function = len(name) > 2 and name[0].isupper()  # of Mathematica's, which we do not know
    message = message.partition("; a product")[0] if is_function else message
    if "[" in applied.partition("(")[0] and "unknown function" in message and not is_function:
        hint = f"a variable with an index is written {name}1 or {name}_i, or `{name}[1]` between backquotes"
        return SyntaxFailure(f"{name}[…] is no function; {hint}", at)
    depth = 0
    for end, character in enumerate(applied[:60], 1):
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(character, 0)
        if character in ")]" and depth == 0:
            return SyntaxFailure(f"{applied[:end]}: {message}", at)
    return SyntaxFailure(message, at)


def unknown_character(text: str, at: int) -> SyntaxFailure:
    """No token starts at ``at``."""
    character = text[at]
    hint = _CHARACTERS.get(character)
    shown = f"'{character}'" if character.isprintable() else f"U+{ord(character):04X}"
    return SyntaxFailure(f"unknown character {shown}" + (f"; {hint}" if hint else ""), at)


def unexpected_token(text: str, kind: str, value: str, at: int, expected: Collection[str]) -> SyntaxFailure:
    """A token that cannot stand here; ``kind`` is ``$END`` at the end of the text."""
    before = text[:at].rstrip()
    wanted = _expected(expected)
    if not before and kind == "$END":
        return SyntaxFailure("the text is empty", 0, "a formula")
    if kind == "$END":
        if "Root[" in before:
            return SyntaxFailure("Root[#^3 - 2 &, 1] is written root(1, x^3 - 2)", before.rindex("Root["))
        opening = unmatched_opening(text)
        if opening is not None and "CLOSE" in expected:
            return SyntaxFailure("unbalanced brackets: this '(' is never closed", opening)
        return SyntaxFailure("the text ends too early", len(before), wanted)
    if kind == "CLOSE" and "CLOSE" not in expected and unmatched_opening(text[:at]) is None:
        return SyntaxFailure("unbalanced brackets: this ')' has no partner", at)
    if value == "=>":
        return SyntaxFailure("'=>' is not used here; write >= for a comparison or -> for an implication", at + 1)
    hint = _word_hint(before, kind, value, expected) or _hint(text, before, kind, value, at, expected)
    if hint:
        return SyntaxFailure(hint, at)
    return SyntaxFailure(f"unexpected '{value}'", at, wanted)


def _hint(text: str, before: str, kind: str, value: str, at: int, expected: Collection[str]) -> str:
    """The known misunderstandings, by what stands left and right of the offset."""
    previous = before[-1:]
    if value in ("=", "==>", "==") and previous == "=":
        return "'===' is not used here; an equation is written with one ="
    if value in ("|", "||") or (previous == "|" and kind != "$END"):
        return f"the bars near '{value}' are ambiguous; write abs(x) for an absolute value, or for 'or'"
    reversed_ends = kind == "RIGHT" and re.search(r"(∈|∉|\bin)$", before) is not None
    if reversed_ends or (kind == "LEFT" and {"CLOSE", "RIGHT"} <= {*expected}):
        return "an interval without its ends is written (0, 1), one without its upper end [0, 1)"
    if kind == "QUANTIFIER" and {"TIMES", "AND", "PLUS"} & {*expected}:
        return "a quantifier stands in front of its formula: all x. x^2 >= 0"
    if kind == "NOT" and value == "!":
        return "'!' stands before the formula that it negates; it is no factorial"
    if value == "=" and previous in "<>" and previous:
        return f"write {previous}= without a space"
    if value == "." and before[-1:].isalnum() and text[at + 1 : at + 2].isalpha():
        return "a name with a dot stands between backquotes, as in `a.b`"
    if value in ("/", "*") and previous == "/":
        return "a comment starts with # and goes to the end of the line"
    if value == "," and previous.isdigit() and text[at + 1 : at + 2].isdigit():
        return "a decimal number is written with a point, as in 0.5; several conditions are joined by and"
    complete = "PLUS" not in expected or "AND" in expected
    if value == "," and complete and not {"NUMBER", "NAME", "DOT", "CLOSE"} & {*expected}:
        return "several conditions are joined by and, or stand in braces {…, …}"
    if kind == "POWER" and "POWER" not in expected and "TIMES" in expected and previous not in "*^":
        return "a^b^c is ambiguous; use brackets"
    behind_a_term = "TIMES" in expected or ("PLUS" in expected and "NUMBER" not in expected)
    if value == ":" and text.startswith(":=", at):
        return "':=' is not used here; an equation is written with one ="
    if previous == "(" and kind in ("AND", "OR", "NOT", "RELATION", "IMPLIES", "IFF", "TIMES", "OVER"):
        return "operators stand between what they join; a text in SMT-LIB is read with format smtlib"
    if {"DOT", "PLUS"} <= {*expected} and kind in ("NAME", "NUMBER", "OPEN", "OPENBAR", "RADICAL", "NOT", "IF"):
        return f"the condition of a quantifier ends with a dot, as in …{_last_word(before)}. {value}…"
    if kind in ("NAME", "NUMBER", "OPEN", "OPENBAR", "RADICAL") and behind_a_term and "\n" in text[len(before) : at]:
        return "the conditions of several lines are joined by and, or stand in braces {…, …}"
    if kind in ("NAME", "NUMBER", "OPEN", "OPENBAR", "RADICAL") and behind_a_term:
        left = _last_word(before)
        right = "(…)" if kind == "OPEN" else value
        return f"an operator is missing; a product is written {left}*{right}"
    if kind == "RELATION" and previous == ")" and "AND" in expected:
        return f"'{value}' compares terms, but a formula stands left of it; two formulas are compared with <->"
    return ""


_COMMANDS = re.compile(
    r"\s*(N?M(?:in|ax)(?:imize|Value)|Arg(?:Min|Max)|Find\w+|rl[a-z]+|QuantifierElimination|N?[Ss]olve\w*|reduce\w*|minimi[sz]e"
    r"|maximi[sz]e|find|simplify|prove|show|assert|print|Assum\w+|let)\b\s*[\[({]?"
)
_WORDS = {
    "xor": "write Xor(p, q)",
    "nand": "write not (p and q)",
    "nor": "write not (p or q)",
    "mod": "mod needs integers, and all variables are real",
    "div": "div needs integers, and all variables are real",
    "is": "conditions are written with = /= < <= > >=",
    "between": "write 0 < x < 1, or x in [0, 1]",
    **dict.fromkeys(("but", "unless"), "conditions are joined by and, or, ->"),
    **dict.fromkeys(("has", "have"), "how many values there are is asked as exactly 2 x. f, infinitely many x. f"),
    "where": "put the term in the place of its name, or write ex y. y = … and …",
}


def _word_hint(before: str, kind: str, value: str, expected: Collection[str]) -> str:
    """What helps where words of other systems stand."""
    if kind == "NAME" and value in _WORDS and "TIMES" in expected:
        return f"an operator is missing in front of {value}; {_WORDS[value]}"
    if "Piecewise" in before or (kind == "IF" and "AND" in expected):
        return "a choice between cases is written if c then a else b"
    command = _COMMANDS.match(before)
    if command is not None and (command[1] == "let" or kind != "$END" or "$END" not in expected):
        return _command_hint(command[1])
    return ""


def _command_hint(command: str) -> str:
    """What to write in place of a command of another system."""
    if command == "let":
        return "definitions are not read; put the term in the place of its name, or write ex y. y = … and …"
    if command.startswith("Assum"):
        return f"{command} is no part of a formula; what it assumes is given with assuming= or --assuming"
    if re.match("n?m(in|ax)|argm|findm", command.lower()):
        return f"{command} is no part of a formula; an optimum is asked for with qe.minimize or qe minimize"
    return f"{command} is a command, not a part of a formula; give the formula alone"


_TRANSCENDENTAL = re.compile(r"a?(?:sin|cos|tan|cot|sec|csc|arc\w+)h?|exp|log|ln|log10|log2|erf|gamma", re.IGNORECASE)
_ANGLES = re.compile(r"sin|cos|tan|cot|sec|csc", re.IGNORECASE)


def way_out(name: str) -> str:
    """Why a function cannot be used, and what to do instead."""
    if _ANGLES.fullmatch(name):
        return f"{name} is not algebraic; put c and s with c^2 + s^2 = 1 in the place of cos(t) and sin(t)"
    if _TRANSCENDENTAL.fullmatch(name):
        return f"{name} is not algebraic; put a new variable in the place of its value"
    if name.lower() in ("floor", "ceil", "ceiling", "round", "mod", "frac"):
        return f"{name} needs integers, and all variables are real"
    return f"unknown function {name}; known: abs, sqrt, cbrt, min, max, sign, root; a product is written {name}*(…)"


def _last_word(before: str) -> str:
    word = re.search(r"[\w'.]+$", before)
    return "(…)" if before.endswith(")") else word[0] if word else "…"


def _expected(kinds: Collection[str]) -> str:
    """Readable description of the terminals that could have followed."""
    if "QUANTIFIER" in kinds:
        return "'.' or ','" if "DOT" in kinds else "a formula"
    if "NUMBER" in kinds:
        return "a number, a variable or '('"
    if "NAME" in kinds:
        return "the name of a variable"
    parts = ["an operator"] if "PLUS" in kinds else ["'and', 'or', '->', '<->'"] if "AND" in kinds else []
    parts += [shown for kind, shown in _SHOWN.items() if kind in kinds]
    if "$END" in kinds:
        parts.append("the end of the text")
    return " or ".join(parts)


def unmatched_opening(text: str) -> int | None:
    """The offset of the innermost '(' that has no ')' in ``text``; quoted names and comments are skipped."""
    open_at: list[int] = []
    for match in re.finditer(rf"#[^\n]*|{QUOTED}|[()]", text):
        if match[0] == "(":
            open_at.append(match.start())
        elif match[0] == ")" and open_at:
            open_at.pop()
    return open_at[-1] if open_at else None
