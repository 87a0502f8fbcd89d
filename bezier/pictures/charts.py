"""Charts of a path with matplotlib, from floating-point samples: heights and clearances, speed and curvature, and the
height profiles of Method 1. Each is a row of panels in a file, and every panel alone for the page."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path as FilePath
from typing import Any

import numpy as np

from bezier.curves.curve import Bezier
from bezier.input.task import Axis, Task
from bezier.obstacles.clearance import Contact
from bezier.obstacles.survey import Finding
from bezier.paths.path import Path
from bezier.pictures.mesh import Array, sampled
from bezier.pictures.obstacles import COLOURS as OBSTACLES
from bezier.pictures.obstacles import ObstaclePicture, signed_distances
from bezier.pictures.picture import COLOURS, GRID, INK, PALE, SHADE, Chart, numbers
from bezier.pictures.plot import framed, new_figure, svg_text

COUNT = 241
"""Samples of a curve."""

Panels = Mapping[str, Callable[[Any], None]]
"""What draws on axes, by what it shows in words."""


def saved(panels: Panels, file: FilePath, rows: int = 1) -> tuple[Chart, ...]:
    """The panels side by side in a file, in so many rows, and each alone for the page."""
    count = len(panels) // rows
    whole, wide, high, charts = new_figure(6 * count, 4.2 * rows), 1 / count, 1 / rows, []
    for k, (words, draw) in enumerate(panels.items()):
        across, down = k % count, k // count
        draw(whole.add_axes((wide * (across + 0.11), 1 - high * (down + 0.87), wide * 0.85, high * 0.76)))
        single = new_figure(5.8, 3.6)
        draw(single.add_axes((0.11, 0.15, 0.86, 0.75)))
        charts.append((svg_text(single), words))
    whole.savefig(file, dpi=120, pil_kwargs={"compress_level": 4})
    return tuple(charts)


def _titled(axis: Any, title: str, across: str, up: str = "", *, legend: bool = False) -> None:
    framed(axis, across, up, title)
    if legend:
        axis.legend(frameon=False, fontsize=9)


# --- clearance --------------------------------------------------------------------------------------------
def clearance(findings: Sequence[Finding], pictures: Sequence[ObstaclePicture]) -> Panels:
    """``clearance.png``: heights over x, and the distance to each obstacle over t."""
    panels = {"height over x, with the silhouettes of the obstacles": partial(_heights, findings, pictures)}
    if any(finding.obstacle.body is not None for finding in findings):
        panels["distance to each obstacle along the path, in mm"] = partial(_clearances, findings, pictures)
    return panels


def _heights(findings: Sequence[Finding], pictures: Sequence[ObstaclePicture], axis: Any) -> None:
    for picture in pictures:
        outline = picture.outline(0, 2)
        if outline is not None:
            axis.fill(*outline.T, color=picture.colour, alpha=0.35)
    for name, curve in {finding.name: finding.curve for finding in findings}.items():
        points = sampled(curve.points, 81)
        axis.plot(points[:, 0], points[:, 2], color=COLOURS.get(name, INK), linewidth=2.2)
    axis.set_aspect("equal", adjustable="datalim")
    _titled(axis, "height over x", "x (mm)", "z (mm)")


def _clearances(findings: Sequence[Finding], pictures: Sequence[ObstaclePicture], axis: Any) -> None:
    names = list(dict.fromkeys(finding.name for finding in findings))
    colours, seen = {picture.name: picture.colour for picture in pictures}, set()
    for finding in findings:
        start, obstacle = names.index(finding.name), finding.obstacle
        colour = colours.get(obstacle.name, OBSTACLES[0])
        if obstacle.body is not None:
            values = np.maximum(signed_distances(sampled(finding.curve.points, COUNT), obstacle.body), 0)
            label = None if obstacle.name in seen else obstacle.name
            axis.plot(start + np.linspace(0, 1, COUNT), values, color=colour, linewidth=1.8, label=label)
            seen.add(obstacle.name)
        if isinstance(finding.outcome, Contact):
            axis.plot(start + float(finding.outcome.t[0]), 0, "x", color=colour, markersize=9)
    for k in range(1, len(names)):
        axis.axvline(k, color=GRID, linewidth=1)
    axis.set_xticks([k + 0.5 for k in range(len(names))], list(names))
    axis.set_ylim(bottom=0)
    _titled(axis, "distance to each obstacle", "curve", "distance (mm)", legend=bool(seen))


# --- speed and curvature ----------------------------------------------------------------------------------
def motion(path: Path) -> Panels:
    """``motion.png``: speed and curvature over time."""
    speed = "speed (mm per unit of time)"
    titles = {speed: lambda slope, _, time: np.linalg.norm(slope, axis=1) / time, "curvature (1/mm)": _curvature}
    return {f"{title} along the path, over time": partial(_over_time, path, title, of) for title, of in titles.items()}


def _over_time(path: Path, title: str, value: Callable[[Array, Array, float], Array], axis: Any) -> None:
    begin = 0.0
    for name, curve in path.curves.items():
        duration, first = float(path.duration(name)), curve.hodograph()
        slope, turn = sampled(first.points, COUNT), sampled(first.hodograph().points, COUNT)
        time = begin + duration * np.linspace(0.0, 1.0, COUNT)
        axis.plot(time, value(slope, turn, duration), color=COLOURS.get(name, INK), linewidth=2, label=name)
        begin += duration
    axis.set_ylim(bottom=0.0)
    _titled(axis, title, "time, in units of the middle curve's duration", legend=len(path.curves) > 1)


def _curvature(slope: Array, turn: Array, duration: float) -> Array:
    """|P' x P''| / |P'|^3; not a number where the curve stops."""
    size = np.linalg.norm(slope, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.linalg.norm(np.cross(slope, turn), axis=1) / np.where(size > 1e-9, size, np.nan) ** 3)


# --- Method 1 ---------------------------------------------------------------------------------------------
def profile(given: Task, curves: Mapping[str, Bezier]) -> Panels:
    """``profile.png``: each raised coordinate over x with its control points, the interval [a, b] and the height h;
    ``curves`` by their names in the legend, the first one chosen."""
    words = "{} over x with its control points; shaded: from a to b, where the height h is to be kept"
    return {words.format(axis.name): partial(_profile, given, curves, axis) for axis in given.raised}


def _profile(given: Task, curves: Mapping[str, Bezier], axis: Axis, panel: Any) -> None:
    a, b = map(float, given.interval)
    panel.axvspan(a, b, color=SHADE, zorder=0)
    panel.plot([a, b], [float(axis.height or 0)] * 2, color=COLOURS["Q"], linewidth=2, label="h on [a, b]")
    column = 1 + given.axes.index(axis)
    for i, (label, drawn) in enumerate(curves.items()):
        points, polygon = sampled(drawn.points, COUNT), numbers(drawn.points)
        colour = COLOURS["P"] if i == 0 else PALE
        panel.plot(polygon[:, 0], polygon[:, column], "--o", color=colour, linewidth=0.8, markersize=3, alpha=0.8)
        panel.plot(points[:, 0], points[:, column], color=colour, linewidth=2.2, label=label)
    _titled(panel, f"{axis.name} over x", "x (mm)", f"{axis.name} (mm)", legend=True)
