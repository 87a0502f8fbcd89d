"""How the name of a variable is written in text: as it stands where it is a plain word, else between bars."""

from __future__ import annotations

import re

WORD = r"[^\W\d⁰¹²³⁴-⁹][^\W⁰¹²³⁴-⁹]*'*"
"""A plain word: letters, digits and ``_``, not a digit first, perhaps with primes."""

KEYWORDS = frozenset(("ex", "exists", "Ex", "all", "forall", "All", "and", "or", "not", "true", "false"))
"""Words that mean something else in the text syntax."""

_PLAIN = re.compile(WORD)


def quoted_if_needed(name: str) -> str:
    """The name as the text syntax reads it."""
    return name if _PLAIN.fullmatch(name) and name not in KEYWORDS else f"|{name}|"
