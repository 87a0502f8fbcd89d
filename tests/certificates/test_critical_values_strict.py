"""Critical values where all inequalities are strict, and where the body is a disjunction."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.errors import CertificateRejected, Unable
from qe.formula.build import convert
from qe.formula.syntax import Exists
from qe.io.text import read
from tests.certificates.test_critical_values import block, check, example, made

DISC = "ex x, y. (x - a)^2 + (y - b)^2 < 1 and x^2 + y^2 < 4"
SLIDE = "ex x. (x - a)^2 < 1 and x^2 < 4"
CUTS = "ex x, y. (x - a)^2 + y^2 < 1 and x^2 + y^2 < 4 and x + y = 1"


def proved(before: Exists, after: str, order: tuple[str, ...]) -> bool:
    """Whether an answer has evidence that is accepted."""
    wanted = read(after)
    try:
        check(before, wanted, made(before, wanted, order))
    except (CertificateRejected, Unable):
        return False
    return True


@pytest.mark.parametrize(
    ("text", "after", "order"),
    [
        (DISC, "a^2 + b^2 < 9", ("a", "b")),
        (SLIDE, "a < 3 and a > -3", ("a",)),
        (SLIDE, "a^2 < 9", ("a",)),
        (SLIDE, "(a - 4)*(a^2 - 9) > 0 and a < 4", ("a",)),  # no convex conditions: a table of the complement
        (DISC, "(a^2 + b^2 - 9)*(a^2 + 1) < 0", ("a", "b")),
    ],
)
def test_open_sets(text: str, after: str, order: tuple[str, ...]) -> None:
    assert proved(block(text), after, order)


@pytest.mark.parametrize(
    ("text", "after", "order"),
    [
        (DISC, "a^2 + b^2 <= 9", ("a", "b")),
        (DISC, "a^2 + b^2 < 8", ("a", "b")),
        (DISC, "a^2 + b^2 < 9 and a /= b", ("a", "b")),
        (DISC, "a^2 + b^2 < 9 and (a /= 0 or b /= 0)", ("a", "b")),
        (DISC, "a^2 + b^2 < 9 or a = 4 and b = 0", ("a", "b")),
        (SLIDE, "a < 3 and a >= -3", ("a",)),
        (SLIDE, "a^2 < 9 and a /= 1", ("a",)),
        (SLIDE, "a^2 < 9 or a = 3", ("a",)),
        (SLIDE, "a <= 3 and a >= -3", ("a",)),
        (SLIDE.replace("<", "<="), "a < 3 and a > -3", ("a",)),
        (SLIDE.replace("< 4", "<= 4"), "a < 3 and a > -3", ("a",)),  # of both kinds: the theorem says nothing
        (SLIDE.replace("< 4", "<= 4"), "a <= 3 and a >= -3", ("a",)),
    ],
)
def test_what_is_no_open_set_or_not_this_one(text: str, after: str, order: tuple[str, ...]) -> None:
    assert not proved(block(text), after, order)


def test_the_evidence_of_weak_conditions_does_not_serve() -> None:
    weak, strict = "ex x. (x - a)^2 <= 1 and x^2 <= 4", block(SLIDE)
    _, answer, evidence = example(weak)
    with pytest.raises(CertificateRejected):
        check(strict, answer, evidence)
    check(strict, read("a < 3 and a > -3"), evidence)  # the same chains, cells, points and weights
    with pytest.raises(CertificateRejected):
        check(block(weak), read("a < 3 and a > -3"), evidence)


@settings(max_examples=6, deadline=None, derandomize=True)
@given(st.integers(1, 3), st.integers(1, 4), st.integers(-3, 3), st.integers(1, 9))
def test_random_intervals(p: int, q: int, shift: int, size: int) -> None:
    text = f"ex x. {p}*(x - a)^2 < {q} and x^2 + {shift}*x < {size}"
    answer = qe.eliminate(text, method="critical", check=True, timeout=120)
    assert (answer.guarantee, answer.unchecked_steps) == (qe.Guarantee.CHECKED, ())


@pytest.mark.parametrize(
    "text",
    [
        "ex x, y. ((x - a)^2 + (y - b)^2 <= 1 or (x - a)^2 + (y + b)^2 <= 2) and x^2 + y^2 <= 4",
        "all x. not (((x - a)^2 <= 1 or (x + 2*a)^2 <= 2) and x^2 <= 4)",
        "ex x. ((x - a)^2 <= 1 or x^2 + a^2 <= 3) and x^2 <= 3 and a <= 2",
    ],
)
def test_disjuncts_have_steps_of_their_own(text: str) -> None:
    answer = qe.eliminate(text, method="critical", check=True, timeout=120)
    assert (answer.guarantee, answer.unchecked_steps) == (qe.Guarantee.CHECKED, ())
    assert [step.rule for step in answer.derivation.steps].count("critical values") == 2
    assert answer.certificate is not None and qe.verify(answer.certificate, formula=text).accepted
    if "y" not in text:
        assert qe.equivalent(answer.formula, qe.eliminate(text, method="cad").formula)


def test_a_false_answer_of_one_disjunct_is_refused() -> None:
    """The steps are checked one by one: a disjunct too few, or too small a set, has no evidence."""
    before = block("ex x. ((x - a)^2 <= 1 or (x - a + 9)^2 <= 1) and x^2 <= 4")
    first = block("ex x. (x - a)^2 <= 1 and x^2 <= 4")
    assert proved(first, "a <= 3 and a >= -3", ("a",))
    assert not proved(first, "a <= 2 and a >= -3", ("a",))
    whole = convert(read("a <= 3 and a >= -3 or a >= 6 and a <= 12"), first.ring)  # type: ignore[arg-type]
    with pytest.raises(CertificateRejected):
        check(before, whole, example("ex x. (x - a)^2 <= 1 and x^2 <= 4")[2])
