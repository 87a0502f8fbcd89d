"""Certificates about arms of former releases are read as sentences, and altered ones are refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

import qe
from bezier.arm.continuous import continuous_motions
from bezier.arm.evidence import certificates, motions_certificate
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_path import joint_path
from bezier.arm.reader import load_arm
from bezier.curves.curve import Bezier
from qe.proof.certificate import digest
from qe.proving.older_kinds import recent
from tests.certificates.restated import evidence_of

EV3 = load_arm("ev3-120")
LINE = {"line": Bezier.of([(10, 40, 80), (40, 100, 20)])}


def motions() -> qe.Certificate:
    found = continuous_motions(EV3, LINE)
    assert found is not None
    return motions_certificate(found)


MADE: dict[str, tuple[Callable[[], qe.Certificate], Callable[[Any], Any]]] = {
    "inverse": (lambda: inverse_certificate(solve(EV3, (10, 40, 80))), lambda p: p.update(count=p["count"] + 1)),
    "branch": (lambda: certificates(joint_path(EV3, LINE))[0][1], lambda p: p["pieces"][0].update(radius=["3"] * 3)),
    "motions": (motions, lambda p: p.update(motions=p["motions"] + 1)),
}


def read(kind: str, payload: Any) -> qe.Certificate:
    """A certificate as a file of version 2 has it, with its digest."""
    whole: dict[str, Any] = {"format": "bezier-qe certificate", "version": 2, "kind": kind, "payload": payload}
    return qe.Certificate.from_json(json.dumps({**whole, "digest": digest(whole)}))


@pytest.mark.parametrize("kind", MADE)
def test_what_was_accepted_is_the_evidence_of_a_sentence(kind: str) -> None:
    make, alter = MADE[kind]
    made = make()
    payload = evidence_of(made)
    certificate = read(kind, payload)
    assert recent(certificate).payload == made.payload
    assert qe.verify(certificate).accepted and qe.verify(certificate, core=True).step == "core"
    alter(payload)
    assert not qe.verify(read(kind, payload)).accepted
    assert not qe.verify(read(kind, {})).accepted and not qe.verify(read(kind, {**payload, "arm": None})).accepted
