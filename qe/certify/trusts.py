"""What a certificate rests on beside the primitives: theorems without a proof of their own, and the expert ring.

A step, or a certificate inside one, is looked at by the checker that its rule, or its kind, names. So what is not named
anywhere in a certificate has no part in its verdict.
"""

from __future__ import annotations

from collections.abc import Iterator

from qe.kernel.primitives import PRIMITIVES
from qe.kernel.statements import rows
from qe.proof.certificate import Certificate
from qe.proof.entry import Json

CORE_KINDS = frozenset({"derivation", "bundle"})
"""Kinds of certificates that need nothing of the second ring."""


def trusts(certificate: Certificate) -> tuple[str, ...]:
    """The names of the axioms of which its steps are instances, and of the expert rules and kinds that it uses."""
    return tuple(dict.fromkeys((*_names(certificate), *expert_parts(certificate))))


def expert_parts(certificate: Certificate) -> tuple[str, ...]:
    """The rules and kinds that the certificate names and that are not of the kernel: of the second ring, or unknown."""
    return tuple(dict.fromkeys(_expert(certificate)))


def _expert(certificate: Certificate) -> Iterator[str]:
    for node in _nodes(certificate):
        if isinstance(rule := node.get("rule"), str) and "before" in node and rule not in PRIMITIVES:
            yield rule
        if isinstance(kind := node.get("kind"), str) and "payload" in node and kind not in CORE_KINDS:
            yield kind


def _names(certificate: Certificate) -> Iterator[str]:
    names = {row.name for row in rows().values() if "axiom" in row.data}
    for node in _nodes(certificate):
        if isinstance(name := node.get("theorem"), str) and name in names:
            yield name


def _nodes(certificate: Certificate) -> Iterator[dict[str, Json]]:
    """All objects in the data of a certificate and of its members, itself the first."""
    pending: list[Json] = [certificate.payload] if isinstance(certificate.payload, dict) else []
    yield {"kind": certificate.kind.value, "payload": None}
    if isinstance(certificate.payload, tuple):
        for member in certificate.payload:
            yield from _nodes(member.certificate)
    while pending:
        node = pending.pop()
        if isinstance(node, list):
            pending += reversed(node)
        elif isinstance(node, dict):
            yield node
            pending += reversed(node.values())
