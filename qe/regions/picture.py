"""Pictures of regions in one, two and three variables, painted from a sketch. For looking only."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

from qe.errors import InputError
from qe.regions.sketch import Sketch
from qe.regions.space import draw_space
from qe.regions.upright import isolated, uprights

FILL, EDGE = "#4c78a8", "#1f3b5c"
LONGEST = 20.0
"""A picture longer than that, as a share of its height, is not drawn to scale."""
FLAT, TURNABLE = (".png", ".svg", ".pdf"), ".html"


def check_ending(path: Path) -> None:
    """``InputError`` for a file name that no picture has."""
    if path.suffix.lower() not in (*FLAT, TURNABLE):
        raise InputError(f"a picture needs a file name ending in .png, .svg, .pdf or .html, {path.name} found")


def inline(sketch: Sketch) -> str:
    """An HTML image that holds the picture itself. Raises ``ImportError`` where matplotlib is not installed."""
    from base64 import b64encode
    from io import BytesIO

    content = BytesIO()
    written(partial(paint, sketch), content, "png", projection=_projection(sketch), figsize=(3.6, 2.9), dpi=100)
    names = escape(", ".join(sketch.order))
    return f'<img alt="the region in {names}" src="data:image/png;base64,{b64encode(content.getvalue()).decode()}">'


def write(sketch: Sketch, path: Path) -> Any:
    """Write a picture, or a page for .html, in space with a turnable one; the axes of the former."""
    if path.suffix.lower() == TURNABLE:
        from qe.regions.turnable import page

        path.write_text(page(sketch, "" if len(sketch.order) == 3 else _drawing(sketch)), encoding="utf-8")
        return None
    return written(partial(paint, sketch), path, projection=_projection(sketch))


def _drawing(sketch: Sketch) -> str:
    """The picture as SVG."""
    from io import StringIO

    content = StringIO()
    written(partial(paint, sketch), content, "svg")
    return content.getvalue()


def written(painted: Callable[[Any], Any], target: Any, kind: str | None = None, **look: Any) -> Any:
    """Paint on the axes of a new figure, and write it to a file or a buffer; the axes. ``look``: of ``Figure``."""
    from matplotlib.figure import Figure

    projection = look.pop("projection", None)
    figure = Figure(**{"figsize": (6.4, 5.2), "dpi": 150, **look})
    axes = painted(figure.add_subplot(projection=projection))
    figure.tight_layout()
    figure.savefig(target, format=kind)
    return axes


def show(sketch: Sketch, axes: Any) -> Any:
    """Paint on the caller's axes, or on new ones of pyplot's, and return them. The backend stays as it is.

    Raises ``InputError`` for axes of another dimension, or for things that are none.
    """
    if axes is None:
        from matplotlib import pyplot

        axes = pyplot.figure().add_subplot(projection=_projection(sketch))
    elif not hasattr(axes, "fill_between"):
        raise InputError(f"ax: matplotlib's axes expected, {type(axes).__name__} found")
    elif (getattr(axes, "name", "") == "3d") != (len(sketch.order) == 3):
        needed = "axes with projection='3d'" if len(sketch.order) == 3 else "plane axes"
        raise InputError(f"ax: {needed} expected for a region in {', '.join(sketch.order)}")
    return paint(sketch, axes)


def _projection(sketch: Sketch) -> str | None:
    if len(sketch.order) < 3:
        return None
    import mpl_toolkits.mplot3d  # noqa: F401  (registers the projection)

    return "3d"


def paint(sketch: Sketch, axes: Any) -> Any:
    """Paint on axes of the right dimension; the axes."""
    if len(sketch.order) == 3:
        draw_space(sketch.solid, sketch.frame or {}, sketch.order, axes)
    else:
        (_line, _plane)[len(sketch.order) - 1](sketch, axes)
    if sketch.is_empty:
        axes.set_title("empty region")
    return axes


def _line(sketch: Sketch, axes: Any) -> None:
    for part in sketch.segments:
        axes.plot([part.low, part.high], [0, 0], color=FILL, linewidth=6, solid_capstyle="butt")
        for end, closed in ((part.low, part.lower), (part.high, part.upper)):
            if closed is not None:
                face = FILL if closed else "white"
                axes.plot([end], [0], "o", markersize=9, markerfacecolor=face, markeredgecolor=EDGE)
    axes.set_xlim(*sketch.spans[0])
    axes.set_ylim(-1, 1)
    axes.set_yticks([])
    axes.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    axes.set_xlabel(sketch.order[0])


def _plane(sketch: Sketch, axes: Any) -> None:
    (left, right), (bottom, top) = sketch.spans
    for band in sketch.bands:
        if len(band.xs) == 1:
            continue
        axes.fill_between(band.xs, band.low, band.high, color=FILL, alpha=0.55, linewidth=0)
        for closed, curve in ((band.lower, band.low), (band.upper, band.high)):
            if closed is not None:
                axes.plot(band.xs, curve, color=EDGE, linewidth=1.2, linestyle="-" if closed else "--")
    for place in isolated(sketch.bands, top - bottom):
        axes.plot(*[[c] for c in place], color=EDGE, marker="o", markersize=5)
    for line in uprights(sketch.bands, top - bottom):
        axes.plot(
            [line.x] * 2, [line.low, line.high], color=EDGE, linewidth=1.2, linestyle="-" if line.closed else "--"
        )
        for end in line.open_ends:
            axes.plot([line.x], [end], "o", markersize=5, markerfacecolor="white", markeredgecolor=EDGE)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    shares = (right - left) / (top - bottom)
    axes.set_aspect("equal" if 1 / LONGEST <= shares <= LONGEST else "auto", adjustable="box")
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.set_xlabel(sketch.order[0])
    axes.set_ylabel(sketch.order[1])
