"""Obstacles: their files, their distances, and what they are."""

from __future__ import annotations

from fractions import Fraction
from math import dist, hypot

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves.curve import Bezier
from bezier.curves.scalar import dot, subtract
from bezier.input.toml_table import Table
from bezier.obstacles import survey
from bezier.obstacles.bodies import Cylinder, HalfSpaceBody, Rounded, distance_enclosure
from bezier.obstacles.clearance import Clear, examine
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, Piece, from_body, half_space, pieces_of
from bezier.obstacles.polyhedron import from_corners, from_half_spaces, point
from bezier.obstacles.reader import read_obstacles, via_over
from bezier.pictures.mesh import sampled
from bezier.pictures.obstacles import signed_distances
from bezier.problem import from_json, read_problem, to_json
from qe.errors import InputError
from qe.exact.field import NumberField
from tests.bezier.made import (
    CUBE,
    OCTAHEDRON,
    TURNED,
    WEDGE,
    at,
    ball,
    bodies,
    control_points,
    cylinders,
    half_spaces,
    obstacle,
    points,
    rounded,
)
from tests.tables import each

anywhere = points(3, st.fractions(-5, 5, max_denominator=4))


@given(st.one_of(rounded, half_spaces), anywhere)
def test_a_body_is_the_points_within_its_radius_of_its_core(body, p):
    away = subtract(p, body.nearest(p))
    assert obstacle(body).contains(p) == (dot(away, away) <= body.radius**2)


@given(cylinders, anywhere)
def test_a_cylinder_with_margin_is_the_points_within_the_margin(body, p):
    across = max(hypot(float(p[0] - body.centre[0]), float(p[1] - body.centre[1])) - float(body.tube_radius), 0.0)
    above = 0.0 if body.top is None else max(float(p[2] - body.top), 0.0)
    below = 0.0 if body.bottom is None else max(float(body.bottom - p[2]), 0.0)
    excess = hypot(across, above, below) - float(body.radius)
    if abs(excess) > 1e-9:
        assert obstacle(body).contains(p) == (excess < 0)


@pytest.mark.parametrize("turn", [(1, 0), (0, 1), (-1, 0), (0, -1)])
def test_the_rim_of_a_cylinder_is_rounded_all_around(turn):
    body = Cylinder((Fraction(5), Fraction(-3)), Fraction(1), Fraction(0), Fraction(1), Fraction(1, 2))
    thing = obstacle(body)
    for away, inside in ((Fraction(13, 10), True), (Fraction(7, 5), False)):  # 0.3 and 0.4 beyond the rim, both ways
        x, y = 5 + away * turn[0], -3 + away * turn[1]
        assert thing.contains((x, y, away)) is inside and thing.contains((x, y, 1 - away)) is inside


def test_a_rim_with_a_margin_beyond_the_axis():
    body = Cylinder((Fraction(0), Fraction(0)), Fraction(1), Fraction(0), Fraction(1), Fraction(3))
    assert len(pieces_of(body)) == 6
    assert obstacle(body).contains(at(0, 0, 4)) and not obstacle(body).contains(at(0, 0, "401/100"))
    assert obstacle(body).contains(at(4, 0, "1/2")) and not obstacle(body).contains(at(4, 0, "11/10"))


@given(st.one_of(rounded, half_spaces, cylinders), anywhere)
def test_every_point_of_a_body_lies_in_its_box_and_below_its_support(body, p):
    if body.box is not None and obstacle(body).contains(p):
        assert all(low <= x <= high for low, x, high in zip(body.box[0], p, body.box[1], strict=True))
    q = body.nearest(p)
    towards = subtract(p, q)
    support = body.support(towards)
    assert support is not None and dot(towards, q) <= support


@given(st.one_of(rounded, half_spaces), anywhere)
def test_the_nearest_point_has_a_supporting_plane(body, p):
    """q is nearest iff (p - q) . k <= (p - q) . q for all k in the core (projection theorem for convex sets)."""
    q = body.nearest(p)
    assert dot(subtract(p, q), q) == body.support(subtract(p, q))


@each((CUBE, (8, 12, 6)), (TURNED, (8, 12, 6)), (OCTAHEDRON, (6, 12, 8)))
def test_corners_edges_and_facets(body, counts):
    assert (len(body.corners), len(body.edges), len(body.facets)) == counts


@each(CUBE, TURNED, OCTAHEDRON, WEDGE)
def test_half_spaces_and_corners_describe_the_same_body(body):
    assert from_half_spaces([(f.normal, f.offset) for f in body.facets]) == body
    redundant = [(f.normal, f.offset) for f in body.facets] + [(at(1, 1, 1), Fraction(100))]
    assert from_half_spaces(redundant) == body
    middle = tuple(sum(c[i] for c in body.corners) / len(body.corners) for i in range(3))
    assert from_corners([*body.corners, middle]) == body


UP, DOWN = (at(0, 0, 1), Fraction(1)), (at(0, 0, -1), Fraction(0))
WALLS = [(at(*n), Fraction(1)) for n in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]


@each(
    ([*WALLS, UP], "unbounded"),
    ([UP, DOWN], "unbounded"),
    ([*WALLS[:2], UP, DOWN], "unbounded"),
    ([*WALLS, UP, (at(0, 0, -1), Fraction(-2))], "empty"),
    ([*WALLS, UP, (at(0, 0, -1), Fraction(-1))], "in one plane"),
)
def test_bad_half_spaces(half_spaces, said):
    with pytest.raises(InputError, match=said):
        from_half_spaces(half_spaces)


def test_flat_corners_are_refused():
    for corners in ([at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(1, 1, 0)], [at(0, 0, 0), at(1, 1, 1), at(2, 2, 2)]):
        with pytest.raises(InputError, match="in one plane"):
            from_corners(corners)


def test_edges_have_the_length_of_a_side():
    sides = {round(dist(map(float, TURNED.corners[i]), map(float, TURNED.corners[j]))) for i, j in TURNED.edges}
    assert sides == {1, 5}


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
    nearest = signed_distances(sampled(curve.points, 257), body).min()
    assert float(found.low) <= nearest * (1 + 1e-9)
    assert found.high - found.low <= COARSE * found.high
    raised = distance_enclosure(curve.elevate(curve.degree + 1), body, COARSE)
    assert raised.low <= found.high and found.low <= raised.high


@settings(max_examples=25, deadline=None)
@given(bodies, control_points(4, 9))
def test_distances_of_pictures_are_negative_just_inside(body, points):
    for exact, distance in zip(points, signed_distances(np.array(points, dtype=float), body), strict=True):
        assert obstacle(body).contains(exact) == (distance <= 0) or abs(distance) < 1e-9


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


def read(text: str):
    return read_obstacles(Table.parse(text, "f.toml"))


def one(body: str):
    return read(f"[[obstacle]]\n{body}")[0]


@each(
    ('kind="ball"\ncentre=[1,0,0]\nradius="1/2"', (1.5, 0, 0), (1.6, 0, 0)),
    ('kind="ball"\ncentre=[1,0,0]\nradius="1/2"\nmargin=0.1', (1.6, 0, 0), (1.61, 0, 0)),
    ('kind="box"\nlow=[0,0,0]\nhigh=[1,2,3]', (1, 2, 3), (1, 2, 3.01)),
    ('kind="box"\nlow=[0,0,0]\nhigh=[1,2,3]\nmargin=0.5', (1.3, 2.4, 3), (1.3, 2.41, 3)),
    ('kind="box"\ncorner=[0,0,0]\nedges=[[3,4,0],[-4,3,0],[0,0,1]]', (-1, 7, 1), (-1.01, 7, 1)),
    ('kind="half_space"\nnormal=[0,0,2]\noffset=3', (9, 9, 1.5), (0, 0, 1.51)),
    ('kind="half_space"\nnormal=[0,3,4]\noffset=0\nmargin=1', (5, 0.6, 0.8), (5, 0.61, 0.8)),
    ('kind="cylinder"\ncentre=[1,1]\nradius=1\nbottom=0', (2, 1, 99), (2, 1, -0.01)),
    ('kind="capsule"\nstart=[0,0,0]\nend=[0,0,2]\nradius=1', (0, 0, 3), (1, 0, 3)),
    ('kind="polyhedron"\nvertices=[[0,0,0],[2,0,0],[0,2,0],[0,0,2]]', (0, 1, 1), (1, 1, 1)),
    ('kind="polyhedron"\nhalf_spaces=[[-1,0,0,0],[0,-1,0,0],[0,0,-1,0],[1,1,1,2]]', (0, 1, 1), (1, 1, 1)),
    ('kind="formula"\nformula="x*y >= 1 or z = 5"', (1, 1, 0), (1, 0, 0)),
    ('kind="formula"\nformula="not (x /= 0) and 2*y < z"', (0, 1, 3), (0, 1, 2)),
    ('kind="formula"\nformula="ex u. x = u^2 and y = u and z > 0"', (4, -2, 1), (4, -1, 1)),
)
def test_every_kind(body, inside, outside):
    found = one(body)
    assert found.contains(at(*map(str, inside))) and not found.contains(at(*map(str, outside)))


def test_names_and_tops():
    first, second, third = read(
        '[[obstacle]]\nkind="ball"\ncentre=[0,0,1]\nradius=1\n'
        '[[obstacle]]\nkind="cylinder"\nname="pole"\ncentre=[0,0]\nradius=1\ntop=4\nmargin=1\n'
        '[[obstacle]]\nkind="half_space"\nnormal=[0,0,1]\noffset=0\n'
    )
    assert (first.name, second.name, third.kind) == ("ball 1", "pole", ObstacleKind.HALF_SPACE)
    assert (first.top, second.top, third.top) == (2, 5, None)


BALL = 'kind="ball"\ncentre=[0,0,0]\n'


@each(
    ('kind="cone"', 'f.toml:2: obstacle[0].kind: expected "ball" or'),
    ("radius=1", "obstacle[0].kind: expected"),
    (BALL + "radius=-1", "f.toml:4: obstacle[0].radius: expected a number above zero, found -1"),
    (BALL + "radius=0", "expected a number above zero, found 0"),
    (BALL + 'radius="big"', "obstacle[0].radius: expected an integer, a decimal or a fraction"),
    (BALL + "radius=1\nmargin=-0.5", "margin: expected a number that is not negative, found -1/2"),
    (BALL + "radius=1\nheight=2", "expected one of the keys kind, name, margin, above, centre, radius"),
    (BALL + "radius=nan", 'radius: expected an integer, a decimal or a fraction such as "3/4", found nan'),
    (BALL + 'radius=1\nname=""', 'name: expected a name on one line, of at most 100 characters, found ""'),
    ('kind="ball"\ncentre=[0,0]\nradius=1', "centre: expected a point of 3 numbers, found an array of 2 values"),
    ('kind="box"\nlow=[0,0,0]\nhigh=[1,0,1]', "high: expected every coordinate above that of low, found (1, 0, 1)"),
    ('kind="box"\ncorner=[0,0,0]\nedges=[[1,0,0],[1,1,0],[0,0,1]]', "edges: expected three orthogonal vectors"),
    ('kind="box"\ncorner=[0,0,0]\nedges=[[1,0,0],[0,1,0]]', "edges: expected three vectors"),
    ('kind="box"\nlow=[0,0,0]\ncorner=[0,0,0]', "low: expected either low and high, or corner and edges"),
    ('kind="half_space"\nnormal=[0,0,0]\noffset=1', "normal: expected a point of 3 numbers, not all zero"),
    (
        'kind="cylinder"\ncentre=[0,0]\nradius=1\nbottom=2\ntop=1',
        "top: expected a number above bottom = 2, found 1",
    ),
    ('kind="cylinder"\ncentre=[0,0,0]\nradius=1', "centre: expected the x and y of the axis"),
    ('kind="capsule"\nstart=[0,0,0]\nend=[0,0,0]\nradius=1', "end: expected a point other than start"),
    ('kind="polyhedron"\nhalf_spaces=[[0,0,1,1],[0,0,-1,1]]', "expected a bounded polyhedron with interior"),
    ('kind="polyhedron"\nvertices=[[0,0,0],[1,0,0],[0,1,0]]', "found a set of corners in one plane"),
    ('kind="polyhedron"', "expected either half_spaces or vertices"),
    ('kind="polyhedron"\nhalf_spaces=[[0,0,0,1]]', "a half-space with normal zero"),
    ('kind="formula"\nformula="x >"', "formula: expected a formula in x, y, z, found formula:1:4"),
    ('kind="formula"\nformula="x + w > 0"', "expected no free variables but x, y, z, found w"),
    ('kind="formula"\nformula="1 > 2"', "expected a set that is not empty"),
    ('kind="formula"\nformula="y^2 >= x^3 - x"\nmargin=1', "a formula that can be used with the margin 1, found time"),
    ('kind="formula"\nformula=3', "formula: expected a formula in x, y, z, found 3"),
)
def test_bad_obstacles_get_one_clear_line(body, said, monkeypatch):
    monkeypatch.setattr("bezier.obstacles.reader.ELIMINATION_SECONDS", 0.5)
    with pytest.raises(InputError) as error:
        one(body)
    assert said in str(error.value) and "\n" not in str(error.value)


def outline(x, y):
    """Points of a curve with their parameters, many."""
    s = np.linspace(-4, 4, 40_001)
    return x(s), y(s)


@each(
    ("x^2 + 4*y^2 <= 4", outline(lambda s: 2 * np.cos(s), np.sin), lambda x, y: x * x + 4 * y * y <= 4),
    ("y >= x^2", outline(lambda s: s, lambda s: s * s), lambda x, y: y >= x * x),
    ("y = x^3", outline(lambda s: s, lambda s: s**3), lambda x, y: y == x**3),
    ("ex u. u^2 <= 1 and x = u and y = 2*u^2 - 1", outline(np.cos, lambda s: np.cos(2 * s)), lambda x, y: False),
)
def test_a_formula_with_margin_is_the_points_within_the_margin(text, boundary, holds):
    """Against the nearest of many points of the boundary; along z nothing changes."""
    body, margin = one(f'kind="formula"\nformula="{text}"\nmargin=0.75'), 0.75
    assert body.margin == Fraction(3, 4)
    for x, y in np.random.default_rng(5).uniform(-3, 3, (300, 2)):
        far = np.hypot(boundary[0] - x, boundary[1] - y).min()
        if abs(far - margin) > 1e-3:
            assert body.contains((Fraction(x), Fraction(y), Fraction(7))) is bool(far < margin or holds(x, y))


def test_margins_of_formulas_in_space_and_of_open_ones():
    ellipsoid = one('kind="formula"\nformula="x^2 + 4*y^2 + z^2 <= 4"\nmargin=0.5')
    assert [ellipsoid.contains((Fraction(x), Fraction(0), Fraction(0))) for x in ("2.5", "2.5001")] == [True, False]
    assert [ellipsoid.contains((Fraction(0), Fraction(0), Fraction(z))) for z in ("-2.5", "-2.5001")] == [True, False]
    assert [ellipsoid.contains((Fraction(0), Fraction(y), Fraction(0))) for y in ("1.5", "1.5001")] == [True, False]
    closed, opened = (one(f'kind="formula"\nformula="z {sign} 1"\nmargin=2') for sign in ("<=", "<"))
    assert closed.contains((Fraction(0), Fraction(0), Fraction(3))) and not opened.contains(
        (Fraction(0), Fraction(0), Fraction(3))
    )
    curve = Bezier(
        (
            (Fraction(-3), Fraction(0), Fraction(3)),
            (Fraction(0), Fraction(0), Fraction(4)),
            (Fraction(3), Fraction(0), Fraction(3)),
        )
    )
    assert isinstance(examine(curve, opened), Clear) and not isinstance(examine(curve, closed), Clear)


def test_two_obstacles_of_one_name():
    with pytest.raises(InputError, match="a name of its own"):
        read(f'[[obstacle]]\nname="a"\n{BALL}radius=1\n[[obstacle]]\nname="a"\n{BALL}radius=2')


PROBLEM = """
method = "quadratic"
start = [-4, 2, 1]
goal = [4, 2, 1]
radius = 6
[[obstacle]]
kind = "box"
name = "crate"
low = [-1, 1, 0]
high = [1, 3, 2]
margin = 0.1
above = ["Q1"]
"""


def test_via_points_come_from_the_obstacle_in_the_way():
    found = read_problem(PROBLEM)
    height = Fraction(21, 10) + Fraction(22, 10) / 10
    assert found.via == ((Fraction(-11, 10), 2, height), (Fraction(11, 10), 2, height))
    beside = PROBLEM.replace("[-1, 1, 0]", "[-1, 4, 0]").replace("[1, 3, 2]", "[1, 5, 2]")
    assert read_problem(beside).via == ((Fraction(-4, 3), 2, 1), (Fraction(4, 3), 2, 1))


def test_a_start_under_the_obstacle_needs_via_points():
    with pytest.raises(InputError, match="obstacle: expected obstacles that via points can be found for"):
        read_problem(PROBLEM.replace("start = [-4, 2, 1]", "start = [0, 2, 5]"))


def test_above_becomes_a_condition_on_control_points():
    (condition,) = read_problem(PROBLEM).point_conditions
    assert condition.points == ("Q1",) and condition.half_space.margin(at(0, 0, "21/10")) == 0
    with pytest.raises(InputError, match=r"obstacle\[0\].above\[0\]: expected a list of control points"):
        read_problem(PROBLEM.replace('["Q1"]', '["Q7"]'))
    endless = PROBLEM.replace("low = [-1, 1, 0]\nhigh = [1, 3, 2]", "centre = [0, 0]\nradius = 1").replace(
        "box", "cylinder"
    )
    with pytest.raises(InputError, match="above: expected this key for an obstacle with a top"):
        read_problem(endless)


def test_a_problem_with_obstacles_survives_json():
    found = read_problem(PROBLEM)
    again = from_json(to_json(found), "stored")
    assert (again.obstacles, again.via, again.above) == (found.obstacles, found.via, found.above)


START, GOAL = at(0, 0, 0), at(12, 0, 0)


def test_without_anything_in_the_way_thirds() -> None:
    thirds = (at(4, 0, 0), at(8, 0, 0))
    assert via_over(START, GOAL, []) == thirds
    assert via_over(START, GOAL, [ball((6, 5, 0), 1)]) == thirds  # beside the way
    assert via_over(START, at(0, 0, 9), []) == (at(0, 0, 3), at(0, 0, 6))


def test_over_one_and_over_two_boxes() -> None:
    """A tenth of the height of the highest box above it, where the boxes begin and end."""
    q0, r0 = via_over(START, GOAL, [ball((6, 0, 0), 1)])
    assert (q0, r0) == ((5, 0, Fraction(6, 5)), (7, 0, Fraction(6, 5)))
    q0, r0 = via_over(START, GOAL, [ball((9, 0, 1), 2), ball((3, 0, 0), 1)])
    assert (q0, r0) == ((2, 0, 3 + Fraction(4, 10)), (11, 0, 3 + Fraction(4, 10)))
    q0, _ = via_over(START, GOAL, [ball((6, 0, 0), 1)], Fraction(1))
    assert q0[2] == 3


@pytest.mark.parametrize("centre", [(0, 0, 5), (12, 0, 0), (1, 0, 0), (11, 0, -7)])
def test_nothing_may_stand_over_the_ends(centre: tuple[int, int, int]) -> None:
    with pytest.raises(InputError, match="give via points"):
        via_over(START, GOAL, [ball(centre, 1)])
