"""Pictures of regions in one, two and three variables, drawn from the cylindrical description. For looking only."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from qe.errors import InputError
from qe.report.ends import ends
from qe.report.space import draw_space
from qe.solution.pieces import Piece

if TYPE_CHECKING:
    from qe.solution.region import Region

FILL, EDGE = "#4c78a8", "#1f3b5c"
SAMPLES_2D = 400
MARGIN = 0.06
UNBOUNDED = 4.0
INSIDE = 1e-7
"""The share of a range left out at its ends, where the roots above may coincide or vanish."""


def draw(region: Region, path: Path) -> None:
    """Write a picture of the region; the format follows the file name. ``InputError`` above three variables."""
    if len(region.order) > 3:
        raise InputError(f"a picture needs 1 to 3 variables, the region has {len(region.order)}")
    if path.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise InputError(f"a picture needs a file name ending in .png, .svg or .pdf, {path.name} found")
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure = pyplot.figure(figsize=(6.4, 5.2), dpi=150)
    axes = figure.add_subplot(projection="3d" if len(region.order) == 3 else None)
    (_line, _plane, draw_space)[len(region.order) - 1](region, axes)
    if region.is_empty:
        axes.set_title("empty region")
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)


def _span(region: Region, variable: str) -> tuple[float, float]:
    """Drawing limits of a variable; unbounded directions are cut off."""
    if region.is_empty:
        return -1.0, 1.0
    lower, upper = region.bounds(variable)
    lo = float(lower) if lower is not None else (float(upper) if upper is not None else 0.0) - UNBOUNDED
    hi = float(upper) if upper is not None else (float(lower) if lower is not None else 0.0) + UNBOUNDED
    pad = MARGIN * (hi - lo) or 1.0
    return lo - pad, hi + pad


def _inner_grid(count: int) -> Any:
    """Shares of a range from end to end, dense towards the ends but not on them."""
    import numpy

    return INSIDE + (1 - 2 * INSIDE) * (1 - numpy.cos(numpy.linspace(0, numpy.pi, count))) / 2


def _seams(pieces: list[Piece]) -> frozenset[Any]:
    """The values of the first variable where several pieces meet: inner lines, not the region's outline."""
    met: Counter[Any] = Counter()
    for piece in pieces:
        met.update({end.value for end in (piece.ranges[0].lower, piece.ranges[0].upper) if end is not None})
    return frozenset(value for value, count in met.items() if count > 1)


def _line(region: Region, axes: Any) -> None:
    span = _span(region, region.order[0])
    for piece in region.cells:
        lo, hi = ends(piece, 0, {}, span)
        axes.plot([lo, hi], [0, 0], color=FILL, linewidth=6, solid_capstyle="butt")
        for end, closed in ((lo, piece.ranges[0].lower_closed), (hi, piece.ranges[0].upper_closed)):
            axes.plot([end], [0], "o", markersize=9, markerfacecolor=FILL if closed else "white", markeredgecolor=EDGE)
    axes.set_xlim(*span)
    axes.set_ylim(-1, 1)
    axes.set_yticks([])
    axes.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    axes.set_xlabel(region.order[0])


def bands(region: Region) -> list[tuple[list[float], list[float], list[float]]]:
    """A bounded region in two variables as areas between curves: values of the first variable, both ends over them."""
    nowhere = (0.0, 0.0)  # every piece has ends of its own
    return [_band(piece, nowhere, nowhere) for piece in region.cells if not piece.ranges[0].is_point]


def _band(
    piece: Piece, x_span: tuple[float, float], y_span: tuple[float, float]
) -> tuple[list[float], list[float], list[float]]:
    lo, hi = ends(piece, 0, {}, x_span)
    xs = [lo] if piece.ranges[0].is_point else list(lo + (hi - lo) * _inner_grid(SAMPLES_2D))
    found = [ends(piece, 1, {0: x}, y_span) for x in xs]
    return xs, [low for low, _ in found], [high for _, high in found]


def _plane(region: Region, axes: Any) -> None:
    seams = _seams(region.cells)
    x_span, y_span = _span(region, region.order[0]), _span(region, region.order[1])
    for piece in region.cells:
        xs, low, high = _band(piece, x_span, y_span)
        if len(xs) == 1:
            first = piece.ranges[0].lower
            width = 0.4 if first is not None and first.value in seams else 1.2
            marker = "o" if piece.ranges[1].is_point and width > 1 else None
            axes.plot([xs[0], xs[0]], [low[0], high[0]], color=EDGE, marker=marker, markersize=5, linewidth=width)
            continue
        axes.fill_between(xs, low, high, color=FILL, alpha=0.55, linewidth=0)
        up = piece.ranges[1]
        for side, closed, curve in ((up.lower, up.lower_closed, low), (up.upper, up.upper_closed, high)):
            if side is not None:
                axes.plot(xs, curve, color=EDGE, linewidth=1.2, linestyle="-" if closed else "--")
    axes.set_xlim(*x_span)
    axes.set_ylim(*y_span)
    axes.set_aspect("equal", adjustable="box")
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.set_xlabel(region.order[0])
    axes.set_ylabel(region.order[1])
