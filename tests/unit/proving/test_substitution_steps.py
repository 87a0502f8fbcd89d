"""The trace of virtual substitution as steps: each is accepted by the checkers, and none where evidence is missing."""

import pytest

from qe.certify.registry import RULES
from qe.elimination.vs.block import eliminate_block
from qe.elimination.vs.trace import Eliminated, Unchanged
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert, neg
from qe.formula.syntax import Exists, Formula
from qe.io.text import read
from qe.kernel.derivation import limits_of
from qe.options import Budget
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json
from qe.proving.lemmas import refuting
from qe.proving.made import FRESH
from qe.proving.substitution_steps import steps
from qe.simplifier.simplify import simplify
from tests.tables import each

LIMITS = limits_of(Budget(), RULES)


def simplification(before: Formula, after: Formula) -> Json:
    assert before.ring is not None or after.ring is not None
    ring = before.ring or after.ring
    evidence = refuting(([before, neg(after)], [after, neg(before)]), ring, LIMITS)
    if evidence is None:
        raise CertificateRejected("simplification", "none found")
    return written("signs", (), before, after, (), evidence)


def eliminated(text: str) -> tuple[Exists, Formula, list[Json], Ring]:
    start = read(text)
    ring = Ring.of((*(start.ring.names if start.ring else ()), *FRESH))
    block = convert(start, ring)
    assert isinstance(block, Exists)
    found = eliminate_block(block.variables, block.body, budget=Budget(20), simplify=simplify)
    assert found.trace is not None
    return block, found.formula, steps(block, found.trace, found.formula, ring, simplification, LIMITS), ring


@each(
    ("ex x. x > a and x < b", ["elimination set"]),
    ("ex x. a*x = b and x > 0", ["elimination set"]),
    ("ex x, y. x > a and y < b and y > 0", ["quantifiers", "steps", "steps"]),
    ("ex x. x > a and x < 0 or x < b and x > 1", ["quantifiers", "steps", "steps"]),
    ("ex x. x^2 = 2", ["instance"]),
    ("ex x. x^2 < a", ["steps", "converse", "quantifiers", "root", "quantifiers", "elimination set"]),
)
def test_steps_lead_from_the_block_to_the_answer(text: str, rules: list[str]) -> None:
    block, answer, made, ring = eliminated(text)
    assert [step["rule"] for step in made if step["rule"] != "signs"] == rules  # type: ignore[index,call-overload]
    assert LIMITS.replay(Entry(made, "steps"), block, (), ring) == answer
    for left_out in range(len(made)):
        try:
            reached = LIMITS.replay(Entry(made[:left_out] + made[left_out + 1 :], "steps"), block, (), ring)
        except CertificateRejected:
            continue
        assert reached != answer


def test_nothing_is_written_without_evidence() -> None:
    block = read("ex x. a*x^2 + x > b")
    assert isinstance(block, Exists) and block.ring is not None
    found = eliminate_block(block.variables, block.body, budget=Budget(20), simplify=simplify)
    assert found.trace is not None

    def refused(before: Formula, after: Formula) -> Json:
        raise CertificateRejected("simplification", "none found")

    with pytest.raises(CertificateRejected):
        steps(block, found.trace, found.formula, block.ring, refused, LIMITS)


def test_a_block_that_stays_needs_no_step() -> None:
    block = read("ex x. x^7 + a*x > b")
    assert isinstance(block, Exists) and block.ring is not None
    trace = Eliminated(block.body, block, Unchanged())
    assert steps(block, trace, block, block.ring, simplification, LIMITS) == []
