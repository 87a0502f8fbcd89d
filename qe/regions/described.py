"""What pictures and measures ask of a region; ``qe.regions.region.Region`` has it, and knows them in turn."""

from __future__ import annotations

from typing import Protocol

from qe.decomposition.interval import Interval
from qe.decomposition.pieces import Piece
from qe.formula.syntax import Formula


class Described(Protocol):
    """A set of real points as cylindrical pieces."""

    @property
    def order(self) -> tuple[str, ...]:
        """The variables, each bounded by functions of those before it."""

    @property
    def is_empty(self) -> bool: ...

    @property
    def cells(self) -> list[Piece]:
        """Disjoint pieces."""

    def bounds(self, variable: str) -> Interval:
        """The exact infimum and supremum of a variable."""

    def within(self, condition: Formula) -> Described:
        """The part where a quantifier-free condition holds, in the same order."""
