"""What a certificate rests on, and that the core alone refuses what needs more."""

import pytest

import qe
from qe.certify.registry import RULES
from qe.certify.trusts import expert_parts
from qe.expert.rules import EXPERT
from qe.proof.certificate import Certificate

CORE = [
    "ex x. x^2 + b*x + c = 0",
    "ex x, y. x*y = a and x + y = b and x^3 + y^3 > 1",
    "ex x. x >= 0 and x <= 1 and a*x^3 + b*x^2 + c*x + d < 0",
    "all x. ex y. y^3 = x",
    "ex x. x > 0 and x^4 + a*x^3 + b*x + c = 0",
]
NEEDS = {"ex x. (x - a)^2 <= 1 and x^2 <= 4": "critical values"}


@pytest.mark.parametrize("question", CORE)
def test_the_core_suffices(question: str) -> None:
    certificate = qe.eliminate(question, check=True).certificate
    assert certificate is not None and qe.verify(certificate, core=True).accepted
    assert not expert_parts(certificate)


@pytest.mark.parametrize("question", NEEDS)
def test_the_core_refuses_what_needs_the_expert_ring(question: str) -> None:
    certificate = qe.eliminate(question, method="critical", check=True).certificate
    assert certificate is not None and qe.verify(certificate).accepted
    verdict = qe.verify(certificate, core=True)
    assert not verdict.accepted and verdict.step == "core" and NEEDS[question] in verdict.reason
    assert NEEDS[question] in certificate.trusts
    bundle = Certificate.bundle((("one", certificate),))
    assert qe.verify(bundle).accepted and not qe.verify(bundle, core=True).accepted


def test_every_expert_rule_has_a_checker() -> None:
    assert set(RULES) >= set(EXPERT)
