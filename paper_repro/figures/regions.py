"""Regions of control points: three discs that meet or not, and pictures the engine draws itself."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import qe
from paper_repro.figures.canvas import COLOURS, INK, Figure, circle, drawing, label, plane


@drawing
def three_discs(via: Sequence[Sequence[Any]], radii: Sequence[float], titles: Sequence[str]) -> Figure:
    """The discs about O, 2 Q0 and 2 R0 in the plane of O, Q0, R0, for several radii."""
    figure, axes = plane(9.6, 4.4, len(radii))
    q0, r0 = ([float(c) for c in p] for p in via)
    for axis, radius, title in zip(axes, radii, titles):
        for name, centre, colour in (
            ("Q_1", (0, 0), "Q"),
            ("P_1", [2 * c for c in q0], "P"),
            ("R_1", [2 * c for c in r0], "R"),
        ):
            circle(axis, centre, radius, COLOURS[colour], fill=True, facecolor=(COLOURS[colour], 0.16))
            label(axis, rf"$\|\hat{{{name[0]}}}_1\| \leq r$", centre, (-20, -3), color=COLOURS[colour], fontsize=10)
        for name, point in (("O", (0.0, 0.0)), (r"\hat{Q}_0", q0), (r"\hat{R}_0", r0)):
            axis.plot([point[0]], [point[1]], "o", color=INK, markersize=5)
            label(axis, f"${name}$", point, (5, 6) if name != "O" else (5, -14))
        axis.set_title(title, fontsize=10)
    return figure


def region(found: qe.Region) -> str:
    """The picture that a region draws of itself."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "region.svg"
        found.plot(path)
        text = path.read_text()
    return text[text.index("<svg") :]


@drawing
def two_regions(
    inner: Sequence[tuple[Sequence[Any], float]], outer: Any, window: tuple[float, float, float, float]
) -> Figure:
    """Where control points may be by the polygon test (the common part of discs) and by the exact test on the curves.

    ``outer``: a function that is nonnegative exactly on the larger region.
    """
    figure, (axis,) = plane(6.4, 4.2)
    x, y = np.meshgrid(np.linspace(window[0], window[1], 241), np.linspace(window[2], window[3], 241))
    depth = np.min([r * r - (x - float(c[0])) ** 2 - (y - float(c[1])) ** 2 for c, r in inner], axis=0)
    axis.contourf(x, y, outer(x, y), levels=[0, np.inf], colors=["#f4c7cd"])
    axis.contourf(x, y, depth, levels=[0, np.inf], colors=["#bcd3ea"])
    axis.contour(x, y, outer(x, y), levels=[0], colors=[COLOURS["Q"]], linewidths=1.6)
    axis.contour(x, y, depth, levels=[0], colors=[COLOURS["P"]], linewidths=1.6)
    axis.plot([], [], color=COLOURS["P"], label="control points in the disc: formula (8)")
    axis.plot([], [], color=COLOURS["Q"], label="whole curves in the disc: (8*)")
    axis.legend(frameon=False, loc="upper right", fontsize=9)
    axis.set_xlabel("$x$")
    axis.set_ylabel("$y$")
    return figure
