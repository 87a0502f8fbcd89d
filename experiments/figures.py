"""Figures from results alone, as vector graphics: solved over time, us against each peer, growth."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from experiments import measures
from experiments.results import Log, Result, Status
from experiments.solvers import OURS
from experiments.tables import without_ablation

COLOURS = ("#1b6ca8", "#c8553d", "#2f8f5b", "#7d5ba6", "#b8860b", "#444444", "#c2185b", "#0097a7", "#6d4c41", "#8bc34a")
MARKS = "osD^vP*X<>"
UNSOLVED = 2.0
"""Where an unsolved problem stands in a scatter plot, in limits."""


@dataclass(frozen=True, slots=True)
class Picture:
    """``name`` of its file without ending; ``figure`` is matplotlib's."""

    name: str
    caption: str
    figure: Any

    def svg(self) -> str:
        """The SVG document: the same bytes for the same data, text kept as text."""
        import matplotlib

        buffer = io.StringIO()
        with matplotlib.rc_context({"svg.hashsalt": self.name, "svg.fonttype": "none"}):
            self.figure.savefig(buffer, format="svg", metadata={"Date": None}, bbox_inches="tight")
        return buffer.getvalue()


def pictures(log: Log) -> Iterator[Picture]:
    """All figures that the results allow."""
    groups = {name: without_ablation(table) for name, table in measures.by_group(log).items()}
    for name, table in groups.items():
        if any(r.is_solved for rows in table.values() for r in rows.values()):
            yield Picture(f"cactus-{name}", f"{name}: problems solved within a time", cactus_figure(name, table))
    for name, table in measures.by_set(log).items():
        if any(r.size is not None for rows in table.values() for r in rows.values()):
            figure = growth_figure(name, without_ablation(table))
            yield Picture(f"growth-{name.rpartition('/')[2]}", f"{name}: time over size", figure)
    for peer in dict.fromkeys(s for table in groups.values() for s in table if not s.startswith(OURS)):
        pairs = list(_pairs(groups, peer))
        if pairs:
            yield Picture(f"scatter-{peer}", f"{OURS} and {peer}, every problem", scatter_figure(peer, pairs))


def _axes(title: str, x: str, y: str) -> tuple[Any, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.2))
    axes = figure.add_subplot()
    axes.set_title(title, fontsize=11)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.3, linewidth=0.5)
    return figure, axes


def _style(i: int) -> dict[str, Any]:
    return {"color": COLOURS[i % len(COLOURS)], "marker": MARKS[i % len(MARKS)], "markersize": 4, "linewidth": 1.3}


def cactus_figure(name: str, table: measures.Table) -> Any:
    """How many problems each solver solves within a time, one problem at a time."""
    total = len({id for rows in table.values() for id in rows})
    figure, axes = _axes(f"{name}: solved of {total}", "seconds for each problem", "problems solved")
    axes.set_xscale("log")
    for i, (solver, rows) in enumerate(table.items()):
        times = measures.solved_over_time(rows.values())
        if times:
            every = max(1, len(times) // 15)
            axes.step(times, range(1, len(times) + 1), where="post", label=solver, markevery=every, **_style(i))
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=8)
    return figure


def _pairs(groups: Mapping[str, measures.Table], peer: str) -> Iterator[tuple[Result, Result]]:
    for table in groups.values():
        mine, other = table.get(OURS, {}), table.get(peer, {})
        both = [(mine[key], row) for key, row in other.items() if key in mine]
        yield from (pair for pair in both if pair[1].status is not Status.UNSUPPORTED)


def scatter_figure(peer: str, pairs: Sequence[tuple[Result, Result]]) -> Any:
    """One point per problem; unsolved ones stand beyond the limit."""

    def place(row: Result) -> float:
        return max(row.seconds, measures.FASTEST) if row.is_solved else UNSOLVED * row.limit

    figure, axes = _axes(f"{len(pairs)} problems; above the line we are faster", f"{OURS}, seconds", f"{peer}, seconds")
    axes.set_xscale("log")
    axes.set_yscale("log")
    both = [[place(row) for row in pair] for pair in pairs]
    low, high = min(map(min, both)) / 1.5, max(map(max, both)) * 1.5
    axes.plot([low, high], [low, high], color="#888888", linewidth=0.8)
    for limit in sorted({row.limit for pair in pairs for row in pair if not row.is_solved}):
        axes.axvline(limit, color="#bbbbbb", linewidth=0.7, linestyle=":")
        axes.axhline(limit, color="#bbbbbb", linewidth=0.7, linestyle=":")
    axes.scatter(*zip(*both, strict=True), s=14, color=COLOURS[0], alpha=0.7, linewidths=0)
    axes.set_xlim(low, high)
    axes.set_ylim(low, high)
    return figure


def growth_figure(name: str, table: measures.Table) -> Any:
    """Seconds over size with the fitted power; a cross on the limit where a size was not solved."""
    figure, axes = _axes(name, "size", "seconds")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    for i, (solver, rows) in enumerate(table.items()):
        points = [(size, max(seconds, measures.FASTEST)) for size, seconds in measures.scaling_points(rows)]
        fit = measures.growth(points)
        label = solver if fit is None else f"{solver}: size^{fit.exponent:.1f} (R² {fit.exponent_fit:.2f})"
        if points:
            axes.plot(*zip(*points, strict=True), label=label, **_style(i))
        lost = [(r.size, r.limit) for r in measures.offered(rows) if not r.is_solved and r.size is not None]
        if lost:
            axes.plot(*zip(*lost, strict=True), "x", color=COLOURS[i % len(COLOURS)])
    sizes = sorted({r.size for rows in table.values() for r in rows.values() if r.size is not None})
    axes.set_xticks(sizes, [str(size) for size in sizes])
    axes.minorticks_off()
    axes.set_xlim(sizes[0] / math.sqrt(2), sizes[-1] * math.sqrt(2))
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize=8)
    return figure
