"""Words with which people quantify: ``there are at least two positive x such that …``, ``for all real a, b``."""

from __future__ import annotations

import re

from qe.spelling import QUOTED, WORD

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
        (*SIGNED, "non"),
        "a condition stands behind the variable, as in exists x > 0",
    ),
    **dict.fromkeys(("integer", "integers", "natural", "rational", "complex"), "all variables are real"),
    **dict.fromkeys(
        ("an", "the", "no", "at", "one", "two", "only", "some", "given", "many", "infinitely", "real", "number", "st"),
        "names of variables alone stand behind a quantifier, with commas between them: exists x, y: …",
    ),
}
"""Words in front of the variables of a quantifier that would otherwise be taken for a variable."""


def quantity(value: str) -> str:
    """The letter of QEPCAD for words that say how many (L: at least, M: at most), with the number."""
    words = value.split()
    if words[-1] in COUNTS or words[-1].isdecimal():
        letter = {"least": "L", "most": "M"}.get(words[-2], "X")
        return f"{letter} {COUNTS.get(words[-1], words[-1])}"
    return {"many": "G" if "but" in words else "F", "all": "G", "connected": "C"}.get(words[-1], "X 1")
