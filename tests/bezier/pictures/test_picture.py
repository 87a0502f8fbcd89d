"""Pictures: the surface that is drawn is the boundary of the region, and the page's parts are well formed."""

import json
import xml.etree.ElementTree as ElementTree
from fractions import Fraction

import numpy as np
import pytest

from bezier.curves.workspace import Ball, HalfSpace
from bezier.methods.quadratic import formula as quadratic
from bezier.pictures import mesh, scene
from bezier.pictures.picture import PathPicture, curve_pictures, numbers, region_picture
from bezier.problem import load_problem
from bezier.report import mathml
from bezier.report.recognise import as_conditions
from qe.io import text

ORIGIN = (Fraction(0),) * 3


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


def test_conditions_are_read_back_from_an_answer():
    variables = ("x", "y", "z")
    found = as_conditions(text.read("x^2 + y^2 + z^2 - 4*x <= 0 and 3 - 2*z >= 0"), variables)
    assert found == (Ball((2, 0, 0), Fraction(4)), HalfSpace((0, 0, -2), Fraction(3)))
    for other in ("x*y >= 0", "x^2 + 2*y^2 + z^2 <= 1", "x^2 + y^2 + z^2 >= 1", "x = 0", "x > 0 or y > 0", "w > 0"):
        assert as_conditions(text.read(other), variables) is None


def test_labels_and_colours(picture):
    assert picture.region.labels == ("P1", "Q1", "R1")
    assert len({picture.region.colour(k) for k in range(3)}) == 3


def test_figures_are_json_without_nan(picture):
    for figure in (scene.region_figure(picture), scene.path_figure(picture)):
        assert json.loads(json.dumps(figure, allow_nan=False))["data"]


@pytest.mark.parametrize(
    ("source", "fragment"),
    [("3/4", "mfrac"), ("-2", "mo"), ("(3 - sqrt(5))/2", "msqrt"), ("2*sqrt(3)", "msqrt"), ("??", "mtext")],
)
def test_numbers_as_mathml(source, fragment):
    body = mathml.number_text(source)
    ElementTree.fromstring(f"<math>{body}</math>")
    assert f"<{fragment}>" in body


def test_formulas_as_mathml():
    body = mathml.formula(text.read("q1x^2 - 3*q1y < 0 and (q1z = 0 or not q1x /= 1)"))
    ElementTree.fromstring(f"<math>{body}</math>")
    assert "∧" in body and "∨" in body and "&lt;" in body and "&gt;" not in body and body.count("<mover") == 4
