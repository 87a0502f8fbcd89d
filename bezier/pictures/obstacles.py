"""Obstacles in pictures. Floating point, for the eye only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import Constraint, Obstacle
from bezier.obstacles.polyhedron import Polytope
from bezier.pictures.mesh import Array, Indices, directions_around, hull, hull_faces

COLOURS = ("#d98a2b", "#8a6fb0", "#3f9aa8", "#8c6239", "#c2a92b", "#6b7785")
"""The colours of obstacles, in turn; none is near a colour of the curves."""
GRID = 21
"""Grid points per axis to show an obstacle given by a formula."""


@dataclass(frozen=True, slots=True)
class ObstaclePicture:
    """An obstacle's surface as triangles; without ``faces`` the vertices are points inside it."""

    name: str
    colour: str
    vertices: Array
    faces: Indices | None

    def outline(self, i: int, j: int) -> Array | None:
        """Its silhouette in a coordinate view, None for a cloud of points."""
        return None if self.faces is None else hull(self.vertices[:, [i, j]])


def obstacle_pictures(obstacles: Sequence[Obstacle], reach: float) -> tuple[ObstaclePicture, ...]:
    """All obstacles as far as they lie within ``reach`` of the origin; those that do not are left out."""
    result = []
    for k, obstacle in enumerate(obstacles):
        colour = COLOURS[k % len(COLOURS)]
        if obstacle.body is None:
            inside = _cloud(obstacle, reach)
            if len(inside):
                result.append(ObstaclePicture(obstacle.name, colour, inside, None))
            continue
        points = _surface(obstacle.body, reach)
        if len(points):
            result.append(ObstaclePicture(obstacle.name, colour, points, _faces(points)))
    return tuple(result)


def _faces(points: Array) -> Indices | None:
    """The triangles of the hull; None for a body so small or so far away that floating point sees no inside."""
    from scipy.spatial import QhullError

    try:
        return hull_faces(points, points.mean(axis=0))
    except QhullError:
        return None


def _surface(body: Body, reach: float) -> Array:
    """Points whose convex hull is the body, or its part that matters."""
    match body:
        case Rounded(core, radius):
            return _widened(np.array([[float(c) for c in p] for p in core.corners]), float(radius))
        case Cylinder():
            angle = np.linspace(0, 2 * np.pi, 33)[:-1]
            x, y = (float(c) + float(body.tube_radius) * turn(angle) for c, turn in zip(body.centre, (np.cos, np.sin)))
            heights = [-reach if body.bottom is None else float(body.bottom)]
            heights.append(reach if body.top is None else float(body.top))
            return _widened(np.concatenate([np.stack([x, y, 0 * x + h], axis=1) for h in heights]), float(body.radius))
    return _slice(body, reach)


def _widened(points: Array, radius: float) -> Array:
    """The points with balls around them."""
    if not radius:
        return points
    spiral = directions_around(642 if len(points) < 4 else 162 if len(points) < 20 else 42)
    directions = np.concatenate([spiral, np.eye(3), -np.eye(3)])  # flat sides are as far out as they are
    widened: Array = (points[:, None, :] + radius * directions[None]).reshape(-1, 3)
    return widened


def _slice(body: HalfSpaceBody, reach: float) -> Array:
    """A plate on the boundary plane of a half-space, inside the ball of radius ``reach``."""
    normal = np.array([float(c) for c in body.normal])
    size = np.linalg.norm(normal)
    unit, height = normal / size, float(body.offset) / size + float(body.radius)
    if abs(height) >= reach:
        return np.zeros((0, 3))
    first = np.cross(unit, np.eye(3)[np.argmin(abs(unit))])
    first /= np.linalg.norm(first)
    angle, wide = np.linspace(0, 2 * np.pi, 49)[:-1, None], (reach**2 - height**2) ** 0.5
    rim = height * unit + wide * (np.cos(angle) * first + np.sin(angle) * np.cross(unit, first))
    plate: Array = np.concatenate([rim, rim - 0.02 * reach * unit])
    return plate


def _cloud(obstacle: Obstacle, reach: float) -> Array:
    """Grid points inside an obstacle, within ``reach`` of the origin."""
    axes = [np.linspace(-reach, reach, GRID)] * 3
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    shown = excess([piece.constraints for piece in obstacle.pieces], axes).reshape(-1) >= 0
    return np.asarray(grid[shown & (np.linalg.norm(grid, axis=1) <= reach)])


def excess(pieces: Sequence[Sequence[Constraint]], axes: Sequence[Array]) -> Array:
    """On a grid, numbers that are not negative where all conditions of a piece hold, at most 1; where an equation is
    among them, in the cells that it goes through."""
    from scipy.ndimage import maximum_filter

    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)

    def values(condition: Constraint) -> Array:
        terms = (float(x) * np.prod(points ** np.array(e), axis=-1) for e, x in condition.terms)
        return np.asarray(sum(terms, np.zeros(points.shape[:-1])))

    def least(piece: Sequence[Constraint]) -> Array:
        is_thin = not {c.terms for c in piece}.isdisjoint(c.negated.terms for c in piece)
        listed = (maximum_filter(values(c), 3) if is_thin else values(c) for c in piece)
        return np.asarray(np.min([np.ones(points.shape[:-1]), *listed], axis=0))

    return np.asarray(np.max([least(piece) for piece in pieces], axis=0))


# --- distances ----------------------------------------------------------------------------------------------
def signed_distances(points: Array, body: Body) -> Array:
    """For points (n, 3); inside the body minus the depth, as far as planes, axis and corners tell it."""
    match body:
        case HalfSpaceBody(normal, offset):
            core = _beyond(points, normal, offset)
        case Cylinder(centre, tube_radius, bottom, top):
            across = np.linalg.norm(points[:, :2] - _floats(centre), axis=1) - float(tube_radius)
            ends = [float(bottom) - points[:, 2]] if bottom is not None else []
            ends += [points[:, 2] - float(top)] if top is not None else []
            parts = np.stack([across, np.max(ends, axis=0) if ends else np.full(len(points), -np.inf)])
            core = np.linalg.norm(np.maximum(parts, 0), axis=0) + np.minimum(parts.max(axis=0), 0)
        case _:
            core = _from_polytope(points, body.core)
    result: Array = core - float(body.radius)
    return result


def _from_polytope(points: Array, core: Polytope) -> Array:
    """By the nearest facet, edge or corner; inside by the nearest plane."""
    corners = [_floats(corner) for corner in core.corners]
    listed = [np.linalg.norm(points - corner, axis=1) for corner in corners]
    for i, j in core.edges:
        along = corners[j] - corners[i]
        share = np.clip((points - corners[i]) @ along / (along @ along), 0, 1)
        listed.append(np.linalg.norm(points - corners[i] - share[:, None] * along, axis=1))
    heights = [_beyond(points, facet.normal, facet.offset) for facet in core.facets]
    for facet, height in zip(core.facets, heights, strict=True):
        is_above = (height >= 0) & np.all([_beyond(points, n, c) <= 0 for n, c in facet.boundaries], axis=0)
        listed.append(np.where(is_above, height, np.inf))
    depth = np.max(heights, axis=0) if heights else np.zeros(len(points))
    result: Array = np.where(depth < 0, depth, np.min(listed, axis=0))
    return result


def _beyond(points: Array, normal: Any, offset: Any) -> Array:
    """How far beyond a plane."""
    n = _floats(normal)
    result: Array = (points @ n - float(offset)) / np.linalg.norm(n)
    return result


def _floats(values: Any) -> Array:
    return np.array([float(value) for value in values])
