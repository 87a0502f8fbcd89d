"""Critical values where all inequalities are strict or the body is a disjunction, and of universal blocks."""

from __future__ import annotations

import functools
import json
import random
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.elimination.critical.apart as apart
from qe.api.input import read_formula
from qe.elimination.critical.method import ConvexUniversal
from qe.elimination.protocol import Context
from qe.errors import CertificateRejected, Unable
from qe.formula.block import Block
from qe.formula.build import convert
from qe.formula.syntax import Exists
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover
from tests.certificates.altered_derivations import steps
from tests.certificates.test_critical_values import block, check, example, made
from tests.certificates.test_steps_by_hand import accepted

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


RULE_ALONG = "constant along directions"
BAND = "all x. -1 <= x and x <= 1 -> -m <= a + b*x + x^2 and a + b*x + x^2 <= m"


@functools.cache
def example_along(text: str) -> str:
    answer = qe.eliminate(text, method="critical", check=True, process=False)
    assert RULE_ALONG in [step.rule for step in answer.derivation.steps]
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps and answer.certificate is not None
    return answer.certificate.to_json()


def test_random_pieces_are_accepted():
    rng = random.Random(5)
    for _ in range(2):
        p, q, r = (rng.choice((-2, -1, 1, 2, 3)) for _ in range(3))
        text = f"all x. 0 <= x and x <= 1 -> {p}*a + {q}*m + b*x <= x^2 and a*x + {r}*m*x + b <= 2"
        whole = json.loads(example_along(text))
        assert any(step["rule"] == "no exception" for step in steps(whole["payload"]))


def steps_of(text: str) -> list[Step]:
    """The steps of the rule as the method logs them."""
    problem, log = Block.of(read_formula(text)), RunLog()
    assert problem is not None
    assert ConvexUniversal().run(problem, Context(Options(), Budget(20), log)) is not None
    return [step for step in log.steps() if step.rule == RULE_ALONG]


def test_altered_directions_are_refused():
    for step in steps_of(BAND):
        proof = step.evidence["proof"]
        ((name, vector),) = proof["directions"]
        (first, *others), doubled = vector, [[v, w if v == name else 2 * w] for v, w in vector]
        for directions in ([], [[name, doubled]], [[name, others]], [[name, [first]]], [["x", vector]]):
            altered = {"proof": {**proof, "directions": directions}}
            assert not accepted(replace(step, evidence=altered)), directions


def test_another_formula_of_the_same_form_is_refused():
    one, other = steps_of(BAND)
    assert not accepted(replace(one, after=other.after)) and not accepted(replace(other, after=one.after))


def test_pieces_that_are_not_constant_are_not_proved(monkeypatch: pytest.MonkeyPatch):
    """A producer that takes any direction for one of the null space."""
    assert all(accepted(step) for step in steps_of(BAND))
    any_of_three = lambda _, names: dict.fromkeys(sorted(names) if len(names) > 2 else (), Fraction(1))  # noqa: E731
    monkeypatch.setattr(apart, "constant_direction", any_of_three)
    assert [accepted(step) for step in steps_of(BAND)] == [False, False]
