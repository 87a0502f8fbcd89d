"""Steps of rules that are no primitives, made of steps of primitives (``qe.kernel``).

Nothing here is trusted: the kernel checks what comes out. An elaborator is given a step, as its rule's evidence says,
and says by which steps of the kernel it is made. Steps that the engine takes today go through it, and those that
certificates of former releases have (``qe.proving.older``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace

from qe.certify.block import block_goals, existential
from qe.certify.boolean import Goal
from qe.certify.derivation import replaced
from qe.certify.linear_equation import term
from qe.certify.step import Claim, Context, Limits, only
from qe.errors import CertificateRejected
from qe.formula.build import atom, conj, disj, exists
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Or, Relation
from qe.formula.traverse import conjuncts, subformula
from qe.kernel.terms import Quotient, at_terms, terms_goals
from qe.kernel.theorem import theorem_goals
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json, poly_to_text
from qe.proving.lemma_list import EMPTY
from qe.proving.lemmas import refuting
from qe.rules.closed_forms import matches

Elaborator = Callable[[Claim, Context, Limits], list[Json]]
"""The steps that lead from ``claim.before`` to ``claim.after``; ``CertificateRejected`` where there are none."""


def closed_form(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """An instance of a theorem of the family that is called like the rule, and what the answer was simplified to."""
    before, after = existential(claim)
    if not isinstance(before, Exists):
        raise claim.fail("a block expected")
    steps = by_theorems(before, context, claim, limits)
    same = next((step for step, answer in steps if answer == after), None)
    if same is not None:
        return [same]
    for step, answer in by_theorems(before, context, claim, limits):
        with suppress(CertificateRejected):
            return [step, simplified(answer, after, context, claim, limits)]
    raise claim.fail("not an instance of a theorem")


def by_theorems(
    block: Exists, context: Context, claim: Claim, limits: Limits, place: tuple[int, ...] = ()
) -> Iterator[tuple[Json, Formula]]:
    """Steps from a block to its answer by theorems of the family that is called like the rule, and the answers."""
    for match in matches(claim.rule, block.variables, block.body):
        answer = nnf(match.formula("answer"))
        evidence = {**match.evidence, "theory": EMPTY}
        step = replace(claim, rule="theorem", before=block, after=answer, evidence=Entry(evidence, claim.path))
        theory = refuting(theorem_goals(step, context), claim.ring, limits)
        if theory is not None:
            yield written("theorem", place, block, answer, context, {**evidence, "theory": theory}), answer


def square_alone(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A variable that one condition looks at, as a parabola: that condition in a block of its own, by a theorem."""
    (variable,) = only(claim, "variable")
    block, name, _ = claim.variable(variable)
    parts = conjuncts(block.body)
    part = next((f for f in parts if name in f.free), TRUE)
    inner, rest = Exists((name,), part), tuple(v for v in block.variables if v != name)
    body = conj(inner if f is part else f for f in parts)
    middle = Exists(rest, body) if rest else body  # the blocks stay two, also where one stands in the other alone
    place = (*((0,) if rest else ()), *((parts.index(part),) if len(parts) > 1 else ()))
    solved = next(by_theorems(inner, (), claim, limits, place), None)
    if solved is None:
        raise claim.fail("not an instance of a theorem")
    return [written("quantifiers", (), block, middle, (), {}), solved[0]]


def simplified(before: Formula, after: Formula, context: Context, claim: Claim, limits: Limits) -> Json:
    """A step that signs of polynomials prove."""
    empty = Entry({"theory": EMPTY}, claim.path)
    step = replace(claim, rule="simplification", before=before, after=after, evidence=empty)
    theory = _theory(block_goals(step, context), claim, limits)
    return written("simplification", (), before, after, context, {"theory": theory})


def terms(
    before: Formula,
    after: Formula,
    there: Mapping[str, Quotient],
    back: Mapping[str, Quotient],
    context: Context,
    claim: Claim,
    limits: Limits,
    place: tuple[int, ...] = (),
) -> Json:
    """A change of variables by these terms."""
    evidence: dict[str, Json] = {"there": _rows(there), "back": _rows(back), "theory": EMPTY}
    step = replace(claim, rule="terms", before=before, after=after, evidence=Entry(evidence, claim.path))
    theory = _theory(terms_goals(step, context), claim, limits)
    return written("terms", place, before, after, context, {**evidence, "theory": theory})


def _rows(of: Mapping[str, Quotient]) -> list[Json]:
    return [[name, poly_to_text(top), poly_to_text(bottom)] for name, (top, bottom) in of.items()]


def _theory(goals: Sequence[Goal], claim: Claim, limits: Limits) -> Json:
    theory = refuting(goals, claim.ring, limits) if goals else EMPTY
    if theory is None:
        raise claim.fail("no lemmas show what has to be shown")
    return theory


def _at(quotient: Quotient, terms: Mapping[int, Quotient]) -> Quotient:
    """A quotient whose bottom is a number, at such terms."""
    (top, bottom), ((i, (_, lead)),) = quotient, terms.items()
    degree = top.degree(i)
    even = degree + (degree % 2 if lead.constant_value() < 0 else 0)
    return at_terms(top, terms), bottom * lead**even


def redundant(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A part that makes no difference, turned into a constant at its own place."""
    at, steps = only(claim, "at", "steps")
    place = [entry.integer() for entry in at.items()]
    parent = subformula(claim.before, place[:-1])
    part, constant = subformula(parent, place[-1:]), FALSE if isinstance(parent, Or) else TRUE
    facts, _ = replaced(claim.before, place, part, constant, (), at)
    return [written("no exception", place, part, constant, facts, {"exceptions": [steps.value]})]


def constant(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A formula that holds nowhere, or everywhere: by steps, or by a table."""
    value = claim.evidence.value
    if isinstance(value, dict) and "certificate" in value:
        return [written("cells", (), claim.before, claim.after, context, value)]
    steps = only(claim, "steps")[0]
    return [written("no exception", (), claim.before, claim.after, (), {"exceptions": [steps.value]})]


def witness(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """Terms in the parameters that satisfy a block."""
    equations, block = only(claim, "equations", "theory")[0], claim.block()
    there: dict[str, Quotient] = {}
    for entry in equations.items():
        pivot = term(entry, block.variables, block.body, claim)
        one = {claim.ring.index[pivot.name]: (-pivot.rest, pivot.lead)}
        there = {name: _at(quotient, one) for name, quotient in there.items()}
        there[pivot.name] = (-pivot.rest, pivot.lead)
    return [terms(claim.before, TRUE, there, {}, context, claim, limits)]


def sheared(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """m*x + n as the new x; where m may vanish, the case that it does stays as it is."""
    variable, form = only(claim, "variable", "form")
    (block, name, x), ring = claim.variable(variable), claim.ring
    n, m = form.polynomial(ring).coefficients(x)
    if m.is_constant and m.constant_value() < 0:
        m, n = -m, -n
    there, back = {name: (ring.gen(x) - n, m)}, {name: (m * ring.gen(x) + n, ring.constant(1))}
    if m.is_constant:
        return [terms(block, claim.after, there, back, context, claim, limits)]
    if not isinstance(claim.after, Or):
        raise claim.fail("two cases expected")
    cases = [exists(block.variables, conj((atom(m, rel), block.body))) for rel in (Relation.NE, Relation.EQ)]
    regular = next(part for part in claim.after.args if part != cases[1])
    middle = disj(cases)
    inner = terms(cases[0], regular, there, back, (), claim, limits, place=(0,))
    return [simplified(block, middle, context, claim, limits), inner]


def distributed(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A block that goes into a disjunction."""
    return [simplified(claim.before, claim.after, (), claim, limits)]


ELABORATORS: Mapping[str, Elaborator] = {
    "cubic on an interval": closed_form,
    "two balls": closed_form,
    "quadric in a quadric": closed_form,
    "roots in a half-plane": closed_form,
    "square of a variable alone": square_alone,
    "redundant part": redundant,
    "constant": constant,
    "witness in the parameters": witness,
    "linear form as a variable": sheared,
    "disjuncts with equations apart": distributed,
}
