"""Tokens, and how a format finds them with one compiled pattern."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from qe.io.text_errors import unknown_character

END = "$END"
"""The kind of the token behind a text."""


def kinds(table: str) -> dict[str, str]:
    """Kinds by spelling, from lines of a kind and its spellings."""
    return {spelling: kind for line in table.splitlines() if line for kind, *row in [line.split()] for spelling in row}


SIGNS = kinds("PLUS +\nMINUS -\nTIMES *\nOVER /\nPOWER ^\nOPEN (\nCLOSE )\nCOMMA ,")
"""The kinds of the signs that terms have in every format."""


class Token(NamedTuple):
    """A token: what it is, its text, and the offset where it starts."""

    kind: str
    text: str
    at: int


def matches(pattern: re.Pattern[str], text: str, at: int = 0) -> Iterator[tuple[str, str, int]]:
    """Names of the groups of ``pattern`` that match one behind another, with text and offset, but for ``SPACE``.

    Raises ``SyntaxFailure`` where nothing matches.
    """
    while at < len(text):
        match = pattern.match(text, at)
        if match is None:
            raise unknown_character(text, at)
        if match.lastgroup != "SPACE":
            yield str(match.lastgroup), match.group(), at
        at = match.end()
