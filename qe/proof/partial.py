"""What is known of an answer when a limit was reached."""

from __future__ import annotations

from dataclasses import dataclass

from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, TRUE, Formula


@dataclass(frozen=True, slots=True)
class Partial:
    """Where the question is proved to be true and where to be false, as quantifier-free formulas in its free variables.

    ``proved_true`` implies the question, and ``proved_false`` its negation; they may have root atoms. ``open`` holds
    wherever neither does. By the theorems of the algorithms alone (``Guarantee.DERIVED``): no certificate goes with
    the parts.
    """

    proved_true: Formula = FALSE
    proved_false: Formula = FALSE
    open: Formula = TRUE

    @property
    def negated(self) -> Partial:
        """The same about the negation of the question."""
        return Partial(self.proved_false, self.proved_true)

    @staticmethod
    def of_disjunction(parts: list[Partial]) -> Partial:
        """The same about the disjunction of questions: one is true; all are false."""
        return Partial(disj(p.proved_true for p in parts), conj(p.proved_false for p in parts))

    def __str__(self) -> str:
        return f"true: {self.proved_true}\nfalse: {self.proved_false}\nopen: {self.open}"
