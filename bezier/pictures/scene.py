"""Turnable pictures for the pages, as plain data for ``scene.js``: points rounded to what a screen can show.

Everything drawn is a convex body with a closed surface, a cloud of points, or a line, so that the page needs no
library to draw it: of a convex body only the faces towards the viewer are seen.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from itertools import combinations, product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bezier.motion.track import Track
from bezier.pictures.mesh import Array, best_view, sampled
from bezier.pictures.obstacles import ObstaclePicture, obstacle_pictures
from bezier.pictures.picture import (
    COLOURS,
    CurvePicture,
    PathPicture,
    RegionPicture,
    boundary,
    numbers,
    written,
)
from bezier.scenes.route import Blocked, Route

FRAMES = 181
VIEW = (20.0, -62.0)
"""Elevation and azimuth of the first look, in degrees."""
TONES = {"P": "p", "Q": "q", "R": "r"}
Scene = dict[str, Any]
EMPTY: Scene = {"reach": None, "floor": False, "view": VIEW, "motion": None, "arm": None}
EMPTY |= {key: [] for key in ("bodies", "clouds", "curves", "marks")}


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
        **EMPTY,
        "reach": float(picture.radius),
        "floor": picture.has_floor,
        **_obstacles(picture.obstacles, picture.radius),
        "curves": [curve(c, picture.radius, TONES.get(c.name, "ink")) for c in picture.curves],
        "marks": marks,
        "motion": None if track is None else _motion(track, picture.radius, timed),
    }


def with_arm(scene: Scene, arm: Mapping[str, Any]) -> Scene:
    """The scene with an arm that follows the path: its frames, which then are the moments shown."""
    return {**scene, "arm": {key: arm[key] for key in ("names", "turns", "moving", "frames")}}


def arm_scene(arm: Mapping[str, Any]) -> Scene:
    """An arm and the path it follows, and nothing else."""
    path = np.array(arm["path"], dtype=float)
    size = float(np.abs(path).max()) or 1.0
    line = {"tone": "r", "colour": "#2e9e6b", "v": _flat(path, size), "polygon": []}
    marks = [[name, _flat(path[k], size), 1] for name, k in (("start", 0), ("goal", -1))]
    return with_arm({**EMPTY, "floor": True, "curves": [line], "marks": marks}, arm)


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
    return {**EMPTY, "view": best_view((seen_as or region).mesh), "bodies": [body], "marks": marks}


def region_legend(region: RegionPicture) -> list[tuple[str, str]]:
    """The boundary surfaces that are seen: what each is, and its colour."""
    return [(boundary(region.labels[k]), region.colour(k)) for k in sorted(set(region.mesh.owner.tolist()))]


def route_scene(known: Route | Blocked) -> Scene:
    """A scene in space with the box around its workspace, and the way through it."""
    scene, ends = known.scene, numbers([known.scene.low, known.scene.high])
    size = float(np.abs(ends).max())
    shown = obstacle_pictures([body.obstacle for body in scene.bodies], size * 3**0.5)
    corners = [np.array(corner) for corner in product(*ends.T)]
    edges = [_flat(np.array([a, b]), size) for a, b in combinations(corners, 2) if np.count_nonzero(a - b) == 1]
    box = {"alpha": 0.5, "v": _flat(np.array(corners), size), "f": [], "colours": [], "edges": edges}
    way = [sampled(curve, 2 if len(curve) == 2 else 25) for curve in known.curves] if isinstance(known, Route) else []
    listed = [{"tone": "r", "colour": COLOURS["R"], "v": _flat(points, size), "polygon": []} for points in way]
    marks = [[name, _flat(numbers([p]), size), 1] for name, p in (("start", scene.start), ("goal", scene.goal))]
    whole = {**_obstacles(shown, size), "curves": listed, "marks": marks}
    return {**EMPTY, **whole, "bodies": [box, *whole["bodies"]]}


def _obstacles(shown: Sequence[ObstaclePicture], size: float) -> Scene:
    """Bodies, and clouds where there are no faces."""
    clouds = [{"colour": o.colour, "v": _flat(o.vertices, size)} for o in shown if o.faces is None]
    return {"bodies": [_body(o, size) for o in shown if o.faces is not None], "clouds": clouds}


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
