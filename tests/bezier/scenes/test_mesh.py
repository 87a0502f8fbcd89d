"""Meshes and polygons that are not convex: parts against cubes, answers against a flood, and lies."""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.ndimage import label

import bezier
import qe
from bezier.scenes import mesh
from bezier.scenes.mesh import Surface
from bezier.scenes.route import decided
from bezier.scenes.scene import Scene, of_sides
from bezier.scenes.sentences import surfaces
from bezier.scenes.solid import ZERO
from qe.options import Budget
from tests.bezier.scenes.test_route import SCENE, read_scene
from tests.tables import each

Triangle = tuple[tuple[Fraction, ...], ...]
RING = {(x, y, 0) for x in range(3) for y in range(3)} - {(1, 1, 0)}
BRACKET = {(0, 0, 0), (1, 0, 0), (1, 0, 1)}
HOLLOW = {*product(range(3), repeat=3)} - {(1, 1, 1)}


def sheared(p: Any) -> tuple[Fraction, ...]:
    """The cubes as slanted bodies, whose planes are none of the coordinates'."""
    x, y, z = map(Fraction, p)
    return x + y / 3, y - z / 5, z + x / 7


def of_cubes(cubes: Any, image: Any = sheared) -> list[Triangle]:
    """The surface of a union of unit cubes by their lowest corners, its outer side outwards."""
    triangles = []
    for cube in cubes:
        for axis, up in product(range(3), (0, 1)):
            if tuple(c + (k == axis) * (2 * up - 1) for k, c in enumerate(cube)) in cubes:
                continue
            i, j = (axis + 1) % 3, (axis + 2) % 3
            square = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = [*cube]
                corner[axis], corner[i], corner[j] = cube[axis] + up, cube[i] + a, cube[j] + b
                square.append(image(corner))
            a, b, c, d = square if up else square[::-1]
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def random_cubes(rng: random.Random, size: int, count: int) -> set[tuple[int, ...]]:
    """Cubes that hang together by faces, of which no two meet in an edge alone."""
    cubes = {tuple(rng.randrange(size) for _ in range(3))}
    for _ in range(3 * count):
        at, axis = rng.choice(sorted(cubes)), rng.randrange(3)
        new = tuple(c + (k == axis) * rng.choice((-1, 1)) for k, c in enumerate(at))
        facets = [*mesh._facets("cubes", of_cubes({*cubes, new}))]
        try:
            mesh._refuse_open("cubes", facets)
        except qe.InputError:
            continue
        if len(cubes) < count and all(0 <= c < size for c in new):
            cubes.add(new)
    return cubes


@each(("a cube", {(0, 0, 0)}), ("a ring", RING), ("a bracket", BRACKET))
def test_the_parts_are_just_what_is_inside(what: str, cubes: set[Any]) -> None:
    surface = Surface.of(what, of_cubes(cubes))
    surface.check()
    for cube in product(range(-1, 4), repeat=3):
        for share in ((Fraction(1, 3),) * 3, (Fraction(1, 7), Fraction(2, 7), Fraction(6, 7))):
            point = sheared([c + s for c, s in zip(cube, share)])
            assert any(core.contains(point) for core in surface.cores) is (cube in cubes)


def caged(surface: Surface, start: Any, goal: Any) -> Scene:
    """Two points in a box, with a surface between them."""
    given = read_scene({"domain": {"low": [-4] * 3, "high": [9] * 3}, "start": [0] * 3, "goal": [0] * 3})
    bodies = tuple(of_sides("part", cell.corners, cell.sides, ZERO) for cell in surface.cores)
    return replace(given, start=sheared(start), goal=sheared(goal), obstacles=bodies, surfaces=(surface,))


INSIDE, OUTSIDE = (Fraction(3, 2),) * 3, (Fraction(3, 2), Fraction(3, 2), Fraction(4))


@each((HOLLOW, True), (HOLLOW - {(1, 1, 2)}, False))
def test_a_hollow_is_left_through_a_hole_only(cubes: set[Any], blocked: bool) -> None:
    found = decided(caged(Surface.of("hollow", of_cubes(cubes)), INSIDE, OUTSIDE), Budget(60))
    found.check()
    assert found.blocked is blocked


@each(({(0, 0, 0)}, "cores"), (RING, "beside"))
def test_one_cell_with_the_surface_inside_is_refused(cubes: set[Any], side: str) -> None:
    """The surface goes once around its centre, or not at all, which says nothing about the rest."""
    surface = Surface.of("whole", of_cubes(cubes))
    surface.check()
    with pytest.raises(qe.CertificateRejected, match="goes through the inside"):
        replace(surface, **{"cores": (), "beside": (), side: (surface.around,)}).check()  # type: ignore[arg-type]


def test_a_wrong_division_is_refused() -> None:
    surface = Surface.of("bracket", of_cubes(BRACKET))
    known = caged(surface, (0, 0, 3), (0, 0, 4))
    found = decided(known, Budget(60))
    first = surface.facets[0]
    for altered in (
        replace(surface, cores=surface.cores[1:]),
        replace(surface, beside=surface.beside[:-1]),
        replace(surface, cores=(*surface.cores, surface.beside[0]), beside=surface.beside[1:]),
        replace(surface, cores=(), beside=(surface.around,)),
        replace(surface, facets=surface.facets[1:]),
        replace(surface, facets=tuple(mesh.facet(f.corners[::-1]) for f in surface.facets)),  # type: ignore[misc]
        replace(surface, facets=(*surface.facets, first)),
    ):
        with pytest.raises((qe.CertificateRejected, qe.Unable)):
            scene = replace(known, surfaces=(altered,))
            replace(found, scene=scene).check()  # the proof that was made does not fit
            decided(scene, Budget(60)).check()  # and none is made
    with pytest.raises(qe.CertificateRejected, match="no obstacle"):
        dict(surfaces(replace(known, obstacles=known.obstacles[1:])))


C = [[3, 3], [7, 3], [7, 4], [4, 4], [4, 6], [7, 6], [7, 7], [3, 7]]
SQUARE, HOLE = [[2, 2], [8, 2], [8, 8], [2, 8]], [[4, 4], [6, 4], [6, 6], [4, 6]]


@each(
    ({"vertices": C}, False),
    ({"vertices": C[::-1], "margin": "9/10"}, False),
    ({"vertices": C, "margin": 1}, "the start is in polygon obstacle 1, part"),
    ({"vertices": SQUARE, "holes": [HOLE]}, "separate"),
    ({"vertices": [*SQUARE, [2, 6], [6, 6], [6, 4], [2, 4]]}, False),
)
def test_polygons_need_not_be_convex(shape: Any, blocked: Any) -> None:
    scene = {**SCENE, "start": [5, 5], "obstacle": [{"kind": "polygon", **shape}]}
    found = bezier.route(scene)
    assert found.blocked is bool(blocked) and (not blocked or blocked in str(found))
    found.check()


@each(
    ({"vertices": [[0, 0], [1, 1], [1, 0], [0, 1]]}, "self-intersecting: sides 1 and 3"),
    ({"vertices": [[0, 0], [1, 1], [1, 1], [0, 1]]}, "side 2 is flat"),
    ({"vertices": [[0, 0], [1, 1]]}, "3 to"),
    ({"vertices": SQUARE, "holes": 3}, "holes"),
    ({"vertices": SQUARE, "holes": [[[1, 3], [5, 3], [5, 5]]]}, "self-intersecting"),
    ({"vertices": HOLE, "holes": [SQUARE]}, "inside out"),
)
def test_bad_polygons_are_one_line(shape: Any, word: str) -> None:
    with pytest.raises(qe.InputError, match=word):
        bezier.route({**SCENE, "obstacle": [{"kind": "polygon", **shape}]})


CUBE = of_cubes({(0, 0, 0)})
FAR = of_cubes({(1, 1, 1)}, lambda p: tuple(map(Fraction, p)))
HALVES = of_cubes({(0, 0, 0)}, lambda p: tuple(Fraction(c) / 2 + Fraction(1, 4) for c in p))
STRAIGHT = of_cubes({(0, 0, 0)}, lambda p: tuple(map(Fraction, p)))


@each(
    (CUBE[1:], r"not closed \(edge .* belongs to 1 triangle\)"),
    ([*CUBE, *CUBE], "belongs to 4 triangles"),
    ([CUBE[0][::-1], *CUBE[1:]], "not oriented"),
    ([t[::-1] for t in CUBE], "inside out"),
    (
        [*STRAIGHT, *of_cubes({(0, 0, 0)}, lambda p: tuple(Fraction(c) + Fraction(1, 2) for c in p))],
        "triangles 7 and 13",
    ),
    ([*STRAIGHT, *HALVES], "around another"),
    ([(CUBE[0][0], CUBE[0][1], CUBE[0][1]), *CUBE], "triangle 1 is flat"),
)
def test_surfaces_that_bound_no_body_are_refused(triangles: list[Triangle], word: str) -> None:
    with pytest.raises(qe.InputError, match=word):
        Surface.of("mesh", triangles)


def written(triangles: list[Triangle]) -> str:
    """As an OBJ file."""
    lines = [f"v {' '.join(str(float(c)) for c in p)}" for triangle in triangles for p in triangle]
    return "\n".join([*lines, *(f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(triangles)))])


def test_a_mesh_beside_the_scene_is_scaled_and_moved(tmp_path: Path) -> None:
    pytest.importorskip("trimesh")
    (tmp_path / "cube.obj").write_text(written(STRAIGHT))
    wall = {"kind": "mesh", "file": "cube.obj", "scale": 4, "shift": [-2, -2, "-3/2"], "margin": "1/4"}
    ends = {"domain": {"low": [-3] * 3, "high": [3] * 3}, "start": [0, 0, "-2"], "goal": [0, 0, "11/4"]}
    (tmp_path / "scene.json").write_text(json.dumps({**ends, "obstacle": [wall]}))
    found = bezier.route(tmp_path / "scene.json")
    (body,) = found.scene.obstacles
    assert body.low_high() == (
        (Fraction(-9, 4), Fraction(-9, 4), Fraction(-7, 4)),
        (Fraction(9, 4),) * 2 + (Fraction(11, 4),),
    )
    assert str(found) == "blocked: the goal is in mesh cube.obj, part 1"


@each(
    ("none.stl", None, "no such file"),
    ("x.step", "ISO", "ends in"),
    ("x.stl", "", "found none"),
    ("x.stl", "this is no mesh", "found none"),
    ("x.ply", "this is no mesh", "found none"),
    ("x.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "finite"),
    ("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "found none"),
    ("x.obj", written(CUBE[:1] * 1001), "at most 1000 triangles, found 1001"),
)
def test_files_that_are_no_meshes_are_one_line(name: str, text: str | None, word: str, tmp_path: Path) -> None:
    pytest.importorskip("trimesh")
    if text is not None:
        (tmp_path / name).write_text(text)
    scene = {"domain": {"low": [-3] * 3, "high": [3] * 3}, "start": [2] * 3, "goal": [-2] * 3}
    with pytest.raises(qe.InputError) as caught:
        bezier.route({**scene, "obstacle": [{"kind": "mesh", "file": str(tmp_path / name)}]})
    assert word in str(caught.value).lower() and "\n" not in str(caught.value)


@pytest.mark.deep
def test_random_cubes_agree_with_a_flood() -> None:
    rng = random.Random(5)
    for _ in range(40):
        cubes = random_cubes(rng, 4, rng.randint(4, 40))
        taken = np.zeros((8, 8, 8), dtype=bool)
        for cube in cubes:
            taken[tuple(c + 2 for c in cube)] = True
        parts, _ = label(~taken)
        free = [tuple(int(c) - 2 for c in p) for p in np.argwhere(~taken)]
        start, goal = rng.choice(free), rng.choice(free)
        ends = [tuple(c + Fraction(1, 2) for c in p) for p in (start, goal)]
        found = decided(caged(Surface.of("cubes", of_cubes(cubes)), *ends), Budget(120))
        found.check()
        joined = parts[tuple(c + 2 for c in start)] == parts[tuple(c + 2 for c in goal)]
        assert found.blocked is not bool(joined)
