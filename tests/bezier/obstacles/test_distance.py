"""Least distances between curves and convex obstacles: closed forms, sampling, and whole surveys."""

from fractions import Fraction

from hypothesis import given, settings

from bezier.curves.curve import Bezier
from bezier.obstacles import survey
from bezier.obstacles.bodies import Cylinder, HalfSpaceBody, Rounded, distance_at, distance_enclosure
from bezier.obstacles.clearance import Clear, examine
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, Piece, from_body, half_space
from bezier.obstacles.polyhedron import point
from qe.exact.field import NumberField
from tests.bezier.bodies import CUBE, at, bodies, obstacle
from tests.bezier.numbers import control_points
from tests.tables import each

ARCH = Bezier.of([(-2, 0, 0), (0, 0, 4), (2, 0, 0)])
LINE = Bezier.of([(-3, 0, 0), (3, 0, 0)])
GRID = [Fraction(k, 16) for k in range(17)]
COARSE = Fraction(1, 1000)


def encloses(enclosure, value: float) -> bool:
    return float(enclosure.low) <= value * (1 + 1e-12) and value * (1 - 1e-12) <= float(enclosure.high)


@each(
    (ARCH, Rounded(point(at(0, 0, 4)), Fraction(1, 2)), 1.5),
    (ARCH, Rounded(point(at(0, 0, 0)), Fraction(1)), 3**0.5 - 1),
    (LINE, Rounded(CUBE, Fraction(0)), None),
    (Bezier.of([(-3, 3, 3), (3, 3, 3)]), Rounded(CUBE, Fraction(1, 2)), 8**0.5 - 0.5),
    (ARCH, HalfSpaceBody(at(0, 0, 1), Fraction(-1), Fraction(1, 4)), 0.75),
    (LINE, Cylinder((Fraction(0), Fraction(5)), Fraction(1), None, None), 4.0),
    (LINE, Cylinder((Fraction(0), Fraction(5)), Fraction(1), Fraction(3), None), 5.0),
)
def test_known_distances(curve, body, value):
    if value is None:
        assert distance_enclosure(curve, body).high == 0
    else:
        found = distance_enclosure(curve, body)
        assert encloses(found, value) and found.high - found.low <= found.high / 10**6


def test_a_curve_over_a_number_field():
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    curve = Bezier(((root, root * 0, root * 0), (root, root, root)))
    assert encloses(distance_enclosure(curve, Rounded(point(at(0, 0, 0)), Fraction(1))), 2**0.5 - 1)


@settings(max_examples=25, deadline=None)
@given(bodies, control_points(1, 4))
def test_no_sample_is_nearer_than_the_enclosure_says(body, points):
    curve = Bezier.of(points)
    if not isinstance(examine(curve, obstacle(body)), Clear):
        return
    found = distance_enclosure(curve, body, COARSE)
    nearest = min(distance_at(curve, body, t) for t in GRID)
    assert float(found.low) <= nearest * (1 + 1e-9)
    assert found.high - found.low <= COARSE * found.high
    raised = distance_enclosure(curve.elevate(curve.degree + 1), body, COARSE)
    assert raised.low <= found.high and found.low <= raised.high


def test_a_survey_says_what_was_found():
    touched = from_body("ball", ObstacleKind.BALL, Rounded(point(at(0, 0, 3)), Fraction(1)))
    entered = from_body("floor", ObstacleKind.HALF_SPACE, HalfSpaceBody(at(1, 0, 0), Fraction(-1)))
    unknown = Obstacle("deep", ObstacleKind.FORMULA, (Piece((half_space(at(0, 0, 1), Fraction(-1)),)),))
    findings = survey.survey({"A": ARCH}, [touched, entered, unknown])
    assert [f.is_clear for f in findings] == [False, False, True]
    words = [survey.in_words(f) for f in findings]
    assert words[0] == "A: touches ball, first at t = 1/2, (0, 0, 2)"
    assert words[1].startswith("A: enters floor, first at t = 0")
    assert words[2] == "A: clear of deep for all t (Bernstein coefficients of the whole curve)"
    data = [survey.to_json(f) for f in findings]
    assert data[0]["first_contact"]["exact_place"] == ["0", "0", "2"] and data[0]["distance"]["high"] == "0"
    assert data[2]["distance"] is None and data[2]["argument"] == "Bernstein coefficients of the whole curve"
    labels = [label for label, _ in survey.certificates(findings)]
    assert labels == ["A meets ball", "A meets floor", "A clear of deep"]
