"""A scene as a drawing: obstacles, workspace, and the path through them or the side of the start. Floating point."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from bezier.pictures.mesh import Array, hull, sampled
from bezier.pictures.obstacles import held
from bezier.pictures.picture import numbers
from bezier.scenes.barrier import Wall
from bezier.scenes.route import Blocked, Route
from bezier.scenes.scene import Scene
from bezier.scenes.solid import Solid

WIDTH, GRID = 340.0, 96
WAY, WALL, SIDE, BODY, START, GOAL = "#175cd3", "#b42318", "#fda29b", "#98a2b3", "#067647", "#b42318"


def drawing(known: Route | Blocked) -> str:
    """An SVG picture of the plane, or of space from above and from the front."""
    views = ((0, 1),) if known.scene.dimension == 2 else ((0, 1), (0, 2))
    parts, right, tall = list[str](), 0.0, 0.0
    for i, j in views:
        body, height = _view(known, i, j)
        parts.append(f'<g transform="translate({right:.0f} 0)">{body}</g>')
        right, tall = right + WIDTH + 16, max(tall, height)
    view = f'xmlns="http://www.w3.org/2000/svg" viewBox="-4 -4 {right - 8:.0f} {tall + 8:.0f}" width="{right - 8:.0f}"'
    return f'<svg {view} role="img">{"".join(parts)}</svg>'


def _view(known: Route | Blocked, i: int, j: int) -> tuple[str, float]:
    scene = known.scene
    low, high = (np.array([float(c[i]), float(c[j])]) for c in (scene.low, scene.high))
    unit = WIDTH / (high - low)[0]
    height = float((high - low)[1] * unit)

    def at(points: Array) -> str:
        return " ".join(
            f"{x:.2f},{y:.2f}" for x, y in zip(*(points - [low[0], high[1]]).T * [[unit], [-unit]], strict=True)
        )

    def shape(points: Array, look: str) -> str:
        return f'<polygon points="{at(points)}" {look}/>'

    parts = [shape(p, 'fill="#ffffff" stroke="#667085"') for p in _workspace(scene, i, j)]
    if isinstance(known, Blocked) and scene.dimension == 2:
        sides = (np.array(cell.floats) for cell in known.start_side)
        parts += [shape(hull(p), f'fill="{SIDE}" opacity="0.4"') for p in sides if len(p) > 2]
    bodies = (shape(outline(body, i, j), f'fill="{BODY}"') for body in scene.solids)
    crisp = f'fill="{BODY}" shape-rendering="crispEdges"'
    rows = (shape(row, crisp) for body in scene.formulas for row in _shaded(scene, body, i, j))
    parts.append(f'<g opacity="0.8">{"".join((*bodies, *rows))}</g>')  # as one: parts of a mesh overlap
    if isinstance(known, Route):
        way = at(np.concatenate([sampled(curve, 2 if len(curve) == 2 else 13) for curve in known.curves])[:, (i, j)])
        parts.append(f'<polyline points="{way}" fill="none" stroke="{WAY}" stroke-width="2"/>')
    else:
        walls = (at(numbers([wall.start, wall.end])) for wall in known.walls if isinstance(wall, Wall))
        parts += [f'<polyline points="{wall}" stroke="{WALL}" stroke-width="2"/>' for wall in walls]
    for point, colour in ((scene.start, START), (scene.goal, GOAL)):
        cx, cy = at(numbers([point])[:, (i, j)]).split(",")
        parts.append(f'<circle cx="{cx}" cy="{cy}" r="4" fill="{colour}"/>')
    name = f"view{i}{j}"
    clip = f'<clipPath id="{name}"><rect x="-4" y="-4" width="{WIDTH + 8}" height="{height + 8:.0f}"/></clipPath>'
    return f'{clip}<g clip-path="url(#{name})">{"".join(parts)}</g>', height


def _workspace(scene: Scene, i: int, j: int) -> list[Array]:
    """The box around it; the other bounded parts over it."""
    (a, b), (c, d) = numbers([scene.low, scene.high])[:, (i, j)]
    box = np.array([[a, b], [c, b], [c, d], [a, d]])
    return [box, *(outline(part, i, j) for part in scene.domain if part.corners and not part.is_polytope)]


def _shaded(scene: Scene, body: Solid, i: int, j: int) -> Iterator[Array]:
    """The shadow of conditions in two coordinates, as rectangles in the rows of a grid."""
    steps = [(float(b - a) / GRID, float(a)) for a, b in zip(scene.low, scene.high, strict=True)]
    axes = [low + step * (np.arange(GRID) + 0.5) for step, low in steps] + [np.zeros(1)] * (3 - len(steps))
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    inside = held(body.pieces, points.reshape(-1, 3)).reshape(points.shape[:3])
    (dx, left), (dy, bottom) = steps[i], steps[j]
    filled: Any = inside.any(axis=tuple(k for k in range(3) if k not in (i, j)))
    for k, row in enumerate(filled.T):
        ends = np.flatnonzero(np.diff(np.concatenate(([0], row.astype(int), [0]))))
        for a, b in ends.reshape(-1, 2):
            corners = [(a, k), (b, k), (b, k + 1), (a, k + 1)]
            yield np.array([(left + dx * x, bottom + dy * y) for x, y in corners])


def outline(body: Solid, i: int, j: int) -> Array:
    """The silhouette of a body in two coordinates."""
    corners, wide = numbers(body.corners), np.linspace(0, 2 * np.pi, 73)[:-1]
    circle = np.stack([np.cos(wide), np.sin(wide)], axis=1)
    if body.tube:
        corners = np.concatenate([corners + [*(float(body.tube) * u), 0] for u in circle])
    corners = corners[:, (i, j)]
    return hull(np.concatenate([corners + float(body.radius) * u for u in circle]) if body.radius else corners)
