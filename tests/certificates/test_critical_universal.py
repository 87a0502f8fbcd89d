"""Universal blocks with convex truth sets: proved on open cells; altered evidence and false claims are not."""

from __future__ import annotations

import functools
import json
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.expert.critical_universal as checker
from qe.certify.registry import RULES
from qe.certify.verify import verify_json
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import TRUE
from qe.io.text import read
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.derivation import moved
from qe.proof.entry import Entry, formula_to_json
from qe.proving.critical import universal_evidence
from tests.certificates.mutation import leaves, lists, replaced, without

RULE = "critical values of a universal block"
PARABOLA = "all t. 0 <= t and t <= 1 -> (a - t)^2 + (b - t^2)^2 <= 4"
BERNSTEIN = "all t. 0 < t and t < 1 -> (1 - t)^2*a + 2*t*(1 - t)*b + t^2 >= 0"
TWO = "all t. 0 <= t and t <= 1 -> a*t - b <= 1 and b*t - a <= t^2"
LINE = "all t. -1 <= t and t <= 2 -> a*t^2 - t <= 1"
AT_END = "all t. 0 <= t and t <= 1 -> t*(1 - t)^2*(a^2 + t*b - 1) <= 0"
WITHOUT = "all t. 0 <= t and t <= 1 -> a*t - b <= 1 and (1 - t)*(a - 2) <= 0"


@functools.cache
def example(text: str) -> str:
    answer = qe.eliminate(text, method="critical", check=True, process=False)
    assert [step.rule for step in answer.derivation.steps] == [RULE]
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps and answer.certificate is not None
    return answer.certificate.to_json()


def refused(text: str) -> bool:
    verdict = verify_json(text)
    return not verdict.accepted and verdict.step != "digest"


@pytest.mark.parametrize("text", [PARABOLA, BERNSTEIN, TWO, LINE, AT_END])
def test_it_is_accepted(text):
    assert qe.verify(Certificate.from_json(example(text)), formula=text).accepted


@pytest.mark.parametrize(("answer", "accepted"), [("a*1 - b <= 1 and b >= -1 and a <= 2", True), ("a <= 2", False)])
def test_an_inequality_without_the_quantified_variable_is_proved(answer, accepted):
    """The derivative by y is 0 then, from which no chain can begin: the ends of the interval say all."""
    before = read(WITHOUT)
    claim = Claim(RULE, before, convert(read(answer), before.ring), before.ring, Entry({}, "evidence"), "step")
    budget = Budget(20)
    try:
        evidence = universal_evidence(claim, ("a", "b"), Options(), budget)
        checker.check_critical_universal(
            replace(claim, evidence=Entry(evidence, "evidence")), (), limits_of(budget, RULES)
        )
    except qe.CertificateRejected:
        assert not accepted
    else:
        assert accepted


@settings(max_examples=12, deadline=None)
@given(st.integers(-2, 2), st.integers(-2, 2), st.integers(1, 3), st.integers(0, 2))
def test_whatever_is_found_is_accepted(p, q, size, shift):
    text = f"all t. 0 <= t and t <= {size} -> (a - {p}*t)^2 + {shift}*b*t <= {q}*t + 3"
    answer = qe.eliminate(text, method="critical", check=True, process=False)
    if answer.formula is not None and RULE in [step.rule for step in answer.derivation.steps]:
        assert RULE not in answer.unchecked_steps


@pytest.mark.parametrize("text", [LINE, BERNSTEIN, AT_END])
def test_altered_evidence_is_refused(text):
    whole = json.loads(example(text))
    step = ("payload", "steps", 0)
    count = 0
    for path, value in list(leaves(whole)):
        if path[:4] == (*step, "evidence") and path[4] in ("chains", "order", "exceptions"):
            count += refused(replaced(whole, path, value + 1 if isinstance(value, int) else "0"))
            assert refused(replaced(whole, path, "x"))
    assert count > 3
    for path, items in list(lists(whole)):
        if path[:4] == (*step, "evidence") and path[4:5] in (("chains",), ("stacks",), ("factors",)):
            assert all(refused(without(whole, path, k)) for k in range(len(items))), path


def test_what_is_said_of_a_cell_is_looked_at():
    whole = json.loads(example(LINE))
    stacks = ("payload", "steps", 0, "evidence", "stacks")
    for k, (_, said) in enumerate(whole["payload"]["steps"][0]["evidence"]["stacks"]):
        assert refused(replaced(whole, (*stacks, k, 1), -1 if said >= 0 else 0))
        assert refused(replaced(whole, (*stacks, k, 1), 99))


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
def test_other_answers_are_refused(text, other):
    whole = json.loads(example(text))
    answer = moved(read(other), Ring.of(whole["payload"]["order"]))
    said = formula_to_json(answer)
    if said == whole["payload"]["answer"]:
        pytest.skip("the same answer")
    whole["payload"]["answer"] = said
    whole["payload"]["steps"][0]["evidence"]["regular"] = None
    assert refused(replaced(whole, ("payload", "steps", 0, "after"), said))


BEYOND = [
    "all t. 0 <= t and t <= 1 -> a*t - a^2 <= 1",  # not convex
    "all t. 0 <= t and t <= 1 -> a*t < 1",  # an open set
    "all t. 0 <= t -> a*t <= 1",  # no interval
    "all t. t^2 <= 1 -> a*t <= 1",  # bounds that are not linear
    "all t. 0 <= t and t <= 0 -> a*t <= 1",  # a point
    "all t. 0 <= t and t <= 1 -> a*t = 1",  # an equation
    "all t. 0 <= t and t <= 1 -> t^2*a^2 - (t - 2)*b^2 - 3*t*a*b <= 1",  # indefinite for some t
    "ex t. 0 <= t and t <= 1 and a*t <= 1",
]


@pytest.mark.parametrize("text", BEYOND)
def test_what_the_theorem_does_not_cover_is_refused(text):
    before = read(text)
    assert before.ring is not None
    claim = Claim(RULE, before, TRUE, before.ring, Entry({}, "evidence"), "step")
    with pytest.raises(qe.CertificateRejected):
        checker.read_parts(claim, before.free)


@given(st.lists(st.integers(-4, 4), min_size=1, max_size=5), st.integers(-3, 2), st.integers(1, 4))
def test_nowhere_negative_means_so_at_all_points(coefficients, low, width):
    ring = Ring.of(("t",))
    poly = ring.from_terms({(k,): c for k, c in enumerate(coefficients) if c})
    found = checker.is_nonnegative(poly, Fraction(low), Fraction(low + width))
    points = [low + Fraction(width * k, 24) for k in range(25)]
    values = [poly.evaluate((point,)) for point in points]
    if found:
        assert min(values) >= 0
    if min(values) < 0:
        assert not found
    square = poly * poly
    assert checker.is_nonnegative(square, Fraction(low), Fraction(low + width))


@given(st.lists(st.integers(-2, 2), max_size=3), st.integers(-3, 3), st.integers(-3, 3), st.sampled_from([1, -1]))
def test_leaving_out_factors_of_one_variable_changes_no_truth(zeros, slope, constant, sign):
    """Where a curve begins at a given point of the sphere, everything was critical there, and no chain was found."""
    ring, (low, high) = Ring.of(("a", "t")), (Fraction(-1), Fraction(2))
    a, t = ring.var("a"), ring.var("t")
    content = ring.constant(sign)
    for zero in zeros:
        content *= t - zero
    whole = content * (a + t * slope + constant)
    kept = checker._without_content(whole, low, high)
    assert kept.degree(0) == 1 and (kept == whole or kept.degree(1) <= 1)
    places = [low + Fraction(3 * k, 24) for k in range(25)]
    for p in (Fraction(k, 2) for k in range(-12, 13)):
        signs = [(whole.evaluate((p, y)), kept.evaluate((p, y))) for y in places]
        assert all(before * after > 0 or not before for before, after in signs)
        assert all(
            before or content.evaluate((0, y)) == 0 or not after
            for (before, after), y in zip(signs, places, strict=True)
        )


def no_shape(m: pytest.MonkeyPatch) -> None:
    m.setattr("qe.proving.critical._table", lambda *_: None)


def no_walls(m: pytest.MonkeyPatch) -> None:
    m.setattr("qe.proving.critical.factor_lists", lambda walls, size, *_: [[] for _ in range(size)])


def any_exception(m: pytest.MonkeyPatch) -> None:
    m.setattr("qe.proving.critical._exception", lambda parts, *_: (0, parts[0].low))


@pytest.mark.parametrize("patch", [no_shape, no_walls, any_exception])
def test_side_conditions_switched_off_in_the_producer_are_seen(patch, monkeypatch):
    patch(monkeypatch)
    answer = qe.eliminate(PARABOLA, method="critical", check=True, process=False)
    assert RULE in answer.unchecked_steps


def test_a_polynomial_that_is_zero_at_an_end_breaks_nothing():
    """There was an internal error: the chain of elimination began with the polynomial 0 (Hong, Liska & Steinberg)."""
    text = "all c. -1 <= c and c <= 1 -> a^2*(1 + 2*c - 2*c^3 - c^4) + c^2 + 2*c + 1 <= 4"
    answer = qe.eliminate(text, check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and qe.equivalent(answer.formula, "2*a^2 <= 1")
