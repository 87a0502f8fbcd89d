"""Empty drawings and how they become SVG text. In floating point, for looking only: nothing depends on them."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any, ParamSpec

import matplotlib
import mpl_toolkits.mplot3d  # noqa: F401  (registers the 3-D projection)
from matplotlib.figure import Figure

from bezier.curves.curve import Bezier
from bezier.pictures.mesh import Array, sampled
from bezier.pictures.picture import COLOURS, FLOOR, INK, PALE

__all__ = [
    "COLOURS",
    "FLOOR",
    "INK",
    "PALE",
    "Array",
    "Figure",
    "circle",
    "curve",
    "drawing",
    "label",
    "plane",
    "space",
]

P = ParamSpec("P")

STYLE = {
    "font.size": 10,
    "mathtext.fontset": "cm",
    "svg.hashsalt": "paper",
    "axes.edgecolor": PALE,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": PALE,
    "ytick.color": PALE,
}


def plane(width: float, height: float, count: int = 1) -> tuple[Figure, list[Any]]:
    """A figure with ``count`` plane drawings side by side, of equal scale on both axes."""
    figure = Figure(figsize=(width, height), layout="constrained")
    axes = [figure.add_subplot(1, count, k + 1) for k in range(count)]
    for axis in axes:
        axis.set_aspect("equal", adjustable="datalim")
        axis.spines[["top", "right"]].set_visible(False)
        axis.grid(color="#e9edf1", linewidth=0.6)
        axis.set_axisbelow(True)
    return figure, axes


def space(width: float, height: float) -> tuple[Figure, Any]:
    """A figure with one drawing in space."""
    figure = Figure(figsize=(width, height))
    return figure, figure.add_axes((0, 0, 1, 1), projection="3d")


def drawing(make: Callable[P, Figure]) -> Callable[P, str]:
    """Make SVG text of a figure drawn in this package's style: one ``<svg>`` element, also a file of its own."""

    @wraps(make)
    def drawn(*given: P.args, **named: P.kwargs) -> str:
        buffer = io.StringIO()
        with matplotlib.rc_context(STYLE):
            figure = make(*given, **named)
            figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
        text = buffer.getvalue()
        return re.sub(r"\s*<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)

    return drawn


def label(axis: Any, text: str, at: Sequence[Any], offset: tuple[float, float] = (4, 6), **style: Any) -> None:
    """A name beside a point; ``offset`` in printer's points."""
    place = (float(at[0]), float(at[1]))
    axis.annotate(text, place, xytext=offset, textcoords="offset points", **{"fontsize": 11, **style})


def curve(axis: Any, given: Bezier, colour: str, *, polygon: bool = True, text: str | None = None) -> Array:
    """A plane curve with its control polygon; returns the points drawn."""
    points = sampled(given.points, 121)
    axis.plot(*points.T, color=colour, linewidth=2.2, label=text)
    if polygon:
        corners = [[float(c) for c in p] for p in zip(*given.points)]
        axis.plot(*corners, "--o", color=colour, linewidth=0.9, markersize=4, alpha=0.8)
    return points


def circle(axis: Any, centre: Sequence[Any], radius: float, colour: str, **style: Any) -> None:
    """A circle, or a filled disc with ``fill=True``."""
    from matplotlib.patches import Circle

    place = (float(centre[0]), float(centre[1]))
    patch = Circle(place, radius, **{"fill": False, "edgecolor": colour, "linewidth": 1.4, **style})
    axis.add_patch(patch)
    axis.update_datalim([(place[0] - radius, place[1] - radius), (place[0] + radius, place[1] + radius)])
    axis.autoscale_view()
