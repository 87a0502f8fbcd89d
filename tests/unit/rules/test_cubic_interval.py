"""Cubics on intervals: the conditions against decisions at numbers, the rule's side conditions, its checker."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
import qe.rules.cubic_interval as cubic_interval
from qe.certify.cubic_interval import check_cubic_interval

import qe
from qe.api.input import read_formula
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_broken_producers import accepted
from tests.unit.certify.claims import NO_LEMMAS, objection

FORM = "a*(1 - x)^3 + b*x*(1 - x)^2 + c*x^2*(1 - x) + d*x^3"
UNIT = f"ex x. 0 <= x and x <= 1 and {FORM}"
TAKEN = [
    f"{UNIT} < 0",
    f"{UNIT} <= 0",
    f"{UNIT.replace('<=', '<')} < 0",
    f"ex x. x > 0 and -x >= -1 and {FORM} > 0",
    f"ex x. 2*x >= -3 and {FORM} < 0",
    "ex x. 3*x < c and a*x^3 + b*x + d > 0",
    "c > b and (ex x. b <= x and 2*x <= 2*c and x^3 - a*x - d >= 0)",
]
SMALL = (0, 0, 0, 1, 1, -1, 2, -2, 3, Fraction(1, 2), Fraction(-3, 2))


def steps_of(text: str) -> list[Step]:
    """The steps of this rule alone."""
    log = RunLog()
    prepare(read_formula(text), enabled={StepKind.CUBIC_INTERVAL}, log=log)
    return [step for step in log.steps() if step.rule == StepKind.CUBIC_INTERVAL.value]


@pytest.mark.parametrize("text", TAKEN)
def test_the_coefficients_tell_what_the_block_does(text: str) -> None:
    """Parameters at random, often with zeros at the ends, multiple roots, or a degree that drops."""
    (step,) = steps_of(text)
    assert accepted(step)
    rng, seen = random.Random(3), set()
    for _ in range(30):
        values = {name: Fraction(rng.choice(SMALL)) for name in "abcd"}
        values["c"] = values["b"] + 1 if text.startswith("c > b") else values["c"]
        sides = [qe.decide(side.substitute(values), process=False) for side in (step.before, step.after)]
        assert sides[0] is sides[1], values
        seen.add(sides[0])
    assert seen == {True, False}


@pytest.mark.parametrize("double", [Fraction(0), Fraction(1, 3), Fraction(1), Fraction(2)])
@pytest.mark.parametrize("simple", [Fraction(-1), Fraction(0), Fraction(1, 2), Fraction(1), None])
@pytest.mark.parametrize("sign", [1, -1])
def test_multiple_roots(double: Fraction, simple: Fraction | None, sign: int) -> None:
    """A double root inside, at an end or outside, beside another root, or one at infinity."""
    u, t = sign * double**2, -2 * sign * double  # the polynomial sign*(x - double)^2*(x - simple) by its powers
    powers = [u, t, sign, 0] if simple is None else [-simple * u, u - simple * t, t - simple * sign, sign]
    for relation in ("<", "<="):
        (step,) = steps_of(f"ex x. 0 <= x and x <= 1 and d*x^3 + c*x^2 + b*x + a {relation} 0")
        values = dict(zip("abcd", map(Fraction, powers), strict=True))
        before, after = (qe.decide(side.substitute(values), process=False) for side in (step.before, step.after))
        assert before is after


@pytest.mark.parametrize(
    "text",
    [
        f"{UNIT.replace('0 <=', '0 <')} <= 0",  # a zero at an end that does not belong to the interval
        f"ex x. 0 <= x and {FORM} <= 0",
        f"{UNIT} = 0",
        "ex x. b <= x and x <= c and x^3 - a*x - d < 0",  # perhaps no interval
        "ex x. 0 <= x and 1 <= 2*x and x^3 + a*x^2 + b*x + c < 0",
        "ex x. a*x >= 1 and x <= 1 and x^3 + b*x + c < 0",
        "ex x. 0 <= x and x <= 1 and x^4 + a*x^2 + b*x + c < 0",
        "ex x. 0 <= x and x <= 1 and x^3 + a*x + b < 0",  # two parameters
    ],
)
def test_others_are_left_alone(text: str) -> None:
    assert not steps_of(text)


def test_the_answer_is_short() -> None:
    """A cubic by its Bernstein coefficients: 1981 characters by virtual substitution of roots."""
    answer = qe.eliminate(f"all x. 0 <= x and x <= 1 -> {FORM} >= 0").formula
    assert len(str(answer)) < 200


# --- the checker -----------------------------------------------------------------------------------------------------
BLOCK = "ex x. x >= 0 and x <= 1 and x^3 + a*x^2 + b*x + c < 0"
D = "a^2*b^2 - 4*b^3 - 4*a^3*c + 18*a*b*c - 27*c^2"
B, C, END = "b + 3*c >= 0", "a + 2*b + 3*c >= 0", "a + b + c + 1"
AFTER = (
    f"not (c >= 0 and {END} >= 0 and ({B} and {C} or "
    f"{D} <= 0 and (c > 0 or b + 3*c > 0) and (a + 2*b + 3*c > 0 or {END} > 0)))"
)
CLOSED = f"not (c > 0 and {END} > 0 and ({B} and {C} or {D} < 0))"


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        (BLOCK, AFTER, ""),
        (BLOCK.replace("x >= 0", "x > 0"), AFTER, ""),
        (BLOCK.replace("x^3 + a*x^2 + b*x + c < 0", "-x^3 - a*x^2 - b*x - c > 0"), AFTER, ""),
        (BLOCK.replace("c < 0", "c <= 0"), CLOSED, ""),
        (BLOCK, CLOSED, "do not exclude"),
        (BLOCK.replace("c < 0", "c <= 0"), AFTER, "do not exclude"),
        (BLOCK.replace("c < 0", "c <= 0").replace("x >= 0", "x > 0"), CLOSED, "closed and bounded"),
        (BLOCK.replace("c < 0", "c <= 0").replace("x <= 1 and", ""), CLOSED, "closed and bounded"),
        (BLOCK.replace("c < 0", "c = 0"), CLOSED, "one inequality"),
        (BLOCK.replace("c < 0", "c /= 0"), AFTER, "one inequality"),
        (BLOCK.replace("c < 0", "c > 0"), AFTER, "do not exclude"),
        (BLOCK.replace("x <= 1", "x <= 2"), AFTER, "do not exclude"),
        (BLOCK.replace("x <= 1", "x <= -1"), AFTER, "do not exclude"),
        (BLOCK.replace("x <= 1", "x >= 1"), AFTER, "one bound on a side"),
        (BLOCK.replace("x <= 1", "a*x <= 1"), AFTER, "a number as coefficient"),
        (BLOCK.replace("x^3", "x^4"), AFTER, "degree 3"),
        (BLOCK.replace("x >= 0", "x*y >= 0").replace("ex x", "ex x, y"), AFTER, "one variable"),
        (BLOCK.replace("and", "or"), AFTER, "several conditions"),
        (BLOCK, AFTER.replace(" and (c > 0 or b + 3*c > 0)", ""), "do not exclude"),
        (BLOCK, AFTER.replace(B, "b + 2*c >= 0"), "do not exclude"),
        (BLOCK, AFTER.replace("27*c^2", "26*c^2"), "do not exclude"),
        (BLOCK, AFTER.replace("not (", "("), "do not exclude"),
    ],
)
def test_what_the_checker_says(before: str, after: str, reason: str) -> None:
    found = objection(check_cubic_interval, before, after, {"theory": NO_LEMMAS})
    assert reason in found and bool(found) is bool(reason)


def test_evidence_that_is_not_asked_for() -> None:
    assert objection(check_cubic_interval, BLOCK, AFTER, {"theory": NO_LEMMAS, "along": "x"})


def no_discriminant(m: pytest.MonkeyPatch) -> None:
    """The discriminant counts as negative."""
    m.setattr(cubic_interval, "discriminant", lambda powers: powers[0] * 0 - 1)


def no_edge(m: pytest.MonkeyPatch) -> None:
    """The coefficients of the polynomial stand for those on the interval."""
    m.setattr(cubic_interval, "on_edge", lambda powers, ends: tuple(powers))


def any_interval(m: pytest.MonkeyPatch) -> None:
    """Only what is below the upper end is asked."""
    ends = cubic_interval.interval
    m.setattr(cubic_interval, "interval", lambda bounds, x: ends(bounds[-1:], x))


@pytest.mark.parametrize("broken", [no_discriminant, no_edge, any_interval])
def test_a_broken_producer_is_not_believed(broken: object, monkeypatch: pytest.MonkeyPatch) -> None:
    broken(monkeypatch)  # type: ignore[operator]
    (step,) = steps_of(f"{UNIT} < 0")
    assert not accepted(step)
