"""Altering JSON certificates one entry at a time."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from qe.proof.certificate import digest

Path = tuple[str | int, ...]

EVIDENCE, PLACE = ("payload", "steps", 0, "evidence"), "payload.steps[0].evidence"
"""Where the evidence of a derivation by one step is, as a path and as a verdict names it."""


def evidence_in(whole: Any) -> Any:
    """The evidence of a derivation by one step."""
    return whole["payload"]["steps"][0]["evidence"]


def at(node: Any, path: Sequence[str | int]) -> Any:
    """What stands at a path."""
    for key in path:
        node = node[key]
    return node


def leaves(node: Any, path: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Every string, number, truth value or null with its path."""
    if isinstance(node, dict | list):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield from leaves(value, (*path, key))
    else:
        yield path, node


def paths(node: Any, path: Path = ()) -> Iterator[Path]:
    """The path of everything below a node."""
    if isinstance(node, dict | list):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield (*path, key)
            yield from paths(value, (*path, key))


def lists(node: Any, path: Path = ()) -> Iterator[tuple[Path, list[Any]]]:
    """Every nonempty list with its path."""
    if isinstance(node, list) and node:
        yield path, node
    if isinstance(node, dict | list):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield from lists(value, (*path, key))


def replaced(whole: Any, path: Path, value: Any, *, signed: bool = True) -> str:
    """The certificate's text with another value at ``path``; ``signed``: with the digest of the new content."""
    altered = copy.deepcopy(whole)
    at(altered, path[:-1])[path[-1]] = value
    return _text(altered, signed)


def without(whole: Any, path: Path, index: int, *, signed: bool = True) -> str:
    """The certificate's text without one element of the list at ``path``."""
    altered = copy.deepcopy(whole)
    del at(altered, path)[index]
    return _text(altered, signed)


def _text(whole: Any, signed: bool) -> str:
    if signed:
        whole["digest"] = digest(whole)
    return json.dumps(whole)


def other_signs(text: str) -> Iterator[str]:
    """The string of signs with one character changed, added or left out."""
    for i, c in enumerate(text):
        yield from (text[:i] + d + text[i + 1 :] for d in "+-0" if d != c)
    yield text + "+"
    if text:
        yield text[:-1]


def other_numbers(text: str) -> Iterator[str]:
    """Rational numbers far below and far above, and the negative."""
    number = Fraction(text)
    yield from (str(n) for n in {number - 1000, number + 1000, -number} if n != number)
