"""Curves in regions, and sentences about curves."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from bezier.curves import bernstein as bs
from bezier.curves.containment import Argument, Inside, Leaves, containment, examine, examine_closely
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Negative, Nonnegative, decide, events_of
from bezier.curves.scalar import sign
from bezier.curves.sentences import UNIT as UNIT_INTERVAL
from bezier.curves.sentences import CurveSentence
from bezier.curves.workspace import Ball, HalfSpace, Workspace, WorkspaceKind
from qe.exact.field import NumberField
from qe.exact.radicals import root_text
from qe.formula.syntax import Relation
from tests.bezier.made import control_points, root2, small, surds
from tests.tables import each

ORIGIN = (Fraction(0),) * 3
GRID = [Fraction(k, 48) for k in range(49)]


def check_proof(b, proof: Nonnegative):
    """Nonnegative coefficients on a cover, or zeros between which the polynomial is positive."""
    for low, high in proof.boxes:
        assert all(sign(c) >= 0 for c in bs.restrict(b, low, high))
    if proof.boxes:
        assert proof.boxes[0][0] == 0 and proof.boxes[-1][1] == 1
        assert all(x[1] == y[0] for x, y in zip(proof.boxes, proof.boxes[1:], strict=False))
        return
    ends = [(Fraction(0),) * 2, *proof.touches, (Fraction(1),) * 2]
    assert all(sign(bs.value(b, (one[1] + two[0]) / 2)) > 0 for one, two in pairwise(ends) if one[1] < two[0])
    assert all(sign(bs.value(b, low)) == 0 for low, high in proof.touches if low == high)


@given(st.lists(small, min_size=1, max_size=7))
def test_decision_agrees_with_sampling_and_proves_itself(b):
    outcome = decide(b)
    if isinstance(outcome, Negative):
        assert 0 <= outcome.t <= 1 and bs.value(b, outcome.t) == outcome.value < 0
    else:
        check_proof(b, outcome)
        assert all(bs.value(b, t) >= 0 for t in GRID)


@given(st.lists(surds, min_size=1, max_size=4), st.lists(surds, min_size=1, max_size=2), st.booleans())
def test_squares_times_something_over_a_number_field(square, factor, flip):
    p = bs.multiply(bs.multiply(square, square), factor)
    p = bs.negate(p) if flip else p
    outcome = decide(p)
    if isinstance(outcome, Negative):
        assert sign(bs.value(p, outcome.t)) < 0
    else:
        check_proof(p, outcome)


@given(st.lists(st.fractions(min_value=-1, max_value=2, max_denominator=9), min_size=1, max_size=5))
def test_isolation_finds_the_roots_inside(roots):
    power = (Fraction(1),)
    for root in roots:
        power = bs.power_multiply(power, (-root, Fraction(1)))
    expected = sorted({r for r in roots if 0 < r < 1})
    found = [event.t for event in events_of((bs.from_power(power),))[1:-1]]
    assert len(found) == len(expected)
    for (low, high), root in zip(found, expected, strict=True):
        assert low == root == high or low < root < high


@given(
    st.lists(st.integers(0, 255), min_size=1, max_size=4, unique=True),
    st.sampled_from([(Fraction(1), Fraction(0)), (Fraction(-1, 2), Fraction(0), Fraction(1))]),
)
def test_roots_are_between_neighbouring_multiples_of_the_width(places, other):
    power = other
    for k in places:
        power = bs.power_multiply(power, (-Fraction(2 * k + 1, 512), Fraction(1)))
    b, width = bs.from_power(power), Fraction(1, 256)
    found = [event.t for event in events_of((b,), width)[1:-1]]
    exact = {(Fraction(2 * k + 1, 512),) * 2 for k in places}
    assert exact <= {*found}
    irrational = [t for t in found if t not in exact]
    assert all(low < high and sign(bs.value(b, low)) * sign(bs.value(b, high)) < 0 for low, high in irrational)
    assert len(found) == len(places) + (len(other) == 3)


@given(control_points(1, 4, dimension=2), st.fractions(min_value=1, max_value=20, max_denominator=4))
def test_ball_against_dense_sampling(control, r2):
    curve, ball = Bezier.of(control), Ball((Fraction(0),) * 2, r2)
    outcome = examine(curve, ball)
    sampled = [ball.margin(curve.point(t)) for t in GRID]
    if isinstance(outcome, Leaves):
        assert ball.margin(curve.point(outcome.t)) == outcome.margin < 0
    else:
        assert min(sampled) >= 0
        if outcome.proof:
            check_proof(ball.margin_along(curve), outcome.proof)


@given(control_points(1, 4, coordinate=surds), st.integers(0, 2))
def test_elevation_leaves_the_answer(control, more):
    curve, ball = Bezier.of(control), Ball(ORIGIN, Fraction(9))
    assert type(examine(curve, ball)) is type(examine(curve.elevate(curve.degree + more), ball))


def test_the_three_arguments():
    ball = Ball((Fraction(0),) * 2, Fraction(1))
    inside = examine(Bezier.of([(0, 0), (1, 0), (0, 1)]), ball)
    assert isinstance(inside, Inside) and inside.test is Argument.POLYGON
    # one control point outside, the curve inside: only the finer test sees it
    finer = examine(Bezier.of([(0, 0), (0, Fraction(11, 10)), (Fraction(1, 2), 0)]), ball)
    assert isinstance(finer, Inside) and finer.test is Argument.BERNSTEIN
    # the parabola y = 1 - x^2/2 about its vertex touches the unit circle from outside at (0, 1)
    touching = Bezier.of([(-1, Fraction(1, 2)), (0, Fraction(3, 2)), (1, Fraction(1, 2))])
    assert touching.point(Fraction(1, 2)) == (0, 1)
    assert isinstance(examine(touching, ball), Leaves)
    # y = 1 - x^2 on |x| <= 1/2: x^2 + y^2 = 1 - x^2 + x^4 touches the circle from inside at t = 1/2
    contact = Bezier.of([(Fraction(-1, 2), Fraction(3, 4)), (0, Fraction(5, 4)), (Fraction(1, 2), Fraction(3, 4))])
    outcome = examine(contact, ball)
    assert isinstance(outcome, Inside) and outcome.touches == ((Fraction(1, 2), Fraction(1, 2)),)


def test_tangency_at_a_parameter_that_is_not_dyadic():
    # height 9 (t - 1/3)^2 touches the floor at t = 1/3, where no bisection point falls
    floor = Workspace(WorkspaceKind.HEMISPHERE, Fraction(100)).floor
    heights = bs.from_power((Fraction(1), Fraction(-6), Fraction(9)))
    curve = Bezier.of([(k, 0, z) for k, z in enumerate(heights)])
    outcome = examine(curve, floor)
    assert isinstance(outcome, Inside) and outcome.test is Argument.ROOTS
    low, high = outcome.touches[0]
    assert len(outcome.touches) == 1 and low <= Fraction(1, 3) <= high
    lowered = Bezier.of([(k, 0, z - Fraction(1, 10**30)) for k, z in enumerate(heights)])
    leaves = examine(lowered, floor)
    assert isinstance(leaves, Leaves) and leaves.margin < 0 and abs(leaves.t - Fraction(1, 3)) < Fraction(1, 10**14)


def test_tangency_at_an_irrational_parameter():
    # (t - (sqrt2 - 1))^2 over Q(sqrt 2)
    a = root2(Fraction(-1), Fraction(1))
    heights = bs.from_power((a * a, -2 * a, root2(Fraction(1))))
    curve = Bezier.of([(root2(Fraction(k)), root2(Fraction(0)), z) for k, z in enumerate(heights)])
    outcome = examine(curve, HalfSpace((Fraction(0), Fraction(0), Fraction(1)), Fraction(0)))
    assert isinstance(outcome, Inside) and outcome.test is Argument.ROOTS
    assert [(low + 1) ** 2 <= 2 <= (high + 1) ** 2 for low, high in outcome.touches] == [True]


def test_degenerate_curves():
    ball = Ball(ORIGIN, Fraction(1))
    point = examine(Bezier.of([(1, 0, 0)]), ball)
    assert isinstance(point, Inside)
    on_sphere = examine_closely(Bezier.of([(1, 0, 0)] * 3), ball)
    assert isinstance(on_sphere, Inside) and on_sphere.touches == ((0, 1),)
    assert isinstance(examine(Bezier.of([(2, 0, 0)] * 3), ball), Leaves)


def test_workspaces():
    hemisphere = Workspace(WorkspaceKind.HEMISPHERE, Fraction(27))
    assert hemisphere.contains((5, 1, 1)) and not hemisphere.contains((5, 1, -1)) and not hemisphere.contains((5, 1, 2))
    assert Workspace(WorkspaceKind.BALL, Fraction(27)).contains((5, 1, -1))


def test_root_text():
    cases = {Fraction(27): "3*sqrt(3)", Fraction(9, 4): "3/2", Fraction(2, 9): "sqrt(2)/3", Fraction(1, 2): "sqrt(2)/2"}
    cases |= {Fraction(0): "0", Fraction(7): "sqrt(7)", Fraction(27, 4): "3*sqrt(3)/2"}
    assert {q: root_text(q) for q in cases} == cases


UNIT = Ball((Fraction(0),) * 2, Fraction(1))
FLOOR = HalfSpace((Fraction(0), Fraction(1)), Fraction(0))
ROOT2 = NumberField.from_root([-2, 0, 1], 1, 2).generator()


def accepted(certificate):
    again = qe.Certificate.from_json(certificate.to_json())
    return qe.verify(again)


@given(control_points(1, 4, dimension=2))
def test_every_proof_is_accepted(control):
    curve = Bezier.of(control)
    for condition in (Ball((Fraction(0),) * 2, Fraction(9)), FLOOR):
        outcome = examine(curve, condition)
        if isinstance(outcome, Inside):
            certificate = containment(curve, outcome)
            assert certificate is not None and accepted(certificate).accepted


def test_over_a_number_field():
    curve = Bezier.of([(0, 0), (ROOT2 / 2, ROOT2 / 2), (-1, 0)])
    outcome = examine(curve, UNIT)
    assert isinstance(outcome, Inside)
    assert accepted(containment(curve, outcome)).accepted
    outside = Bezier.of([(0, 0), (ROOT2 / 2, ROOT2 / 2 + Fraction(1, 10**9)), (ROOT2 / 2, ROOT2 / 2)])
    assert isinstance(examine(outside, Ball((Fraction(0),) * 2, Fraction(1, 2))), Leaves)


def test_contact_at_an_irrational_parameter_is_proved_over_the_rationals():
    heights = bs.from_power((Fraction(4), Fraction(0), Fraction(-16), Fraction(0), Fraction(16)))  # 4 (2t^2 - 1)^2
    curve = Bezier.of([(k, z) for k, z in enumerate(heights)])
    assert qe.verify(containment(curve, examine(curve, FLOOR)), core=True).accepted


def test_contact_at_a_rational_and_at_an_irrational_parameter():
    heights = bs.from_power((Fraction(1), Fraction(-6), Fraction(9)))
    rational = Bezier.of([(k, z) for k, z in enumerate(heights)])
    assert accepted(containment(rational, examine(rational, FLOOR))).accepted
    a = ROOT2 - 1
    heights = bs.from_power((a * a, -2 * a, ROOT2 * 0 + 1))
    irrational = Bezier.of([(k, z) for k, z in enumerate(heights)])
    assert isinstance(examine(irrational, FLOOR), Inside)
    assert containment(irrational, examine(irrational, FLOOR)) is None


@pytest.mark.parametrize(("old", "new"), [("x^2 + y^2 - 1", "2*x^2 + 2*y^2 - 1"), ("t - 1", "t - 2"), ("x", "y")])
def test_altered_numbers_are_rejected(old, new):
    # the curve needs the finer test, so growing the curve or shrinking the ball breaks the proof
    curve = Bezier.of([(0, 0), (0, Fraction(11, 10)), (Fraction(1, 2), 0)])
    certificate = containment(curve, examine(curve, UNIT))
    assert qe.verify(certificate, core=True).accepted
    text = json.dumps(certificate.payload)
    assert f'"{old}"' in text
    for payload in (text.replace(f'"{old}"', f'"{new}"'), text.replace(f'"{old}"', f'"{new}"', 1)):
        assert not qe.verify(qe.Certificate(certificate.kind, json.loads(payload))).accepted


SMALLEST = NumberField.from_root([1, -3, 0, 1], Fraction(-2), Fraction(-3, 2)).generator()  # of three real roots
WHOLE = (*UNIT_INTERVAL, 0)
ARCH = Bezier.of([(-1, 0), (0, 2), (1, 0)])


def disc(square: Fraction | int, relation: Relation = Relation.GT) -> Any:
    return {(2, 0): Fraction(1), (0, 2): Fraction(1), (0, 0): -Fraction(square)}, relation


@each(
    (ARCH, "ex t, x, y. 0 <= t <= 1 and 2*t = x + 1 and 4*t^2 - 4*t + y = 0 and x^2 + y^2 > 4"),
    (
        Bezier.of([(ROOT2, 0), (0, ROOT2)]),
        "ex root, t, x, y. root^2 = 2 and 1 <= root <= 3/2 and 0 <= t <= 1 and"
        " root*t - root + x = 0 and y = root*t and x^2 + y^2 > 4",
    ),
    (
        Bezier.of([(SMALLEST, 0)]),
        "ex root, t, x, y. root^3 - 3*root + 1 = 0 and -2 <= root <= -3/2 and 0 <= t <= 1 and"
        " root = x and y = 0 and x^2 + y^2 > 4",
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
