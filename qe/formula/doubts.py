"""What somebody may have meant otherwise who wrote a formula that can be read: notes, for people alone."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Sequence

from qe.formula.syntax import Formula, Quantified
from qe.formula.traverse import subformulas
from qe.spelling import WORD, is_product

_NUMBERS = ("e", "i", "E", "I")
"""Letters that are numbers to many readers, and variables here."""
_WORD = re.compile(WORD)
_RELATED = re.compile(r"[<>=≠≤≥⩽⩾∈∉\[{]|\b(?:not|in|true|false|Eq|Ne|Lt|Le|Gt|Ge)\b", re.IGNORECASE)
_WRITTEN_OUT = ("text", "latex", "smtlib", "redlog")
"""Formats in which a variable stands at its quantifier and where it is used, and nowhere else."""


def doubts(formula: Formula, text: str = "", format: str = "", solved: Sequence[str] = ()) -> tuple[str, ...]:
    """The notes on a formula, each a line; ``text`` and its ``format`` where it was read from one.

    ``solved``: the variables for which it is to be solved, which are to occur like those of a quantifier."""
    typed = text if format == "text" and "\\" not in text else ""  # in LaTeX letters side by side are a product
    names = formula.ring.names if formula.ring is not None else ()
    parts = subformulas(formula) if formula.bound else ()
    blocks = [(part.variables, part.body.free) for part in parts if isinstance(part, Quantified)]
    unused: dict[str, None] = {}
    joined: dict[str, str] = {}
    for variables, free in (*blocks, (solved, formula.free)):
        occurring = {*free}
        unused |= dict.fromkeys(name for name in variables if name not in occurring)
        joined |= {**joined_names(free, variables), **_made_of(free)} if typed else {}
    if typed and "*" not in typed:  # x^2 + px + q = 0, b^2 = 4ac
        joined |= joined_names(formula.free, [name for name in formula.free if len(name) == 1])
    behind_numbers = re.findall(r"(?<![\w.])[0-9]+([^\W\d_]{2,3})\b", typed)
    joined |= {name: "*".join(name) for name in behind_numbers if name in formula.free and name.isalpha()}
    if unused and format in _WRITTEN_OUT:  # what is used as well cancels
        bound = Counter(name for variables, _ in blocks for name in variables)
        written = Counter(_WORD.findall(text))
        unused = {name: None for name in unused if written[name] <= bound[name]}
    notes = []
    for variable in unused:
        meant = next((product for name, product in joined.items() if variable in name), None)
        notes.append(f"{variable} does not occur" + (f"; did you mean {meant}?" if meant else ""))
    for name, product in joined.items():
        if unused.keys().isdisjoint(name) and f"`{name}`" not in text:
            notes.append(f"{name} is one name; a product is written {product}")
    read = [name for name in names if len(name) == 1 and re.search(rf"(?<![\w`∃∀]){name}\(", typed)]
    notes += [f"{name}(…) is the product {name}*(…)" for name in read]
    if typed and not _RELATED.search(typed):
        notes.append("a term alone is taken as an equation with 0")
    return (*notes, *numbers_as_names(formula.free, typed, names))


def joined_names(names: Iterable[str], letters: Collection[str]) -> dict[str, str]:
    """The names that look like products of different letters, one of ``letters`` among them, of which all but perhaps
    one are names or ``letters`` themselves. Each with the product that may be meant: ``ax`` beside x with ``a*x``."""
    known = {*names, *letters}
    return {
        name: "*".join(name)
        for name in names
        if len({*name} & known) >= len(name) - 1 > 0 and name.isalpha()
        if name not in letters and not {*name}.isdisjoint(letters)
    }


def _made_of(names: Collection[str]) -> dict[str, str]:
    """The names that are made of others of them alone, as ``ab`` beside a and b, each with the product of these."""
    return {name: "*".join(name) for name in names if is_product(name, names)}


def products_as_names(names: Collection[str], noted: Collection[str]) -> tuple[str, ...]:
    """A note for every name that is made of others, but not of those ``noted`` alone."""
    made = {name: product for name, product in _made_of(names).items() if name not in _made_of(noted)}
    return tuple(f"{name} is one name; a product is written {product}" for name, product in made.items())


def numbers_as_names(free: Iterable[str], text: str, names: Iterable[str] = ()) -> tuple[str, ...]:
    """A note where ``e`` or ``i`` is free in a text and none of its neighbours in the alphabet is one of the names."""
    alphabet = {*free, *names}
    doubtful = [
        name
        for name in _NUMBERS
        if name in free and re.search(rf"(?<![^\W\d])(?<!`){name}(?!\w)", text) and "\\" not in text
        if not alphabet & {chr(ord(name) - 1), chr(ord(name) + 1)}
    ]
    verb = "is a variable here, no number" if len(doubtful) == 1 else "are variables here, no numbers"
    return (f"{' and '.join(doubtful)} {verb}",) if doubtful else ()
