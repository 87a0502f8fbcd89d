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
BEHIND = re.compile(rf"\b[Ff]or\s+(?:all|every|any|some)\s+(?:\w+\s+)*?({LISTED}(?:\s*(?:,|and)\s*{LISTED})*)\s*$")
"""A quantifier behind all, and its variables."""
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


_ASKED = re.compile(
    r"(?:(?:prove|show|verify|check|decide|determine)\s+(?:that|whether|if)|is\s+it\s+true\s+that"
    r"|(?:prove|show|solve)(?::|(?=\s+[\w(|`√]))(?!\s+(?:in|and|or)\b)"
    r"|(?:for\s+(?:which|what)|(?:find|determine)(?:\s+(?:all|every|the|some))?)\s+(?:real\s+)?(?:values?\s+(?:of\s+)?)?"
    rf"(?!values?\b)({LISTED}(?:\s*(?:,|and)\s*{LISTED})*)\s*(?:such\s+that|for\s+which|does|do|is|are))\s+",
    re.IGNORECASE,
)
"""Words in front of what is to be shown or solved, or of a condition on the variables that are asked for."""
_COUNTED = re.compile(
    rf"(?:the\s+(?:equation|polynomial)\s+)?(.+?)\s+ha(?:s|ve)\s+(an?|no|{QUANTITY}|{'|'.join(COUNTS)}|[2-6])"
    rf"(?:\s+(?:distinct|different))?(?:\s+real)?\s+(?:roots?|solutions?|zeros?)(?:\s+(?:in|for)\s+({LISTED}))?",
    re.DOTALL,
)


def plainly(text: str) -> tuple[str, tuple[str, ...]]:
    """A question in words as a formula, and the variables that it asks for: ``for which m does x^2 = m have two
    solutions?`` is ``exactly two x. x^2 = m``. Roots are counted as different values of x, or of the only variable that
    is not asked for; other texts, also where that is not clear, stay as they are."""
    short = text.strip() if len(text) < 1000 else ""
    begins = _ASKED.match(short)
    rest, listed = (short[begins.end() :], begins[1] or "") if begins else (short, "")
    named = tuple(re.findall(rf"(?!and\b){LISTED}", listed))
    counted = _COUNTED.fullmatch(rest.rstrip(" ?."))
    if counted is None:
        return (re.sub(r"\s*(?:\bholds?)?[\s?.]*$", "", rest), named) if begins else (text, ())
    others = {*re.findall(LISTED, counted[1])}.difference(named)
    name = counted[3] or ("x" if "x" in others else others.pop() if len(others) == 1 else "")
    if not name or re.search(r"[<>≤≥≠∃∀]|\b(?:and|or|ex|all|for|if)\b", counted[1]):
        return text, ()
    many = counted[2]
    kind = {"a": "ex", "an": "ex", "no": "not ex"}.get(many) or ("" if " " in many else "exactly ") + many
    return f"{kind} {name}. {counted[1]}{'' if '=' in counted[1] else ' = 0'}", named
