"""Triangles and lines for pictures. Everything here is floating point and decides nothing.

A region bounded by spheres and planes is convex, so its surface is the convex hull of boundary points: those
met by rays from an inner point, and those on the circles where two boundary surfaces meet.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bezier.curves.workspace import Ball, Condition
from bezier.motion.track import casteljau
from qe.regions.space import direction

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class RegionMesh:
    """A closed surface: ``vertices`` (n, 3), ``faces`` (m, 3), ``owner`` (m,): index of the bounding condition.

    ``normals`` (m, 3): outward, those of the boundary surface itself.
    """

    vertices: Array
    faces: Indices
    owner: Indices
    normals: Array
    edges: tuple[Array, ...]
    """Polylines where two of these meet."""


Shape = tuple[str, Array, float]
"""("ball", centre, radius), or ("plane", unit normal, offset) for {p : normal . p + offset >= 0}."""


def directions_around(count: int) -> Array:
    """Unit vectors that are nearly even on the sphere: a Fibonacci spiral."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    return np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], axis=1)


def region_mesh(conditions: Sequence[Condition], level: int = 3) -> RegionMesh | None:
    """The surface of an intersection of balls and half-spaces; None when it is unbounded or has no inner point."""
    shapes = [_numbers(c) for c in conditions]
    if not any(isinstance(c, Ball) for c in conditions):
        return None
    centre = _inner_point(shapes)
    depth = min(_margin(s, centre[None, :])[0] for s in shapes)
    if depth <= 1e-6 * max(1.0, float(np.abs(centre).max())):
        return None
    directions = directions_around(10 * 4**level + 2)
    boundary = _cast(shapes, centre, directions)
    # a second time with directions stretched to the shape found, so that thin regions are sampled evenly
    spread = np.linalg.cholesky(np.cov((boundary - centre).T))
    boundary = _cast(shapes, centre, directions @ spread.T)
    edges = _creases(shapes, centre, directions_around(16 * len(directions)) @ spread.T)
    vertices = np.concatenate([boundary, *edges])
    faces = hull_faces(vertices, centre)
    middle = vertices[faces].mean(axis=1) - centre
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    owner = np.stack([_ray(s, centre, middle) for s in shapes]).argmin(axis=0)
    return RegionMesh(vertices, faces, owner, _normals(shapes, owner, vertices[faces].mean(axis=1)), edges)


def _normals(shapes: Sequence[Shape], owner: Indices, middles: Array) -> Array:
    """The outward unit normals of the surfaces to which the faces belong: a thin triangle's own one tells little."""
    result = np.zeros_like(middles)
    for k, (kind, vector, _number) in enumerate(shapes):
        mine = owner == k
        result[mine] = middles[mine] - vector if kind == "ball" else -vector
    return np.asarray(result / (np.linalg.norm(result, axis=1, keepdims=True) + 1e-30))


def _cast(shapes: Sequence[Shape], centre: Array, directions: Array) -> Array:
    """The boundary points of the region in these directions from an inner point."""
    units = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    lengths = np.stack([_ray(s, centre, units) for s in shapes]).min(axis=0)
    return np.asarray(centre + units * lengths[:, None])


def hull_faces(vertices: Array, centre: Array) -> Indices:
    """Triangles of the convex hull, all seen counter-clockwise from outside.

    A convex region's boundary points and edge points give its surface.
    """
    from scipy.spatial import ConvexHull

    faces = np.asarray(ConvexHull(vertices).simplices, dtype=np.int64)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * (a - centre)).sum(axis=1) < 0
    faces[inward] = faces[inward][:, [0, 2, 1]]
    return faces


def _numbers(condition: Condition) -> Shape:
    if isinstance(condition, Ball):
        return "ball", np.array([float(c) for c in condition.centre]), float(condition.radius_squared) ** 0.5
    normal = np.array([float(c) for c in condition.normal])
    size = float(np.linalg.norm(normal))
    return "plane", normal / size, float(condition.offset) / size


def _margin(shape: Shape, points: Array) -> Array:
    """Distance to the boundary, positive inside."""
    kind, vector, number = shape
    if kind == "ball":
        return np.asarray(number - np.linalg.norm(points - vector, axis=1))
    return np.asarray(points @ vector + number)


def _inner_point(shapes: Sequence[Shape]) -> Array:
    """A point as far inside as can be: a convex problem."""
    from scipy import optimize

    balls = [s for s in shapes if s[0] == "ball"]
    start, size = np.mean([b[1] for b in balls], axis=0), max(b[2] for b in balls)

    def room(x: Array) -> Array:
        return np.array([_margin(s, x[None, :3] * size + start)[0] / size - x[3] for s in shapes])

    minimize: Any = optimize.minimize
    best = minimize(lambda x: -x[3], [0.0, 0.0, 0.0, -2.0], constraints={"type": "ineq", "fun": room})
    return np.asarray(best.x[:3] * size + start)


def _ray(shape: Shape, origin: Array, directions: Array) -> Array:
    """The distance from an inner point to the boundary in each unit direction."""
    kind, vector, number = shape
    if kind == "ball":
        arrow = origin - vector
        b = directions @ arrow
        return -b + np.sqrt(np.maximum(b * b - arrow @ arrow + number * number, 0.0))
    slope = directions @ vector
    with np.errstate(divide="ignore"):
        return np.where(slope < 0, (origin @ vector + number) / np.where(slope < 0, -slope, 1.0), np.inf)


def _creases(shapes: Sequence[Shape], centre: Array, directions: Array) -> tuple[Array, ...]:
    """Lines along which two boundary surfaces meet: points by bisection between neighbours on different ones."""

    def owners(units: Array) -> Indices:
        return np.asarray(np.stack([_ray(s, centre, units) for s in shapes]).argmin(axis=0))

    units = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    faces = hull_faces(units, np.zeros(3))
    pairs = np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)
    own = owners(units)
    pairs = pairs[own[pairs[:, 0]] != own[pairs[:, 1]]]
    low, high = units[pairs[:, 0]], units[pairs[:, 1]]
    for _ in range(40):
        middle = low + high
        middle /= np.linalg.norm(middle, axis=1, keepdims=True)
        is_low = (owners(middle) == own[pairs[:, 0]])[:, None]
        low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
    meeting = np.sort(np.stack([own[pairs[:, 0]], owners(high)], axis=1), axis=1)
    points = _cast(shapes, centre, low)
    listed = (points[(meeting == pair).all(axis=1)] for pair in np.unique(meeting, axis=0))
    return tuple(line for part in listed if len(part) > 3 for line in _lines(part))


def _lines(points: Array) -> list[Array]:
    """Points of a convex plane curve, or of a straight line, in order, cut where there are gaps."""
    away = points - points.mean(axis=0)
    x, y = (away @ axis for axis in np.linalg.svd(away)[2][:2])
    ordered = points[np.argsort(x if np.ptp(y) < 1e-6 * np.ptp(x) else np.arctan2(y, x))]
    steps = np.linalg.norm(np.roll(ordered, -1, axis=0) - ordered, axis=1)
    cuts = np.flatnonzero(steps > 4 * steps.mean())
    if not len(cuts):
        return [np.concatenate([ordered, ordered[:1]])]
    return np.split(np.roll(ordered, -cuts[0] - 1, axis=0), cuts[1:] - cuts[0])


def sampled(control: Sequence[Sequence[Any]], count: int = 61) -> Array:
    """Points of a Bézier curve at equally spaced parameters, by de Casteljau in floating point."""
    return casteljau(np.array([[float(c) for c in p] for p in control]), np.linspace(0.0, 1.0, count))


def hull(points: Array) -> Array:
    """The convex hull of points in the plane, counter-clockwise and closed; the points themselves where it is flat."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        corners = points[ConvexHull(points).vertices]
    except (QhullError, ValueError):
        return points
    return np.concatenate([corners, corners[:1]])


def best_view(mesh: RegionMesh) -> tuple[float, float]:
    """Elevation and azimuth in degrees from which the boundary surfaces are all seen as well as possible."""
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    owners, whole = sorted(set(mesh.owner.tolist())), np.linalg.norm(normals, axis=1).sum()

    def score(view: tuple[float, float]) -> float:
        seen = np.clip(normals @ direction(view), 0, None)
        return sum(float(np.sqrt(seen[mesh.owner == k].sum() / whole)) for k in owners)

    return max(product((15.0, 25.0, 35.0), map(float, range(-170, 190, 15))), key=score)
