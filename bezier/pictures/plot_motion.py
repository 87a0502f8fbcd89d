"""Speed and curvature of a path over time, drawn with matplotlib from floating-point samples."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import Any

import numpy as np

from bezier.paths.path import Path
from bezier.pictures.mesh import Array, sampled
from bezier.pictures.picture import COLOURS, GRID, INK, Chart
from bezier.pictures.plot import new_figure, svg_text

COUNT = 201
TITLES = ("speed (mm per unit of time)", "curvature (1/mm)")


def save(path: Path, file: FilePath) -> None:
    """``motion.png``: speed and curvature over time."""
    figure = new_figure(11, 3.6)
    for k in range(len(TITLES)):
        _draw(figure.add_axes((0.06 + 0.5 * k, 0.15, 0.41, 0.74)), path, k)
    figure.savefig(file, dpi=120, pil_kwargs={"compress_level": 4})


def charts(path: Path) -> tuple[Chart, ...]:
    """The same for the page."""
    found = []
    for k, title in enumerate(TITLES):
        figure = new_figure(5.6, 3.4)
        _draw(figure.add_axes((0.11, 0.15, 0.86, 0.75)), path, k)
        found.append((svg_text(figure), f"{title} along the path, over time"))
    return tuple(found)


def _draw(axis: Any, path: Path, which: int) -> None:
    begin = 0.0
    for name, curve in path.curves.items():
        duration = float(path.duration(name))
        first = curve.hodograph()
        slope, turn = sampled(first.points, COUNT), sampled(first.hodograph().points, COUNT)
        time = begin + duration * np.linspace(0.0, 1.0, COUNT)
        value = _curvature(slope, turn) if which else np.linalg.norm(slope, axis=1) / duration
        axis.plot(time, value, color=COLOURS.get(name, INK), linewidth=2, label=name)
        begin += duration
    axis.set_ylim(bottom=0.0)
    axis.set_title(TITLES[which], fontsize=10, color=INK)
    axis.set_xlabel("time, in units of the middle curve's duration")
    axis.grid(color=GRID, linewidth=0.6)
    if not which and len(path.curves) > 1:
        axis.legend(frameon=False, fontsize=9)


def _curvature(slope: Array, turn: Array) -> Array:
    """|P' x P''| / |P'|^3; not a number where the curve stops."""
    size = np.linalg.norm(slope, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.linalg.norm(np.cross(slope, turn), axis=1) / np.where(size > 1e-9, size, np.nan) ** 3)
