"""The theorem of a rule, in full: what the docstring of its checker says.

The checkers stand above this row and are read as text here, so that a page is written without loading them.
"""

from __future__ import annotations

import functools
import inspect
import re
from importlib.resources import files

THEOREM = "THEOREM"


def theorem_of(rule: str) -> tuple[str, ...]:
    """The theorems that the checker of a rule rests on, a paragraph each; none where the rule has no checker."""
    for head, theorems in _checkers():
        if f'"{rule}"' in head:
            own = [text for text in theorems if _case(text) and _case(text) in rule]
            return tuple(own) or theorems
    return ()


@functools.cache
def _checkers() -> tuple[tuple[str, tuple[str, ...]], ...]:
    """For every checker the first paragraph of its docstring, which names its rules, and its theorems."""
    found = []
    checkers = (file for folder in ("kernel", "certify") for file in files("qe").joinpath(folder).iterdir())
    for file in sorted(checkers, key=lambda f: f.name):
        if file.name.endswith(".py"):
            head, *more = _docstring(file.read_text("utf-8")).split("\n\n")
            found.append((" ".join(head.split()), tuple(part for text in more for part in _theorems(text))))
    return tuple(found)


def _docstring(text: str) -> str:
    """What stands at the head of a file; reading all of it as Python would take longer than writing most pages."""
    found = re.match(r'"""(.*?)"""', text, re.DOTALL)
    return inspect.cleandoc(found[1]) if found else ""


def _theorems(paragraph: str) -> list[str]:
    """The theorems of a paragraph, each in one line of text."""
    parts = " ".join(paragraph.split()).split(THEOREM)
    return [THEOREM.capitalize() + part.rstrip() for part in parts[1:]] if not parts[0] else []


def _case(text: str) -> str:
    """The word in brackets after "Theorem", where several stand in one docstring."""
    rest = text.removeprefix(THEOREM.capitalize()).lstrip()
    return rest[1 : rest.index(")")] if rest.startswith("(") else ""
