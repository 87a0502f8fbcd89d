"""What the public functions are given, as formulas and polynomials: text, ``Formula``, ``Poly``, SymPy, answers."""

from __future__ import annotations

import re
import sys
import warnings
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

from qe import arguments
from qe.errors import DoubtfulInput, InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj
from qe.formula.syntax import TRUE, Constant, Exists, ForAll, Formula
from qe.formula.traverse import has_root_atoms
from qe.io import formats
from qe.io.names import names_in
from qe.io.substitution import over_one_ring
from qe.proof.answer import Answer
from qe.spelling import KEYWORDS, QUOTED, WORD, WORDS_FOR_PI, unquoted

if TYPE_CHECKING:
    from qe.optimization.values import Objective

AnyFormula = Any
"""A ``Formula``, text, bytes, a file (``Path``), an object of SymPy, z3 or pySMT, or a list, which holds together."""


Read = tuple[Formula, Formula]
"""A formula, and what it is asked under: TRUE, or what a session, a theory or SymPy's symbols assume."""


def read_formula(given: AnyFormula, format: str = "text", total_division: bool = False) -> Formula:
    """The formula given in any of the accepted shapes, with what it assumes; ``InputError`` otherwise.

    ``total_division``: what text says of a division by zero (see ``qe.io.text.read``); other shapes know it already.
    """
    return conj(over_one_ring(*reversed(read_posed(given, format, total_division))))


def read_posed(given: AnyFormula, format: str = "text", total_division: bool = False) -> Read:
    """As ``read_formula``, with what is assumed by itself."""
    chosen = formats.checked(format)
    if isinstance(given, Formula):
        return given, TRUE
    if isinstance(given, Answer):
        if given.formula is None:
            raise InputError("an answer without a formula was given")
        return given.formula, given.assuming
    if isinstance(given, bytes | bytearray | Path):
        text, ending = arguments.content(given, "formula")
        kind = formats.BY_ENDING.get(ending, chosen) if chosen is formats.Format.TEXT else chosen
        source = str(given) if isinstance(given, Path) else "<bytes>"
        return formats.read_posed(text, kind, source=source, total_division=total_division)
    if isinstance(given, str):
        return formats.read_posed(given, chosen, total_division=total_division)
    if isinstance(given, list | tuple):  # conditions that hold together
        if not given:
            raise InputError("formula: at least one condition expected, an empty list found")
        parts, known = zip(*(read_posed(part, format, total_division) for part in given), strict=True)
        return conj(over_one_ring(*parts)), conj(over_one_ring(*known))
    if isinstance(held := getattr(given, "formula", None), Formula):  # of a statement, or a region
        return held, TRUE
    from qe.io.smtlib import from_solver

    if (formula := from_solver(given)) is not None:
        return formula, TRUE
    from qe.io.sympy import posed_from_sympy

    return posed_from_sympy(given)


def read_assumptions(given: AnyFormula) -> Formula:
    """What is to be taken for granted, without quantifiers and roots; text is read as ``qe.io.text`` does."""
    try:
        known = TRUE if given is None or (isinstance(given, list | tuple) and not given) else read_formula(given)
    except InputError as error:
        raise InputError(f"assuming: {error}") from None
    if not known.is_quantifier_free or has_root_atoms(known):
        raise InputError("assuming: comparisons of polynomials without quantifiers expected")
    return known


def note_doubts(given: AnyFormula, formula: Formula, format: str = "text", solved: Sequence[str] = ()) -> None:
    """Warn (``DoubtfulInput``) of what may have been meant otherwise in what was given and is read as this formula,
    which is to be ``solved`` for some variables; a ``Formula`` or an answer was made or read before."""
    from qe.formula.doubts import doubts

    if isinstance(given, Formula | Answer):
        return
    text = "\n".join(part for part in (given if isinstance(given, list | tuple) else [given]) if isinstance(part, str))
    kind = formats.kind(text, formats.checked(format)).value if text else ""
    words = {*re.findall(WORD, text)}.difference(KEYWORDS, names_in(formula)) if kind == "text" else ()
    notes: tuple[str, ...] = ()
    if any(len(word) > 1 for word in words):
        from qe.io.text import understood

        text, notes = understood(text)
    warned((*notes, *doubts(formula, text, kind, solved)))


def warned(notes: Iterable[str]) -> None:
    """Warn of these notes, at the line outside this package that called it."""
    if message := "; ".join(notes):
        frame, level = sys._getframe(), 1
        while frame.f_back is not None and str(frame.f_globals.get("__name__")).partition(".")[0] == "qe":
            frame, level = frame.f_back, level + 1
        warnings.warn(message, DoubtfulInput, stacklevel=level)


def read_block(given: AnyFormula, format: str = "text", total_division: bool = False) -> Read:
    """As ``read_posed``; the formula has its outermost quantifier, which text and ``qe.Exists``/``qe.ForAll`` tell,
    also where reading would drop it because its body is true or false."""
    formula, known = read_posed(given, format, total_division)
    if not isinstance(formula, Constant):
        return formula, known
    block = getattr(given, "block", None)
    if isinstance(given, str) and formats.checked(format) is formats.Format.TEXT:
        from qe.io.text import outermost

        block = outermost(given)
    if block is None:
        return formula, known
    universal, names = block
    return (ForAll if universal else Exists)(names, formula), known


def names_typed(given: AnyFormula) -> set[str]:
    """The names in what a caller gave, also those that reading simplifies away: ``0 < 0 and (ex x. x > a)`` has two."""
    if isinstance(given, str):
        words = set(re.findall(WORD, given)).difference(KEYWORDS, WORDS_FOR_PI)
        return words | {unquoted(name) for name in re.findall(QUOTED, given)}
    if isinstance(given, Formula):
        return set(names_in(given))
    if isinstance(given, Mapping):
        given = list(given.values())
    if isinstance(given, list | tuple):
        return {name for part in given for name in names_typed(part)}
    if isinstance(given, Poly):
        return set(given.ring.names)
    symbols = given.atoms() if hasattr(given, "free_symbols") else ()
    return {symbol.name for symbol in symbols if getattr(symbol, "is_Symbol", False)}


def order_of(order: Any, given: AnyFormula, formula: Formula) -> tuple[str, ...] | None:
    """Those names of an order that a formula has, which was read from what was given, or made of it. Raises
    ``InputError`` for names of neither."""
    names, known = arguments.names(order), set(names_in(formula))
    if names is None:
        return None
    if not (known | names_typed(given)).issuperset(names):
        raise InputError(f"order: variables of the formula expected, each once, {', '.join(names)} found")
    return tuple(name for name in names if name in known)


def read_posed_constraints(given: AnyFormula, objective: AnyFormula) -> Read:
    """One formula, or the conjunction of a list of formulas, and what is assumed, of symbols of the objective, too."""
    formula, known = (TRUE, TRUE) if isinstance(given, list | tuple) and not given else read_posed(given)
    if not hasattr(objective, "free_symbols"):
        return formula, known
    from qe.io.sympy import assumed_of

    return formula, conj(over_one_ring(known, *assumed_of(objective)))


def of_one_problem(*given: AnyFormula, listed: Collection[str] = ()) -> list[AnyFormula]:
    """What was given for one problem, alone or in lists, as ``qe.io.text.with_products`` has texts that are read by
    themselves, with a note on each product; ``listed``: variables that the caller names."""
    texts = [*_texts(given)]
    if len(texts) < 2 and not listed:
        return [*given]
    from qe.io.text import with_products

    texts, products = with_products(texts, listed)
    warned(products)
    written = iter(texts)

    def put(part: AnyFormula) -> AnyFormula:
        if isinstance(part, list | tuple):
            return [put(one) for one in part]
        return next(written) if isinstance(part, str) else part

    return [put(one) for one in given]


def _texts(given: AnyFormula) -> Iterator[str]:
    """The texts among what was given, in lists, too."""
    if isinstance(given, str):
        yield given
    for part in given if isinstance(given, list | tuple) else ():
        yield from _texts(part)


def read_polynomial(given: AnyFormula, what: str, *, known: Container[str] = ()) -> tuple[Poly, Fraction]:
    """The given term as a polynomial p and a rational s: it is s*p (or they are given, as a pair). ``known``: names
    that are variables whatever else they may mean (``pi``). Raises ``InputError`` for what is no polynomial over Q."""
    if isinstance(given, Poly):
        return given, Fraction(1)
    if isinstance(given, tuple) and len(given) == 2 and isinstance(given[0], Poly) and isinstance(given[1], Fraction):
        return given
    if isinstance(given, bool):
        raise arguments.wrong(what, "a polynomial", given)
    if isinstance(given, Real | Decimal):
        number = arguments.rational(given, what)
        return Ring.of(()).constant(number.numerator), Fraction(1, number.denominator)
    try:
        if isinstance(given, str):
            from qe.io.text import read_polynomial as read

            return read(given, known=known)
        from qe.io.expressions import Expression

        if not isinstance(given, Expression):
            from qe.io.sympy import term_from_sympy

            given = Expression(term_from_sympy(given))
        value = given.polynomial()
        return value.poly, Fraction(1, value.den)
    except InputError as error:
        raise InputError(f"{what}: a polynomial expected: {error}") from None


def read_objective(given: AnyFormula, taken: Iterable[str]) -> Objective:
    """A term to be optimised, polynomial or not (quotients, roots, ``abs``, ``min``, ``max``, ``pi``); ``taken``: the
    names of the rest of the problem. Raises ``InputError`` for what is no term."""
    from qe.optimization.values import Objective, new_name

    is_term = isinstance(given, str) or any(hasattr(given, mark) for mark in ("free_symbols", "term", "sexpr"))
    try:
        poly, scale = read_polynomial(given, "objective")
        return Objective.of(poly, scale, new_name(poly.ring.names, taken))
    except InputError:
        if not is_term:
            raise
    value = new_name(taken)
    while value in str(given):
        value += "_"
    try:
        if isinstance(given, str):
            from qe.io.text import read_graph

            graph = read_graph(value, given)
        else:
            from qe.io.expressions import graph_of

            graph = graph_of(value, given)
    except InputError as error:
        raise InputError(f"objective: a term expected: {error}") from None
    return Objective(graph, value, tuple(name for name in graph.free if name != value))
