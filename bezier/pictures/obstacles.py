"""Obstacles in pictures, and the chart of heights and clearances. Floating point, for the eye only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import numpy as np

from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.clearance import Contact
from bezier.obstacles.distance import distance_at
from bezier.obstacles.obstacle import Obstacle
from bezier.obstacles.survey import Finding
from bezier.pictures.mesh import Array, Indices, hull, hull_faces, icosphere, sampled

COLOURS = ("#c9772b", "#8a6fb0", "#5d8a3a", "#b5537c", "#4a8d97", "#a08a2e")
"""The colours of obstacles, in turn."""
GRID = 21
"""Grid points per axis to show an obstacle given by a formula."""
STEPS = 40
"""Steps per curve in the chart of clearances."""


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
    found = []
    for k, obstacle in enumerate(obstacles):
        colour = COLOURS[k % len(COLOURS)]
        if obstacle.body is None:
            inside = _cloud(obstacle, reach)
            if len(inside):
                found.append(ObstaclePicture(obstacle.name, colour, inside, None))
            continue
        points = _surface(obstacle.body, reach)
        if len(points):
            found.append(ObstaclePicture(obstacle.name, colour, points, hull_faces(points, points.mean(axis=0))))
    return tuple(found)


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
    directions, _ = icosphere(3 if len(points) < 4 else 2 if len(points) < 20 else 1)
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
    axis = np.linspace(-reach, reach, GRID)
    grid = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
    grid = grid[np.linalg.norm(grid, axis=1) <= reach]
    inside = np.zeros(len(grid), dtype=bool)
    for piece in obstacle.pieces:
        held = np.ones(len(grid), dtype=bool)
        for constraint in piece.constraints:
            held &= sum(float(c) * np.prod(grid ** np.array(e), axis=1) for e, c in constraint.terms) >= 0
        inside |= held
    found: Array = grid[inside]
    return found


def save_chart(findings: Sequence[Finding], pictures: Sequence[ObstaclePicture], file: FilePath) -> str:
    """``clearance.png``, and the same as SVG text: heights over x, and the distance to each obstacle over t."""
    from bezier.pictures.plot import new_figure, svg_text

    figure = new_figure(12, 4.2)
    curves = {finding.name: finding for finding in findings}
    _heights(figure.add_axes((0.06, 0.13, 0.41, 0.76)), list(curves.values()), pictures)
    _clearances(figure.add_axes((0.55, 0.13, 0.43, 0.76)), findings, list(curves), pictures)
    figure.savefig(file, dpi=120, pil_kwargs={"compress_level": 4})
    return svg_text(figure)


def _heights(axis: Any, findings: Sequence[Finding], pictures: Sequence[ObstaclePicture]) -> None:
    from bezier.pictures.picture import COLOURS as CURVES
    from bezier.pictures.picture import INK

    for picture in pictures:
        outline = picture.outline(0, 2)
        if outline is not None:
            axis.fill(*outline.T, color=picture.colour, alpha=0.35)
    for finding in findings:
        points = sampled(finding.curve.points, 81)
        axis.plot(points[:, 0], points[:, 2], color=CURVES.get(finding.name, INK), linewidth=2.2)
    axis.set_aspect("equal", adjustable="datalim")
    _labelled(axis, "height over x, with the silhouettes of the obstacles", "x", "z")


def _clearances(
    axis: Any, findings: Sequence[Finding], names: Sequence[str], pictures: Sequence[ObstaclePicture]
) -> None:
    colours, seen = {picture.name: picture.colour for picture in pictures}, set()
    for finding in findings:
        start, obstacle = names.index(finding.name), finding.obstacle
        colour = colours.get(obstacle.name, COLOURS[0])
        if obstacle.body is not None:
            times = [Fraction(k, STEPS) for k in range(STEPS + 1)]
            values = [distance_at(finding.curve, obstacle.body, t) for t in times]
            label = None if obstacle.name in seen else obstacle.name
            axis.plot([start + float(t) for t in times], values, color=colour, linewidth=1.8, label=label)
            seen.add(obstacle.name)
        if isinstance(finding.outcome, Contact):
            axis.plot(start + float(finding.outcome.t[0]), 0, "x", color=colour, markersize=9)
    for k in range(1, len(names)):
        axis.axvline(k, color="#dfe5ea", linewidth=1)
    axis.set_xticks([k + 0.5 for k in range(len(names))], list(names))
    axis.set_ylim(bottom=0)
    if seen:
        axis.legend(frameon=False, fontsize=9)
    _labelled(axis, "distance to each obstacle along the path", "curve", "distance")


def _labelled(axis: Any, title: str, across: str, up: str) -> None:
    axis.set_title(title, fontsize=10)
    axis.set_xlabel(across)
    axis.set_ylabel(up)
    axis.grid(color="#e3e8ec", linewidth=0.6)
