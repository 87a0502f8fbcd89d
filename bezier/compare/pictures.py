"""Pictures of a comparison: the planar regions of Q1 over each other, and both paths in the same views."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import Any

import numpy as np

from bezier.compare.comparison import METHODS, Comparison
from bezier.compare.output import TITLES
from bezier.compare.planar import plane_coordinates
from bezier.pictures import labels
from bezier.pictures.mesh import Array
from bezier.pictures.picture import COLOURS, GRID, INK, PALE, Chart, curve_pictures, numbers
from bezier.pictures.plot import new_figure, svg_text
from bezier.problem import PlanMethod
from qe.regions.region import Region

REGION_COLOURS = {"(7)": "#2e9e6b", "(8*)": "#d1a03b", "(8)": "#2364aa"}
LABELS = {
    "(7)": "(7): cubic curves, some Q₂",
    "(8*)": "(8*): whole quadratic curves",
    "(8)": "(8): their control polygons",
}
VIEWS = (("top view", 0, 1), ("front view", 0, 2))


def save(found: Comparison, folder: FilePath, regions: Any) -> list[str]:
    """``regions.png`` (of the figure that ``regions_of`` makes) and ``paths.png``."""
    paths = new_figure(11, 8)
    for k, method in enumerate(METHODS):
        for column in range(len(VIEWS)):
            _view(paths.add_axes((0.06 + 0.5 * column, 0.56 - 0.5 * k, 0.41, 0.37)), found, method, column)
    for name, figure in (("regions.png", regions), ("paths.png", paths)):
        figure.savefig(folder / name, dpi=120, pil_kwargs={"compress_level": 4})
    return ["regions.png", "paths.png"]


def charts(found: Comparison, regions: Any) -> dict[str, tuple[Chart, ...]]:
    """The same for the page."""
    paths = []
    for method in METHODS:
        for column, (title, _i, _j) in enumerate(VIEWS):
            figure = new_figure(5.6, 4.2)
            _view(figure.add_axes((0.1, 0.1, 0.88, 0.81)), found, method, column)
            paths.append((svg_text(figure), f"{TITLES[method]}: {title} of the path and its control polygons"))
    words = "where Q1 may be, in the plane of O, Q0 and R0"
    return {"regions": ((svg_text(regions), words),), "paths": tuple(paths)}


def regions_of(found: Comparison) -> Any:
    """The figure of the planar regions, with axes in mm along and across R0 - Q0."""
    figure = new_figure(6, 6.6)
    axis = figure.add_axes((0.1, 0.2, 0.87, 0.75))
    plane = found.planar.plane
    unit = [float(np.linalg.norm(np.array([float(c) for c in v]))) for v in (plane.first, plane.second)]
    for name, colour in REGION_COLOURS.items():
        region = found.planar.named[name].region
        if region is None or region.is_empty:
            continue
        across = outline(region) * (unit if region.order == plane_coordinates("Q1") else unit[::-1])
        x, y = across.T if region.order == plane_coordinates("Q1") else across.T[::-1]
        axis.fill(x, y, color=colour, alpha=0.3, linewidth=0, label=LABELS[name])
        axis.plot(x, y, color=colour, linewidth=1.4)
    marks = []
    for text, point in _marks(found).items():
        u, v = (float(c) * s for c, s in zip(plane.place(point), unit, strict=True))
        axis.plot([u], [v], "o", color=INK, markersize=5)
        marks.append((text, (u, v)))
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_title("where Q₁ may be, in the plane of O, Q₀ and R₀", fontsize=11, color=INK)
    axis.set_xlabel("along R₀ − Q₀, mm")
    axis.set_ylabel("across, mm")
    axis.grid(color=GRID, linewidth=0.6)
    axis.set_axisbelow(True)
    labels.place(axis, marks, np.zeros((0, 2)), size=9)
    figure.legend(loc="lower left", bbox_to_anchor=(0.08, 0.0), frameon=False, fontsize=10)
    return figure


def outline(region: Region) -> Array:
    """The closed line around a bounded convex region in the plane: points in the order of its variables.

    Out along the lower ends over the first variable and back along the upper ones. At a tip these meet between the
    last samples, which the line joins.
    """
    from qe.regions.sketch import bands

    found = [np.array(band) for band in bands(region)]
    if not found:
        return np.zeros((0, 2))
    whole = np.concatenate([row[:, np.isfinite(row).all(axis=0)] for row in found], axis=1)
    values, low, high = whole[:, np.argsort(whole[0], kind="stable")]
    around = np.stack([np.concatenate([values, values[::-1]]), np.concatenate([low, high[::-1]])], axis=1)
    return np.concatenate([around, around[:1]])


def _marks(found: Comparison) -> dict[str, Any]:
    q0, r0 = found.problem.via
    marks = {"Q₀": q0, "R₀": r0}
    for method, sign in zip(METHODS, ("8", "7"), strict=True):
        path = found.sides[method].plan.path
        if path is not None:
            marks[f"Q₁ of ({sign})"] = path.points["Q1"]
    return marks


def _view(axis: Any, found: Comparison, method: PlanMethod, column: int) -> None:
    path, (title, i, j) = found.sides[method].plan.path, VIEWS[column]
    reach = float(found.problem.workspace.radius_squared) ** 0.5
    angle = np.linspace(0, 2 * np.pi, 181)
    axis.plot(reach * np.cos(angle), reach * np.sin(angle), color=PALE, linewidth=1)
    drawn = [np.zeros((0, 2))]
    for curve in curve_pictures(path.curves) if path is not None else ():
        colour = COLOURS.get(curve.name, INK)
        axis.plot(curve.polygon[:, i], curve.polygon[:, j], "--o", color=colour, linewidth=0.8, markersize=3, alpha=0.8)
        axis.plot(curve.points[:, i], curve.points[:, j], color=colour, linewidth=2.2)
        drawn += [curve.points[:, [i, j]], curve.polygon[:, [i, j]]]
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_title(f"{TITLES[method]}: {title}", fontsize=10, color=INK)
    axis.grid(color=GRID, linewidth=0.6)
    axis.set_axisbelow(True)
    given: Array = numbers(list(found.problem.named_points.values()))
    names = ("P₀", "Q₀", "R₀", "goal")
    labels.place(axis, [(n, (p[i], p[j])) for n, p in zip(names, given, strict=True)], np.concatenate(drawn))
