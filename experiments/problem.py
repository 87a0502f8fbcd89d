"""One problem of a suite, and the folder that the packages lie in. Nothing is ever written there."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


@dataclass(frozen=True, slots=True)
class Problem:
    """A formula in the text syntax. ``set`` is the family it is reported with and ``id`` its name there.

    ``expected``: an equivalent quantifier-free formula, if one is known, under the condition ``assume``.
    ``size``: what grows along a scaling family (degree, number of balls, bits).
    """

    set: str
    id: str
    formula: str
    expected: str | None = None
    assume: str | None = None
    size: int | None = None
