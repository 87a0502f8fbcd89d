"""Turnable pictures for the pages, as plain data for ``scene.js``: points rounded to what a screen can show.

Everything drawn is a convex body with a closed surface, a cloud of points, or a line, so that the page needs no
library to draw it: of a convex body only the faces towards the viewer are seen.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bezier.motion.track import Track
from bezier.pictures.mesh import Array, best_view
from bezier.pictures.obstacles import ObstaclePicture
from bezier.pictures.picture import CurvePicture, PathPicture, RegionPicture, boundary, written

FRAMES = 181
VIEW = (20.0, -62.0)
"""Elevation and azimuth of the first look, in degrees."""
TONES = {"P": "p", "Q": "q", "R": "r"}
Scene = dict[str, Any]


def path_scene(picture: PathPicture, track: Track | None, *, timed: bool, given: Mapping[str, Array]) -> Scene:
    """The path with its control polygons, the obstacles, and the workspace.

    ``track``: the motion along it, in seconds if ``timed``; None: nothing moves. ``given``: the points of the problem
    by the words to be shown, in place of their names in ``picture.marks``.
    """
    marks = [[name, _flat(point, picture.radius), 1] for name, point in given.items()]
    near, named = 1e-6 * picture.radius, list(given.values())
    for name, point in picture.marks.items():
        if all(np.abs(point - other).max() > near for other in named):
            named.append(point)
            label = written(name) if picture.hatted_names else written(name).replace("\u0302", "")
            marks.append([label, _flat(point, picture.radius), 0])
    return {
        "reach": float(picture.radius),
        "floor": picture.has_floor,
        "view": VIEW,
        "bodies": [_body(o, picture.radius) for o in picture.obstacles if o.faces is not None],
        "clouds": [
            {"colour": o.colour, "v": _flat(o.vertices, picture.radius)} for o in picture.obstacles if o.faces is None
        ],
        "curves": [curve(c, picture.radius, TONES.get(c.name, "ink")) for c in picture.curves],
        "marks": marks,
        "motion": None if track is None else _motion(track, picture.radius, timed),
        "arm": None,
    }


def with_arm(scene: Scene, arm: Mapping[str, Any]) -> Scene:
    """The scene with an arm that follows the path: its frames, which then are the moments shown."""
    return {**scene, "arm": {key: arm[key] for key in ("names", "turns", "moving", "frames")}}


def arm_scene(arm: Mapping[str, Any]) -> Scene:
    """An arm and the path it follows, and nothing else."""
    path = np.array(arm["path"], dtype=float)
    size = float(np.abs(path).max()) or 1.0
    line = {"tone": "r", "colour": "#2e9e6b", "v": _flat(path, size), "polygon": []}
    scene: Scene = {"reach": None, "floor": True, "view": VIEW, "bodies": [], "clouds": [], "curves": [line]}
    marks = [[name, _flat(path[k], size), 1] for name, k in (("start", 0), ("goal", -1))]
    return with_arm({**scene, "marks": marks, "motion": None}, arm)


def region_scene(region: RegionPicture, seen_as: RegionPicture | None = None) -> Scene:
    """A region with the point chosen in it; seen from where ``seen_as`` is seen best."""
    mesh, size = region.mesh, float(np.abs(region.mesh.vertices).max())
    owners = sorted(set(mesh.owner.tolist()))
    body = {
        "alpha": 1,
        "v": _flat(mesh.vertices, size),
        "f": mesh.faces.reshape(-1).tolist(),
        "n": np.round(mesh.normals, 2).reshape(-1).tolist(),
        "c": [owners.index(owner) for owner in mesh.owner.tolist()],
        "colours": [region.colour(k) for k in owners],
        "edges": [_flat(edge[::6] if len(edge) > 60 else edge, size) for edge in mesh.edges],
    }
    marks = [] if region.chosen is None else [["the best one", _flat(region.chosen, size), 1]]
    scene: Scene = {"reach": None, "floor": False, "view": best_view((seen_as or region).mesh), "bodies": [body]}
    return scene | {"clouds": [], "curves": [], "marks": marks, "motion": None, "arm": None}


def region_legend(region: RegionPicture) -> list[tuple[str, str]]:
    """The boundary surfaces that are seen: what each is, and its colour."""
    return [(boundary(region.labels[k]), region.colour(k)) for k in sorted(set(region.mesh.owner.tolist()))]


def text(scene: Scene) -> str:
    """The scene as JSON that may stand inside a page."""
    return json.dumps(scene, separators=(",", ":"), allow_nan=False).replace("</", "<\\/")


def curve(curve: CurvePicture, size: float, tone: str) -> dict[str, Any]:
    """A curve with its polygon; ``tone``: the name of a colour of the page."""
    return {"tone": tone, "colour": curve.colour, "v": _flat(curve.points, size), "polygon": _flat(curve.polygon, size)}


def _body(obstacle: ObstaclePicture, size: float) -> dict[str, Any]:
    assert obstacle.faces is not None
    faces = obstacle.faces.reshape(-1).tolist()
    return {"alpha": 0.62, "v": _flat(obstacle.vertices, size), "f": faces, "colours": [obstacle.colour]}


def _motion(track: Track, size: float, timed: bool) -> dict[str, Any]:
    times = np.linspace(0.0, track.end, FRAMES)
    speed = np.linalg.norm(track.derivative.at(times), axis=1)
    unit = ("s", "mm/s") if timed else ("units of time", "mm per unit of time")
    top = float(speed.max()) or 1.0
    return {
        "t": _flat(times, track.end),
        "p": _flat(track.at(times), size),
        "speed": _flat(speed, top),
        "unit": unit[0],
        "per": unit[1],
    }


def _flat(values: NDArray[np.float64], size: float) -> list[float]:
    """All numbers in a row, rounded to five digits of ``size``."""
    digits = 5 - int(np.ceil(np.log10(size)))
    result: list[float] = np.round(np.asarray(values, dtype=float).reshape(-1), digits).tolist()
    return result
