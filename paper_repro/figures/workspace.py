"""Figures 1 and 2: the feasible region and its radius; and a spline that leaves it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import sqrt
from typing import Any

import numpy as np

from bezier.curves.curve import Bezier
from paper_repro.figures.canvas import COLOURS, FLOOR, INK, PALE, Figure, circle, curve, drawing, label, plane, space


@drawing
def feasible_region(radius: float) -> Figure:
    """Figure 1: the surface and the interior of a hemisphere about the base of the arm."""
    figure, axis = space(5.4, 3.9)
    turn, height = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi / 2, 15))
    x, y, z = (radius * f for f in (np.cos(height) * np.cos(turn), np.cos(height) * np.sin(turn), np.sin(height)))
    axis.plot_surface(x, y, z, color="#c9dcf0", alpha=0.35, linewidth=0, shade=False)
    axis.plot_wireframe(x, y, z, color=COLOURS["P"], linewidth=0.4, alpha=0.5, rstride=2, cstride=4)
    rim = np.linspace(0, 2 * np.pi, 97)
    axis.plot(radius * np.cos(rim), radius * np.sin(rim), 0 * rim, color=FLOOR, linewidth=1.6)
    for name, end in (("x", (1.3, 0, 0)), ("y", (0, 1.3, 0)), ("z", (0, 0, 1.25))):
        tip = radius * np.array(end)
        axis.quiver(0, 0, 0, *tip, color=INK, linewidth=1.1, arrow_length_ratio=0.06)
        axis.text(*(1.06 * tip), f"${name}$", fontsize=12)
    axis.plot([0], [0], [0], "o", color=INK, markersize=5)
    axis.text(0.05 * radius, -0.14 * radius, -0.16 * radius, "$O$", fontsize=12)
    axis.set_axis_off()
    axis.set_box_aspect((2.6, 2.6, 1.3), zoom=1.5)
    axis.set_xlim(-1.3 * radius, 1.3 * radius)
    axis.set_ylim(-1.3 * radius, 1.3 * radius)
    axis.set_zlim(0, 1.3 * radius)
    axis.view_init(elev=18, azim=-58)
    return figure


@drawing
def radius_rule(points: Mapping[str, Sequence[Any]], farthest: str) -> Figure:
    """Figure 2: the radius is the distance of the farthest of the given points from O."""
    figure, (axis,) = plane(6.0, 3.6)
    radius = sqrt(sum(float(c) ** 2 for c in points[farthest]))
    _half_disc(axis, radius)
    for name, point in points.items():
        x, y = map(float, point)
        axis.plot([0, x], [0, y], color=INK if name == farthest else PALE, linewidth=1.4 if name == farthest else 0.9)
        axis.plot([x], [y], "o", color=COLOURS["Q"], markersize=6)
        label(axis, f"${name[0]}_{name[1:]}$" if name[1:] else f"${name}$", point)
    x, y = (float(c) / 2 for c in points[farthest])
    label(axis, "$r$", (x, y), (-13, 2), color=COLOURS["Q"])
    label(axis, "$O$", (0, 0), (-4, -14))
    axis.set_aspect("equal", adjustable="box")
    axis.set_ylim(-0.14 * radius, 1.14 * radius)
    return figure


def _half_disc(axis: Any, radius: float) -> None:
    angle = np.linspace(0, np.pi, 181)
    axis.fill(radius * np.cos(angle), radius * np.sin(angle), color="#eef4fa", zorder=0)
    axis.plot(radius * np.cos(angle), radius * np.sin(angle), color=COLOURS["P"], linewidth=1.6)
    axis.plot([-radius, radius], [0, 0], color=FLOOR, linewidth=1.6)
    axis.plot([0], [0], "o", color=INK, markersize=5)


@drawing
def spline_outside(spans: Sequence[Bezier], radius: float, outside: Sequence[Any]) -> Figure:
    """A natural cubic spline through points of the half-disc that leaves it."""
    figure, (axis,) = plane(6.0, 3.8)
    _half_disc(axis, radius)
    for span in spans:
        curve(axis, span, COLOURS["Q"], polygon=False)
    for point in [spans[0].points[0], *(s.points[-1] for s in spans)]:
        axis.plot([float(point[0])], [float(point[1])], "o", color=INK, markersize=6)
    axis.plot([float(outside[0])], [float(outside[1])], "s", color=COLOURS["Q"], markersize=7)
    label(axis, "outside", outside, (9, -4), color=COLOURS["Q"])
    return figure


@drawing
def dips_below_floor(curves: Mapping[str, Bezier], radius: float, axes: tuple[int, int], title: str) -> Figure:
    """A path whose control points keep the norm condition while one of them lies below the table z = 0."""
    figure, (axis,) = plane(6.4, 4.4)
    circle(axis, (0, 0), radius, PALE)
    axis.axhspan(-2 * radius, 0, color="#f7efe2", zorder=0)
    axis.axhline(0, color=FLOOR, linewidth=1.6)
    label(axis, "table $z = 0$", (-0.2 * radius, 0), (0, -14), color=FLOOR)
    for name, item in curves.items():
        flat = Bezier.of([[p[k] for k in axes] for p in item.points])
        curve(axis, flat, COLOURS[name], text=f"${name}(t)$")
        for i, point in enumerate(flat.points[1:-1], 1):
            low = float(point[1]) < 0
            label(axis, f"${name}_{i}$", point, (5, -14 if low else 6), color=COLOURS[name])
    axis.set_aspect("equal", adjustable="box")
    axis.set_xlim(-1.4 * radius, 1.4 * radius)
    axis.set_ylim(-0.75 * radius, 1.1 * radius)
    axis.set_title(title, fontsize=10)
    axis.legend(frameon=False, loc="upper left")
    return figure
