"""Pictures of a comparison: the planar regions of Q1 over each other, and both paths in the same views."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import Any

import numpy as np

from bezier.compare.comparison import METHODS, Comparison
from bezier.compare.output import TITLES
from bezier.compare.planar import plane_coordinates
from bezier.pictures.mesh import Array
from bezier.pictures.picture import COLOURS, INK, PALE, curve_pictures, numbers
from bezier.pictures.plot import new_figure, svg_text

REGION_COLOURS = {"(7)": "#2e9e6b", "(8*)": "#d1a03b", "(8)": "#2364aa"}
LABELS = {
    "(7)": "(7): cubic curves, some $Q_2$",
    "(8*)": "(8*): whole quadratic curves",
    "(8)": "(8): their control polygons",
}
VIEWS = (("top view", 0, 1), ("front view", 0, 2))


def save(found: Comparison, folder: FilePath) -> list[str]:
    """``regions.png`` and ``paths.png``."""
    for name, figure in (("regions.png", _regions(found)), ("paths.png", _paths(found))):
        figure.savefig(folder / name, dpi=120, pil_kwargs={"compress_level": 4})
    return ["regions.png", "paths.png"]


def svg(found: Comparison) -> dict[str, str]:
    """The same as SVG text for the page."""
    return {"regions": svg_text(_regions(found)), "paths": svg_text(_paths(found))}


def _regions(found: Comparison) -> Any:
    """Axes in mm along and across R0 - Q0."""
    from qe.regions.sketch import bands

    figure = new_figure(9, 6.4)
    axis = figure.add_axes((0.08, 0.09, 0.6, 0.85))
    plane = found.planar.plane
    unit = [float(np.linalg.norm(np.array([float(c) for c in v]))) for v in (plane.first, plane.second)]
    for name, colour in REGION_COLOURS.items():
        region = found.planar.named[name].region
        if region is None:
            continue
        along_first = region.order == plane_coordinates("Q1")
        scales, fill = (unit, axis.fill_between) if along_first else (unit[::-1], axis.fill_betweenx)
        for k, band in enumerate(bands(region)):
            # right at the ends of a band two roots may coincide, where floating point finds none
            inner = (np.array(row[8:-8]) for row in band)
            values, low, high = (row * size for row, size in zip(inner, (*scales, scales[1]), strict=True))
            fill(values, low, high, color=colour, alpha=0.3, linewidth=0, label=None if k else LABELS[name])
            for end in (low, high):
                axis.plot(*((values, end) if along_first else (end, values)), color=colour, linewidth=1.4)
    for k, (text, point) in enumerate(_marks(found).items()):
        u, v = (float(c) * s for c, s in zip(plane.place(point), unit, strict=True))
        axis.plot([u], [v], "o", color=INK, markersize=5)
        above = k >= 2
        side = "center" if not above else "left" if k == 2 else "right"
        axis.annotate(text, (u, v), xytext=(0, 8 if above else -14), textcoords="offset points", ha=side)
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_title("where $Q_1$ may be, in the plane of $O$, $Q_0$ and $R_0$", fontsize=11, color=INK)
    axis.set_xlabel("along $R_0 - Q_0$, mm")
    axis.set_ylabel("across, mm")
    axis.grid(color="#e3e8ec", linewidth=0.6)
    axis.set_axisbelow(True)
    figure.legend(loc="upper left", bbox_to_anchor=(0.69, 0.94), frameon=False, fontsize=9)
    return figure


def _marks(found: Comparison) -> dict[str, Any]:
    q0, r0 = found.problem.via
    marks = {"$Q_0$": q0, "$R_0$": r0}
    for method, sign in zip(METHODS, ("8", "7"), strict=True):
        path = found.sides[method].plan.path
        if path is not None:
            marks[f"$Q_1$ of ({sign})"] = path.points["Q1"]
    return marks


def _paths(found: Comparison) -> Any:
    figure = new_figure(11, 8)
    for row, method in enumerate(METHODS):
        path = found.sides[method].plan.path
        for column, (title, i, j) in enumerate(VIEWS):
            axis = figure.add_axes((0.06 + 0.5 * column, 0.56 - 0.5 * row, 0.41, 0.37))
            _view(axis, found, path, i, j)
            axis.set_title(f"{TITLES[method]}: {title}", fontsize=10, color=INK)
    return figure


def _view(axis: Any, found: Comparison, path: Any, i: int, j: int) -> None:
    reach = float(found.problem.workspace.radius_squared) ** 0.5
    angle = np.linspace(0, 2 * np.pi, 181)
    axis.plot(reach * np.cos(angle), reach * np.sin(angle), color=PALE, linewidth=1)
    for curve in curve_pictures(path.curves) if path is not None else ():
        colour = COLOURS.get(curve.name, INK)
        axis.plot(curve.polygon[:, i], curve.polygon[:, j], "--o", color=colour, linewidth=0.8, markersize=3, alpha=0.8)
        axis.plot(curve.points[:, i], curve.points[:, j], color=colour, linewidth=2.2)
    given: Array = numbers(list(found.problem.named_points.values()))
    for name, point in zip(("$P_0$", "$Q_0$", "$R_0$", "goal"), given, strict=True):
        axis.annotate(name, (point[i], point[j]), xytext=(3, 6), textcoords="offset points", fontsize=8)
    axis.set_aspect("equal", adjustable="datalim")
    axis.grid(color="#e3e8ec", linewidth=0.6)
    axis.set_axisbelow(True)
