"""What a rule's checker is given: one step of a derivation, what holds at its place, and the limits.

A checker is a function ``check(claim, context, limits) -> None``. It returns if ``claim.before`` <-> ``claim.after``
holds over R for all values of the variables for which every formula of ``context`` holds, and raises
``CertificateRejected`` (by ``claim.fail`` or by ``Entry.fail``) otherwise, also where it does not understand the step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.syntax import Exists, Formula
from qe.formula.traverse import clashes, has_root_atoms
from qe.options import Budget
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

    def block(self) -> Exists:
        """The formula before, which has to be an existential block."""
        if not isinstance(self.before, Exists):
            raise self.fail("expected an existential block")
        return self.before

    def plain(self, formula: Formula) -> Formula:
        """A formula of the step, which has to be one of comparisons of polynomials, without quantifiers."""
        if not formula.is_quantifier_free or has_root_atoms(formula):
            raise self.fail("a formula without quantifiers and root atoms expected")
        return formula

    def variable(self, entry: Entry) -> tuple[Exists, str, int]:
        """The existential block, and its variable that the entry names, with its index in the ring."""
        block, name = self.block(), entry.text()
        if name not in block.variables or name not in self.ring.index:
            raise entry.fail("expected a variable of the existential block")
        return block, name, self.ring.index[name]


@dataclass(frozen=True, slots=True)
class Limits:
    """``budget``: looked at between pieces of work (``tick``). ``replay``: the formula to which nested steps (a list
    entry) lead from one under a context, each step checked.
    """

    budget: Budget
    replay: Callable[[Entry, Formula, Context, Ring], Formula]

    def tick(self) -> None:
        """Raise ``BudgetExceeded`` where a limit is reached."""
        self.budget.check("verify")


Check = Callable[[Claim, Context, Limits], None]


def outside(context: Context, names: Iterable[str]) -> Context:
    """What of a context holds inside a block over these names: formulas with one of them are about another variable."""
    inner = set(names)
    return tuple(f for f in context if not inner & set(f.free))


def check_names(claim: Claim, context: Context) -> None:
    """What every checker may rely on: nowhere in a step does a quantifier bind a name that is seen there.

    That is: no formula of the step binds a name below a quantifier that binds it, and none that is free in one of
    them is bound in another. So whatever a checker takes from the place of the step inwards keeps its meaning.
    """
    formulas = (claim.before, claim.after, *context)
    if quantified := [formula for formula in formulas if formula.bound]:
        free = {name for formula in formulas for name in formula.free}
        for ambiguous in (clashes(formula, free) for formula in quantified):
            if ambiguous:
                raise claim.fail(f"{min(ambiguous)} is bound where it is seen from outside")


def only(claim: Claim, *names: str, optional: Sequence[str] = ()) -> list[Entry]:
    """The members of the evidence, which has exactly these names beside the optional ones."""
    return claim.evidence.fields(*names, optional=tuple(optional))
