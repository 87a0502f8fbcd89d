"""What an elimination method hands back to the pipeline."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from qe.formula.syntax import Formula

if TYPE_CHECKING:
    from qe.exact.algebraic import RealAlgebraic

Number = "Fraction | RealAlgebraic"
Assignment = Mapping[str, "Fraction | RealAlgebraic"]
Values = dict[str, "Fraction | RealAlgebraic"]


@dataclass(frozen=True, slots=True)
class Elimination:
    """``formula`` is equivalent to the input over R; it may still hold quantifiers a method could not remove.

    ``witness``: values for the outermost existential block when the result is TRUE, or a counterexample
    for the outermost universal block when it is FALSE; None when not known. ``evidence``: data for a
    certificate, method specific. ``stats``: what was done, for people.
    """

    formula: Formula
    witness: Assignment | None = None
    evidence: object | None = None
    stats: Mapping[str, object] = field(default_factory=dict)

    @property
    def parameter_order(self) -> tuple[str, ...] | None:
        """The order of the free variables in which critical values gave the answer, if they did."""
        entries = self.stats.get("critical")
        return tuple(entries[-1]["order"]) if isinstance(entries, list) else None
