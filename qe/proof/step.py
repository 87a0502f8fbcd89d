"""One step of a derivation: a formula replaced by an equivalent one, by the theorem of a rule."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from qe.formula.syntax import TRUE, Formula

Place = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """``before`` <-> ``after`` wherever ``context`` holds, by the theorem of the rule with this name.

    ``evidence``: what the rule found, as plain data. ``places``: where ``before`` stood (paths of argument numbers from
    the root); found when the derivation is put together, and empty until then.
    """

    rule: str
    before: Formula
    after: Formula
    context: Formula = TRUE
    evidence: Mapping[str, object] = field(default_factory=dict)
    places: tuple[Place, ...] = ()


@dataclass(frozen=True, slots=True)
class Nested:
    """A derivation inside the evidence of a step: how ``start`` became ``answer``."""

    start: Formula
    steps: tuple[Step, ...]
    answer: Formula
