"""Height profiles over x of Method 1: each coordinate with its control points, the interval [a, b] and the height h."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import Any

from bezier.curves.curve import Bezier
from bezier.input.task import Task
from bezier.pictures.mesh import sampled
from bezier.pictures.picture import COLOURS, GRID, INK, PALE, SHADE, Chart, numbers
from bezier.pictures.plot import new_figure, svg_text

COUNT = 241


def save(given: Task, curves: Mapping[str, Bezier], file: FilePath) -> None:
    """``profile.png``: one panel per raised axis; ``curves`` by their names in the legend, the first one chosen."""
    count = len(given.raised)
    figure = new_figure(11, 3.9)
    for k in range(count):
        _draw(figure.add_axes((0.06 + k * 0.5, 0.14, 0.92 / count - 0.04 * count, 0.76)), given, curves, k)
    figure.savefig(file, dpi=120, pil_kwargs={"compress_level": 4})


def charts(given: Task, curves: Mapping[str, Bezier]) -> tuple[Chart, ...]:
    """The same for the page."""
    found = []
    for k, axis in enumerate(given.raised):
        figure = new_figure(6.4, 3.6)
        _draw(figure.add_axes((0.09, 0.14, 0.88, 0.76)), given, curves, k)
        words = f"{axis.name} over x with its control points; shaded: from a to b, where the height h is to be kept"
        found.append((svg_text(figure), words))
    return tuple(found)


def _draw(panel: Any, given: Task, curves: Mapping[str, Bezier], k: int) -> None:
    axis = given.raised[k]
    a, b = map(float, given.interval)
    panel.axvspan(a, b, color=SHADE, zorder=0)
    panel.plot([a, b], [float(axis.height or 0)] * 2, color=COLOURS["Q"], linewidth=2, label="h on [a, b]")
    column = 1 + given.axes.index(axis)
    for i, (label, drawn) in enumerate(curves.items()):
        points, polygon = sampled(drawn.points, COUNT), numbers(drawn.points)
        colour = COLOURS["P"] if i == 0 else PALE
        panel.plot(polygon[:, 0], polygon[:, column], "--o", color=colour, linewidth=0.8, markersize=3, alpha=0.8)
        panel.plot(points[:, 0], points[:, column], color=colour, linewidth=2.2, label=label)
    panel.set_title(f"{axis.name} over x", fontsize=10, color=INK)
    panel.set_xlabel("x")
    panel.grid(color=GRID, linewidth=0.6)
    panel.legend(frameon=False, fontsize=9)
