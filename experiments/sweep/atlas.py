"""The atlas of a sweep: where (8) is feasible, how much room Q1 has, and the objective of (7), over the via points."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from experiments.figures import Picture
from experiments.sweep.grid import Method
from experiments.sweep.solve import Outcome

Value = Callable[[Outcome], float | None]

PANELS: tuple[tuple[Method, str, Value], ...] = (
    (Method.QUADRATIC, "formula (8) feasible", lambda row: None if row.feasible is None else float(row.feasible)),
    (Method.QUADRATIC, "volume of the region of $Q_1$", lambda row: row.volume_high if row.feasible else None),
    (Method.CUBIC, "least objective of formula (7)", lambda row: row.objective),
)
CURVE_POINTS = 200


def atlas(outcomes: Iterable[Outcome]) -> Iterator[Picture]:
    """One picture per radius."""
    by_radius: dict[Fraction, list[Outcome]] = {}
    for row in outcomes:
        by_radius.setdefault(Fraction(row.radius), []).append(row)
    for radius, rows in sorted(by_radius.items()):
        name = f"atlas-r{str(radius).replace('/', '_')}"
        yield Picture(name, f"via points (-d, 0, k), (d, 0, k) in a ball of radius {radius}", _figure(radius, rows))


def boundary(radius: float) -> tuple[list[float], list[float]]:
    """The exact border of feasibility in the (d, k) plane: d = r/2 up to k = r/2, then d^2 + k^2 = r k."""
    heights = [radius / 2 * (1 + i / CURVE_POINTS) for i in range(CURVE_POINTS + 1)]
    widths = [math.sqrt(max(radius * k - k * k, 0.0)) for k in heights]
    return [radius / 2, *widths], [0.0, *heights]


def _figure(radius: Fraction, rows: Sequence[Outcome]) -> Any:
    from matplotlib.figure import Figure

    panels = [(title, cells) for method, title, value in PANELS if (cells := _cells(rows, method, value))]
    figure = Figure(figsize=(5 * len(panels), 4.4), layout="constrained")
    figure.suptitle(f"r = {radius}")
    for i, (title, cells) in enumerate(panels):
        axes = figure.add_subplot(1, len(panels), i + 1)
        _panel(figure, axes, title, cells)
        axes.plot(*boundary(float(radius)), color="black", linewidth=1.6, label="$d^2 + k^2 = r k$; $d = r/2$ below")
        axes.set_xlim(0, float(radius))
        axes.set_ylim(0, float(radius))
        axes.set_aspect("equal")
        axes.legend(fontsize=8, loc="upper right")
    return figure


def _cells(rows: Sequence[Outcome], method: Method, value: Value) -> dict[tuple[float, float], float]:
    found = {(r.half_width, r.height): value(r) for r in rows if r.method == method.value}
    return {(float(Fraction(d)), float(Fraction(k))): v for (d, k), v in found.items() if v is not None}


def _panel(figure: Any, axes: Any, title: str, cells: dict[tuple[float, float], float]) -> None:
    widths, heights = (sorted({place[i] for place in cells}) for i in (0, 1))
    field = [[cells.get((d, k), math.nan) for d in widths] for k in heights]
    mesh = axes.pcolormesh(_edges(widths), _edges(heights), field, cmap="viridis", edgecolors="face", linewidth=0.3)
    if len(set(cells.values())) > 2:
        figure.colorbar(mesh, ax=axes)
    axes.set_title(title, fontsize=11)
    axes.set_xlabel("d")
    axes.set_ylabel("k")


def _edges(centres: Sequence[float]) -> list[float]:
    """The borders of cells around these values."""
    if len(centres) == 1:
        return [centres[0] - 0.5, centres[0] + 0.5]
    middles = [(a + b) / 2 for a, b in pairwise(centres)]
    return [2 * centres[0] - middles[0], *middles, 2 * centres[-1] - middles[-1]]
