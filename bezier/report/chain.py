"""The page of ``bezier chain``: the curves and their control polygons in the ball and the half-spaces, what is proved,
and where there is no chain, what excludes it and what repairs it."""

from __future__ import annotations

from typing import Any

import numpy as np

from bezier.chains.chain import Chain
from bezier.chains.region import PointRegion
from bezier.curves.curve import Bezier
from bezier.pictures.mesh import hull, sampled
from bezier.pictures.picture import COLOURS, INK, PALE, Chart
from bezier.pictures.plot import AXES, VIEWS, framed, new_figure, place, svg_text
from bezier.report import html
from bezier.report.html import Card, Page, Section
from bezier.report.parts import decimal_point

BAD = "#c0392b"
_CURVES = tuple(COLOURS.values())


def page(
    chain: Chain,
    curves: tuple[Bezier, ...],
    lines: list[str],
    title: str,
    cards: list[Card],
    shown: PointRegion | None = None,
) -> Page:
    """``lines``: what the command says; without curves the given points alone are drawn."""
    drawn = html.figures(pictures(chain, curves, shown), wide=True)
    rows = [
        (f"C{k + 1}", str(chain.times[k]), html.joined(*(decimal_point(p, 6) for p in curve.points)))
        for k, curve in enumerate(curves)
    ]
    said = Section("proved", "What is proved", html.bullets(lines), short="proved")
    listed = html.folded("Control points", html.table(("curve", "seconds", "control points"), rows)) if rows else ""
    sections = [Section("picture", "Picture", html.joined(drawn, listed), short="picture"), said]
    note = "Pictures are floating point; what is said of the chain is proved in exact arithmetic."
    return Page(title=f"Chain {title}", lead=lines[0], sections=sections, footer=note, cards=cards)


def pictures(chain: Chain, curves: tuple[Bezier, ...], shown: PointRegion | None = None) -> list[Chart]:
    """The plane, or the three views of space; with the region where one is ``shown``."""
    where = "" if shown is None else f"; shaded: where {shown.name} may be"
    if chain.dimension == 2:
        return [(_view(chain, curves, 0, 1, shown), f"the chain, its control polygons and its conditions{where}")]
    return [(_view(chain, curves, i, j, shown), f"the chain, {title}{where}") for title, i, j in VIEWS]


def _view(chain: Chain, curves: tuple[Bezier, ...], i: int, j: int, shown: PointRegion | None) -> str:
    figure = new_figure(7.2, 6.4)
    axis = figure.add_axes((0.1, 0.08, 0.87, 0.88))
    given = np.array([[float(c) for c in p] for p in chain.points])
    polygons = [np.array([[float(c) for c in p] for p in curve.points]) for curve in curves]
    everything = np.concatenate([given, *polygons])[:, (i, j)]
    _conditions(axis, chain, i, j)
    if shown is not None:
        corners = np.array([[float(c) for c in p] for p in shown.inner])
        axis.fill(*hull(corners[:, (i, j)]).T, color=PALE, alpha=0.3, linewidth=0)
    drawn = [everything]
    for k, (curve, polygon) in enumerate(zip(curves, polygons, strict=True)):
        colour = _CURVES[k % len(_CURVES)]
        points = sampled(curve.points, 61)[:, (i, j)]
        axis.plot(*polygon[:, (i, j)].T, "--o", color=colour, linewidth=0.8, markersize=3, alpha=0.7)
        axis.plot(*points.T, color=colour, linewidth=2.2)
        drawn.append(points)
    axis.plot(*given[:, (i, j)].T, "o" if curves else "o:", color=INK, markersize=6, linewidth=0.8, zorder=5)
    if chain.radius_squared is not None:
        centre = np.array([float(chain.centre[i]), float(chain.centre[j])])
        radius = float(chain.radius_squared) ** 0.5
        everything = np.concatenate([everything, [centre - radius, centre + radius]])
    low, high = everything.min(axis=0), everything.max(axis=0)
    pad = 0.05 * float((high - low).max()) + 1e-9
    axis.set_xlim(low[0] - pad, high[0] + pad)
    axis.set_ylim(low[1] - pad, high[1] + pad)
    axis.set_aspect("equal", adjustable="box")
    framed(axis, f"{AXES[i]} (mm)", f"{AXES[j]} (mm)")
    names = zip(chain.point_names, given[:, (i, j)], strict=True)
    place(axis, [(name, point) for name, point in names if len(given) <= 16], np.concatenate(drawn))
    return svg_text(figure)


def _conditions(axis: Any, chain: Chain, i: int, j: int) -> None:
    """The ball's outline, and the lines of half-spaces in the plane."""
    if chain.radius_squared is not None:
        turn, radius = np.linspace(0, 2 * np.pi, 241), float(chain.radius_squared) ** 0.5
        centre = float(chain.centre[i]), float(chain.centre[j])
        axis.plot(centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn), color=PALE, linewidth=1.2)
    for normal, offset in chain.half_spaces if chain.dimension == 2 else ():
        arrow = np.array([float(c) for c in normal])
        foot = arrow * float(offset) / (arrow @ arrow)
        axis.axline(tuple(foot), tuple(foot + np.array([-arrow[1], arrow[0]])), color=BAD, linewidth=1, linestyle="--")
