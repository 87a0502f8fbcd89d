"""The text syntax: ``ex x, y. all z. x^2 + 2*x*y >= 0 and not z = 0 or p -> q``; ``docs/formats.md`` has all of it.
What a whole text is: questions in words, definitions behind ``where``, problems of optimisation, terms alone."""

from __future__ import annotations

import re
from collections.abc import Collection, Container, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import cast

from qe.errors import ParseError
from qe.exact.ring import Poly
from qe.formula.build import conj
from qe.formula.syntax import Formula, Relation
from qe.io.lowering import lower, lower_term
from qe.io.parser import TERM, parsed
from qe.io.substitution import over_one_ring
from qe.io.surface import FUNCTIONS, Comparison, Every, Meet, Name, Node, Number, Quantification, Term
from qe.io.text_errors import Failing, SyntaxFailure
from qe.io.text_lexer import KEYWORDS
from qe.io.text_parser import is_latex, parser_of, products
from qe.io.text_words import Question, in_words, split
from qe.io.tokens import without_collections
from qe.io.total import Total
from qe.spelling import CONSTANTS as CONSTANTS
from qe.spelling import QUOTED, WORD, WORDS_FOR_PI, is_product

_WHERE = re.compile(r"(.*?)[,;]?\s+where\s+((?:[A-Z]\s*=[^=<>≤≥≠]+,\s*)*[A-Z]\s*=[^=<>≤≥≠]+)", re.DOTALL)
_DEFINED = re.compile(r"([A-Z])\s*=\s*([^=]+?)\s*(?:,(?=\s*[A-Z]\s*=)|$)")
_OPTIMUM = re.compile(
    r"\s*(?:N?(M(?:in|ax))(?:imize|Value)\[|Arg(M(?:in|ax))\[|(m(?:in|ax))imi[sz]e\()(.*)[\])]\s*;?\s*", re.DOTALL
)
_RANGE = re.compile(rf"({WORD})\s*=\s*(.+?)\s*\.\.\s*(.+)")
_POINT = ("Reals", "point", "locus", "coordinates")
"""What an optimum may be asked with, besides conditions and variables."""


def read(text: str, *, source: str = "<text>", known: Container[str] = (), total_division: bool = False) -> Formula:
    """The formula that ``text`` means, with what it assumes. ``source`` names the text in messages.

    ``pi`` is the number, a variable with a name of its own (``qe.formula.numbers``), and a word whose letters are names
    a product, unless it stands between backquotes or is ``known`` to be a variable (as programs know theirs). A
    quotient has no value where its denominator is zero; with ``total_division`` it has one there that nothing is known
    of, as in SMT-LIB, and the formula holds if it holds for some choice of these values. Raises ``ParseError``, one
    line with line, column and what was expected.
    """
    return conj(reversed(read_posed(text, source=source, known=known, total_division=total_division)))


def read_posed(
    text: str, *, source: str = "<text>", known: Container[str] = (), total_division: bool = False
) -> tuple[Formula, Formula]:
    """As ``read``; over the same ring what it assumes, c of ``Assuming[c, f]`` and ``Refine[f, c]``, TRUE without."""
    question = _question(_quoting(text, known))
    texts = [_written_out(question.formula), *([question.assumed] if question.assumed else [])]
    formula, *assumed = over_one_ring(*(_lowered(part, source, known, total_division) for part in texts))
    return formula, conj(assumed)


def _lowered(text: str, source: str, known: Container[str], total_division: bool) -> Formula:
    fail = Failing(text, source)
    total = Total() if total_division else None
    with without_collections(text):
        formula = lower(_node(text, fail), fail, meet=_no_constants(fail, known), total=total)
    return formula if total is None else total.checked(formula)


def _question(text: str) -> Question:
    """What a text asks, which may be words or a script."""
    if not in_words(text):
        return Question(text)
    from qe.io.questions import plainly

    return plainly(text)


def _node(text: str, fail: Failing) -> Node:
    """What a text is; terms alone, one or a list, are equations with zero, as for SymPy's ``solve``."""
    try:
        return cast(Node, parsed(parser_of(text), text, fail))
    except ParseError:
        try:
            terms = parser_of(text)(text).terms()
        except SyntaxFailure:
            terms = []
        if not terms or isinstance(terms[0], Name | Number):
            raise
    return Every([Comparison([term, Number(0)], [Relation.EQ], -1) for term in terms])


def _written_out(text: str) -> str:
    """The text as a formula, without the capitals that it ends with: ``D > 0 where D = b^2 - 4*a*c``."""
    where = _WHERE.fullmatch(text) if "where" in text else None
    if where is None:
        return text
    terms = {name: f"({term})" for name, term in _DEFINED.findall(where[2])}
    return re.sub(rf"{QUOTED}|{WORD}", lambda word: terms.get(word[0], word[0]), where[1])


def _quoting(text: str, known: Container[str]) -> str:
    """The text with backquotes around words that would not be read as names, and are known to be."""
    words = {
        word for word in re.findall(WORD, text) if word in known and (word in WORDS_FOR_PI or is_product(word, word))
    }
    words -= {*KEYWORDS, *FUNCTIONS}
    return re.sub(rf"{QUOTED}|{WORD}", lambda w: f"`{w[0]}`" if w[0] in words else w[0], text) if words else text


def read_polynomial(text: str, *, source: str = "<text>", known: Container[str] = ()) -> tuple[Poly, Fraction]:
    """A polynomial p and a rational s: ``text`` means s*p. Names and errors as for ``read``."""
    text = _quoting(text, known)
    fail = Failing(text, source)
    term = parsed(parser_of(text), text, fail, TERM)
    value = lower_term(cast(Term, term), fail, meet=_no_constants(fail, known))
    return value.poly, Fraction(1, value.den)


def read_graph(name: str, text: str) -> Formula:
    """Where a variable of this name has the value of the term that ``text`` is; names and errors as for ``read``."""
    fail = Failing(text, "<text>")
    equation = Comparison([Name(name, -1), read_term(text)], [Relation.EQ], -1)
    return lower(equation, fail, meet=_no_constants(fail, (name,)))


def read_term(text: str) -> Term:
    """The term that ``text`` is, as a surface tree. Names and errors as for ``read``."""
    return cast(Term, parsed(parser_of(text), text, Failing(text, "<text>"), TERM))


def read_node(text: str) -> Node:
    """The formula that ``text`` is, as a surface tree. Names and errors as for ``read``."""
    text = _written_out(_question(text).formula)
    return _node(text, Failing(text, "<text>"))


def outermost(text: str) -> tuple[bool, tuple[str, ...]] | None:
    """Whether the outermost quantifier of a text that can be read is universal, and its names; None without one."""
    node = read_node(text)
    return (node.universal, tuple(node.names)) if isinstance(node, Quantification) else None


def solved_for(text: str) -> tuple[str, ...] | None:
    """The variables of a command, x and y of ``Reduce[f, {x, y}, Reals]``, or of a question in words; None without."""
    question = _question(text)
    if not re.match(r"\s*[A-Z]\w+\[", question.formula):
        return question.names or None
    parser = parser_of(question.formula)(question.formula)
    with suppress(SyntaxFailure):
        parser.whole()
    return parser.asked or question.names or None


def optimum_asked(text: str) -> tuple[int, str, str, tuple[str, ...]] | None:
    """1 or -1, the objective, the constraints and the variables of ``Minimize[{f, c}, {x, y}]``, ``Maximize`` and
    ``minimize(f, x=0..1)``; for ``minimize f subject to c`` (0 without its first word) all are variables, and none are
    listed."""
    from qe.io.questions import optimum_in_words
    from qe.io.scripts import last_command

    call = _OPTIMUM.fullmatch(text := last_command(text))
    given = [part for part in split(call[4]) if part not in _POINT] if call else []
    if call is None or (call[3] and len(given) < 2):
        return (*words, ()) if (words := optimum_in_words(text)) else None
    objective, *others = [one for part in given for one in (split(part[1:-1]) if part[:1] in "[{" else (part,))]
    variables: list[str] = []
    constraints: list[str] = []
    for other in others:
        ranges = _RANGE.fullmatch(other)
        variables += [ranges[1]] if ranges else [other] if re.fullmatch(WORD, other) else []
        constraints += [f"{ranges[2]} <= {ranges[1]} <= {ranges[3]}"] if ranges else []
        constraints += [other] if not ranges and other not in variables else []
    sign = 1 if (call[1] or call[2] or call[3]).lower() == "min" else -1
    return sign, objective, f"{{{', '.join(constraints)}}}" if constraints else "true", (*dict.fromkeys(variables),)


def with_products(texts: Sequence[str], listed: Collection[str] = ()) -> tuple[list[str], list[str]]:
    """The texts of one problem with the signs of the products that the lexer reads in them as one text whose variables
    are the ``listed`` ones, notes on these; and listed names between backquotes."""
    texts = [_quoting(text, listed) for text in texts]
    whole = "\n;\n".join(texts)
    words = {*re.findall(WORD, whole)}
    joined: set[str] = set()
    if "(assert" not in whole and any(len(word) > 1 and word.isalpha() for word in words):
        joined = products(whole, {name for name in listed if len(name) == 1} - words)
    made = {word: "*".join(word) for word in joined}
    texts = [re.sub(rf"{QUOTED}|{WORD}", lambda word: made.get(word[0], word[0]), text) for text in texts]
    return texts, _noted(joined)


def _noted(joined: Collection[str]) -> list[str]:
    return [f"{word} is read as the product {'*'.join(word)}" for word in sorted(joined)]


def understood(text: str) -> tuple[str, tuple[str, ...]]:
    """A text, or what is read where it asks in words, with notes on this and on what is read as a product."""
    question = _question(text)
    meant, joined = question.formula, _noted(products(_written_out(question.formula)))
    meant = f"{meant}, assuming {question.assumed}" if question.assumed else meant
    return meant, (*([f"read as {meant}"] if meant != text else ()), *joined)


def _no_constants(fail: Failing, known: Container[str]) -> Meet:
    refused = {*CONSTANTS, "e"} if is_latex(fail.text) else CONSTANTS

    def meet(name: str, at: int) -> None:
        if name in refused and name not in known and not fail.text.startswith("`", at):
            hint = f"put a variable in its place, or write `{name}` for a variable of that name"
            raise fail(f"{name} is no number here, coefficients are rational; {hint}", at)

    return meet


def write(formula: Formula) -> str:
    """One line of text that ``read`` turns back into the same formula."""
    return str(formula)
