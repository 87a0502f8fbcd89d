"""Kinds of certificates that other packages bring: what they claim is about their objects, not about formulas.

A package names each of them as an entry point of the group ``bezier_qe.kinds``: the kind's name, and the
``BroughtKind`` in its code.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import entry_points

from qe.options import Budget
from qe.proof.entry import Entry, Json

Checker = Callable[[dict[str, Json], Budget], None]
GROUP = "bezier_qe.kinds"


@dataclass(frozen=True, slots=True)
class BroughtKind:
    """``check`` accepts a payload silently or raises ``CertificateRejected`` naming the entry that fails; ``words``:
    what such a certificate claims, read off the entries that are checked."""

    check: Checker
    words: Callable[[Entry], str]


def brought_kind(name: str) -> BroughtKind | None:
    """The kind that an installed package brings under this name."""
    for point in entry_points(group=GROUP, name=name):
        kind = point.load()
        if isinstance(kind, BroughtKind):
            return kind
    return None
