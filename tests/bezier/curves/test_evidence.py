"""Containment certificates: accepted by the independent checker, and rejected when altered."""

import json
from fractions import Fraction

import pytest
from hypothesis import given

import qe
from bezier.curves import bernstein as bs
from bezier.curves.containment import Inside, Leaves, containment, examine
from bezier.curves.curve import Bezier
from bezier.curves.workspace import Ball, HalfSpace
from qe.exact.field import NumberField
from tests.bezier.numbers import control_points

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


def test_contact_at_a_rational_and_at_an_irrational_parameter():
    heights = bs.from_power((Fraction(1), Fraction(-6), Fraction(9)))
    rational = Bezier.of([(k, z) for k, z in enumerate(heights)])
    assert accepted(containment(rational, examine(rational, FLOOR))).accepted
    a = ROOT2 - 1
    heights = bs.from_power((a * a, -2 * a, ROOT2 * 0 + 1))
    irrational = Bezier.of([(k, z) for k, z in enumerate(heights)])
    assert isinstance(examine(irrational, FLOOR), Inside)
    assert containment(irrational, examine(irrational, FLOOR)) is None


@pytest.mark.parametrize("path", [("points", 1, 0, 0), ("points", 2, 1, 0), ("condition", "radius_squared", 0)])
def test_altered_numbers_are_rejected(path):
    # the curve needs the finer test, so pushing a control point out or shrinking the ball breaks the proof
    curve = Bezier.of([(0, 0), (0, Fraction(11, 10)), (Fraction(1, 2), 0)])
    payload = json.loads(json.dumps(containment(curve, examine(curve, UNIT)).payload))
    node = payload
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = "1/100" if path[0] == "condition" else "3"
    altered = qe.Certificate(containment(curve, examine(curve, UNIT)).kind, payload)
    assert not qe.verify(altered).accepted
