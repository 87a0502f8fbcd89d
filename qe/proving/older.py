"""Certificates of former releases, whose steps had rules with checkers of their own, in the language of the kernel.

Nothing here is trusted: the kernel checks what comes out. A converter says by which steps of today a step of a former
rule is made. Rules that only had another name have none (``qe.certify.registry``). Kept for one release.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from qe.certify.block import existential
from qe.certify.boolean import equivalence
from qe.certify.derivation import limits_of, replaced
from qe.certify.registry import RULES
from qe.certify.step import Claim, Context, Limits, only
from qe.certify.verify import check_certificate
from qe.exact.ring import Ring
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Or
from qe.formula.traverse import subformula
from qe.kernel.theorem import theorem_goals
from qe.options import Budget
from qe.proof.certificate import Certificate, Labelled, written
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proving.lemma_list import EMPTY
from qe.proving.lemmas import refuting
from qe.rules.closed_forms import matches

Converter = Callable[[Claim, Context, Limits], list[Json]]
"""The steps that lead from ``claim.before`` to ``claim.after``; ``CertificateRejected`` where there are none."""


def closed_form(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """An instance of a theorem of the family that is called like the rule, and what the answer was simplified to."""
    before, after = existential(claim)
    if not isinstance(before, Exists):
        raise claim.fail("a block expected")
    for match in matches(claim.rule, before.variables, before.body):
        answer = nnf(match.instance(match.theorem.answer))
        evidence = {**match.evidence, "theory": EMPTY}
        middle = replace(claim, rule="theorem", before=before, after=answer, evidence=Entry(evidence, claim.path))
        theory = refuting(theorem_goals(middle, context), claim.ring, limits)
        if theory is None:
            continue
        steps = [written("theorem", (), before, answer, context, {**evidence, "theory": theory})]
        return steps if answer == after else [*steps, simplified(answer, after, context, claim, limits)]
    raise claim.fail("not an instance of a theorem")


def simplified(before: Formula, after: Formula, context: Context, claim: Claim, limits: Limits) -> Json:
    """A step that signs of polynomials prove."""
    theory = refuting(equivalence(before, after, context), claim.ring, limits)
    if theory is None:
        raise claim.fail("not shown that this was simplified to that")
    return written("simplification", (), before, after, context, {"theory": theory})


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


CONVERTERS: Mapping[str, Converter] = {
    "cubic on an interval": closed_form,
    "redundant part": redundant,
    "constant": constant,
}


def recent(certificate: Certificate, budget: Budget) -> Certificate:
    """The certificate with the steps of former rules converted; itself where there are none.

    Raises ``CertificateRejected`` naming a step that cannot be, and ``Unable`` at a limit.
    """
    payload = certificate.payload
    if isinstance(payload, tuple):
        members = tuple(Labelled(m.label, recent(m.certificate, budget)) for m in payload)
        return certificate if members == payload else replace(certificate, payload=members)
    if not isinstance(payload, dict) or not _mentions_former(payload):
        return certificate
    found = _Conversion(budget).data(payload, "payload")
    assert isinstance(found, dict)
    return replace(certificate, payload=found)


def _mentions_former(data: Json) -> bool:
    pending = [data]
    while pending:
        node = pending.pop()
        if isinstance(node, dict):
            rule = node.get("rule")
            if isinstance(rule, str) and rule in CONVERTERS:
                return True
            pending += node.values()
        elif isinstance(node, list):
            pending += node
    return False


class _Conversion:
    """Steps of one certificate, with those inside their evidence, under one budget."""

    def __init__(self, budget: Budget) -> None:
        self.limits = limits_of(budget, RULES, check_certificate)
        self.ring = Ring.of(())

    def data(self, value: Json, path: str) -> Json:
        """The same data with every step of a former rule as one that is made of steps of today."""
        if isinstance(value, list):
            return [self.data(part, f"{path}[{k}]") for k, part in enumerate(value)]
        if not isinstance(value, dict):
            return value
        outer = self.ring
        if "order" in value:
            self.ring = Ring.of(Entry(value["order"], f"{path}.order").names())
        found = {name: self.data(part, f"{path}.{name}") for name, part in value.items()}
        rule = value.get("rule")
        if isinstance(rule, str) and (converter := CONVERTERS.get(rule)) is not None:
            found = self.step(Entry(found, path), converter)
        self.ring = outer
        return found

    def step(self, entry: Entry, converter: Converter) -> dict[str, Json]:
        """A step of a former rule, made of steps of today."""
        assert isinstance(entry.value, dict)
        rule, _, old, new, used, evidence = entry.fields("rule", "at", "before", "after", "context", "evidence")
        before, after = (formula_from_json(e, self.ring, quantified=True) for e in (old, new))
        context = tuple(formula_from_json(e, self.ring, quantified=True) for e in used.items())
        claim = Claim(rule.text(), before, after, self.ring, evidence, entry.path)
        return {**entry.value, "rule": "steps", "evidence": {"steps": converter(claim, context, self.limits)}}
