"""The text syntax: ``ex x, y. all z. x^2 + 2*x*y >= 0 and not z = 0 or p -> q``.

Operators from tight to loose: ``not`` (``~``), ``and`` (``/\\``), ``or`` (``\\/``), ``->`` (``==>``, to the right),
``<->`` (``<==>``). A quantifier is ``ex`` or ``all`` (also ``exists forall Ex All E A``); its body runs to the end of
its brackets. Relations ``= /= < <= > >=`` may be chained. Numbers are exact: ``3/4``, ``0.75``,
``1.5e-3``. ``x < root(2, x^2 - y)`` compares with the second smallest real root in x. A name is a word, possibly
with primes, or anything between backquotes: `` `my name` ``. ``#`` starts a comment.
"""

from __future__ import annotations

from collections.abc import Callable, Container
from fractions import Fraction
from typing import cast

from qe.exact.ring import Poly
from qe.formula.syntax import Formula, RootAtom
from qe.formula.traverse import free_variables, ring_of
from qe.io.grammar import Failing, parse
from qe.io.infix import Notation, formula_text, polynomial, positive
from qe.io.surface import Meet, Quantification, Term, lower, lower_term
from qe.io.text_parser import text_parser
from qe.spelling import CONSTANTS as CONSTANTS
from qe.spelling import between_quotes, quoted_if_needed


def read(text: str, *, source: str = "<text>", known: Container[str] = ()) -> Formula:
    """The formula that ``text`` means. ``source`` names the text in messages.

    ``pi``, ``e`` and ``i`` are no numbers here: as free variables they are refused unless they stand between backquotes
    or are ``known`` to be variables (for texts that programs wrote). Raises ``ParseError``, one line with line, column
    and what was expected.
    """
    fail = Failing(text, source)
    return lower(parse(text_parser(), text, fail), fail, meet=_no_constants(fail, known))


def read_polynomial(text: str, *, source: str = "<text>", known: Container[str] = ()) -> tuple[Poly, Fraction]:
    """A polynomial p and a rational s: ``text`` means s*p. Names and errors as for ``read``."""
    fail = Failing(text, source)
    term = parse(text_parser("sum"), text, fail)
    value = lower_term(cast(Term, term), fail, meet=_no_constants(fail, known))
    return value.poly, Fraction(1, value.den)


def outermost(text: str) -> tuple[bool, tuple[str, ...]] | None:
    """Whether the outermost quantifier of a text that can be read is universal, and its names; None without one."""
    node = parse(text_parser(), text, Failing(text, "<text>"))
    return (node.universal, tuple(node.names)) if isinstance(node, Quantification) else None


def _no_constants(fail: Failing, known: Container[str]) -> Meet:
    def meet(name: str, at: int) -> None:
        if name in CONSTANTS and name not in known and not fail.text.startswith("`", at):
            hint = f"put a rational number in its place, or write `{name}` for a variable of that name"
            raise fail(f"{name} is no number here, coefficients are rational; {hint}", at)

    return meet


def write(formula: Formula) -> str:
    """One line of text that ``read`` turns back into the same formula."""
    ring = ring_of(formula)
    doubtful = CONSTANTS.intersection(ring.names if ring is not None else ())
    free = doubtful.intersection(free_variables(formula)) if doubtful else doubtful

    def spelled(name: str) -> str:
        return between_quotes(name) if name in free else quoted_if_needed(name)

    return formula_text(formula, _notation(spelled) if free else _NOTATION)


def _notation(spelled: Callable[[str], str]) -> Notation:
    def quantifier(universal: bool, names: tuple[str, ...]) -> str:
        return f"{'all' if universal else 'ex'} {', '.join(map(spelled, names))}. "

    def root(atom: RootAtom) -> str:
        poly = polynomial(positive(atom.poly), notation)
        return f"{spelled(atom.variable)} {atom.relation.value} root({atom.k}, {poly})"

    notation = Notation(
        name=spelled,
        relation=lambda relation: relation.value,
        quantifier=quantifier,
        root=root,
        conjunction=" and ",
        disjunction=" or ",
        negation="not ",
        true="true",
        false="false",
    )
    return notation


_NOTATION = _notation(quoted_if_needed)
