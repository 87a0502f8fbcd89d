"""Universal blocks with convex truth sets: their steps are decompositions; false claims have none."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.verify import checked
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, written
from qe.proof.derivation import moved
from qe.proof.step import Step
from qe.proving.prover import Prover

RULE = "critical values of a universal block"
PARABOLA = "all t. 0 <= t and t <= 1 -> (a - t)^2 + (b - t^2)^2 <= 4"
BERNSTEIN = "all t. 0 < t and t < 1 -> (1 - t)^2*a + 2*t*(1 - t)*b + t^2 >= 0"
LINE = "all t. -1 <= t and t <= 2 -> a*t^2 - t <= 1"
AT_END = "all t. 0 <= t and t <= 1 -> t*(1 - t)^2*(a^2 + t*b - 1) <= 0"


@settings(max_examples=12, deadline=None)
@given(st.integers(-2, 2), st.integers(-2, 2), st.integers(1, 3), st.integers(0, 2))
def test_whatever_is_found_is_accepted(p, q, size, shift):
    text = f"all t. 0 <= t and t <= {size} -> (a - {p}*t)^2 + {shift}*b*t <= {q}*t + 3"
    answer = qe.eliminate(text, method="critical", check=True, process=False)
    if answer.formula is not None and RULE in [step.rule for step in answer.derivation.steps]:
        assert RULE not in answer.unchecked_steps


@pytest.mark.parametrize(
    ("text", "other"),
    [
        (LINE, "4*a - 3 <= 1"),
        (LINE, "a <= 2"),
        (LINE, "a < 1/4"),
        (BERNSTEIN, "a >= 0 and b >= 0"),
        (BERNSTEIN, "b^2 - a <= 0"),
        (AT_END, "a^2 <= 1"),
        (AT_END, "a^2 + b <= 1"),
        (PARABOLA, "a^2 + b^2 <= 4"),
    ],
)
def test_other_answers_have_no_proof(text: str, other: str) -> None:
    before = read(text)
    assert before.ring is not None
    prover = Prover(before.ring, Options(), Budget(20))
    right = qe.eliminate(text, method="critical", process=False).formula
    assert right is not None and prover.own(Step(RULE, before, moved(right, before.ring)), ()) is not None
    assert prover.own(Step(RULE, before, moved(read(other), before.ring)), ()) is None


def test_evidence_of_former_releases_is_not_needed() -> None:
    """Steps of this rule had a checker of their own: whatever their evidence, they are made anew, or refused."""
    before = read(LINE)
    assert before.ring is not None
    for other, accepted in (("2*a <= 0", True), ("a <= 1", False)):
        after = moved(read(other), before.ring)
        step = written(RULE, (), before, after, (), {"order": ["a"], "chains": [], "exceptions": []})
        read_again = Certificate.from_json(Certificate.derivation(before.ring.names, before, [step], after).to_json())
        assert checked(read_again, Budget(20), core=True).accepted == accepted
