"""Tokens, and how a format finds them with one compiled pattern."""

from __future__ import annotations

import gc
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from qe.io.text_errors import unknown_character

END = "$END"
"""The kind of the token behind a text."""


def kinds(table: str) -> dict[str, str]:
    """Kinds by spelling, from lines of a kind and its spellings."""
    return {spelling: kind for line in table.splitlines() if line for kind, *row in [line.split()] for spelling in row}


SIGNS = kinds("PLUS +\nMINUS -\nTIMES *\nOVER /\nPOWER ^\nOPEN (\nCLOSE )\nCOMMA ,")
"""The kinds of the signs that terms have in every format."""


REDLOG = r"rl(?:qe|cad|gqe|hqe|qea|simpl|decide)"
"""The calls of Redlog that a question may stand in."""

LONG = 100_000
"""Characters of a text from which on the collector waits until it is read."""


class Token(NamedTuple):
    """A token: what it is, its text, and the offset where it starts."""

    kind: str
    text: str
    at: int


def matches(pattern: re.Pattern[str], text: str, at: int = 0) -> Iterator[tuple[str, str, int]]:
    """Names of the groups of ``pattern`` that match one behind another, with text and offset, but for ``SPACE``."""
    while at < len(text):
        match = pattern.match(text, at)
        if match is None:
            raise unknown_character(text, at)
        if match.lastgroup != "SPACE":
            yield str(match.lastgroup), match.group(), at
        at = match.end()


@contextmanager
def without_collections(text: str) -> Iterator[None]:
    """While a large tree grows, looking for circles in it takes most of the time, and there are none.

    What is left of a long text is old at once: whatever is frozen and not frozen any more is in the oldest generation.
    """
    waits = len(text) >= LONG and gc.isenabled()
    if waits:
        gc.disable()
    try:
        yield
    finally:
        if waits:
            if not gc.get_freeze_count():  # else somebody wants it so
                gc.freeze()
                gc.unfreeze()
            gc.enable()
