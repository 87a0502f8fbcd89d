"""A scene as a drawing: obstacles, workspace, and the path through them or the side of the start. Floating point."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from typing import Any

import numpy as np

from bezier.pictures.mesh import Array, hull, sampled
from bezier.pictures.obstacles import excess
from bezier.pictures.picture import COLOURS, PALE, numbers
from bezier.pictures.plot import AXES, framed, new_figure, svg_text
from bezier.scenes.route import Blocked, Route
from bezier.scenes.scene import Scene
from bezier.scenes.solid import Solid

WIDTH, SAMPLES = 4.6, 320
"""Of a view, in inches; of conditions, along an axis."""
WAY, WALL, SIDE, BODY = COLOURS["P"], "#b42318", "#fedad6", "#adb4c0"


def drawing(known: Route | Blocked, kind: str = "svg") -> bytes:
    """A picture of the plane, or of space from above and from the front, as a file of this kind (svg, png, pdf)."""
    buffer, unsaid = BytesIO(), {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    _figure(known).savefig(buffer, format=kind, dpi=150, metadata=unsaid.get(kind))
    return buffer.getvalue()


def inline(known: Route | Blocked) -> str:
    """The same as an element of a page."""
    return svg_text(_figure(known))


def _figure(known: Route | Blocked) -> Any:
    views = ((0, 1),) if known.scene.dimension == 2 else ((0, 1), (0, 2))
    wide, *tall = (float(b - a) for a, b in zip(known.scene.low, known.scene.high, strict=True))
    shape = min(max(*tall, wide / 3) / wide, 2.0)
    figure = new_figure(WIDTH * len(views) + 0.5, WIDTH * shape + 0.7)
    for axis, view in zip(figure.subplots(1, len(views), squeeze=False)[0], views, strict=True):
        _view(axis, known, *view)
    figure.tight_layout()
    return figure


def _view(axis: Any, known: Route | Blocked, i: int, j: int) -> None:
    from matplotlib.patches import Polygon

    scene = known.scene
    low, high = numbers([scene.low, scene.high])[:, (i, j)]
    rims = [outline(part, i, j) for part in scene.domain if part.corners and not part.is_polytope]
    rims = rims or [hull(np.array([low, [high[0], low[1]], high, [low[0], high[1]]]))]
    axis.add_patch(rim := Polygon(rims[0], fill=False, edgecolor=PALE, zorder=3))
    drawn, alpha = [], 1.0 if scene.dimension == 2 else 0.4  # in space silhouettes hide each other
    if isinstance(known, Blocked) and scene.dimension == 2:
        sides = (hull(np.array(cell.floats)) for cell in known.start_side if len(cell.floats) > 2)
        drawn += [axis.fill(*side.T, color=SIDE)[0] for side in sides]
    drawn += [axis.fill(*outline(body, i, j).T, color=BODY, alpha=alpha)[0] for body in scene.solids]
    drawn += [
        axis.contourf(*_shadow(scene, body, i, j), [0, np.inf], colors=[BODY], alpha=alpha) for body in scene.formulas
    ]
    for part in drawn:
        part.set_clip_path(rim)
    if isinstance(known, Route):
        way = np.concatenate([sampled(curve, 2 if len(curve) == 2 else 13) for curve in known.curves])
        axis.plot(*way[:, (i, j)].T, color=WAY, linewidth=2)
    elif scene.dimension == 2 and known.divider:
        zeros = replace(scene.formulas[0], pieces=(known.divider,))
        axis.contour(*_shadow(scene, zeros, i, j), [0], colors=[WALL], linewidths=2)
    elif scene.dimension == 2:
        for wall in known.walls:
            axis.plot(*numbers([wall.start, wall.end]).T, color=WALL, linewidth=2)  # type: ignore[union-attr]
    for name, point, mark in (("start", scene.start, "o"), ("goal", scene.goal, "s")):
        axis.plot(*numbers([point])[0, [i, j]], mark, color=WAY, label=name, zorder=4)
    pad = 0.02 * (high - low)
    xs, ys = zip(low - pad, high + pad, strict=True)
    axis.set(xlim=xs, ylim=ys, aspect="equal")
    framed(axis, AXES[i], AXES[j])
    axis.set_axisbelow(True)
    axis.legend(loc="best", fontsize=8)


def _shadow(scene: Scene, body: Solid, i: int, j: int) -> tuple[Array, Array, Array]:
    """Two coordinates of a grid, and numbers that are positive in the shadow of conditions."""
    count = SAMPLES if scene.dimension == 2 else SAMPLES // 4
    ends = zip(scene.low, scene.high, strict=True)
    axes = [np.linspace(float(a), float(b), count) for a, b in ends] + [np.zeros(1)] * (3 - scene.dimension)
    most = excess(body.pieces, axes).max(axis=tuple(k for k in range(3) if k not in (i, j)))
    return axes[i], axes[j], most.T


def outline(body: Solid, i: int, j: int) -> Array:
    """The silhouette of a body in two coordinates."""
    corners, wide = numbers(body.corners), np.linspace(0, 2 * np.pi, 73)[:-1]
    circle = np.stack([np.cos(wide), np.sin(wide)], axis=1)
    if body.tube:
        corners = np.concatenate([corners + [*(float(body.tube) * u), 0] for u in circle])
    corners = corners[:, (i, j)]
    return hull(np.concatenate([corners + float(body.radius) * u for u in circle]) if body.radius else corners)
