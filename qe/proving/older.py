"""Certificates of former releases, whose steps had rules with checkers of their own, in the language of the kernel.

Nothing here is trusted: the kernel checks what comes out. The elaborators of today read them
(``qe.proving.elaborators``); rules that only had another name have none (``qe.certify.registry``). Kept for one
release.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import replace

from qe.certify.registry import RULES
from qe.certify.verify import check_certificate
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim
from qe.kernel.verdict import CRASHES
from qe.options import Budget
from qe.proof.certificate import Certificate, Labelled
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proving.elaborators import ELABORATORS, FRESH, NAMING, Elaborator
from qe.proving.older_coverings import covering

FORMER = {**ELABORATORS, "covering": covering}


def recent(certificate: Certificate, budget: Budget) -> Certificate:
    """The certificate with the steps of former rules converted; itself where there are none.

    Raises ``CertificateRejected`` naming a step that cannot be, and ``Unable`` at a limit.
    """
    payload = certificate.payload
    if isinstance(payload, tuple):
        members = tuple(Labelled(m.label, recent(m.certificate, budget)) for m in payload)
        return certificate if members == payload else replace(certificate, payload=members)
    if not isinstance(payload, dict) or not _mentions(payload, FORMER):
        return certificate
    found = _Conversion(budget).data(payload, "payload")
    assert isinstance(found, dict)
    return replace(certificate, payload=found)


def _mentions(data: Json, rules: Container[str]) -> bool:
    """Whether a step of one of these rules is in the data."""
    pending: list[Json] = [data]
    while pending:
        node = pending.pop()
        if isinstance(node, dict):
            rule = node.get("rule")
            if isinstance(rule, str) and rule in rules:
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
            names = Entry(value["order"], f"{path}.order").names()
            fresh = FRESH if _mentions(value, NAMING) else ()
            value = {**value, "order": list(dict.fromkeys((*names, *fresh)))}
            self.ring = Ring.of(dict.fromkeys((*names, *fresh)))
        found = {name: self.data(part, f"{path}.{name}") for name, part in value.items()}
        rule = value.get("rule")
        if isinstance(rule, str) and (elaborator := FORMER.get(rule)) is not None:
            try:
                found = self.step(Entry(found, path), elaborator)
            except (CertificateRejected, *CRASHES) as error:
                if rule not in RULES:  # else the step has a checker of its own
                    raise CertificateRejected(path, f"{rule}: not understood ({error})") from error
        self.ring = outer
        return found

    def step(self, entry: Entry, elaborator: Elaborator) -> dict[str, Json]:
        """A step of a former rule, made of steps of today."""
        assert isinstance(entry.value, dict)
        rule, _, old, new, used, evidence = entry.fields("rule", "at", "before", "after", "context", "evidence")
        before, after = (formula_from_json(e, self.ring, quantified=True) for e in (old, new))
        context = tuple(formula_from_json(e, self.ring, quantified=True) for e in used.items())
        claim = Claim(rule.text(), before, after, self.ring, evidence, entry.path)
        return {**entry.value, "rule": "steps", "evidence": {"steps": elaborator(claim, context, self.limits)}}
