"""Certificates of former releases, whose steps had rules with checkers of their own, in the language of the kernel.

Nothing here is trusted: the kernel checks what comes out. The elaborators of today read them
(``qe.proving.elaborators``); rules that only had another name get that of today (``qe.proving.primitive_names``), and
lemmas the cases for which a checker once searched. Kept for one release.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from dataclasses import replace

from qe.certify.registry import RULES
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.kernel.boolean import ByLemmas
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim, Context
from qe.kernel.verdict import CRASHES
from qe.options import Budget
from qe.proof.certificate import Certificate, Labelled
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proving import older_kinds
from qe.proving.elaborators import ELABORATORS, NAMING, Elaborator
from qe.proving.lemma_list import with_cases
from qe.proving.made import FRESH
from qe.proving.older_coverings import covering
from qe.proving.older_kinds import objects
from qe.proving.primitive_names import BY_SIGNS, SIGNS
from qe.proving.search import former_search
from qe.proving.shifts import has_roots_of_cubics

FORMER = {**ELABORATORS, "covering": covering}


def recent(certificate: Certificate, budget: Budget) -> Certificate:
    """The certificate with the steps of former rules converted; itself where there are none.

    Raises ``CertificateRejected`` naming a step that cannot be, and ``Unable`` at a limit.
    """
    certificate = older_kinds.recent(certificate)
    payload = certificate.payload
    if isinstance(payload, tuple):
        members = tuple(Labelled(m.label, recent(m.certificate, budget)) for m in payload)
        return certificate if members == payload else replace(certificate, payload=members)
    if not isinstance(payload, dict) or not _is_former(payload):
        return certificate
    found = _Conversion(budget).data(payload, "payload")
    assert isinstance(found, dict)
    for theory in _without_cases(found):  # by propagation alone, if at all
        theory["cases"] = []
    return replace(certificate, payload=found)


def _mentions(data: Json, rules: Container[str]) -> bool:
    """Whether a step of one of these rules is in the data."""
    return any(node.get("rule") in rules and _is_former_step(node) for node in objects(data))


def _is_former(data: Json) -> bool:
    """Whether a step is of a former rule, or its lemmas are without cases."""
    return _mentions(data, [*FORMER, *BY_SIGNS]) or any(_without_cases(data))


def _without_cases(data: Json) -> Iterator[dict[str, Json]]:
    """Lemmas of a former release."""
    theories = (node.get("theory") for node in objects(data))
    yield from (theory for theory in theories if isinstance(theory, dict) and "cases" not in theory)


def _is_former_step(step: dict[str, Json]) -> bool:
    """Whether the evidence is not what the rule has today."""
    evidence, entry = step.get("evidence"), CHANGED.get(str(step.get("rule")))
    if entry is None or not isinstance(evidence, dict):
        return entry is None
    return entry in evidence or (step.get("rule") == "elimination set" and has_roots_of_cubics(evidence))


CHANGED = {"elimination set": "exponent", "covering": "line"}
"""Rules of today whose evidence was another, by an entry that it had."""


class _Conversion:
    """Steps of one certificate, with those inside their evidence, under one budget."""

    def __init__(self, budget: Budget) -> None:
        self.limits = limits_of(budget, RULES)
        self.ring = Ring.of(())

    def data(self, value: Json, path: str) -> Json:
        """The same data with every step of a former rule as one that is made of steps of today."""
        if isinstance(value, list):
            return [self.data(part, f"{path}[{k}]") for k, part in enumerate(value)]
        if not isinstance(value, dict):
            return value
        outer = self.ring
        if "order" in value:
            names = Entry(value["order"], f"{path}.order").names()
            fresh = FRESH if _mentions(value, NAMING) else ()
            value = {**value, "order": list(dict.fromkeys((*names, *fresh)))}
            self.ring = Ring.of(dict.fromkeys((*names, *fresh)))
        found = {name: self.data(part, f"{path}.{name}") for name, part in value.items()}
        rule = value.get("rule")
        if isinstance(rule, str) and (elaborator := FORMER.get(rule)) is not None and _is_former_step(value):
            try:
                found = self.step(Entry(found, path), elaborator)
            except (CertificateRejected, *CRASHES) as error:
                if rule not in RULES:  # else the step has a checker of its own
                    raise CertificateRejected(path, f"{rule}: not understood ({error})") from error
                found = self.by_lemmas(Entry(found, path), rule)
        elif isinstance(rule, str):
            found = self.by_lemmas(Entry(found, path), SIGNS if rule in BY_SIGNS else rule)
        self.ring = outer
        return found

    def by_lemmas(self, entry: Entry, rule: str) -> dict[str, Json]:
        """A step with the name and the cases of today; as it stands where there are none to be had."""
        assert isinstance(entry.value, dict)
        found = {**entry.value, "rule": rule}
        evidence = entry.value.get("evidence")
        check = RULES.get(rule)
        if not isinstance(check, ByLemmas) or not isinstance(evidence, dict):
            return found
        claim, context = self.claim(entry)
        if entry.value["rule"] == "Boolean search" and "learnt" in evidence:
            return {**found, "evidence": former_search(claim, self.limits)}
        theory = evidence.get("theory")
        if not isinstance(theory, dict) or "cases" in theory:
            return found
        cased = with_cases(theory, check.obligations(claim, context), self.ring, self.limits)
        return found if cased is None else {**found, "evidence": {**evidence, "theory": cased}}

    def step(self, entry: Entry, elaborator: Elaborator) -> dict[str, Json]:
        """A step of a former rule, made of steps of today."""
        assert isinstance(entry.value, dict)
        claim, context = self.claim(entry)
        return {**entry.value, "rule": "steps", "evidence": {"steps": elaborator(claim, context, self.limits)}}

    def claim(self, entry: Entry) -> tuple[Claim, Context]:
        """What a step claims, and where."""
        rule, _, old, new, used, evidence = entry.fields("rule", "at", "before", "after", "context", "evidence")
        before, after = (formula_from_json(e, self.ring, quantified=True) for e in (old, new))
        context = tuple(formula_from_json(e, self.ring, quantified=True) for e in used.items())
        return Claim(rule.text(), before, after, self.ring, evidence, entry.path), context
