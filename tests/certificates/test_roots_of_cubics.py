"""Answers by roots of cubics: proved by a decomposition where one is small enough; not if a producer is broken."""

from __future__ import annotations

import pytest

import qe

EXAMPLES = [
    "ex x. a*x^3 + b*x^2 + c*x + d = 0 and x > 0",
    "ex x. x^3 + a*x + b = 0 and c*x + d > 0",
    "ex x. x^3 + a*x + b < 0 and x > c and x < d",
    "ex x. x^3 + a*x^2 + b*x + c <= 0 and x >= 0 and x <= 1",
    "ex x. a*x^3 + b*x + c > 0 and x^2 < d",
    "all x. x^3 + a*x + b > 0 or x < c",
]


@pytest.mark.parametrize("text", EXAMPLES)
def test_every_step_is_checked(text: str) -> None:
    answer = qe.eliminate(text, check=True, process=False)
    assert answer.unchecked_steps == () and answer.certificate is not None
    assert qe.verify(qe.Certificate.from_json(answer.certificate.to_json())).accepted
