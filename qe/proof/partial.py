"""What is known of an answer when a limit was reached."""

from __future__ import annotations

from dataclasses import dataclass, field

from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.proof.certificate import Certificate


@dataclass(frozen=True, slots=True)
class Partial:
    """Where the question is proved to be true and where to be false, as quantifier-free formulas in its free variables.

    ``proved_true`` implies the question, and ``proved_false`` its negation; they may have root atoms. ``open`` holds
    wherever neither does. ``certificate``: where a check was asked for, what proves both parts (of kind "parts");
    None where one of them has no proof. ``is_checked``: separate code has accepted it, or ``reason`` says why not.
    """

    proved_true: Formula = FALSE
    proved_false: Formula = FALSE
    open: Formula = TRUE
    certificate: Certificate | None = field(default=None, repr=False)
    is_checked: bool = False
    reason: str = ""

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
