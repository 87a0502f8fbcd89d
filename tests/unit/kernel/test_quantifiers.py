"""The primitive "quantifiers": what the laws of quantifiers allow, and what they do not."""

from __future__ import annotations

from fractions import Fraction

import pytest

from experiments.reference import decide
from qe.formula.build import exists, forall
from qe.formula.evaluate import substituted
from qe.formula.syntax import Formula
from qe.kernel.quantifiers import scoped
from tests.enough import sized
from tests.strategies import NAMES, formulas, points
from tests.unit.certify.claims import objection

EQUIVALENT = [
    ("ex x. x > a or x^2 < b", "(ex x. x > a) or (ex x. x^2 < b)"),
    ("ex x. x > a or b > 0", "b > 0 or (ex x. x > a)"),
    ("ex x. x > a or b > 0", "(ex x. x > a) or (ex x. b > 0)"),
    ("ex x, y. x > a and y^2 < b", "(ex x. x > a) and (ex y. y^2 < b)"),
    ("ex x, y. x > a and y^2 < b and c > 0", "c > 0 and (ex y. y^2 < b) and (ex x. x > a)"),
    ("ex x, y, z. x > a and y > z", "(ex x. x > a) and (ex y, z. y > z)"),
    ("ex x. x > a and (ex y. y > b)", "(ex x. x > a) and (ex y. y > b)"),
    ("ex x. x > a and (ex y. y > x)", "ex x, y. x > a and y > x"),
    ("ex x. (ex y. y > x and (ex z. z > y)) and x > a", "ex x, y, z. y > x and z > y and x > a"),
    ("ex x. (ex y. y > x) and (ex z. z < x)", "ex x, y. y > x and (ex z. z < x)"),
    ("ex x. x > a and (ex y. y > x or y^2 < x)", "ex x, y. x > a and (y > x or y^2 < x)"),
    ("ex x. x > a or (ex y. y > x)", "ex x, y. x > a or y > x"),
    ("all x. x > a or (all y. y > x)", "all x, y. x > a or y > x"),
    ("all x. x > a and x^2 < b", "(all x. x > a) and (all x. x^2 < b)"),
    ("ex x. x > a", "ex y. y > a"),
    ("ex x. x > a", "ex x, y. x > a"),
    ("ex x. all y. x*y > a", "ex z. all x. z*x > a"),
    ("not (ex x. x > a and b > 0)", "b <= 0 or (all x. x <= a)"),
    ("not (a > root(1, a^2 - b) and b > 0)", "not (a > root(1, a^2 - b)) or b <= 0"),
    ("ex x. x - b > 0", "ex a. a - b > 0"),
]

DIFFERENT = [
    ("ex x. x > a and x^2 < b", "(ex x. x > a) and (ex x. x^2 < b)"),
    ("ex x, y. x > a and y > x", "(ex x. x > a) and (ex y. y > x)"),
    ("ex x, y. x > a and y^2 < b", "(ex x. x > a) or (ex y. y^2 < b)"),
    ("ex x, y. x > a and y^2 < b", "ex x. x > a"),
    ("ex x, y. x > a and y^2 < b", "(ex x. x > a) and (all y. y^2 < b)"),
    ("ex x. x > a or b > 0", "x > a or b > 0"),
    ("ex x. x > a and (ex y. y > x) and y < a", "ex x, y. x > a and y > x and y < a"),
    ("ex x. (ex y. y > x) and (ex y. y < x and y > a)", "ex x, y. y > x and y < x and y > a"),
    ("ex x. y < x and (ex y. y > x)", "ex x, y. y < x and y > x"),
    ("ex x. x > a and (ex x. x < b)", "ex x. x > a and x < b"),
    ("ex x. x > a and (all y. y > x)", "ex x, y. x > a and y > x"),
    ("all x. x > a or x <= b", "(all x. x > a) or (all x. x <= b)"),
    ("ex x. all y. x*y > a", "all y. ex x. x*y > a"),
    ("ex x, y. x < y + a and x > y", "ex x, y. y < x + a and x > y"),
    ("ex x. x^2 > a", "ex x. x^2 >= a"),
    ("ex x. x^2 > a", "ex x. x^2 > b"),
    ("not (a > root(1, a^2 - b) and b > 0)", "a <= root(1, a^2 - b) or b <= 0"),
    ("ex x, y. all z. ex a, b. z^2 < x + y + a + b", "ex x, y. all z. ex a, b. b^2 < x + y + a + z"),
]


@pytest.mark.parametrize(("before", "after"), EQUIVALENT)
def test_what_the_laws_allow_is_accepted_either_way(before: str, after: str) -> None:
    assert objection("quantifiers", before, after) == ""
    assert objection("quantifiers", after, before) == ""


@pytest.mark.parametrize(("before", "after"), DIFFERENT)
def test_what_they_do_not_is_rejected_either_way(before: str, after: str) -> None:
    assert "differ in more than" in objection("quantifiers", before, after)
    assert "differ in more than" in objection("quantifiers", after, before)


def test_there_is_no_evidence_to_give() -> None:
    assert objection("quantifiers", "ex x. x > a", "ex x. x > a", {"names": []})


@sized(8, 25, formulas(names=NAMES[:2]), formulas(names=NAMES[:2]), points(NAMES[:1]))
def test_quantifiers_that_went_in_say_the_same(one: Formula, other: Formula, point: dict[str, Fraction]) -> None:
    x, y = NAMES[:2]
    for whole in (exists((y,), one & forall((y,), other)), forall((y,), one | other), exists((x, y), one | ~other)):
        sides = (substituted(f, {k: v for k, v in point.items() if k in f.free}) for f in (whole, scoped(whole)))
        assert len({decide(side) for side in sides}) == 1
