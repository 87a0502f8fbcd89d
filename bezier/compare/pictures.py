"""Pictures of a comparison: the planar regions of Q1 over each other, and both paths in the same views."""

from __future__ import annotations

from functools import partial
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from markupsafe import Markup

from bezier.compare.comparison import METHODS, Comparison
from bezier.compare.output import TITLES
from bezier.compare.whole_curve import plane_coordinates
from bezier.motion.motion import in_time
from bezier.motion.track import Track
from bezier.pictures import plot, scene
from bezier.pictures.charts import saved
from bezier.pictures.mesh import Array
from bezier.pictures.picture import INK, Chart, PathPicture, numbers, path_picture
from bezier.pictures.plot import VIEWS, framed, letter, new_figure, path_view, svg_text
from bezier.problem import PlanMethod
from bezier.report.first import scene_box
from bezier.report.parts import GIVEN
from qe.regions.region import Region

REGION_COLOURS = {"(7)": "#2e9e6b", "(8*)": "#d1a03b", "(8)": "#2364aa"}
LABELS = {
    "(7)": "(7): cubic curves, some Q₂",
    "(8*)": "(8*): whole quadratic curves",
    "(8)": "(8): their control polygons",
}
TONES = {PlanMethod.QUADRATIC: "p", PlanMethod.CUBIC: "q"}
NAMES = ("P0", "Q0", "R0", "goal")
FILES = ("regions.png", "paths.png")


def charts(comparison: Comparison, folder: FilePath) -> dict[str, tuple[Chart, ...]]:
    """``regions.png`` and ``paths.png``, and the same for the page."""
    regions, words = regions_of(comparison), "where Q1 may be, in the plane of O, Q0 and R0"
    regions.savefig(folder / FILES[0], dpi=120, pil_kwargs={"compress_level": 4})
    panels = {
        f"{TITLES[method]}: {title} of the path and its control polygons": partial(_view, comparison, method, column)
        for method in METHODS
        for column, (title, _i, _j) in enumerate(VIEWS[:2])
    }
    return {"regions": ((svg_text(regions), words),), "paths": saved(panels, folder / FILES[1], rows=2)}


def first(comparison: Comparison) -> Markup:
    """Both paths in one turnable scene; the point moves along the last one that exists."""
    shown = {
        method: _picture(comparison, method) for method in METHODS if comparison.sides[method].plan.path is not None
    }
    given = dict(zip(GIVEN, numbers(list(comparison.problem.named_points.values())), strict=True))
    base, track = _picture(comparison, METHODS[0]), None
    for method in shown:
        path = comparison.sides[method].plan.path
        assert path is not None
        track = Track.of(in_time(path, None))
    data = scene.path_scene(base, track, timed=False, given=given)
    reach, curves = base.radius, [(TONES[m], curve) for m, picture in shown.items() for curve in picture.curves]
    data["curves"] = [scene.curve(curve, reach, tone) for tone, curve in curves]
    data["marks"] = data["marks"][: len(given)]
    words = f"the paths of {' and '.join(TITLES[m] for m in shown) or 'neither method'} in the workspace, seen in space"
    legend = [(TITLES[method], f"var(--{TONES[method]})") for method in shown]
    return scene_box(scene.text(data), words, FILES[1], legend, moving=track is not None)


def regions_of(comparison: Comparison) -> Any:
    """The figure of the planar regions, with axes in mm along and across R0 - Q0."""
    plane = comparison.planar.plane
    unit = [float(np.linalg.norm(np.array([float(c) for c in v]))) for v in (plane.first, plane.second)]
    lines = {name: _scaled(comparison, name, unit) for name in REGION_COLOURS}
    named = dict(zip(("Q₀", "R₀"), comparison.problem.via, strict=True))
    for method, number in zip(METHODS, ("8", "7"), strict=True):
        if (path := comparison.sides[method].plan.path) is not None:
            named[f"Q₁ of ({number})"] = path.points["Q1"]
    marks = [
        (text, tuple(float(c) * s for c, s in zip(plane.place(point), unit, strict=True)))
        for text, point in named.items()
    ]
    everything = np.concatenate([*lines.values(), np.array([place for _, place in marks])])
    wide, high = np.ptp(everything, axis=0)
    tall = float(np.clip(5.2 * high / (wide or 1.0), 2.2, 5.2))
    figure = new_figure(6, tall + 1.9)
    axis = figure.add_axes((0.1, 1.45 / (tall + 1.9), 0.87, tall / (tall + 1.9)))
    for name, colour in REGION_COLOURS.items():
        if len(lines[name]):
            axis.fill(*lines[name].T, color=colour, alpha=0.3, linewidth=0, label=LABELS[name])
            axis.plot(*lines[name].T, color=colour, linewidth=1.4)
    axis.plot(*np.array([place for _, place in marks]).T, "o", color=INK, markersize=5)
    axis.margins(0.06)
    axis.set_aspect("equal", adjustable="datalim")
    title = "where Q₁ may be, in the plane of O, Q₀ and R₀"
    framed(axis, "along R₀ − Q₀ (mm)", "across (mm)", title, size=11)
    axis.set_axisbelow(True)
    plot.place(axis, marks, np.concatenate(list(lines.values())), size=9)
    figure.legend(loc="lower left", bbox_to_anchor=(0.08, 0.0), frameon=False, fontsize=10)
    return figure


def _scaled(comparison: Comparison, name: str, unit: list[float]) -> Array:
    """The outline of a planar region in mm, first along and then across; no points where there is none."""
    region = comparison.planar.named[name].region
    if region is None or region.is_empty:
        return np.zeros((0, 2))
    straight = region.order == plane_coordinates("Q1")
    around = outline(region) * (unit if straight else unit[::-1])
    return around if straight else around[:, ::-1]


def outline(region: Region) -> Array:
    """The closed line around a bounded convex region in the plane: points in the order of its variables.

    Out along the lower ends over the first variable and back along the upper ones. At a tip these meet between the
    last samples, which the line joins.
    """
    from qe.regions.sketch import bands

    result = [np.array(band) for band in bands(region)]
    if not result:
        return np.zeros((0, 2))
    whole = np.concatenate([row[:, np.isfinite(row).all(axis=0)] for row in result], axis=1)
    values, low, high = whole[:, np.argsort(whole[0], kind="stable")]
    around = np.stack([np.concatenate([values, values[::-1]]), np.concatenate([low, high[::-1]])], axis=1)
    return np.concatenate([around, around[:1]])


def _picture(comparison: Comparison, method: PlanMethod) -> PathPicture:
    given = dict(zip(NAMES, comparison.problem.named_points.values(), strict=True))
    return path_picture(comparison.problem, comparison.sides[method].plan.path, given, region=None, hatted_names=False)


def _view(comparison: Comparison, method: PlanMethod, column: int, axis: Any) -> None:
    title, i, j = VIEWS[column]
    none = "" if comparison.sides[method].plan.path is not None else ", no path"
    path_view(axis, _picture(comparison, method), f"{TITLES[method]}{none}: {title}", i, j)
    letter(axis, method is PlanMethod.QUADRATIC)
