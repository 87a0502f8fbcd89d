"""Words with which people quantify: ``there are at least two positive x such that …``, ``for all real a, b``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from qe.io.surface import FUNCTIONS
from qe.spelling import KEYWORDS, QUOTED, WORD

LISTED = rf"(?:{WORD}|{QUOTED})"
COUNTS = {"one": "1", "two": "2", "three": "3", "four": "4", "five": "5", "six": "6"}
QUANTITY = (
    r"infinitely\s+many|all\s+but\s+finitely\s+many|almost\s+all|connected"
    rf"|(?:exactly|at\s+least|at\s+most)\s+(?:[0-9]+|{'|'.join(COUNTS)})"
)
THERE = r"[Tt]here\s+(?:is|are|exists?)"
THAT = r"(?:such\s+that\b|s\.\s?t\.|with\b)"
SIGNED = {
    "positive": ">",
    "negative": "<",
    "nonzero": "/=",
    "non-zero": "/=",
    "nonnegative": ">=",
    "non-negative": ">=",
}
_NUMBERS = rf"(?:({'|'.join(SIGNED)})\s+)?(?:reals?\s+)?(?:(?:numbers?|values?\s+of)\s+)?"
SORT = re.compile(rf"\s+(?:some\s+)?{_NUMBERS}(?={LISTED})(?!{THAT}|[.,:=<>])")
"""Words behind a quantifier that say what all variables are, and of what sign."""
BEHIND = re.compile(
    rf"\b[Ff]or\s+(?:all|every|any|some)\s+(?:\w+\s+)*?({LISTED}(?:\s*(?:,|and)\s*{LISTED})*)\s*((?:in\b|[∈<>≤≥≠])[^:]*)?$"
)
"""A quantifier behind all, its variables, and a condition on them."""
SPOKEN = re.compile(rf"\s*(?:{THERE}|[Ff]or)\s")
"""What is no variable, though a word stands behind it."""
NO_VARIABLES = {
    "exactly": "write exactly 1 x. f",
    **dict.fromkeys(
        (*SIGNED, "non", "distinct", "different", "numbers"),
        "a condition stands behind the variable, as in exists x > 0",
    ),
    **dict.fromkeys(("integer", "integers", "natural", "rational", "complex"), "all variables are real"),
    **dict.fromkeys(
        ("an", "the", "no", "at", "one", "two", "only", "some", "given", "many", "infinitely", "real", "number", "st"),
        "names of variables alone stand behind a quantifier, with commas between them: exists x, y: …",
    ),
}
"""Words in front of the variables of a quantifier that would otherwise be taken for a variable."""

LONGEST = 4000
"""Longer texts are none that somebody typed."""
_ORDINARY = frozenset(map(str.lower, (*KEYWORDS, *FUNCTIONS)))


class Question(NamedTuple):
    """What a text asks, as a formula, the variables that are sought, and what it assumes."""

    formula: str
    names: tuple[str, ...] = ()
    assumed: str = ""


def in_words(text: str) -> bool:
    """Whether a text has words that are no part of formulas: it may ask in words, or be a script."""
    words = re.findall("[^\\W\\d_]{3,}", text) if len(text) <= LONGEST else ()
    return ":=" in text or any(word.lower() not in _ORDINARY for word in words)


def split(text: str, signs: str = ",") -> Iterator[str]:
    """What stands between these signs outside of brackets."""
    depth, start = 0, 0
    for at, character in enumerate(text):
        depth += (character in "([{") - (character in ")]}")
        if character in signs and not depth:
            yield text[start:at].strip()
            start = at + 1
    yield text[start:].strip()


def quantity(value: str) -> str:
    """The letter of QEPCAD for words that say how many (L: at least, M: at most), with the number."""
    words = value.split()
    if words[-1] in COUNTS or words[-1].isdecimal():
        letter = {"least": "L", "most": "M"}.get(words[-2], "X")
        return f"{letter} {COUNTS.get(words[-1], words[-1])}"
    return {"many": "G" if "but" in words else "F", "all": "G", "connected": "C"}.get(words[-1], "X 1")
