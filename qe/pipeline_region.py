"""What a region that is described only when asked still needs: eliminations and budgets, as a value to be pickled."""

from __future__ import annotations

from dataclasses import dataclass

from qe import pipeline
from qe.formula.syntax import Formula
from qe.options import Budget, Options
from qe.progress import Listener, silent


@dataclass(frozen=True, slots=True)
class RegionWork:
    """The variable order, the seconds for every single question, and who hears of the progress (not pickled)."""

    order: tuple[str, ...] | None
    timeout: float | None
    progress: Listener = silent

    def limits(self) -> Budget:
        """The budget of one question."""
        return Budget(self.timeout, listener=self.progress)

    def eliminated(self, formula: Formula) -> Formula:
        """An equivalent quantifier-free formula."""
        return pipeline.solve(formula, Options(order=self.order), self.limits()).formula

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return RegionWork, (self.order, self.timeout)
