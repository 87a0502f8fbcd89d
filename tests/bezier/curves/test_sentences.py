"""Sentences about curves: how they read, that true ones are proved and false ones are not."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from bezier.curves.curve import Bezier
from bezier.curves.sentences import UNIT, CurveSentence
from qe.exact.field import NumberField
from qe.formula.syntax import Relation
from tests.tables import each

ROOT2 = NumberField.from_root([-2, 0, 1], 1, 2).generator()
SMALLEST = NumberField.from_root([1, -3, 0, 1], Fraction(-2), Fraction(-3, 2)).generator()  # of three real roots
WHOLE = (*UNIT, 0)
ARCH = Bezier.of([(-1, 0), (0, 2), (1, 0)])


def disc(square: Fraction | int, relation: Relation = Relation.GT) -> Any:
    return {(2, 0): Fraction(1), (0, 2): Fraction(1), (0, 0): -Fraction(square)}, relation


@each(
    (ARCH, "ex t, x, y. t >= 0 and t - 1 <= 0 and 2*t - x - 1 = 0 and 4*t^2 - 4*t + y = 0 and x^2 + y^2 - 4 > 0"),
    (
        Bezier.of([(ROOT2, 0), (0, ROOT2)]),
        "ex root, t, x, y. root^2 - 2 = 0 and root - 1 >= 0 and 2*root - 3 <= 0 and t >= 0 and t - 1 <= 0 and"
        " root*t - root + x = 0 and root*t - y = 0 and x^2 + y^2 - 4 > 0",
    ),
    (
        Bezier.of([(SMALLEST, 0)]),
        "ex root, t, x, y. root^3 - 3*root + 1 = 0 and root + 2 >= 0 and 2*root + 3 <= 0 and t >= 0 and t - 1 <= 0 and"
        " root - x = 0 and y = 0 and x^2 + y^2 - 4 > 0",
    ),
)
def test_how_they_read(curve: Bezier, words: str) -> None:
    sentence = CurveSentence(curve, [[disc(4)]])
    assert str(sentence.formula) == words
    certificate = sentence.refuted([[WHOLE]])
    assert certificate is not None and qe.verify(certificate, formula=sentence.formula, core=True).accepted


@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 4), min_size=1, max_size=3), st.integers(0, 25), st.booleans())
@settings(deadline=None, max_examples=60)
def test_over_a_field_what_is_false_is_not_proved(rows: Any, square: int, strict: bool) -> None:
    """Control points a + b sqrt(2): a proof is accepted, and none is made where a point is outside."""
    curve = Bezier.of([(a + b * ROOT2, c + d * ROOT2) for a, b, c, d in rows])
    sentence = CurveSentence(curve, [[disc(square, Relation.GE if strict else Relation.GT)]])
    places = [curve.point(Fraction(k, 8)) for k in range(9)]
    margins = [square - x * x - y * y for x, y in places]
    is_outside = any(m <= 0 if strict else m < 0 for m in margins)
    certificate = sentence.refuted([[(Fraction(k, 4), Fraction(k + 1, 4), 0) for k in range(4)]])
    assert certificate is None or (not is_outside and qe.verify(certificate, core=True).accepted)


@pytest.mark.parametrize("t", [Fraction(0), Fraction(1, 3), Fraction(1)])
@pytest.mark.parametrize("curve", [ARCH, Bezier.of([(ROOT2, 0), (0, ROOT2)])])
def test_what_holds_at_a_point(curve: Bezier, t: Fraction) -> None:
    sentence = CurveSentence(curve, [[disc(5)], [disc(4, Relation.LE)]], (t, t))
    assert qe.verify(sentence.holds_at(t), formula=sentence.formula, core=True).accepted
    assert not qe.verify(replace(sentence, systems=[[disc(5)]]).holds_at(t)).accepted
    if t:
        assert qe.verify(replace(sentence, between=(t / 2, t)).holds_at(t), core=True).accepted
        assert not qe.verify(replace(sentence, between=(t / 2, t), before=True).holds_at(t)).accepted
        assert not qe.verify(replace(sentence, between=(t / 3, t / 2)).holds_at(t)).accepted


def test_ends_that_do_not_belong_make_a_difference() -> None:
    """The arch is at height 1 at t = 1/2 alone."""
    top = [[({(0, 1): Fraction(1), (0, 0): Fraction(-1)}, Relation.GE)]]
    half = Fraction(1, 2)
    for between, options, is_proved in (
        ((Fraction(0), half), {}, False),
        ((Fraction(0), half), {"before": True}, True),
        ((half, Fraction(1)), {}, False),
        ((half, Fraction(1)), {"after": True}, True),
    ):
        certificate = CurveSentence(ARCH, top, between, **options).refuted([[WHOLE]])
        assert (certificate is not None and qe.verify(certificate, core=True).accepted) is is_proved


def test_many_intervals_of_two_pieces_over_a_field() -> None:
    """Bernstein coefficients on sixteen intervals of each of two discs beside the curve."""
    curve = Bezier.of([(x + ROOT2, y) for x, y in ARCH.points])
    small = {(2, 0): Fraction(-1), (0, 2): Fraction(-1), (1, 0): Fraction(3)}  # around (3/2, 0) and (3/2, 2)
    discs = [{**small, (0, 1): 4 * h, (0, 0): Fraction(-43, 20) - 4 * h} for h in map(Fraction, (0, 1))]
    spans = [(Fraction(k, 16), Fraction(k + 1, 16), 0) for k in range(16)]
    certificate = CurveSentence(curve, [[(terms, Relation.GE)] for terms in discs]).refuted([spans, spans])
    assert certificate is not None and qe.verify(certificate, core=True).accepted
