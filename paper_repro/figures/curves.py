"""Figure 3 (de Casteljau), Figure 4 (Method 1) and the curves of the corrections."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from bezier.curves.curve import Bezier
from bezier.pictures.mesh import sampled
from paper_repro.figures.canvas import COLOURS, INK, PALE, Array, Figure, circle, curve, drawing, label, plane


@drawing
def de_casteljau(points: Sequence[Sequence[Any]], levels: Sequence[Sequence[Sequence[Any]]]) -> Figure:
    """Figure 3: the points of every level of the construction for one t, and the curve they run along."""
    figure, (axis,) = plane(6.4, 3.9)
    curve(axis, Bezier.of(points), COLOURS["Q"], polygon=False)
    colours = (INK, COLOURS["P"], COLOURS["R"], COLOURS["Q"])
    for k, row in enumerate([points, *levels]):
        spots = np.array([[float(c) for c in p] for p in row])
        axis.plot(*spots.T, "-o", color=colours[k], linewidth=1.1, markersize=5)
        for i, spot in enumerate(spots):
            name = f"$P_{i}$" if k == 0 else f"$Q_{i}^{{({k})}}$"
            offset = (5, -17) if k == len(levels) else (-28, 4) if k and not i else (5, 6)
            label(axis, name, spot, offset, color=colours[k])
    axis.margins(0.1)
    return figure


@drawing
def loose_hull(given: Bezier, radius: float) -> Figure:
    """A curve inside a disc although a control point is outside."""
    figure, (axis,) = plane(5.2, 3.6)
    circle(axis, (0, 0), radius, PALE, fill=True, facecolor="#eef4fa")
    curve(axis, given, COLOURS["Q"])
    for i, point in enumerate(given.points):
        label(axis, f"$P_{i}$", point)
    return figure


@drawing
def heights(controls: Sequence[tuple[Any, Any]], interval: tuple[Any, Any], height: Any, p: int, q: int) -> Figure:
    """Figure 4: one coordinate of Method 1 over x, with the points (a, h) and (b, h) that the curve must meet."""
    figure, (axis,) = plane(6.6, 4.0)
    _heights(axis, controls, interval, height)
    bottom = axis.get_ylim()[0]
    names = {0: "x_0", p: "x_p", p + 1: "x_{p+1}", q: "x_q", q + 1: "x_{q+1}", len(controls) - 1: "x_n"}
    axis.set_xticks([float(controls[i][0]) for i in names], [f"${n}$" for n in names.values()])
    axis.tick_params(axis="x", colors=INK, labelsize=11)
    for i in names:
        x, y = map(float, controls[i])
        axis.plot([x, x], [bottom, y], ":", color=PALE, linewidth=0.9)
    axis.set_ylim(bottom=bottom)
    return figure


@drawing
def dip(controls: Sequence[tuple[Any, Any]], interval: tuple[Any, Any], height: Any) -> Figure:
    """A tuple that (4) allows, and how the curve dips below h between a and b (right: enlarged)."""
    figure, (axis, close) = plane(9.6, 3.8, 2)
    _heights(axis, controls, interval, height)
    points = _heights(close, controls, interval, height)
    a, b, h = float(interval[0]), float(interval[1]), float(height)
    inside = points[(points[:, 0] >= a) & (points[:, 0] <= b)]
    close.fill_between(inside[:, 0], inside[:, 1], h, color=COLOURS["Q"], alpha=0.25)
    low = float(inside[:, 1].min())
    close.set_aspect("auto")
    close.set_xlim(a - 0.4 * (b - a), b + 0.4 * (b - a))
    close.set_ylim(low - 0.6 * (h - low), h + (h - low))
    close.set_title("between $a$ and $b$", fontsize=10)
    return figure


def _heights(axis: Any, controls: Sequence[tuple[Any, Any]], interval: tuple[Any, Any], height: Any) -> Array:
    axis.set_aspect("auto")
    points = curve(axis, Bezier.of(controls), COLOURS["P"])
    h = float(height)
    axis.axhline(h, color=COLOURS["R"], linewidth=1, linestyle="-.")
    for name, x in zip("ab", interval):
        axis.plot([float(x)], [h], "o", color=COLOURS["Q"], markersize=7, zorder=5)
        label(axis, f"$({name}, h_y)$", (x, h), (-48, -16) if name == "a" else (6, -16), color=COLOURS["Q"])
    axis.set_xlabel("$x$")
    axis.set_ylabel("$y$")
    return points


@drawing
def path(curves: Mapping[str, Bezier], radius: float, title: str, axes: tuple[int, int] = (0, 1)) -> Figure:
    """A plane view of three joined curves in the disc of radius r."""
    figure, (axis,) = plane(6.4, 4.2)
    circle(axis, (0, 0), radius, PALE, fill=True, facecolor="#f3f7fb")
    seen: dict[tuple[float, float], list[str]] = {}
    for name, item in curves.items():
        flat = Bezier.of([[p[k] for k in axes] for p in item.points])
        curve(axis, flat, COLOURS[name], text=f"${name}(t)$")
        for i, point in enumerate(flat.points):
            seen.setdefault((round(float(point[0]), 6), round(float(point[1]), 6)), []).append(f"{name}_{i}")
    for place, found in seen.items():
        names = found[1:] if len(found) == 2 else found  # where two curves meet, the second one's name will do
        label(axis, "$" + r"{=}".join(names) + "$", place, (5, 7), fontsize=9)
    axis.set_title(title, fontsize=10, pad=14)
    axis.legend(frameon=False, loc="lower right")
    return figure


@drawing
def curvature(curves: Mapping[str, Bezier]) -> Figure:
    """Signed curvature over the joined parameter, span after span."""
    figure, (axis,) = plane(6.4, 3.0)
    axis.set_aspect("auto")
    for k, (name, item) in enumerate(curves.items()):
        first = item.hodograph()
        (dx, dy), (ddx, ddy) = (sampled(d.points, 121).T for d in (first, first.hodograph()))
        values = (dx * ddy - dy * ddx) / (dx**2 + dy**2) ** 1.5
        axis.plot(k + np.linspace(0, 1, 121), values, color=COLOURS[name], linewidth=2.2, label=f"${name}$")
    for knot in pairwise(range(len(curves) + 1)):
        axis.axvline(knot[1], color=PALE, linewidth=0.8, linestyle=":")
    axis.set_xlabel("parameter, one unit per curve")
    axis.set_ylabel("curvature")
    axis.legend(frameon=False)
    return figure
