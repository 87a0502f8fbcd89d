"""Ranges that exclude a condition: what is found, that it is right, and what the checker refuses."""

from collections.abc import Callable
from fractions import Fraction
from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.rules.ranges as ranges
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, Exists
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.step import Step
from qe.proving.prover import Prover
from qe.rules.step import StepKind
from tests.tables import each
from tests.unit.proving.elaborated import refused
from tests.unit.rules.applied import steps_of

ONLY = frozenset({StepKind.RANGES})
RULE = StepKind.RANGES.value


def prover(step: Step) -> Prover:
    assert step.before.ring is not None
    return Prover(step.before.ring, Options(), Budget(), tables=False)


def accepted(step: Step) -> bool:
    return prover(step).own(step, ()) is not None


def small_product(size: int, sphere: str = "< 1", above: str = "> 1") -> str:
    """A ball and a product of all coordinates that is too large for it (Hong 1991)."""
    names = [f"x{i}" for i in range(size)]
    return f"ex {', '.join(names)}. {' + '.join(f'{x}^2' for x in names)} {sphere} and {'*'.join(names)} {above}"


FALSE_ONES = (
    small_product(2),
    small_product(16),
    small_product(5, "<= 4", "> 32"),
    "ex x, y. x^3 - y >= 8 and y >= 0 and x + z^2 < 2",
    "ex x, y. x*y > 1 and x^2 + y^4 <= 1/2 and a > 0",
    "ex x, y. x + y^2 <= 3 and -x <= -4",
    "ex x, y. 2*x^3 + y^2 = -5 and x^5 > 0",
    "ex x, y. x^2 + y^2 = 2 and x^4*y^2 = 9",
    "ex x, y. x - y^2 >= 0 and x <= 1/7 and y^3 > 1",
    "ex x, y. -x^3 - y^2 >= 27 and x + 3 > 0",
)


@pytest.mark.parametrize("text", FALSE_ONES)
def test_what_is_false_by_ranges(text: str) -> None:
    (step,) = steps_of(read(text), StepKind.RANGES)
    assert step.after == FALSE
    assert accepted(step)


@each(
    small_product(3, "<= 3", ">= 1"),  # at one point
    "ex x, y. x^2 + y^2 <= 2 and x*y >= 1",
    "ex x, y. x^2 - y^2 <= 1 and x > 5",  # nothing bounds y
    "ex x, y. x^2 + y^2 <= 1 and x*y /= 5",
    "ex x, y. x < 1 and x > 2 + y and y > 0",  # linear: left to others
    "ex x, y. x^2 + y^2 <= 1 or x*y > 3",
)
def test_what_is_left_to_others(text: str) -> None:
    assert not steps_of(read(text), StepKind.RANGES)


def test_sentences_are_decided_with_a_certificate() -> None:
    answer = qe.eliminate(small_product(16), check=True)
    assert answer.truth is False
    assert [step.rule for step in answer.derivation.steps] == [RULE]
    assert answer.certificate is not None
    assert qe.verify(answer.certificate).accepted
    assert qe.eliminate("all x, y. x^2 + y^2 <= 2 -> x*y^3 < 5").truth is True


POLYS = ("x^2 + y^2", "x*y", "x^3", "x + y^2", "x^2*y", "-x^2 + y", "2*x - y^3", "x^4", "y", "x*y^2 - x^2")


@settings(deadline=None, max_examples=100)
@given(
    st.lists(
        st.tuples(st.sampled_from(POLYS), st.sampled_from(["<", "<=", "=", ">=", ">"]), st.integers(-4, 4)),
        min_size=2,
        max_size=5,
    )
)
def test_no_point_is_lost(conditions: list[tuple[str, str, int]]) -> None:
    """Where the rule says false, the checker agrees and none of many points satisfies all conditions."""
    found = steps_of(read("ex x, y. " + " and ".join(f"{p} {r} {c}" for p, r, c in conditions)), StepKind.RANGES)
    if not found:
        return
    (step,) = found
    assert accepted(step)
    assert isinstance(step.before, Exists)
    values = [Fraction(k, 2) for k in range(-8, 9)]
    names = step.before.body.free
    assert not any(
        holds_at(step.before.body, dict(zip(names, point, strict=True))) for point in product(values, repeat=len(names))
    )


def said(text: str, change: Callable[[dict[str, Any]], None] = lambda evidence: None) -> str:
    """Why a step with this evidence is none of the kernel's; nothing where it is."""
    (step,) = steps_of(read(text), StepKind.RANGES)
    evidence: Any = prover(step)._json(step.evidence["proof"])
    change(evidence)
    return refused(RULE, step.before, step.after, evidence)


def test_the_evidence_as_it_is() -> None:
    assert said(FALSE_ONES[0]) == ""


CHANGES: dict[str, Callable[[dict[str, Any]], None]] = {  # which leave too little to go by
    "tighter": lambda e: e["bounds"][0].__setitem__(4, "1/2"),
    "no bounds": lambda e: e.__setitem__("bounds", []),
    "other condition fails": lambda e: e.__setitem__("fails", 0),
    "no such condition": lambda e: e.__setitem__("fails", 7),
    "negative": lambda e: e.__setitem__("fails", -1),
    "other variable": lambda e: e["bounds"][0].__setitem__(1, "nobody"),
    "other side": lambda e: e["bounds"][0].__setitem__(3, -e["bounds"][0][3]),
    "no side": lambda e: e["bounds"][0].__setitem__(3, 0),
    "not a number": lambda e: e["bounds"][0].__setitem__(4, 1),
    "short": lambda e: e["bounds"][0].pop(),
    "more": lambda e: e.__setitem__("other", 1),
}


@pytest.mark.parametrize("name", CHANGES)
def test_what_is_refused(name: str) -> None:
    assert said(FALSE_ONES[0], CHANGES[name])


def test_only_a_block_that_becomes_false() -> None:
    (step,) = steps_of(read(FALSE_ONES[0]), StepKind.RANGES)
    evidence: Any = prover(step)._json(step.evidence["proof"])
    for before, after in ((step.before, read("x0 > 1")), (read("x0*x1 > 1"), FALSE)):
        assert refused(RULE, before, after, evidence)


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(1, 3), st.integers(-9, 9)), min_size=2, max_size=4))
def test_the_rough_search_misses_no_refutation(rows: list[tuple[int, int, int]]) -> None:
    conditions = " and ".join(f"{a}*x^{k} + y {'<=' if b % 2 else '>='} {b}" for a, k, b in rows)
    for scale in (1, 10**40):
        text = f"ex x, y. x^2 + y^2 <= {9 * scale} and {conditions} and x >= {scale}*y"
        found = [bool(steps_of(read(text), StepKind.RANGES))]
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(ranges, "_may_fail", lambda conditions: True)
            found.append(bool(steps_of(read(text), StepKind.RANGES)))
        assert found[0] == found[1]


BROKEN: dict[str, tuple[str, Callable[..., Any], str]] = {
    "root too small": (
        "_root_above",
        lambda value, k: ranges._root_below(value, k) - 1,
        "ex x, y. x^3 + y^2 <= 7 and x^5 > 20",
    ),
    "infinite times anything": ("times", lambda a, b: Fraction(0), "ex x, y. x^2 + y^2 <= 3 and x*y >= 1"),
    "nothing is unbounded": (
        "_sum",
        lambda values, zero: sum((v for v in values if v != -ranges.inf), zero),
        "ex x, y. x^2 + y <= 3 and x >= 5",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_search_is_not_believed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    function, broken, text = BROKEN[name]
    assert not steps_of(read(text), StepKind.RANGES)
    monkeypatch.setattr(ranges, function, broken)
    monkeypatch.setattr(ranges, "_may_fail", lambda conditions: True)
    (step,) = steps_of(read(text), StepKind.RANGES)
    assert not accepted(step)
