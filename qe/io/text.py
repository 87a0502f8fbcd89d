"""The text syntax: ``ex x, y. all z. x^2 + 2*x*y >= 0 and not z = 0 or p -> q``.

Operators from tight to loose: ``not`` (``~``), ``and`` (``/\\``), ``or`` (``\\/``), ``->`` (``==>``, to the right),
``<->`` (``<==>``). A quantifier is ``ex`` or ``all`` (also ``exists forall Ex All E A``); its body runs to the end of
its brackets. Relations ``= /= < <= > >=`` may be chained. Numbers are exact: ``3/4``, ``0.75``,
``1.5e-3``. ``x < root(2, x^2 - y)`` compares with the second smallest real root in x. A name is a word, possibly
with primes, or anything between bars: ``|my name|``. ``#`` starts a comment.
"""

from __future__ import annotations

import re

from qe.formula.syntax import Formula, RootAtom
from qe.io.grammar import Failing, parse
from qe.io.infix import Notation, formula_text, polynomial, positive
from qe.io.surface import lower
from qe.io.text_parser import KEYWORDS, WORD, text_parser

_PLAIN = re.compile(WORD)


def read(text: str, *, source: str = "<text>") -> Formula:
    """The formula that ``text`` means. ``source`` names the text in messages.

    Raises ``ParseError`` (one line with line, column and what was expected).
    """
    fail = Failing(text, source)
    return lower(parse(text_parser(), text, fail), fail)


def write(formula: Formula) -> str:
    """One line of text that ``read`` turns back into the same formula."""
    return formula_text(formula, _NOTATION)


def quoted(name: str) -> str:
    """The name as ``read`` understands it, between bars if it is not a plain word."""
    return name if _PLAIN.fullmatch(name) and name not in KEYWORDS else f"|{name}|"


def _quantifier(universal: bool, names: tuple[str, ...]) -> str:
    return f"{'all' if universal else 'ex'} {', '.join(map(quoted, names))}. "


def _root(atom: RootAtom) -> str:
    poly = polynomial(positive(atom.poly), _NOTATION)
    return f"{quoted(atom.variable)} {atom.relation.value} root({atom.k}, {poly})"


_NOTATION = Notation(
    name=quoted,
    relation=lambda relation: relation.value,
    quantifier=_quantifier,
    root=_root,
    conjunction=" and ",
    disjunction=" or ",
    negation="not ",
    true="true",
    false="false",
)
