"""The chart of heights and clearances: obstacles over x, and the distance to each of them along the path."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from bezier.obstacles.bodies import distance_at
from bezier.obstacles.clearance import Contact
from bezier.obstacles.survey import Finding
from bezier.pictures.mesh import sampled
from bezier.pictures.obstacles import COLOURS as OBSTACLES
from bezier.pictures.obstacles import ObstaclePicture
from bezier.pictures.picture import COLOURS, GRID, INK, Chart
from bezier.pictures.plot import new_figure, svg_text

STEPS = 40
"""Steps per curve."""


def save_chart(findings: Sequence[Finding], pictures: Sequence[ObstaclePicture], file: FilePath) -> tuple[Chart, ...]:
    """``clearance.png``, and the same for the page: heights over x, and the distance to each obstacle over t."""
    names = list(dict.fromkeys(finding.name for finding in findings))

    def heights(axis: Any) -> None:
        _heights(axis, list({finding.name: finding for finding in findings}.values()), pictures)

    def distances(axis: Any) -> None:
        _clearances(axis, findings, names, pictures)

    panels = {"height over x, with the silhouettes of the obstacles": heights}
    if any(finding.obstacle.body is not None for finding in findings):
        panels["distance to each obstacle along the path, in mm"] = distances
    whole, charts = new_figure(6 * len(panels), 4.2), []
    for k, (words, draw) in enumerate(panels.items()):
        wide = 1 / len(panels)
        draw(whole.add_axes((wide * (k + 0.11), 0.13, wide * 0.85, 0.76)))
        single = new_figure(5.8, 3.6)
        draw(single.add_axes((0.11, 0.15, 0.86, 0.75)))
        charts.append((svg_text(single), words))
    whole.savefig(file, dpi=120, pil_kwargs={"compress_level": 4})
    return tuple(charts)


def _heights(axis: Any, findings: Sequence[Finding], pictures: Sequence[ObstaclePicture]) -> None:
    for picture in pictures:
        outline = picture.outline(0, 2)
        if outline is not None:
            axis.fill(*outline.T, color=picture.colour, alpha=0.35)
    for finding in findings:
        points = sampled(finding.curve.points, 81)
        axis.plot(points[:, 0], points[:, 2], color=COLOURS.get(finding.name, INK), linewidth=2.2)
    axis.set_aspect("equal", adjustable="datalim")
    _labelled(axis, "height over x", "x", "z")


def _clearances(
    axis: Any, findings: Sequence[Finding], names: Sequence[str], pictures: Sequence[ObstaclePicture]
) -> None:
    colours, seen = {picture.name: picture.colour for picture in pictures}, set()
    for finding in findings:
        start, obstacle = names.index(finding.name), finding.obstacle
        colour = colours.get(obstacle.name, OBSTACLES[0])
        if obstacle.body is not None:
            times = [Fraction(k, STEPS) for k in range(STEPS + 1)]
            values = [distance_at(finding.curve, obstacle.body, t) for t in times]
            label = None if obstacle.name in seen else obstacle.name
            axis.plot([start + float(t) for t in times], values, color=colour, linewidth=1.8, label=label)
            seen.add(obstacle.name)
        if isinstance(finding.outcome, Contact):
            axis.plot(start + float(finding.outcome.t[0]), 0, "x", color=colour, markersize=9)
    for k in range(1, len(names)):
        axis.axvline(k, color=GRID, linewidth=1)
    axis.set_xticks([k + 0.5 for k in range(len(names))], list(names))
    axis.set_ylim(bottom=0)
    if seen:
        axis.legend(frameon=False, fontsize=9)
    _labelled(axis, "distance to each obstacle", "curve", "distance (mm)")


def _labelled(axis: Any, title: str, across: str, up: str) -> None:
    axis.set_title(title, fontsize=10)
    axis.set_xlabel(across)
    axis.set_ylabel(up)
    axis.grid(color=GRID, linewidth=0.6)
