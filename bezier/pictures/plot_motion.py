"""Speed and curvature of a path over time, drawn with matplotlib from floating-point samples."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import Any

import numpy as np

from bezier.paths.path import Path
from bezier.pictures.mesh import Array, sampled
from bezier.pictures.picture import COLOURS, INK
from bezier.pictures.plot import new_figure, svg_text

COUNT = 201


def save(path: Path, file: FilePath) -> None:
    """``motion.png``: speed and curvature over time."""
    _drawn(path).savefig(file, dpi=120, pil_kwargs={"compress_level": 4})


def svg(path: Path) -> str:
    """The same as SVG text for the report."""
    return svg_text(_drawn(path))


def _drawn(path: Path) -> Any:
    figure = new_figure(11, 3.6)
    speed, bend = figure.add_axes((0.06, 0.15, 0.41, 0.74)), figure.add_axes((0.56, 0.15, 0.41, 0.74))
    begin = 0.0
    for name, curve in path.curves.items():
        duration = float(path.duration(name))
        first = curve.hodograph()
        slope, turn = sampled(first.points, COUNT), sampled(first.hodograph().points, COUNT)
        time = begin + duration * np.linspace(0.0, 1.0, COUNT)
        style = {"color": COLOURS.get(name, INK), "linewidth": 2, "label": f"${name}$"}
        speed.plot(time, np.linalg.norm(slope, axis=1) / duration, **style)
        bend.plot(time, _curvature(slope, turn), **style)
        begin += duration
    speed.set_ylim(bottom=0.0)
    for axis, title in ((speed, "speed (mm per unit of time)"), (bend, "curvature (1/mm)")):
        axis.set_title(title, fontsize=10, color=INK)
        axis.set_xlabel("time")
        axis.grid(color="#e3e8ec", linewidth=0.6)
    speed.legend(frameon=False, fontsize=9)
    return figure


def _curvature(slope: Array, turn: Array) -> Array:
    """|P' x P''| / |P'|^3; not a number where the curve stops."""
    size = np.linalg.norm(slope, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.linalg.norm(np.cross(slope, turn), axis=1) / np.where(size > 1e-9, size, np.nan) ** 3)
