"""The tokens of the text syntax: what people type for the same thing becomes one token.

A product without a sign is read where nothing else can be meant: between numbers, brackets, letters, and longer names
that stand alone in front of an operator somewhere, on one line, and not behind a division: ``1/2 x`` is ambiguous.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from qe.errors import InputError
from qe.io.names import check_name
from qe.io.surface import FUNCTIONS
from qe.io.text_errors import SyntaxFailure, unknown_character
from qe.io.text_words import BEHIND, LISTED, NO_VARIABLES, QUANTITY, SIGNED, SORT, SPOKEN, THAT, THERE, quantity
from qe.io.tokens import Token, kinds
from qe.spelling import CONSTANTS, PI, QUOTED, WORD, WORDS_FOR_PI, is_product, unquoted

KEYWORDS = kinds("""
QUANTIFIER ex exists Ex Exists EXISTS all forall All ForAll Forall FORALL
AND and AND
OR or OR
NOT not NOT
TRUE true True TRUE
FALSE false False FALSE
INFINITY oo infinity Infinity inf Inf
IMPLIES implies
IFF iff
IN in
REALS Reals ℝ
IF if If
THEN then Then
ELSE else
""")
_OPERATORS = kinds(r"""
QUANTIFIER ∃ ∀ \[ForAll] \[Exists]
RELATION = == /= =/= != =!= ~= <> ≠ < <= =< ≤ ⩽ > >= ≥ ⩾ \[Equal] \[NotEqual] \[LessEqual] \[GreaterEqual]
PLUS +
MINUS - −
TIMES * · × ⋅
OVER / ÷ ⁄ ∕
POWER ^ **
OPEN (
CLOSE )
LEFT [
RIGHT ]
BEGIN {
END }
COMMA , ;
DOT . :
AND /\ ∧ & && \[And] &and &and;
OR \/ ∨ \[Or] &or &or;
NOT ~ ¬ ! \[Not]
IMPLIES -> ==> → ⇒ ⟹ ⟶ => \[Implies] &implies
IFF <-> <=> <==> ↔ ⇔ ⟺ ⟷ \[Equivalent]
TRUE ⊤
FALSE ⊥
IN ∈ \[Element]
INFINITY ∞ \[Infinity]
RADICAL √ ∛
UNION ∪
COMMON ∩
WITHOUT ∖ \
BAR |
""")
CALLS = kinds("""
CONNECTIVE And Or Not Implies Equivalent Xor
COMPARE Eq Equal Ne Unequal Lt Less Le LessEqual Gt Greater Ge GreaterEqual Inequality
CHOICE If ITE ite
ELEMENT Element
PIECEWISE Piecewise
""")
_NO_PRODUCTS = frozenset(map(str.lower, (*KEYWORDS, *FUNCTIONS, *CONSTANTS)))
SIMPLIFIERS = ("FullSimplify", "Simplify", "Refine")
COMMANDS = ("Resolve", "Reduce", "Solve", "FindInstance", "CylindricalDecomposition", *SIMPLIFIERS)
"""Commands of Mathematica around a formula and, perhaps, variables and Reals."""
NOT_REAL = frozenset(
    ("Z", "N", "Q", "C", "ℤ", "ℕ", "ℚ", "ℂ", "Int", "int", "Nat", "Bool")
    + ("Integer", "Integers", "Rationals", "Complexes", "Naturals")
)
ALSO_REALS = frozenset(("R", "RR", "Real", "reals", "real"))
_TYPE = re.compile(rf"\s*(?:{'|'.join((*NOT_REAL, *ALSO_REALS))}|Reals|ℝ)\s*[.,]")
_TOKEN = re.compile(
    rf"(?P<SPACE>\s+|\#[^\n]*)"
    rf"|(?P<QUANTITY>(?:{THERE}\s+|[Ff]or\s+)?(?:{QUANTITY})(?=\s+{LISTED}\s*(?:[.:,]|[<>=]=?|/=|in\b|∈|{THAT})))"
    rf"|(?P<NONE>∄|{THERE}\s+no\b)"
    rf"|(?P<UNIQUE>(?:∃|\b[Ee]xists|\bex)\s*!(?!=)|(?:{THERE}|[Ee]xists)\s+(?:an?\s+)?unique\b)"
    rf"|(?P<COMMAND>(?:{'|'.join(COMMANDS)})(?=\[))\b"
    r"|(?P<EVERY>(?:[Ff]or\s+(?:all|every|each|any|arbitrary)|[Gg]iven\s+any)\b)"
    rf"|(?P<SOME>[Ff]or\s+some\b|{THERE}\b(?:\s+an?\b(?!\s+(?:in\b|{THAT}))(?=\s+{LISTED}))?)"
    rf"|(?P<THAT>{THAT})"
    r"|(?P<NOTIN>not\s+in\b|∉)"
    rf"|(?P<QUANTIFIER>[EA](?=\s+{LISTED}\s*(?:,\s*{LISTED}\s*)*(?:[.:]|\)\s*[(\[])|[a-z][0-9]*\s*\)\s*[(\[]))"
    rf"|(?P<CALL>(?:{'|'.join(CALLS)})(?=\s*[(\[]))\b"
    rf"|(?P<NAME>{WORD})"
    r"|(?P<NUMBER>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[¼-¾⅐-⅞↉])"
    rf"|(?P<QUOTED>{QUOTED})"
    r"|(?P<RAISED>⁻?[⁰¹²³⁴-⁹]+)"
    r"|(?P<OPERATOR>&(?:and|or|implies)\b;?|<==>|<->|<=>|==>|=>|->|=<|=/=|=!=|<=|>=|==|/=|!=|~=|<>|/\\|\\/|\\(?=\s*\{)|&&|\*\*|\\\[\w+\]"
    r"|[-+*/^()=<>~,;.:∃∀∧∨¬→↔⇒⇔⟹⟺⟶⟷⊤⊥≤≥⩽⩾≠−·×⋅÷⁄∕∈∞√∛∪∩∖&|!{}]|\[|\])"
)
_MULTIPLE = (
    r"(?:(?:[0-9]{1,18}|\(-?[0-9]{1,18}\))\s*\*\s*)?"
    rf"(?!(?:{'|'.join(filter(str.isascii, (*KEYWORDS, *CONSTANTS)))})\b)[A-Za-z][A-Za-z0-9_]*+|[0-9]{{1,18}}+"
)
_LINEAR = re.compile(
    rf"(?:-\s*)?(?:{_MULTIPLE})(?:\s*[-+]\s*(?:{_MULTIPLE})){{2,}}(?=\s*(?:[<>=≤≥)]|/=|!=|/\\|\\/|and\b|or\b|$))"
)
"""At least three multiples of names and numbers, and nothing else up to the end of a side or of a bracket."""
_BEFORE_LINEAR = frozenset(("", "AND", "OR", "NOT", "IMPLIES", "DOT", "OPEN", "RELATION"))
_RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
OPERAND_ENDS = frozenset(("NAME", "NUMBER", "CLOSE", "RIGHT", "END", "CLOSEBAR", "INFINITY", "REALS", "TRUE", "FALSE"))
"""Tokens after which a term or a formula may be complete."""

_MATHEMATICA = re.compile(r"\b[A-Z][A-Za-z]+\[")  # where 2/3 a is two thirds of a, and ab a name
_UNDIVIDED = re.compile(rf"[/÷√]\s*({WORD})")
"""What would be divided where it is read as a product."""
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]")
_NEXT_NAME = re.compile(rf"\s*({LISTED})\s*(?=[,.:()\[∈∃∀]|{LISTED}|$)")
_NEXT_BOUNDED = re.compile(
    rf"\s*(?:{LISTED})\s*(?:<=|>=|=<|!=|/=|[<>≤≥≠∈]|in\b)[^:;∃∀&|∧∨→⇒]*?(?<!,)(?::(?!=)|\.(?=\s)|\bsuch\s+that\b|\bs\.t\.)"
)
_NEXT_BOUNDED_HERE = re.compile(rf"\s*({LISTED})\s*(?:<=|>=|=<|!=|/=|[<>≤≥≠])\s*[-\w./*^]+\s*,(?=\s*\S)")
_ENDS_A_NAME = re.compile(r"\s*[,.:]")
_ANOTHER = re.compile(rf"\s+{LISTED}")
_LETTER = re.compile(r"[^\W\d_](?:_?[0-9]+|_[^\W\d_])?'*")
_VARIABLE = re.compile(
    rf"(?:^|[-+*/^(\[{{<>=≤≥≠,.:&|]|\b(?:and|or|not)\b)\s*({WORD})(?=\s*(?:[\^*≤≥≠]|/(?!\\)|=(?!>)|<(?!-|=>)|>))"
)
"""A name alone in front of an operator."""
_LIST = rf"{LISTED}(?:(?:\s*,\s*|\s+){LISTED})*"
_BOUND = re.compile(
    rf"(?:[∃∀]|\b(?:{'|'.join(word for word in KEYWORDS if KEYWORDS[word] == 'QUANTIFIER')}))\s*[(\[]\s*({_LIST})\s*,"
    rf"|\{{\s*\(?\s*({_LIST})\s*(?:\}}|\)?\s*(?:∈|in\b|\||:(?!=)))"
)
"""What is quantified in brackets or listed in braces: ``ForAll[x, …]``, ``{x, y}``, ``{(x, y) | …}``."""
_OPENS, _CLOSING = frozenset(("OPEN", "LEFT", "BEGIN")), frozenset(("CLOSE", "RIGHT", "END"))
_FORMULAS = frozenset(kinds("_ RELATION IN AND OR NOT IMPLIES IFF QUANTIFIER TRUE FALSE COMMA DOT THEN ELSE"))
"""Tokens that terms do not have; all but relations begin another comparison."""
_FUNCTIONS = frozenset("fghpqFGHPQ")
"""Letters in front of a bracket that are no factor."""
_ARGUMENT = re.compile(rf"\(\s*(?:{WORD}|[0-9.]+)?\s*[),]")
_OR_COMMA = OPERAND_ENDS | {"COMMA"}
_SHORT = frozenset(("ex", "Ex", "all", "All", "E", "A"))
"""Quantifiers whose variables end with a dot; behind the others a comma may end them too: ``forall x, x^2 >= 0``."""


def tokens(text: str, state: State | None = None) -> Iterator[Token]:
    """The tokens of a text. Raises ``SyntaxFailure`` where there is none."""
    state = State(text) if state is None else state
    at, end, match = 0, len(text.rstrip("; \t\r\n")), _TOKEN.match
    if end and text[end - 1] == ".":
        end -= 1  # a full stop
    while at < end:
        linear = _LINEAR.match(text, at, end) if state.last in _BEFORE_LINEAR and not state.header else None
        names = re.findall(WORD, linear.group()) if linear is not None else ()
        if linear is not None and not any(state.is_product(name, at) for name in names):
            yield from state.put("LINEAR", linear.group(), at)
            at = state.end = linear.end()
            continue
        token = match(text, at, end)
        if token is None:
            raise unknown_character(text, at)
        kind, value = token.lastgroup, token.group()
        if kind == "NAME" and state.is_product(value, at):
            for letter, place in zip(value, range(at, at + len(value))):
                if place > at:
                    yield from state.put("TIMES", "*", place)
                yield from state.put("NAME", letter, place)
        elif kind == "NAME":
            yield from state.put(KEYWORDS.get(value, "NAME"), PI if state.means_pi(value) else value, at)
        elif kind == "OPERATOR":
            typed = value == ":" and state.header and _TYPE.match(text, at + 1)
            if value not in _OPERATORS:
                raise SyntaxFailure(f"unknown character {value}", at)
            yield from state.put("IN" if typed else _OPERATORS[value], value, at)
        elif kind == "NUMBER":
            if value[0] == "." and state.header and state.last != "RELATION":  # the dot ends the quantifier
                yield from state.put("DOT", ".", at)
                at += 1
                continue
            value = _number(value, state, text, at)
            yield from state.put("NUMBER", value, at)
        elif kind == "QUOTED":
            yield from state.put("NAME", quoted_name(value, at), at)
        elif kind == "RAISED":
            yield from state.raised(value.translate(_RAISED), at)
        elif kind == "CALL":
            yield from state.put(CALLS[value], value, at)
        elif kind in ("EVERY", "SOME", "QUANTITY", "UNIQUE"):
            said = {"EVERY": "forall", "SOME": "exists"}.get(kind) or quantity(value)
            yield from state.put("QUANTIFIER", said, at)
        elif kind == "NONE":
            yield from state.put("NOT", "not", at)
            yield from state.put("QUANTIFIER", "∃", at)
        elif kind == "THAT" and state.header and state.last in OPERAND_ENDS:
            yield from state.put("DOT", value, at)
        elif value == "with" and (not state.header or _ENDS_A_NAME.match(text, at + len(value))):
            yield from state.put("NAME", value, at)
        elif kind == "THAT":
            raise SyntaxFailure(f"'{value}' stands only behind the variables of a quantifier", at)
        elif kind != "SPACE":
            yield from state.put(str(kind), value, at)
        at += len(value) if kind == "NUMBER" else len(token.group())
        if kind != "SPACE":
            state.end = at
        if state.last == "QUANTIFIER" and (sort := SORT.match(text, at, end)) is not None:
            at, state.signed = sort.end(), SIGNED.get(sort[1], "")
    yield from state.signs(end)
    state.is_read = True


def _number(value: str, state: State, text: str, at: int) -> str:
    """The number alone, without a dot that ends a quantifier or begins a range."""
    if value[-1] == "." and (state.header or text.startswith(".", at + len(value))):
        value = value[:-1]
    if value == "0" and _HEXADECIMAL.match(text, at):
        raise SyntaxFailure("numbers are decimal; a product with zero is written 0*x", at)
    if text.startswith("_", at + len(value)):
        raise SyntaxFailure("a number is written without _ between its digits", at)
    if not value.isascii() and state.last == "NUMBER":
        raise SyntaxFailure("a mixed number is written as one fraction: 5/2", at)
    return value


def quoted_name(text: str, at: int) -> str:
    """The name between backquotes."""
    try:
        return check_name(unquoted(text))
    except ValueError as error:
        raise SyntaxFailure(f"the name {text} cannot be read: {error}", at) from None
    except InputError as error:
        raise SyntaxFailure(str(error), at) from None


@dataclass(slots=True)
class _Bracket:
    """Inside a bracket: whether a division stands in front of what comes, whether it is a formula, whether a relation
    stands before in the same comparison, and where, behind it, a space first stands for a product."""

    divided: bool = False
    is_formula: bool = False
    compared: bool = False
    spaced: int = -1


class State:
    """What stands before the next token: ``end`` is the offset where the last one ends. ``header``: inside a
    ``quantifier``, before its body, which may follow a comma where ``spoken``; ``bounded``: a condition stands behind
    the last of its variables; ``within``: the level of brackets at which the set ends that they lie in; ``behind`` its
    formula; ``signed``: a comparison with zero that holds of them. ``brackets``: of those that are open; ``closed``:
    whether the last one that ended held a term. ``is_read``: no token is missing."""

    def __init__(self, text: str) -> None:
        self.text, self.end = text, 0
        self.last = ""
        self.header, self.spoken, self.bounded, self.quantifier, self.signed = False, False, False, "", ""
        self.behind = False
        self.level, self.within = 1, 0
        self.brackets = [_Bracket()]
        self.called, self.listing, self.word, self.closed = False, False, "", False
        self.variables: set[str] | None = None
        behind = BEHIND.search(text)
        quantified = {*re.findall(LISTED, behind[1])} if behind else set()
        self.bound: set[str] = set() if behind is None or behind[2] else {*quantified}
        for match in _BOUND.finditer(text):
            self.bound |= {*re.findall(LISTED, match[1] or match[2])}.difference(WORDS_FOR_PI)
        self.letters = {name for name in self.bound | quantified if len(name) == 1}
        self.words: Counter[str] | None = None
        self.alone = self.names = Counter[str]()
        self.products, self.kept, self.is_read = set[str](), set[str](), False

    def put(self, kind: str, value: str, at: int) -> Iterator[Token]:
        """The token, with the sign of a product in front of it where that is left out."""
        said = kind == "NAME" and self.header and value in NO_VARIABLES
        if said and (self.last == "NAME" or _ANOTHER.match(self.text, at + len(value))):
            raise SyntaxFailure(NO_VARIABLES[value], at)
        if kind == "AND" and self.spoken and self.header:  # for all x and y
            behind = at + len(value)
            kind = "COMMA" if self.goes_on(behind) or self.bounds_another(behind) else kind
        if kind == "COMMA" and self.header:
            rest = at + len(value)
            more = self.behind and self.bound.isdisjoint(re.findall(WORD, self.text[rest:]))
            more = more or self.goes_on(rest) or self.bounds_another(rest)
            if self.bounded and more:  # ∃ x > 0, y > 0: …
                kind, value = "QUANTIFIER", self.quantifier
            elif self.spoken and not more:
                kind = "DOT"
        if self.signed and self.header and kind not in ("NAME", "COMMA"):
            yield from self.signs(at)
        if kind == "QUANTIFIER":
            self.behind = self.behind if self.header else self.last in _OR_COMMA
            self.spoken, self.quantifier, self.bounded = value not in _SHORT, value, False
        elif kind == "NAME" and self.header:
            if self.last == "NAME" and self.begins_body(value, at):
                yield from self.put("DOT", ".", at)
            elif value in self.products:
                raise SyntaxFailure(f"{value} is a variable here, and a product before; write `{value}` there", at)
            else:
                self.bound.add(value)
                self.letters.update(value if len(value) == 1 else ())
        elif self.header and kind in ("RELATION", "IN"):
            self.bounded = True
        if not (self.header or self.listing) and self.multiplies(kind, value, at):
            if self.brackets[-1].divided and not _MATHEMATICA.search(self.text):
                shown = f"{self.text[:at].split()[-1]}{' ' * (self.end < at)}{value}"
                hint = "write 1/2*x or 1/(2*x)"
                raise SyntaxFailure(f"{shown} is ambiguous: a product without * after a division; {hint}", at)
            if self.end < at and self.brackets[-1].spaced < 0:
                self.brackets[-1].spaced = self.end
            yield from self.put("TIMES", "*", at)
        if kind == "RELATION" and self.brackets[-1].compared and self.brackets[-1].spaced >= 0:
            message = "a condition between two relations has a product without *, or an operator is missing here"
            raise SyntaxFailure(message, self.brackets[-1].spaced)
        self.note(kind)
        self.word = value
        yield Token(kind, value, at)

    def signs(self, at: int) -> Iterator[Token]:
        """What ``for all positive x, y`` says of its variables."""
        if self.signed:
            sign, self.signed = self.signed, ""
            yield from self.put("RELATION", sign, at)
            yield from self.put("NUMBER", "0", at)

    def multiplies(self, kind: str, value: str, at: int) -> bool:
        """Whether a product without a sign ends in front of this token."""
        if kind not in ("NAME", "OPEN", "RADICAL") or "\n" in self.text[self.end : at]:
            return False
        if self.last == "NAME" and kind == "OPEN":
            return _LETTER.fullmatch(self.word) is not None and not self.is_function(at)
        factor = kind != "NAME" or self.is_factor(value) or value.lower() in FUNCTIONS
        if self.last == "NUMBER":
            return (factor and self.word != "0") or self.end == at
        if self.last == "NAME":
            return factor and self.end < at and self.is_factor(self.word)
        return factor and self.last in ("CLOSE", "RIGHT") and self.closed

    def is_factor(self, name: str) -> bool:
        """Whether a name is surely no word of a language."""
        if self.variables is None:
            self.variables = {*_VARIABLE.findall(self.text)}
        return bool(_LETTER.fullmatch(name)) or name in self.variables or name in CONSTANTS

    def is_function(self, at: int) -> bool:
        """Whether the name in front of a bracket may be a function."""
        return self.word in _FUNCTIONS or _ARGUMENT.match(self.text, at) is not None

    def means_pi(self, name: str) -> bool:
        """Whether a name is a word for pi, and no quantifier binds it."""
        return name in WORDS_FOR_PI and not self.header and name not in self.bound

    def is_product(self, name: str, at: int) -> bool:
        """Whether a name that no quantifier binds is a product of its letters: no sign of a product is written and all
        are names (``∃x, y: xy ≥ a``, ``a + b > ab``), or all but one, and one has a quantifier (``all x. x + kx > 0``);
        one is the variable of a quantifier that stands nowhere else (``ex x. ax^2 + b = 0``); or it stands behind a
        number alone and its letters elsewhere: ``x^2 - 2mx + m > 0``.

        What stands behind a division or the sign of a root is a name everywhere; Mathematica has names alone."""
        if len(name) == 1 or self.header or not name.isalpha() or name in self.bound or name.lower() in _NO_PRODUCTS:
            return False
        if self.words is None:
            self.words, self.alone = (Counter(re.findall(one, self.text)) for one in (WORD, rf"(?<!\w){WORD}"))
            self.kept = {*_UNDIVIDED.findall(self.text)}
            self.names = Counter() if "*" in self.text else self.words
            if _MATHEMATICA.search(self.text):
                self.words, self.names, self.letters = Counter(), Counter(), set()
        factor = self.last == "NUMBER" and self.end == at and not self.alone[name]
        lone = [letter for letter in self.letters if self.words[letter] < 2]
        strange = [letter for letter in name if letter not in self.names]
        called = self.text.startswith("(", at + len(name))
        almost = len(strange) == 1 and not called and not self.letters.isdisjoint(name)
        product = almost or is_product(name, self.words if factor else self.names, lone)
        product = product and name not in self.kept
        self.products.update((name,) if product else ())
        return product

    def goes_on(self, at: int) -> bool:
        """Whether another variable of the quantifier comes here, not its body."""
        following = None if SPOKEN.match(self.text, at) else _NEXT_NAME.match(self.text, at)
        return following is not None and following[1] not in KEYWORDS and following[1].lower() not in FUNCTIONS

    def bounds_another(self, at: int) -> bool:
        """Whether another variable comes here with a condition of its own, as in ``∃ x > 0, y > 0: x*y = a``, or with a
        comma behind it, which outside of brackets could end nothing else."""
        here = _NEXT_BOUNDED_HERE.match(self.text, at) if self.spoken and self.level == 1 else None
        return (here is not None and here[1] not in self.bound) or _NEXT_BOUNDED.match(self.text, at) is not None

    def begins_body(self, name: str, at: int) -> bool:
        """Whether a name behind another one is no variable of the quantifier any more: ``∀x ∃y y > x``."""
        here = name in self.bound or self.quantifier in ("∀", "∃")
        return here and not (self.goes_on(at) or self.bounds_another(at))

    def raised(self, digits: str, at: int) -> Iterator[Token]:
        """A raised number is an exponent."""
        yield from self.put("POWER", "^", at)
        if digits[0] == "-":
            yield from self.put("MINUS", "-", at)
        yield from self.put("NUMBER", digits.lstrip("-"), at)

    def note(self, kind: str) -> None:
        """Keep the state up to date."""
        last, self.last = self.last, kind
        if kind == "QUANTIFIER":
            self.header = True
        elif kind in ("DOT", "OPEN", "LEFT"):
            self.header, self.within = False, self.level if self.header and last in ("IN", "UNION") else self.within
        if kind in ("OPEN", "LEFT"):
            self.called = last == "QUANTIFIER"
        elif kind in ("BEGIN", "END"):  # the names of ForAll[{x y}, …]
            self.listing = kind == "BEGIN" and self.called and last in ("OPEN", "LEFT")
        if kind in _OPENS:
            self.level += 1
            self.brackets.append(_Bracket())
        elif kind in _CLOSING:
            self.level -= 1
            self.header = False
            self.closed = not self.brackets[-1].is_formula
            if len(self.brackets) > 1:
                self.brackets.pop()
            if self.within == self.level:  # the set that a quantifier ranges over is complete
                self.header, self.within = True, 0
        elif kind not in ("NAME", "NUMBER", "POWER"):
            inside = self.brackets[-1]
            inside.divided = kind == "OVER"
            if kind in _FORMULAS:
                inside.is_formula, inside.compared, inside.spaced = True, kind == "RELATION", -1
