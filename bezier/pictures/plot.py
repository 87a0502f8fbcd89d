"""Still pictures with matplotlib: the region, and the path with its three coordinate views."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from bezier.pictures.mesh import Array, best_view, hull
from bezier.pictures.obstacles import ObstaclePicture
from bezier.pictures.picture import (
    COLOURS,
    FLOOR,
    GRID,
    INK,
    PALE,
    SHADE,
    Chart,
    PathPicture,
    RegionPicture,
    boundary,
    written,
)
from qe.regions.space import direction

GAP, PLACES = 4.0, 16
"""Pixels between a point and its name; directions that are tried."""
REACHES = (7.0, 14.0, 26.0, 40.0)
"""Distances that are tried, in pixels."""
COVERING, OUTSIDE, CROSSING, FAR = 4.0, 20.0, 40.0, 0.6
"""What a place costs: for each square pixel of another name, or outside of the frame, for each point drawn, and for
each pixel of distance. Found by looking at the examples; only their order matters."""


def place(axis: Any, labels: Sequence[tuple[str, Sequence[float]]], drawn: Array, size: float = 8) -> None:
    """Write each text near its point (in the data of ``axis``); ``drawn``: (n, 2), points of the lines drawn."""
    if not labels:
        return
    axis.apply_aspect()
    renderer = axis.figure.canvas.get_renderer()
    frame = axis.get_window_extent(renderer).extents
    busy = axis.transData.transform(drawn) if len(drawn) else np.zeros((0, 2))
    points = axis.transData.transform(np.array([point for _, point in labels], dtype=float))
    taken = [np.concatenate([p - GAP, p + GAP]) for p in points]
    for (text, point), at in zip(labels, points, strict=True):
        note = axis.annotate(text, point, xytext=(0, 0), textcoords="offset points", fontsize=size)
        note.set(ha="center", va="center")
        box = note.get_window_extent(renderer)
        half = np.array([box.width, box.height]) / 2
        centres = np.array([at + _step(k, reach, half) for reach, k in product(REACHES, range(PLACES))])
        best = centres[np.argmin(_costs(centres, half, frame, np.array(taken), busy, at))]
        taken.append(np.concatenate([best - half, best + half]))
        note.set_position(tuple((best - at) * 72 / axis.figure.dpi))
        if np.linalg.norm(np.maximum(np.abs(best - at) - half, 0)) > 2 * REACHES[0]:
            thin = {"arrowstyle": "-", "linewidth": 0.5, "color": note.get_color()}
            towards = tuple((best - at) * 72 / axis.figure.dpi * 0.7)
            axis.annotate("", point, xytext=towards, textcoords="offset points", arrowprops=thin)


def _step(k: int, reach: float, half: Array) -> Array:
    angle = np.pi / 2 - 2 * np.pi * k / PLACES
    way = np.array([np.cos(angle), np.sin(angle)])
    return np.asarray(way * (reach + np.abs(way) * half))


def _costs(centres: Array, half: Array, frame: Array, taken: Array, busy: Array, at: Array) -> Array:
    """What each of the places costs."""
    low, high = centres - half, centres + half
    over = sum(_shared(low, high, other) for other in taken)
    covered = (busy >= low[:, None]) & (busy <= high[:, None])
    outside = np.prod(2 * half) - _shared(low, high, frame)
    away = np.linalg.norm(centres - at, axis=1)
    crossed = covered.all(axis=2).sum(axis=1)
    return np.asarray(COVERING * over + OUTSIDE * outside + CROSSING * crossed + FAR * away)


def _shared(low: Array, high: Array, other: Array) -> Array:
    """The areas that rectangles have in common with one (low, high)."""
    sides = np.minimum(high, other[2:]) - np.maximum(low, other[:2])
    return np.asarray(np.maximum(sides, 0.0).prod(axis=1))


VIEWS = (("top view", 0, 1), ("front view", 0, 2), ("side view", 1, 2))
AXES = ("x", "y", "z")
NEAR = 0.02
"""The share of the radius within which points get one label."""


WORDS = {
    "top view": "the path and its control polygons in the workspace from above",
    "front view": "the same seen from the front",
    "side view": "the same seen from the side",
}


def save_region(picture: PathPicture, path: Path, title: str) -> None:
    """``region.png``: the possible places of Q1 from two sides in space, and the three coordinate views."""
    figure = new_figure(11, 8)
    figure.suptitle(title, fontsize=14, color=INK, y=0.985)
    region = picture.region
    if region is None:
        said = "the region has no interior, so there is nothing to draw:\nsee the report for its exact description"
        figure.text(0.5, 0.5, said, ha="center", fontsize=12, color=INK)
    else:
        elevation, turn = best_view(region.mesh)
        for column, view in enumerate(((elevation, turn), (10.0, turn + 180))):
            axis = figure.add_axes((0.09 + 0.46 * column, 0.37, 0.42, 0.54), projection="3d")
            _draw_region(axis, region, view)
            _frame(axis, region.mesh.vertices, pad=0.06, view=view)
            if region.chosen is not None:
                axis.plot(*region.chosen[:, None], "o", color=INK, markersize=7, zorder=10)
            if column == 0:
                _legend(figure, region)
            else:
                axis.text2D(0.5, 0.97, "from the other side", transform=axis.transAxes, ha="center", fontsize=9)
        for column, (title, a, b) in enumerate(VIEWS):
            _region_view(figure.add_axes((0.065 + 0.325 * column, 0.07, 0.25, 0.23)), region, title, a, b)
    _save(figure, path, picture.hatted_names)


def save_path(picture: PathPicture, path: Path) -> None:
    """``path.png``: the curves with control polygons in the workspace, and the coordinate views."""
    figure = new_figure(11, 9.2)
    axis = figure.add_axes((0.05, 0.33, 0.9, 0.66), projection="3d")
    _draw_workspace(axis, picture)
    for curve in picture.curves:
        axis.plot(*curve.polygon.T, "--o", color=curve.colour, linewidth=1, markersize=4, alpha=0.75)
        axis.plot(*curve.points.T, color=curve.colour, linewidth=3, label=f"{written(curve.name)}(t)")
    for obstacle in picture.obstacles:
        _draw_obstacle(axis, obstacle)
    reach = picture.radius
    low = 0.0 if picture.has_floor else -reach
    ends = np.array([[-reach, -reach, low], [reach, reach, reach]])
    _frame(axis, ends, pad=0.0, zoom=1.2 if picture.has_floor else 1.0)
    _name_in_space(axis, picture)
    if picture.curves:
        handles, texts = axis.get_legend_handles_labels()
        figure.legend(handles, texts, loc="upper left", bbox_to_anchor=(0.02, 0.98), frameon=False)
    for column, (title, i, j) in enumerate(VIEWS):
        path_view(figure.add_axes((0.065 + 0.325 * column, 0.055, 0.25, 0.26)), picture, title, i, j)
    _save(figure, path, picture.hatted_names)


def views(picture: PathPicture) -> tuple[Chart, ...]:
    """The three coordinate views for the page."""
    result = []
    for title, i, j in VIEWS:
        figure = new_figure(4.4, 3.7)
        path_view(figure.add_axes((0.16, 0.14, 0.81, 0.77)), picture, title, i, j)
        letter(figure, picture.hatted_names)
        result.append((svg_text(figure), f"{title} ({AXES[i]}{AXES[j]}): {WORDS[title]}"))
    return tuple(result)


VARIABLES = {INK: "ink", PALE: "pale", GRID: "grid", SHADE: "shade", FLOOR: "floor", "#ffffff": "paper"}
"""The colours that the page changes in the dark, by their names there."""


def svg_text(figure: Any) -> str:
    """A figure as one SVG element, its colours given by those of the page."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    buffer = io.StringIO()
    FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    named = {**VARIABLES, **{colour: letter.lower() for letter, colour in COLOURS.items()}}
    text = re.sub("|".join(named), lambda match: f"var(--{named[match[0]]})", text[text.index("<svg") :])
    return re.sub(r"<metadata>.*?</metadata>\s*", "", text, flags=re.DOTALL)


def new_figure(width: float, height: float) -> Any:
    """An empty figure in inches; without pyplot, whose windows and state are not needed."""
    import matplotlib
    import mpl_toolkits.mplot3d  # noqa: F401  (registers the 3-D projection)
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    matplotlib.rcParams.update({"font.size": 10, "axes.edgecolor": PALE, "axes.labelcolor": INK, "text.color": INK})
    matplotlib.rcParams.update({"xtick.color": PALE, "ytick.color": PALE, "svg.hashsalt": "bezier"})
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def _save(figure: Any, path: Path, hatted_names: bool) -> None:
    letter(figure, hatted_names)
    figure.savefig(path, dpi=120, pil_kwargs={"compress_level": 4})


def letter(drawn: Any, hatted_names: bool) -> None:
    """Take the hats off the names of points in a figure or on axes if they are not wanted."""
    from matplotlib.text import Text

    for item in [] if hatted_names else drawn.findobj(Text):
        item.set_text(item.get_text().replace("\u0302", ""))


def _draw_region(axis: Any, region: RegionPicture, view: tuple[float, float]) -> None:
    """Shaded triangles and creases; only those triangles that face the viewer (the set is convex)."""
    from matplotlib.colors import to_rgb
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    mesh = region.mesh
    seen = mesh.normals @ direction(view) > -0.15
    light = np.array([-0.35, -0.65, 0.68])
    shade = 0.80 + 0.20 * (mesh.normals[seen] @ light)
    base = np.array([to_rgb(region.colour(k)) for k in range(len(region.labels))])[mesh.owner[seen]]
    colours = 1 - (1 - base) * 0.62
    rgb = np.clip(colours * shade[:, None], 0, 1)
    triangles = mesh.vertices[mesh.faces][seen]
    axis.add_collection3d(Poly3DCollection(triangles, facecolors=rgb, edgecolors=rgb, linewidths=0.2))
    for edge in mesh.edges:
        axis.plot(*edge.T, color=INK, linewidth=1.2)


def _draw_obstacle(axis: Any, obstacle: ObstaclePicture) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    if obstacle.faces is None:
        axis.scatter(*obstacle.vertices.T, color=obstacle.colour, s=4, alpha=0.5)
        return
    triangles = obstacle.vertices[obstacle.faces]
    axis.add_collection3d(Poly3DCollection(triangles, facecolors=obstacle.colour, alpha=0.3, linewidths=0))


def _draw_workspace(axis: Any, picture: PathPicture) -> None:
    angle = np.linspace(0, 2 * np.pi, 121)
    heights = np.radians([0, 30, 60] if picture.has_floor else [-60, -30, 0, 30, 60])
    rings = [np.stack([np.cos(h) * np.cos(angle), np.cos(h) * np.sin(angle), 0 * angle + np.sin(h)]) for h in heights]
    arc = np.linspace(0 if picture.has_floor else -np.pi / 2, np.pi / 2, 46)
    for turn in np.radians(np.arange(0, 360, 30)):
        rings.append(np.stack([np.cos(arc) * np.cos(turn), np.cos(arc) * np.sin(turn), np.sin(arc)]))
    for ring in rings:
        axis.plot(*(ring * picture.radius), color=PALE, linewidth=0.5, alpha=0.6)
    axis.plot([0], [0], [0], marker="+", color=INK)


def _frame(axis: Any, points: Array, pad: float, view: tuple[float, float] = (20.0, -62.0), zoom: float = 0.94) -> None:
    from matplotlib.ticker import MaxNLocator

    low, high = points.min(axis=0), points.max(axis=0)
    extra = (high - low) * pad
    widest = float((high - low).max()) or 1.0
    for name, a, b in zip(AXES, low - extra, high + extra, strict=True):
        getattr(axis, f"set_{name}lim")(a, b)
        getattr(axis, f"set_{name}label")(name, labelpad=12)
        getattr(axis, f"{name}axis").set_major_locator(MaxNLocator(max(1, round(5 * (b - a) / widest))))
    axis.set_box_aspect((high - low) + 1e-12, zoom=zoom)
    axis.view_init(elev=view[0], azim=view[1])
    for pane in (axis.xaxis, axis.yaxis, axis.zaxis):
        pane.pane.set_facecolor("#f6f8fa")
        pane.pane.set_edgecolor("#dfe5ea")
        pane._axinfo["grid"]["color"] = GRID


def _legend(figure: Any, region: RegionPicture) -> None:
    from matplotlib.patches import Patch

    shown = sorted(set(region.mesh.owner.tolist()))
    handles = [Patch(color=region.colour(k), alpha=0.75, label=boundary(region.labels[k])) for k in shown]
    figure.legend(handles=handles, loc="upper left", frameon=False, fontsize=9, bbox_to_anchor=(0.01, 0.96))


def _name_in_space(axis: Any, picture: PathPicture) -> None:
    """The names of the points beside them, as seen from the viewer."""
    from mpl_toolkits.mplot3d.proj3d import proj_transform

    axis.apply_aspect()
    axis.M = axis.get_proj()

    def seen(points: Array) -> Array:
        return np.stack(proj_transform(*points.T, axis.M)[:2], axis=1)

    drawn = [seen(part) for curve in picture.curves for part in (curve.points, _along(curve.polygon))]
    texts = [(written(name), tuple(seen(point[None, :])[0])) for name, point in picture.marks.items()]
    place(axis, texts, np.concatenate(drawn) if drawn else np.zeros((0, 2)), size=10)


def _along(polygon: Array) -> Array:
    """Points on the sides of a polygon."""
    share = np.linspace(0.0, 1.0, 9)[:, None, None]
    result: Array = (polygon[:-1] * (1 - share) + polygon[1:] * share).reshape(-1, polygon.shape[1])
    return result


def _region_view(axis: Any, region: RegionPicture, title: str, i: int, j: int) -> None:
    outline = hull(region.mesh.vertices[:, [i, j]])
    axis.fill(*outline.T, color=SHADE, zorder=0)
    axis.plot(*outline.T, color=INK, linewidth=1)
    for edge in region.mesh.edges:
        axis.plot(edge[:, i], edge[:, j], color=PALE, linewidth=0.8)
    if region.chosen is not None:
        axis.plot(region.chosen[i], region.chosen[j], "o", color=INK, markersize=5)
    _flat(axis, title, i, j)


def path_view(axis: Any, picture: PathPicture, title: str, i: int, j: int) -> None:
    """The path, or the given points alone, along one axis, in the outline of the workspace."""
    angle = np.linspace(0, np.pi if picture.has_floor and j == 2 else 2 * np.pi, 181 if picture.has_rim else 0)
    rim = picture.centre[[i, j]] + picture.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    axis.plot(*rim.T, color=PALE, linewidth=1)
    if picture.has_floor and j == 2:
        axis.plot([-picture.radius, picture.radius], [0, 0], color=FLOOR, linewidth=1.5)
    for obstacle in picture.obstacles:
        silhouette = obstacle.outline(i, j)
        if silhouette is None:
            axis.plot(obstacle.vertices[:, i], obstacle.vertices[:, j], ".", color=obstacle.colour, markersize=2)
        else:
            axis.fill(*silhouette.T, color=obstacle.colour, alpha=0.35)
    for curve in picture.curves:
        style = {"color": curve.colour}
        axis.plot(curve.polygon[:, i], curve.polygon[:, j], "--o", linewidth=0.8, markersize=3, alpha=0.8, **style)
        axis.plot(curve.points[:, i], curve.points[:, j], linewidth=2.2, **style)
    _flat(axis, title, i, j)
    if picture.marks and not picture.curves:
        axis.plot(*np.array(list(picture.marks.values()))[:, [i, j]].T, "o", color=INK, markersize=3)
    drawn = [part[:, [i, j]] for curve in picture.curves for part in (curve.points, _along(curve.polygon))]
    place(axis, _grouped(picture, i, j), np.concatenate([rim, *drawn]))


def _grouped(picture: PathPicture, i: int, j: int) -> list[tuple[str, tuple[float, float]]]:
    """One label per place: names of points that coincide in this view are put together."""
    groups: list[tuple[list[str], tuple[float, float]]] = []
    for name, point in picture.marks.items():
        here = (float(point[i]), float(point[j]))
        near = [g for g in groups if np.hypot(g[1][0] - here[0], g[1][1] - here[1]) < NEAR * picture.radius]
        if near:
            near[0][0].append(name)
        else:
            groups.append(([name], here))
    return [(" ".join(map(written, names)), place) for names, place in groups]


def _flat(axis: Any, title: str, i: int, j: int) -> None:
    axis.set_aspect("equal", adjustable="datalim")
    framed(axis, f"{AXES[i]} (mm)", f"{AXES[j]} (mm)", f"{title} ({AXES[i]}{AXES[j]})")
    axis.set_axisbelow(True)


def framed(axis: Any, across: str, up: str = "", title: str = "", size: float = 10) -> None:
    """With these words, and lines behind what is drawn."""
    axis.set_title(title, fontsize=size, color=INK)
    axis.set_xlabel(across)
    axis.set_ylabel(up)
    axis.grid(color=GRID, linewidth=0.6)
