"""Clearance certificates: accepted as made, rejected after any change that matters."""

from __future__ import annotations

import copy
import json
from fractions import Fraction
from typing import Any

import pytest

from bezier.curves.bernstein import from_power
from bezier.curves.curve import Bezier
from bezier.obstacles.bodies import HalfSpaceBody, Rounded
from bezier.obstacles.clearance import Contact, examine
from bezier.obstacles.obstacle import Constraint, Obstacle, ObstacleKind, Piece
from bezier.obstacles.survey import clearance_certificate, contact_certificate
from qe.certify.verify import verify, verify_json
from qe.exact.field import NumberField
from qe.proof.certificate import Certificate
from tests.bezier.bodies import CUBE, at, ball, obstacle
from tests.certificates.mutation import leaves, lists, other_numbers, replaced, without

ARCH = Bezier.of([(-2, 0, 0), (0, 0, 4), (2, 0, 0)])


def made(curve: Bezier, thing: Obstacle) -> Certificate:
    certificate = clearance_certificate(curve, thing)
    assert certificate is not None
    return certificate


def root_curve() -> Bezier:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    zero = root * 0
    return Bezier(((root, zero, zero), (root, root, zero), (zero, root, root)))


CERTIFICATES = [
    made(ARCH, ball((0, 0, 0), 1)),
    made(ARCH, obstacle(Rounded(CUBE, Fraction(0)))),
    made(root_curve(), ball((0, 0, 0), 1)),
]


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_a_certificate_survives_text(certificate: Certificate) -> None:
    assert verify(certificate).accepted
    assert verify_json(certificate.to_json()).accepted


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_intervals_cannot_be_changed(certificate: Certificate) -> None:
    data = json.loads(certificate.to_json())
    tried = 0
    for path, value in leaves(data):
        if "spans" in path and isinstance(value, str):
            for other in (*other_numbers(value), "1/3"):
                if other != value:
                    tried += 1
                    assert not verify_json(replaced(data, path, other)).accepted, path
    assert tried >= 4


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_nothing_can_be_left_out(certificate: Certificate) -> None:
    data = json.loads(certificate.to_json())
    for path, items in lists(data):
        if path[-1] == "spans" or (path[-1] == "constraints" and len(items) == 1):
            for index in range(len(items)):
                assert not verify_json(without(data, path, index)).accepted, (path, index)


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_a_larger_obstacle_is_not_proved_by_the_same_intervals(certificate: Certificate) -> None:
    data = json.loads(certificate.to_json())
    for k, piece in enumerate(data["payload"]["pieces"]):
        used = {span[2] for span in piece["spans"]}
        for i in used:
            terms = piece["constraints"][i]["terms"]
            path = ("payload", "pieces", k, "constraints", i, "terms", 0, 1)
            assert terms[0][0] == [0, 0, 0]
            grown = str(Fraction(terms[0][1]) + 1000)
            assert not verify_json(replaced(data, path, grown)).accepted


def test_every_entry_is_read() -> None:
    data = json.loads(CERTIFICATES[0].to_json())
    for path, value in leaves(data):
        if path[0] == "payload" and path[-2] != "interval":
            wrong: Any = "nonsense" if not isinstance(value, str) else None
            assert not verify_json(replaced(data, path, wrong)).accepted, path


def test_a_touching_ball_has_no_certificate_and_none_can_be_made_up() -> None:
    data = copy.deepcopy(made(ARCH, ball((0, 0, 3), Fraction(99, 100))).payload)
    assert isinstance(data, dict)
    pieces: Any = data["pieces"]
    constraint = Constraint.of({(0, 0, 0): -8, (0, 0, 1): 6, (2, 0, 0): -1, (0, 2, 0): -1, (0, 0, 2): -1})
    pieces[0]["constraints"] = [{"terms": [[list(e), str(c)] for e, c in constraint.terms], "strict": False}]
    kind = CERTIFICATES[0].kind
    assert not verify(Certificate(kind, data)).accepted
    pieces[0]["constraints"][0]["strict"] = True
    assert verify(Certificate(kind, data)).accepted, "the open ball is not met"


def test_strict_obstacles_that_are_touched_where_no_interval_ends_have_none() -> None:
    third = Bezier.of([(0, 0, 1), (0, 0, -2), (0, 0, 4)])  # z = (3t - 1)^2, zero at t = 1/3
    below = Obstacle("below", ObstacleKind.FORMULA, (Piece((Constraint.of({(0, 0, 1): -1}, strict=True),)),))
    assert third.point(Fraction(1, 3)) == at(0, 0, 0)
    assert clearance_certificate(third, below) is None


def first_contact(curve: Bezier, thing: Obstacle) -> Certificate:
    contact = examine(curve, thing)
    assert isinstance(contact, Contact)
    certificate = contact_certificate(curve, thing, contact)
    assert certificate is not None
    return certificate


CONTACTS = [
    first_contact(ARCH, ball((0, 0, 0), Fraction(19, 10))),  # irrational, at t = 0.0145...
    first_contact(ARCH, ball((0, 0, 3), 1)),  # a tangency at t = 1/2
    first_contact(root_curve(), ball((1, 1, 0), Fraction(1, 2))),
]


@pytest.mark.parametrize("certificate", CONTACTS)
def test_first_contacts_are_certified(certificate: Certificate) -> None:
    assert verify_json(certificate.to_json()).accepted
    data = json.loads(certificate.to_json())
    after, t = (Fraction(data["payload"]["contact"][key]) for key in ("after", "t"))
    assert 0 < after < t and t - after <= Fraction(1, 2**40)
    for key, other in (("after", t), ("after", after - Fraction(1, 100)), ("t", after), ("t", after / 2)):
        assert not verify_json(replaced(data, ("payload", "contact", key), str(other))).accepted, key
    for wrong in (1, -1, "0"):
        assert not verify_json(replaced(data, ("payload", "contact", "piece"), wrong)).accepted
    clear = copy.deepcopy(data)
    del clear["payload"]["contact"]
    assert not verify_json(replaced(clear, ("payload", "pieces"), clear["payload"]["pieces"])).accepted


def test_contact_at_the_start_and_an_irrational_tangency() -> None:
    inside = first_contact(ARCH, ball((-2, 0, 0), 1))
    assert verify(inside).accepted and isinstance(inside.payload, dict)
    assert inside.payload["contact"] == {"after": "0", "t": "0", "piece": 0}
    touching = Bezier.of([(0, 0, 2), (0, 0, -2), (0, 0, 2)])  # z = 2 (4 t^2 - 4 t + 1) touches 0 at 1/2, rational
    below = obstacle(HalfSpaceBody(at(0, 0, 1), Fraction(0)))
    assert verify(first_contact(touching, below)).accepted
    # z = (2 t^2 - 1)^2 touches 0 at t = 1/sqrt(2) only
    irrational = Bezier(tuple((Fraction(0), Fraction(0), z) for z in from_power((1, 0, -4, 0, 4))))
    contact = examine(irrational, below)
    assert isinstance(contact, Contact) and not contact.is_exact and not contact.enters
    assert contact_certificate(irrational, below, contact) is None
