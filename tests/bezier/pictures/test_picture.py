"""Pictures: the surface that is drawn is the boundary of the region, and the page's parts are well formed."""

import json
import xml.etree.ElementTree as ElementTree
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves.workspace import Ball, HalfSpace
from bezier.methods.quadratic import formula as quadratic
from bezier.pictures import mesh, plot, scene
from bezier.pictures.picture import INK, PathPicture, RegionPicture, curve_pictures, numbers, region_picture
from bezier.problem import load_problem
from bezier.report import mathml
from bezier.report.parts import GIVEN
from qe.io import text
from tests.tables import each

ORIGIN = (Fraction(0),) * 3
HALF_SPACES = [HalfSpace((Fraction(0), Fraction(0), Fraction(k)), Fraction(1)) for k in range(1, 6)]


@pytest.fixture(scope="module")
def example(root):
    return load_problem(root / "examples" / "three_balls.toml")


@pytest.fixture(scope="module")
def picture(example):
    conditions = quadratic.as_conditions_on_q1(quadratic.system(example))
    q1 = (Fraction(0), Fraction(3), Fraction(3))
    points = quadratic.system(example).points([q1])
    curves = quadratic.system(example).curves(points)
    marks = {name: numbers([p])[0] for name, p in points.items()}
    return PathPicture(4.7, False, curve_pictures(curves, 9), marks, region_picture(conditions, conditions, q1, 2))


def test_the_mesh_is_the_boundary(example):
    conditions = quadratic.as_conditions_on_q1(quadratic.system(example))
    surface = mesh.region_mesh(conditions, 3)
    margins = np.array([[float(c.margin(tuple(map(Fraction, v)))) for c in conditions] for v in surface.vertices])
    assert abs(margins.min(axis=1)).max() < 1e-6
    edges = np.sort(np.concatenate([surface.faces[:, p] for p in ([0, 1], [1, 2], [2, 0])]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    assert (counts == 2).all(), "the surface is closed"
    assert set(surface.owner.tolist()) == {0, 1, 2} and len(surface.edges) == 3


def test_volume_of_a_half_ball():
    half = [Ball(ORIGIN, Fraction(4)), HalfSpace((Fraction(0), Fraction(0), Fraction(2)), Fraction(0))]
    surface = mesh.region_mesh(half, 4)
    corners = surface.vertices[surface.faces]
    volume = np.abs(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum()) / 6
    assert volume == pytest.approx(16 * np.pi / 3, rel=0.01)


def test_nothing_to_draw():
    touching = [Ball(ORIGIN, Fraction(1)), Ball((Fraction(2), Fraction(0), Fraction(0)), Fraction(1))]
    assert mesh.region_mesh(touching) is None
    assert mesh.region_mesh([HalfSpace((Fraction(1), Fraction(0), Fraction(0)), Fraction(0))]) is None


def test_hull_of_a_square_with_a_point_inside():
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]])
    assert sorted(map(tuple, mesh.hull(points)[:-1].tolist())) == [(0, 0), (0, 1), (1, 0), (1, 1)]


def test_labels_and_colours(picture):
    assert picture.region.labels == ("P1", "Q1", "R1")
    assert len({picture.region.colour(k) for k in range(3)}) == 3


def test_every_boundary_surface_has_its_own_colour(example):
    conditions = [*quadratic.as_conditions_on_q1(quadratic.system(example)), *HALF_SPACES]
    labels = ("P1", "Q1", "R1", "P1.z", "Q1.z", "R1.z", "roof", "wall")
    surface = RegionPicture(mesh.region_mesh(conditions[:3], 1), labels)
    colours = [surface.colour(k) for k in range(len(labels))]
    assert len(set(colours)) == len(colours)


def test_normals_point_outwards_and_are_those_of_the_surface(example):
    conditions = quadratic.as_conditions_on_q1(quadratic.system(example))
    surface = mesh.region_mesh(conditions, 2)
    middles = surface.vertices[surface.faces].mean(axis=1)
    assert np.allclose(np.linalg.norm(surface.normals, axis=1), 1)
    assert ((middles - middles.mean(axis=0)) * surface.normals).sum(axis=1).min() > 0
    for k, condition in enumerate(conditions):
        away = middles[surface.owner == k] - np.array([float(c) for c in condition.centre])
        assert np.abs(np.cross(away, surface.normals[surface.owner == k])).max() < 1e-9


def test_scenes_hold_the_numbers_that_are_drawn(picture):
    given = dict(zip(GIVEN, (picture.marks[name] for name in ("P0", "Q0", "R0", "R2")), strict=True))
    shown = json.loads(scene.text(scene.path_scene(picture, None, timed=False, given=given)))
    assert [name for name, _, main in shown["marks"] if main] == [*GIVEN]
    minor = {name for name, _, main in shown["marks"] if not main}
    assert minor == {"P\u0302₁", "Q\u0302₁", "R\u0302₁"}, "a place has one name"
    for curve, drawn in zip(picture.curves, shown["curves"], strict=True):
        assert np.allclose(np.array(drawn["v"]).reshape(-1, 3), curve.points, atol=1e-4 * picture.radius)
    region = json.loads(scene.text(scene.region_scene(picture.region)))["bodies"][0]
    assert len(region["f"]) == 3 * len(region["c"]) == len(region["n"])
    assert max(region["f"]) < len(region["v"]) // 3 and set(region["c"]) == set(range(len(region["colours"])))


@each(1e-7, 1.0, 3e8)
def test_scenes_of_any_size_keep_their_shape(size):
    marks = {"P0": np.array([0.3, -0.2, 0.1]) * size}
    shown = scene.path_scene(PathPicture(size, True, (), marks), None, timed=False, given={"start": marks["P0"]})
    assert np.allclose(np.array(shown["marks"][0][1]), marks["P0"], rtol=1e-3)


def crossing(boxes):
    return [(a, b) for i, a in enumerate(boxes) for b in boxes[i + 1 :] if a.overlaps(b)]


@settings(max_examples=12, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12)), min_size=1, max_size=7, unique=True))
def test_names_cover_neither_each_other_nor_the_frame(points):
    figure = plot.new_figure(5, 4)
    axis = figure.add_axes((0.1, 0.1, 0.85, 0.85))
    axis.set(xlim=(-13, 27), ylim=(-13, 27))
    plot.place(axis, [(f"Q{i}", point) for i, point in enumerate(points)], np.array(points, dtype=float))
    texts = [text for text in axis.texts if text.get_text()]
    boxes = [text.get_window_extent() for text in texts]
    assert len(boxes) == len(points) and not crossing(boxes)
    frame = axis.get_window_extent()
    assert all(frame.x0 <= b.x0 and b.x1 <= frame.x1 and frame.y0 <= b.y0 and b.y1 <= frame.y1 for b in boxes)


def test_drawings_take_the_colours_of_the_page(picture):
    for svg, words in plot.views(picture):
        assert words and ElementTree.fromstring(svg).tag.endswith("svg")
        assert "var(--ink)" in svg and "var(--p)" in svg and INK not in svg


@each(("3/4", "mfrac"), ("-2", "mo"), ("(3 - sqrt(5))/2", "msqrt"), ("2*sqrt(3)", "msqrt"), ("??", "mtext"))
def test_numbers_as_mathml(source, fragment):
    body = mathml.number_text(source)
    ElementTree.fromstring(f"<math>{body}</math>")
    assert f"<{fragment}>" in body


def test_formulas_as_mathml():
    body = mathml.formula(text.read("q1x^2 - 3*q1y < 0 and (q1z = 0 or not q1x /= 1)"))
    ElementTree.fromstring(f"<math>{body}</math>")
    assert "∧" in body and "∨" in body and "&lt;" in body and "&gt;" not in body and body.count("<mover") == 4
