"""Whole-curve clearance: exact contacts, tangency, degenerate curves, and proofs against dense exact sampling."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Nonnegative, decide
from bezier.obstacles.bodies import HalfSpaceBody, Rounded
from bezier.obstacles.clearance import Clear, ClearanceArgument, Contact, enters, examine
from bezier.obstacles.obstacle import Constraint, Obstacle, ObstacleKind, Piece
from bezier.obstacles.survey import clearance_certificate
from qe.certify.verify import verify
from qe.errors import InputError
from qe.exact.field import NumberField
from tests.bezier.made import CUBE, at, ball, bodies, control_points, obstacle
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
    assert isinstance(examine(curve, thing), Clear) == isinstance(examine(curve.reversed(), thing), Clear)


def test_one_convex_condition_agrees_with_the_containment_test():
    """Outside a half-space everywhere is inside the opposite one everywhere."""
    for height in (Fraction(2), Fraction(21, 10), Fraction(19, 10)):
        below = decide(tuple(height - z for z in ARCH.coordinate(2)))
        upper = obstacle(HalfSpaceBody(at(0, 0, -1), -height))
        stays_below = isinstance(below, Nonnegative) and not below.touches
        assert isinstance(examine(ARCH, upper), Clear) == stays_below
