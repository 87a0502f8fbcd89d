"""Clearance of curves, and its certificates: accepted as made, rejected after any change that matters."""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves.bernstein import from_power
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Nonnegative, decide
from bezier.obstacles.bodies import HalfSpaceBody, Rounded
from bezier.obstacles.clearance import Clear, ClearanceArgument, Contact, enters, examine
from bezier.obstacles.obstacle import Constraint, Obstacle, ObstacleKind, Piece
from bezier.obstacles.survey import clearance_certificate, contact_certificate
from qe.certify.claims import claim_of
from qe.certify.verify import verify, verify_json
from qe.errors import InputError
from qe.exact.field import NumberField
from qe.proof.certificate import Certificate
from tests.bezier.made import CUBE, at, ball, bodies, control_points, obstacle
from tests.certificates.false_claims import KINDS
from tests.certificates.mutation import evidence_in, leaves, lists, replaced, without
from tests.tables import each

GRID = [Fraction(k, 20) for k in range(21)]
HALF = Fraction(1, 2)
ARCH = Bezier.of([(-2, 0, 0), (0, 0, 4), (2, 0, 0)])  # z = 2 - x^2/2
LINE = Bezier.of([(-3, 0, 0), (3, 0, 0)])


def met(curve, thing) -> Contact:
    found = examine(curve, thing)
    assert isinstance(found, Contact)
    return found


def test_a_line_enters_a_ball_at_a_known_parameter():
    contact = met(LINE, ball((0, 0, 0), 1))
    assert contact.t == (Fraction(1, 3), Fraction(1, 3))
    assert contact.exact_place == (-1, 0, 0) and contact.enters and contact.attained


def test_an_irrational_first_contact_is_isolated():
    contact = met(ARCH, ball((0, 0, 0), Fraction(19, 10)))  # x^2 + (2 - x^2/2)^2 = 361/100 at x^2 = 2 - sqrt(61)/5
    assert isinstance(examine(ARCH, ball((0, 0, 0), Fraction(17, 10))), Clear)
    low, high = contact.t
    assert low < high and high - low < Fraction(1, 2**60) and not contact.is_exact
    x = float(contact.place[0].low)
    assert abs(x * x - (2 + 61**0.5 / 5)) < 1e-12 and x < 0


@each(0, 3)
def test_tangency_is_contact_without_entering(side):
    contact = met(ARCH, ball((0, 0, side), Fraction(1)) if side else ball((0, 0, 1), 1))
    assert contact.t == (HALF, HALF) and contact.exact_place == (0, 0, 2)
    assert not contact.enters


@pytest.mark.parametrize("gap", [Fraction(1, 10**k) for k in (1, 4, 12)])
def test_close_misses_and_close_hits(gap):
    above = at(0, 0, 3)
    assert isinstance(examine(ARCH, ball(above, 1 - gap)), Clear)
    hit = met(ARCH, ball(above, 1 + gap))
    assert hit.enters and abs(hit.t[0] - HALF) < gap * 4 + Fraction(1, 10)


def test_a_curve_that_touches_at_an_irrational_parameter():
    field = NumberField.from_root([-2, 0, 1], 1, 2)
    root = field.generator()
    zero = root * 0
    # z = (x - sqrt 2)^2 >= 0 touches the floor at x = sqrt 2, t = sqrt(2)/2
    curve = Bezier(((zero, zero, zero + 2), (zero + 1, zero, 2 - 2 * root), (zero + 2, zero, (root - 2) * (root - 2))))
    floor = obstacle(HalfSpaceBody(at(0, 0, 1), Fraction(0)))
    contact = met(curve, floor)
    assert not contact.enters and contact.t[0] < contact.t[1]
    assert abs(float(contact.t[0]) - 2**0.5 / 2) < 1e-15
    assert isinstance(examine(curve, obstacle(HalfSpaceBody(at(0, 0, 1), Fraction(-1, 10**9)))), Clear)


def test_inside_from_the_start():
    contact = met(ARCH, ball((-2, 0, 0), 1))
    assert contact.t == (0, 0) and contact.enters
    assert met(LINE, ball((4, 0, 0), 1)).t == (1, 1)


def test_a_cube_is_met_on_its_face_and_passed_at_its_corner():
    cube = obstacle(Rounded(CUBE, Fraction(0)))
    assert met(LINE, cube).exact_place == (-1, 0, 0)
    past = Bezier.of([(-3, 0, 0), (0, 2, 0), (3, 0, 0)])
    corner = Bezier.of([(-1, 3, 1), (3, -1, 1)])  # through the edge point (1, 1, 1)
    assert met(corner, cube).t == (HALF, HALF) and not met(corner, cube).enters
    assert isinstance(examine(past, cube), Contact)
    outside = Bezier.of([(-1, 4, 1), (4, -1, 1)])
    assert isinstance(examine(outside, cube), Clear)


def test_points_lines_and_repeated_control_points():
    thing = ball((0, 0, 0), 1)
    assert isinstance(examine(Bezier.of([(2, 0, 0)]), thing), Clear)
    assert met(Bezier.of([(1, 0, 0)]), thing).t == (0, 0)
    assert met(Bezier.of([(2, 0, 0), (2, 0, 0), (0, 0, 0), (0, 0, 0)]), thing).t == (HALF, HALF)
    assert isinstance(examine(Bezier.of([(2, 2, 2)] * 4), thing), Clear)


def test_plane_curves_are_refused():
    with pytest.raises(InputError, match="expected a curve of dimension 3, found 2"):
        examine(Bezier.of([(0, 0), (1, 1)]), ball((0, 0, 0), 1))


def test_huge_and_tiny_numbers():
    big, small = 10**400, Fraction(1, 10**400)
    contact = met(Bezier.of([(-3 * big, 0, 0), (3 * big, 0, 0)]), ball((0, 0, 0), big))
    assert contact.t == (Fraction(1, 3), Fraction(1, 3)) and float(contact.place[0]) == -float("inf")
    assert isinstance(examine(LINE, ball((0, 1, 0), 1 - small)), Clear)
    assert met(LINE, ball((0, 1, 0), 1 + small)).enters


def test_running_along_the_surface_is_touching():
    floor = obstacle(HalfSpaceBody(at(0, 0, 1), Fraction(0)))
    assert met(LINE, floor).t == (0, 0) and not met(LINE, floor).enters


def test_an_open_obstacle_is_not_met_at_its_boundary():
    inside = Constraint.of({(0, 0, 0): 1, (2, 0, 0): -1, (0, 2, 0): -1, (0, 0, 2): -1}, strict=True)
    open_ball = Obstacle("open ball", ObstacleKind.FORMULA, (Piece((inside,)),))
    above = Bezier.of([(-2, 0, 1), (2, 0, 1)])
    assert isinstance(examine(above, open_ball), Clear)
    contact = met(LINE, open_ball)
    assert contact.t == (Fraction(1, 3), Fraction(1, 3)) and not contact.attained


def test_arguments_are_named_by_what_was_needed():
    def argument(thing):
        found = examine(ARCH, thing)
        assert isinstance(found, Clear)
        return found.argument

    assert argument(ball((9, 9, 9), 1)) is ClearanceArgument.BOXES
    assert argument(obstacle(HalfSpaceBody(at(1, 0, 1), Fraction(-5)))) is ClearanceArgument.POLYGON
    assert argument(ball((0, 0, 0), 1)) is ClearanceArgument.SUBDIVISION


@settings(max_examples=35, deadline=None)
@given(bodies, control_points(1, 4))
def test_proofs_agree_with_dense_exact_sampling(body, points):
    agrees_with_sampling(body, points, GRID)


@pytest.mark.deep
@settings(max_examples=1500, deadline=None)
@given(bodies, control_points(1, 6))
def test_proofs_agree_with_denser_sampling(body, points):
    agrees_with_sampling(body, points, [Fraction(k, 97) for k in range(98)])


def agrees_with_sampling(body, points, grid):
    curve, thing = Bezier.of(points), obstacle(body)
    found = examine(curve, thing)
    inside = [t for t in grid if thing.contains(curve.point(t))]
    if isinstance(found, Clear):
        assert not inside
        certificate = clearance_certificate(curve, thing)
        assert certificate is not None and verify(certificate).accepted
        return
    assert all(found.t[0] <= t for t in inside)
    if found.is_exact:
        assert thing.contains(curve.point(found.t[0]))
    assert found.enters == enters(curve, thing)
    with pytest.raises(InputError, match="meets the obstacle"):
        clearance_certificate(curve, thing)


@settings(max_examples=20, deadline=None)
@given(bodies, control_points(1, 4), st.integers(1, 3))
def test_degree_elevation_changes_nothing(body, points, more):
    curve, thing = Bezier.of(points), obstacle(body)
    found, raised = examine(curve, thing), examine(curve.elevate(curve.degree + more), thing)
    assert type(found) is type(raised)
    if isinstance(found, Contact):
        assert isinstance(raised, Contact) and (found.enters, found.attained) == (raised.enters, raised.attained)
        assert found.t[0] <= raised.t[1] and raised.t[0] <= found.t[1]


@settings(max_examples=20, deadline=None)
@given(bodies, control_points(2, 4))
def test_running_backwards_meets_the_same_obstacles(body, points):
    curve, thing = Bezier.of(points), obstacle(body)
    assert isinstance(examine(curve, thing), Clear) == isinstance(examine(Bezier(curve.points[::-1]), thing), Clear)


def test_one_convex_condition_agrees_with_the_containment_test():
    """Outside a half-space everywhere is inside the opposite one everywhere."""
    for height in (Fraction(2), Fraction(21, 10), Fraction(19, 10)):
        below = decide(tuple(height - z for z in ARCH.coordinate(2)))
        upper = obstacle(HalfSpaceBody(at(0, 0, -1), -height))
        stays_below = isinstance(below, Nonnegative) and not below.touches
        assert isinstance(examine(ARCH, upper), Clear) == stays_below


ARCH_CERTIFIED = Bezier.of([(-2, 0, 0), (0, 0, 4), (2, 0, 0)])


def made(curve: Bezier, thing: Obstacle) -> Certificate:
    certificate = clearance_certificate(curve, thing)
    assert certificate is not None
    return certificate


def root_curve() -> Bezier:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    zero = root * 0
    return Bezier(((root, zero, zero), (root, root, zero), (zero, root, root)))


CERTIFICATES = [
    made(ARCH_CERTIFIED, ball((0, 0, 0), 1)),
    made(ARCH_CERTIFIED, obstacle(Rounded(CUBE, Fraction(0)))),
    made(root_curve(), ball((0, 0, 0), 1)),
]


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_a_certificate_survives_text_and_needs_the_core_alone(certificate: Certificate) -> None:
    assert verify(certificate, core=True).accepted and not certificate.trusts
    assert verify_json(certificate.to_json()).accepted


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_atoms_of_the_sentence_cannot_be_changed(certificate: Certificate) -> None:
    """Not alone; and everywhere only where what is said then is true, too: the lemmas about signs are checked."""
    data = json.loads(certificate.to_json())
    text, refused = json.dumps(data["payload"]), 0
    for node in {json.dumps(node): node for _, node in lists(data["payload"]["start"]) if node[0] == "atom"}.values():
        turned = {"<=": ">=", ">=": "<=", "=": "/="}[node[2]]
        for other in (["atom", grown(node[1]), node[2]], ["atom", node[1], turned]):
            alone = json.loads(text.replace(json.dumps(node), json.dumps(other), 1))
            assert not verify(Certificate(certificate.kind, alone)).accepted, node
            everywhere = {**data, "payload": json.loads(text.replace(json.dumps(node), json.dumps(other)))}
            is_accepted = verify(Certificate(certificate.kind, everywhere["payload"])).accepted
            assert not (is_accepted and KINDS["clearance"][1](random.Random(0), everywhere)), node
            refused += not is_accepted
    assert refused >= 5


def grown(polynomial: str) -> str:
    """With another constant term."""
    *rest, last = polynomial.split(" ")
    return " ".join([*rest, str(int(last) + 1000)]) if last.isdigit() else f"{polynomial} + 1000"


@pytest.mark.parametrize("certificate", CERTIFICATES)
def test_nothing_can_be_left_out(certificate: Certificate) -> None:
    data = json.loads(certificate.to_json())
    for path, items in lists(data):
        if path[-1] in ("samples", "steps", "solved"):
            for index in range(len(items)):
                assert not verify_json(without(data, path, index)).accepted, (path, index)


def test_an_obstacle_of_many_pieces_is_excluded_piece_by_piece() -> None:
    """It had no certificate where comparisons along the curve have several factors."""
    crate = obstacle(Rounded(CUBE, Fraction(1, 10)))
    certificate = made(ARCH_CERTIFIED, crate)
    assert len(crate.pieces) > 20 and verify(certificate, core=True).accepted
    theory = evidence_in({"payload": certificate.payload})["theory"]
    assert 0 < len(theory["cases"]) <= len(crate.pieces)  # a clause for each at most: nothing has to be searched for


def test_every_entry_is_read() -> None:
    data = json.loads(CERTIFICATES[0].to_json())
    for path, value in leaves(data):
        if path[0] == "payload":
            wrong: Any = "nonsense" if not isinstance(value, str) else None
            assert not verify_json(replaced(data, path, wrong)).accepted, path


def test_a_touched_ball_is_open_or_there_is_no_certificate() -> None:
    touching = ball((0, 0, 3), 1)
    with pytest.raises(InputError, match="meets"):
        clearance_certificate(ARCH_CERTIFIED, touching)
    constraint = replace(touching.pieces[0].constraints[0], strict=True)
    opened = Obstacle("open", ObstacleKind.FORMULA, (Piece((constraint,)),))
    certificate = made(ARCH_CERTIFIED, opened)
    assert verify(certificate, core=True).accepted
    text = json.dumps(certificate.payload).replace('">"', '">="').replace('"<"', '"<="')
    assert not verify(Certificate(certificate.kind, json.loads(text))).accepted


def test_strict_obstacles_that_are_touched_where_no_interval_ends_have_one_over_the_rationals() -> None:
    third = Bezier.of([(0, 0, 1), (0, 0, -2), (0, 0, 4)])  # z = (3t - 1)^2, zero at t = 1/3
    below = Obstacle("below", ObstacleKind.FORMULA, (Piece((Constraint.of({(0, 0, 1): -1}, strict=True),)),))
    assert third.point(Fraction(1, 3)) == at(0, 0, 0)
    assert verify(made(third, below), core=True).accepted
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    shifted = Bezier(tuple((x + root, y, z) for x, y, z in third.points))
    assert clearance_certificate(shifted, below) is None


PLANES = st.lists(st.tuples(*[st.integers(-2, 2)] * 3, st.booleans()), min_size=1, max_size=4)


@settings(deadline=None)
@given(control_points(2, 4), PLANES)
def test_curves_that_touch_or_run_along_planes_have_proofs(points: Any, planes: Any) -> None:
    """Flat curves, constants, common and multiple roots: whatever is clear over the rationals has a proof."""
    listed = (Constraint.of({(1, 0, 0): a, (0, 1, 0): b, (0, 0, 1): c, (0, 0, 0): -1}, s) for a, b, c, s in planes)
    thing = Obstacle("corner", ObstacleKind.FORMULA, (Piece(tuple(listed)),))
    curve = Bezier.of(points)
    outcome = examine(curve, thing)
    if isinstance(outcome, Contact):
        certificate = contact_certificate(curve, thing, outcome)
    else:
        certificate = made(curve, thing)
    assert certificate is None or verify(certificate, core=True).accepted


def first_contact(curve: Bezier, thing: Obstacle) -> Certificate:
    contact = examine(curve, thing)
    assert isinstance(contact, Contact)
    certificate = contact_certificate(curve, thing, contact)
    assert certificate is not None
    return certificate


CONTACTS = [
    first_contact(ARCH_CERTIFIED, ball((0, 0, 0), Fraction(19, 10))),  # irrational, at t = 0.0145...
    first_contact(ARCH_CERTIFIED, ball((0, 0, 3), 1)),  # a tangency at t = 1/2
    first_contact(root_curve(), ball((1, 1, 0), Fraction(1, 2))),
]


@pytest.mark.parametrize("certificate", CONTACTS)
def test_first_contacts_are_certified(certificate: Certificate) -> None:
    assert verify_json(certificate.to_json()).accepted and verify(certificate, core=True).accepted
    before, there = (certificate_.payload for certificate_ in certificate.parts)
    assert isinstance(before, dict) and isinstance(there, dict)
    assert (before["answer"], there["answer"]) == (False, True)
    sentences = [data["start"][2][1:] for data in (before, there)]
    assert sentences[0][-1] == sentences[1][-1]  # one obstacle
    for member in (before, there):  # neither holds with the other's answer, whatever it is called by
        text = json.dumps(member).replace(json.dumps(member["answer"]), json.dumps(not member["answer"]))
        assert not verify(Certificate(certificate.parts[0].kind, json.loads(text))).accepted


def test_the_first_contact_is_said_exactly_where_it_is_rational() -> None:
    words = claim_of(CONTACTS[1]).words
    assert "not before: the sentence  ex t, x, y, z. 0 <= t < 1/2 and" in words[1]
    assert "there: the sentence  ex t, x, y, z. t = 1/2 and" in words[4] and words[5] == "there: is true"


def test_contact_at_the_start_and_an_irrational_tangency() -> None:
    inside = first_contact(ARCH_CERTIFIED, ball((-2, 0, 0), 1))
    assert verify(inside).accepted and isinstance(inside.payload, dict) and inside.payload["answer"] is True
    assert ["atom", "t", "="] in inside.payload["start"][2]  # type: ignore[index,operator]
    touching = Bezier.of([(0, 0, 2), (0, 0, -2), (0, 0, 2)])  # z = 2 (4 t^2 - 4 t + 1) touches 0 at 1/2, rational
    below = obstacle(HalfSpaceBody(at(0, 0, 1), Fraction(0)))
    assert verify(first_contact(touching, below)).accepted
    # z = (2 t^2 - 1)^2 touches 0 at t = 1/sqrt(2) only
    irrational = Bezier(tuple((Fraction(0), Fraction(0), z) for z in from_power((1, 0, -4, 0, 4))))
    contact = examine(irrational, below)
    assert isinstance(contact, Contact) and not contact.is_exact and not contact.enters
    assert contact_certificate(irrational, below, contact) is None
