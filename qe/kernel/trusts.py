"""What a certificate rests on beside the primitives: theorems without a proof of their own, by name."""

from __future__ import annotations

from collections.abc import Iterator

from qe.kernel.statements import rows
from qe.proof.certificate import Certificate
from qe.proof.entry import Json


def trusts(certificate: Certificate) -> tuple[str, ...]:
    """The names of the axioms of which its steps are instances; of a step of a former release, those of its family."""
    return tuple(dict.fromkeys(_names(certificate)))


def _names(certificate: Certificate) -> Iterator[str]:
    if isinstance(certificate.payload, tuple):
        for member in certificate.payload:
            yield from _names(member.certificate)
    axioms = [row for row in rows().values() if "axiom" in row.data]
    names, families = {row.name for row in axioms}, {row.family for row in axioms}
    pending: list[Json] = [certificate.payload] if isinstance(certificate.payload, dict) else []
    while pending:
        node = pending.pop()
        if isinstance(node, list):
            pending += reversed(node)
        elif isinstance(node, dict):
            pending += reversed(node.values())
            if isinstance(name := node.get("theorem"), str) and name in names:
                yield name
            if isinstance(rule := node.get("rule"), str) and rule in families:
                yield from (row.name for row in axioms if row.family == rule)
