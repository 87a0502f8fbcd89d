"""The page of ``bezier chain``: the curves and their control polygons in the ball and the half-spaces, what is proved,
and where there is no chain, what excludes it and what repairs it."""

from __future__ import annotations

import numpy as np

from bezier.chains.chain import Chain
from bezier.chains.region import PointRegion
from bezier.curves.curve import Bezier
from bezier.pictures.mesh import Array, hull, sampled
from bezier.pictures.picture import INK, PALE, Chart, CurvePicture, PathPicture, numbers
from bezier.pictures.plot import VIEWS, new_figure, path_view, svg_text
from bezier.report import html
from bezier.report.html import Card, Page, Section
from bezier.report.parts import decimal_point

BAD = "#c0392b"


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
    given, reach = numbers(chain.points), float(chain.radius_squared or 0) ** 0.5
    drawn = (CurvePicture("PQR"[k % 3], sampled(c.points, 61), numbers(c.points)) for k, c in enumerate(curves))
    picture = PathPicture(
        radius=reach or float(np.ptp(given, axis=0).max()) / 2,
        has_floor=False,
        curves=tuple(drawn),
        marks=dict(zip(chain.point_names, given, strict=True)) if len(given) <= 16 else {},
        centre=numbers([chain.centre or chain.points[0]])[0],
        has_rim=reach > 0,
    )
    where = "" if shown is None else f"; shaded: where {shown.name} may be"
    plane = chain.dimension == 2
    views = (("the chain", 0, 1),) if plane else VIEWS
    words = "{}, its control polygons and its conditions" if plane else "the chain, {}"
    return [(_view(chain, picture, given, view, shown), words.format(view[0]) + where) for view in views]


def _view(
    chain: Chain, picture: PathPicture, given: Array, view: tuple[str, int, int], shown: PointRegion | None
) -> str:
    title, i, j = view
    figure = new_figure(7.2, 6.4)
    axis = figure.add_axes((0.1, 0.09, 0.87, 0.85))
    for normal, offset in chain.half_spaces if chain.dimension == 2 else ():
        arrow = numbers([normal])[0]
        foot = arrow * float(offset) / (arrow @ arrow)
        axis.axline(tuple(foot), tuple(foot + np.array([-arrow[1], arrow[0]])), color=BAD, linewidth=1, linestyle="--")
    if shown is not None:
        axis.fill(*hull(numbers(shown.inner)[:, (i, j)]).T, color=PALE, alpha=0.3, linewidth=0)
    axis.plot(*given[:, (i, j)].T, "o" if picture.curves else "o:", color=INK, markersize=6, linewidth=0.8, zorder=5)
    path_view(axis, picture, title, i, j)
    return svg_text(figure)
