"""The text syntax: ``ex x, y. all z. x^2 + 2*x*y >= 0 and not z = 0 or p -> q``.

Operators from tight to loose: ``not`` (``~``), ``and`` (``/\\``), ``or`` (``\\/``), ``->`` (``==>``, to the right),
``<->`` (``<==>``). A quantifier is ``ex`` or ``all`` (also ``exists forall Ex All E A``); its body runs to the end of
its brackets. Relations ``= /= < <= > >=`` may be chained. Numbers are exact: ``3/4``, ``0.75``,
``1.5e-3``. ``x < root(2, x^2 - y)`` compares with the second smallest real root in x. A name is a word, possibly
with primes, or anything between bars: ``|my name|``. ``#`` starts a comment.
"""

from __future__ import annotations

from qe.formula.syntax import Formula
from qe.formula.text import TEXT
from qe.io.grammar import Failing, parse
from qe.io.surface import lower
from qe.io.text_parser import text_parser


def read(text: str, *, source: str = "<text>") -> Formula:
    """The formula that ``text`` means. ``source`` names the text in messages.

    Raises ``ParseError`` (one line with line, column and what was expected).
    """
    fail = Failing(text, source)
    return lower(parse(text_parser(), text, fail), fail)


def write(formula: Formula) -> str:
    """One line of text that ``read`` turns back into the same formula."""
    return formula.written(TEXT)
