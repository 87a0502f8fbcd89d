"""Signed distances of many points from a body, in floating point: for pictures, where they decide nothing."""

from __future__ import annotations

from typing import Any

import numpy as np

from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody
from bezier.obstacles.polyhedron import Polytope
from bezier.pictures.mesh import Array


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
