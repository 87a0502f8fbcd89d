"""Checker for certificates of kind "derivation": a formula turned into another, step by step.

Payload: ``order`` (all variable names), ``start``, ``steps``, ``answer``. A step has ``rule``, ``at`` (its place:
argument numbers on the way down from the root), ``before``, ``after``, ``context`` (what it uses of its surroundings)
and ``evidence`` (by rule, see ``qe.certify.registry``).

THEOREM. Equivalence over R is a congruence. So if A <-> B holds wherever the facts of the place of A do, then
F <-> F', where F' has B in place of A. The facts of a place are collected on the way down from the root: in a
conjunction the other conjuncts, in a disjunction the negations of the other disjuncts, all as they stand in F; facts
with a variable that a quantifier binds are dropped below it; a negation keeps them. Proof: where a fact does not hold,
the conjunction is false (the disjunction true) whether A or B stands there. By induction start <-> answer.
What a place sees, the names free in F or in what holds around it and those bound above the place, nothing below the
place binds, before and after every step: no name changes its meaning on the way inwards (``traverse.clashes``).
A place may also be a conjunction (disjunction) of which ``before`` is a part: its arguments are among those there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from qe.errors import Unable
from qe.exact.ring import Ring
from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.syntax import And, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import clashes
from qe.kernel.negation import negation
from qe.kernel.nested import proved
from qe.kernel.step import Check, Claim, Context, Limits, check_names, outside
from qe.kernel.verdict import CRASHES
from qe.options import Budget
from qe.proof.entry import Entry, Json, formula_from_json


def check_derivation(payload: dict[str, Json], budget: Budget, rules: Mapping[str, Check]) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the step that fails.

    Raises ``Unable`` for a rule without a checker: what it claims is not wrong for that, but nothing is proved.
    """
    proved(Entry(payload, "payload"), limits_of(budget, rules))


def limits_of(budget: Budget, rules: Mapping[str, Check]) -> Limits:
    """What the checkers of single steps are given."""
    return _Replay(budget, rules).limits


class _Replay:
    """The steps of one derivation, and of those nested in its evidence, under one budget."""

    def __init__(self, budget: Budget, rules: Mapping[str, Check]) -> None:
        self.rules, self.limits = rules, Limits(budget, self.run)

    def run(self, steps: Entry, current: Formula, context: Context, ring: Ring) -> Formula:
        """The formula after the steps, each of them checked."""
        check_seen(steps, current, context)
        for entry in steps.items():
            self.limits.tick()
            current = self.step(entry, current, context, ring)
        return current

    def step(self, entry: Entry, current: Formula, context: Context, ring: Ring) -> Formula:
        """The formula after one step."""
        rule, at, old, new, used, evidence = entry.fields("rule", "at", "before", "after", "context", "evidence")
        before, after = (formula_from_json(e, ring, quantified=True) for e in (old, new))
        place = tuple(e.integer() for e in at.items())
        facts, changed = replaced(current, place, before, after, context, at)
        needed = tuple(formula_from_json(e, ring, quantified=True) for e in used.items())
        for fact, told in zip(needed, used.items(), strict=True):
            if fact not in facts:
                raise told.fail("this is no other condition at the place of the step")
        check_seen(new, changed, context)
        claim = Claim(rule.text(), before, after, ring, evidence, entry.path)
        check_names(claim, needed)
        checker = self.rules.get(claim.rule)
        if checker is None:
            raise Unable(f'{entry.path}: there is no checker for the rule "{claim.rule}"')
        try:
            checker(claim, needed, self.limits)
        except CRASHES as error:
            error.add_note(entry.path)  # for one that is no verdict: it names no entry
            raise
        return changed


def check_seen(entry: Entry, formula: Formula, context: Context) -> None:
    """No quantifier of the formula binds a name that it sees."""
    ambiguous = clashes(formula, (name for fact in context for name in fact.free))
    if ambiguous:
        raise entry.fail(f"{min(ambiguous)} is bound where it is seen from outside")


def replaced(
    formula: Formula, place: Sequence[int], before: Formula, after: Formula, facts: Context, entry: Entry
) -> tuple[Context, Formula]:
    """The facts of the place, and the formula with ``after`` for ``before`` there."""
    match formula:
        case _ if not place and formula == before:
            return facts, after
        case And(args) | Or(args) if not place:
            if type(before) is not type(formula) or not set(before.args) <= set(args):
                raise entry.fail("what the step replaces does not stand there")
            rest = tuple(a for a in args if a not in before.args)
            join = conj if isinstance(formula, And) else disj
            return (*facts, *_beside(formula, rest)), join((*rest, after))
        case And(args) | Or(args) if place[0] < len(args):
            k = place[0]
            inner = (*facts, *_beside(formula, args[:k] + args[k + 1 :]))
            found, changed = replaced(args[k], place[1:], before, after, inner, entry)
            join = conj if isinstance(formula, And) else disj
            return found, join((*args[:k], changed, *args[k + 1 :]))
        case Not(arg) if place and place[0] == 0:
            found, changed = replaced(arg, place[1:], before, after, facts, entry)
            return found, neg(changed) if isinstance(changed, Constant) else Not(changed)
        case Exists(variables, body) | ForAll(variables, body) if place and place[0] == 0:
            found, changed = replaced(body, place[1:], before, after, outside(facts, variables), entry)
            return found, (exists if isinstance(formula, Exists) else forall)(variables, changed)
    raise entry.fail("what the step replaces does not stand there")


def _beside(formula: And | Or, others: Sequence[Formula]) -> Context:
    """What may be taken for granted at one argument, given the others."""
    found = [f if isinstance(formula, And) else negation(f) for f in others]
    return tuple(part for f in found for part in (f.args if isinstance(f, And) else (f,)))
