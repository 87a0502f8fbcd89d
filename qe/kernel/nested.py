"""Primitives "steps", "converse" and "no exception": one step that is made of steps of its own. The first is also
called "virtual substitution" and "equations taken apart".

THEOREM (steps). Equivalence is transitive, and A <-> B iff not A <-> not B: the steps lead from A to B; for a
universal block both sides are negated. THEOREM (converse). A <-> B iff B <-> A: the steps lead from B to A. THEOREM
(no exception). Let G be what holds at the place. If the sentence that G and A and not B hold for some values of the
variables is false, and that with A and B exchanged, too, then A <-> B where G holds.

Evidence: ``steps`` from A to B, or from B to A; or ``exceptions``, a list of steps to false for each of the two
sentences that is not false as it stands.
"""

from __future__ import annotations

from qe.exact.ring import Ring
from qe.formula.build import conj, exists
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.kernel.block import existential
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import is_same
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Entry, formula_from_json


def check_steps(claim: Claim, context: Context, limits: Limits) -> None:
    """The steps lead from the one side to the other."""
    steps = only(claim, "steps")[0]
    before, after = existential(claim)
    if limits.replay(steps, before, context, claim.ring) != after:
        raise claim.fail("the steps do not lead there")


def check_converse(claim: Claim, context: Context, limits: Limits) -> None:
    """The steps lead from what stands after to what stands before."""
    steps = only(claim, "steps")[0]
    if limits.replay(steps, claim.after, context, claim.ring) != claim.before:
        raise claim.fail("the steps do not lead back")


def check_no_exception(claim: Claim, context: Context, limits: Limits) -> None:
    """That the two sides differ is refuted in either direction."""
    listed = list(only(claim, "exceptions")[0].items())
    sides = ((claim.before, claim.after), (claim.after, claim.before))
    wrong = [conj((*map(normal, context), normal(one), negation(other))) for one, other in sides]
    sentences = [exists(body.free, body) for body in wrong if body != FALSE]
    if len(listed) != len(sentences):
        raise claim.fail(f"expected {len(sentences)} lists of steps")
    for steps, sentence in zip(listed, sentences, strict=True):
        if limits.replay(steps, sentence, (), claim.ring) != FALSE:
            raise steps.fail("not shown that there is no exception")


def is_true(sentence: Formula, entry: Entry, limits: Limits) -> bool:
    """Whether a derivation on its own, which is checked, turns the sentence into TRUE."""
    start, answer = proved(entry, limits)
    return is_same(start, sentence) and answer == TRUE


def proved(entry: Entry, limits: Limits) -> tuple[Formula, Formula]:
    """The two formulas of a derivation on its own, which is checked: they are equivalent wherever it stands."""
    order, start, steps, answer = entry.fields("order", "start", "steps", "answer")
    ring = Ring.of(order.names())
    before, after = (formula_from_json(e, ring, quantified=True) for e in (start, answer))
    if limits.replay(steps, before, (), ring) != after:
        raise answer.fail("not the formula to which the steps lead")
    return before, after
