"""A universal block that is false off the zeros of an equation, in steps of the kernel: instances exclude the rest."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, ForAll, Formula, Not, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.linear_equation import substituted
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim, Limits, only
from qe.kernel.terms import Quotient
from qe.proof.entry import Entry, Json
from qe.proving.linear import term
from qe.proving.made import Made, by_signs


def degenerate_truth_set(made: Made, after: Formula) -> None:
    """The block is false off the zeros of the equation, and there the equation may be put in."""
    claim, limits = made.claim, made.limits
    variable, values, equation, parts = only(claim, "variable", "values", "equation", "parts")
    block, name, ring = normal(claim.before), variable.text(), claim.ring
    if not isinstance(block, ForAll) or block.variables != (name,) or not block.body.is_quantifier_free:
        raise variable.fail("expected the one variable of a universal block")
    numbers = [entry.rational() for entry in values.items()]
    assert isinstance(claim.before, ForAll)
    places = {v: (ring.constant(v.numerator), ring.constant(v.denominator)) for v in numbers}
    instances = {v: made.put(claim.before.body, {name: place}) for v, place in places.items()}  # as the steps begin
    cases: list[Formula] = [TRUE]
    made.moved(made.current, Not(block))  # both sides as they stand, though the block is universal
    if equation.value is not None:
        pivot = term(equation, block.free, block, claim)
        zero = conj((atom(pivot.equation, Relation.EQ), block))
        cases = [atom(pivot.equation, relation) for relation in (Relation.LT, Relation.GT)]
        split = disj((zero, *(conj((case, block)) for case in cases)))
        together: list[Json] = [by_signs(claim, limits, split, block, ())]
        made.step("converse", block, split, {"steps": together})
    for case, steps in zip(cases, parts.items(), strict=True):
        refuted = _refuted(claim, limits, conj((case, block)), block, case, instances, steps)
        made.step("no exception", conj((case, block)), FALSE, {"exceptions": [refuted]})
    if equation.value is not None:
        made.simplified(block, substituted(pivot, claim))


def _refuted(
    claim: Claim,
    limits: Limits,
    whole: Formula,
    block: ForAll,
    case: Formula,
    instances: Mapping[Fraction, Formula],
    steps: Entry,
) -> list[Json]:
    """Steps to false from the sentence that the block holds somewhere in a case: beside it stand its instances."""
    made, given = Made(claim, limits, exists(whole.free, whole)), conj((conj(instances.values()), case))
    body = normal(given)
    impossible = next((v for v, instance in instances.items() if instance == FALSE), None)
    if impossible is not None:
        made.terms(block, FALSE, {block.variables[0]: _number(impossible, claim)}, {})
        return made.steps
    start, first = exists(body.free, body), exists(given.free, given)
    if limits.replay(steps, first, (), claim.ring) != FALSE:
        raise steps.fail("not shown that the instances have no common solution")
    beside = exists(whole.free, conj((whole, body)))
    following = Made(claim, limits, beside)
    for member in conjuncts(body):
        number = next((v for v, instance in instances.items() if member in conjuncts(normal(instance))), None)
        if number is not None and member not in conjuncts(whole):
            contrary = conj((block, negation(member)))
            inner = Made(claim, limits, exists(contrary.free, contrary))
            inner.terms(block, FALSE, {block.variables[0]: _number(number, claim)}, {})
            following.step("no exception", member, TRUE, {"exceptions": [inner.steps]}, (block,))
    made.back(made.current, beside, following)
    both, nothing = disj((beside, start)), Made(claim, limits, disj((beside, start)))
    nothing.moved(start, first)
    nothing.derived(first, FALSE, steps.value)
    made.back(beside, both, nothing)
    simpler: list[Json] = [by_signs(claim, limits, start, both, ())]
    made.step("converse", both, start, {"steps": simpler})
    made.moved(start, first)
    made.derived(first, FALSE, steps.value)
    return made.steps


def _number(value: Fraction, claim: Claim) -> Quotient:
    return claim.ring.constant(value.numerator), claim.ring.constant(value.denominator)
