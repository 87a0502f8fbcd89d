"""What the rules of one block share: allowances are charged, facts are added to a copy, steps say what is known."""

from qe.formula.build import conj
from qe.io.text import read
from qe.options import Budget
from qe.proof.step import Step
from qe.rules.block_context import BlockContext
from qe.rules.step import StepKind

FIRST, OTHER = list(StepKind)[:2]


def test_case_distinctions_are_charged() -> None:
    context = BlockContext(Budget(), frozenset((FIRST,)), splits=5)
    assert not context.may_split(OTHER, 2) and context.splits == 5
    assert context.may_split(FIRST, 1) and context.splits == 5  # one case is no distinction
    assert context.may_split(FIRST, 4) and context.splits == 2
    assert not context.may_split(FIRST, 4) and context.splits == 2
    assert context.may_split(FIRST, 3) and context.splits == 0 and not context.may_split(FIRST, 2)


def test_what_is_given_is_known_in_a_copy() -> None:
    context = BlockContext(Budget(), frozenset())
    known = read("x > 0"), read("y = 1")
    inner = context.given(known[:1]).given(known[1:])
    assert inner.known == known and context.known == ()
    assert inner.facts != context.facts and inner.log is context.log


def test_steps_are_recorded_under_what_is_known() -> None:
    known = read("x > 0"), read("x < 9")
    context = BlockContext(Budget(), frozenset()).given(known)
    context.step("a rule", read("x > 1"), read("x > 2"), "why", {"it": 1})
    context.step("a rule", read("x > 2"), read("x > 3"))
    first, second = (entry for entry in context.log.entries if isinstance(entry, Step))
    assert first.context == conj(known) and first.evidence == {"detail": "why", "proof": {"it": 1}}
    assert (first.rule, first.before, first.after) == ("a rule", read("x > 1"), read("x > 2"))
    assert second.evidence == {}
