"""The theorem of a rule, in full: what the docstring of its checker's module says, by paragraphs that begin so."""

from __future__ import annotations

import inspect
import sys

from qe.certify.registry import RULES
from qe.kernel.boolean import ByLemmas

THEOREM = "THEOREM"


def theorem_of(rule: str) -> tuple[str, ...]:
    """The theorems on which the checker of a rule rests, a paragraph each; none where the rule has no checker.

    Where a module checks several rules, a theorem whose word in brackets is part of the rule's name is that rule's own.
    """
    if rule not in RULES:
        return ()
    check = RULES[rule]
    function = check.obligations if isinstance(check, ByLemmas) else check
    text = inspect.cleandoc(sys.modules[function.__module__].__doc__ or "")
    theorems = tuple(t for paragraph in text.split("\n\n") for t in _theorems(paragraph))
    return tuple(t for t in theorems if _case(t) and _case(t) in rule) or theorems


def _theorems(paragraph: str) -> list[str]:
    """The theorems of a paragraph, each in one line of text."""
    parts = " ".join(paragraph.split()).split(THEOREM)
    return [THEOREM.capitalize() + part.rstrip() for part in parts[1:]] if not parts[0] else []


def _case(text: str) -> str:
    """The word in brackets after "Theorem", where several stand in one docstring."""
    rest = text.removeprefix(THEOREM.capitalize()).lstrip()
    return rest[1 : rest.index(")")] if rest.startswith("(") else ""
