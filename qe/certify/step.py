"""What a rule's checker is given: one step of a derivation, what holds at its place, and the limits.

A checker is a function ``check(claim, context, limits) -> None``. It returns if ``claim.before`` <-> ``claim.after``
holds over R for all values of the variables for which every formula of ``context`` holds, and raises
``CertificateRejected`` (by ``claim.fail`` or by ``Entry.fail``) otherwise, also where it does not understand the step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry

Context = tuple[Formula, ...]


@dataclass(frozen=True, slots=True)
class Claim:
    """The formulas over ``ring``, and the evidence as an entry of the certificate (an object, perhaps empty)."""

    rule: str
    before: Formula
    after: Formula
    ring: Ring
    evidence: Entry
    path: str

    def fail(self, reason: str) -> CertificateRejected:
        """The error that names this step."""
        return CertificateRejected(self.path, f"{self.rule}: {reason}")


@dataclass(frozen=True, slots=True)
class Limits:
    """``budget``: looked at between pieces of work (``tick``). ``replay``: the formula to which nested steps (a list
    entry) lead from one under a context, each step checked. ``leaf``: a nested certificate of an older kind, checked.
    """

    budget: Budget
    replay: Callable[[Entry, Formula, Context, Ring], Formula]
    leaf: Callable[[Entry], Certificate]

    def tick(self) -> None:
        """Raise ``BudgetExceeded`` where a limit is reached."""
        self.budget.check("verify")


Check = Callable[[Claim, Context, Limits], None]


def only(claim: Claim, *names: str, optional: Sequence[str] = ()) -> list[Entry]:
    """The members of the evidence, which has exactly these names."""
    return claim.evidence.fields(*names, optional=tuple(optional))
