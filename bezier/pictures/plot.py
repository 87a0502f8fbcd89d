"""Still pictures with matplotlib: the region, and the path with its three coordinate views."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

import numpy as np

from bezier.pictures.mesh import Array, best_view, direction, hull
from bezier.pictures.obstacles import ObstaclePicture
from bezier.pictures.picture import FLOOR, INK, PALE, PathPicture, RegionPicture

CONTROL = {f"{curve}{i}" for curve in "PQR" for i in range(4)}
VIEWS = (("top view", 0, 1), ("front view", 0, 2), ("side view", 1, 2))
AXES = ("x", "y", "z")


def save_region(picture: PathPicture, path: Path, title: str) -> None:
    """``region.png``: the possible places of Q1 from two sides in space, and the three coordinate views."""
    figure = new_figure(11, 8)
    figure.suptitle(title, fontsize=14, color=INK, y=0.995)
    region = picture.region
    if region is None:
        axis = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        _say(axis, "the region has no interior, so there is nothing to draw:\nsee the report for its exact description")
    else:
        elevation, turn = best_view(region.mesh)
        for column, view in enumerate(((elevation, turn), (10.0, turn + 180))):
            axis = figure.add_axes((0.02 + 0.48 * column, 0.37, 0.46, 0.58), projection="3d")
            _draw_region(axis, region, alpha=1.0, view=view)
            _frame(axis, region.mesh.vertices, pad=0.06, view=view)
            if region.chosen is not None:
                axis.plot(*region.chosen[:, None], "o", color=INK, markersize=7, zorder=10)
            if column == 0:
                _legend(axis, region)
            else:
                axis.text2D(0.5, 0.93, "from the other side", transform=axis.transAxes, ha="center", fontsize=9)
        for column, (title, a, b) in enumerate(VIEWS):
            _region_view(figure.add_axes((0.055 + 0.325 * column, 0.06, 0.27, 0.23)), region, title, a, b)
    _save(figure, path, picture.hatted_names)


def save_path(picture: PathPicture, path: Path) -> None:
    """``path.png``: the three curves with control polygons in the workspace, and the coordinate views."""
    figure = new_figure(10, 9)
    axis = figure.add_axes((0.1, 0.385, 0.8, 0.62), projection="3d")
    _draw_workspace(axis, picture)
    for curve in picture.curves:
        axis.plot(*curve.polygon.T, "--o", color=curve.colour, linewidth=1, markersize=4, alpha=0.75)
        axis.plot(*curve.points.T, color=curve.colour, linewidth=3, label=f"$\\hat{{{curve.name}}}(t)$")
    if picture.region is not None:
        _draw_region(axis, picture.region, alpha=0.25)
    for obstacle in picture.obstacles:
        _draw_obstacle(axis, obstacle)
    for name, point in picture.marks.items():
        axis.text(*(point * 1.04), mathematical(name), fontsize=10, color=INK)
    if picture.curves:
        axis.legend(loc="upper left", frameon=False)
    reach = picture.radius
    low = 0.0 if picture.has_floor else -reach
    _frame(axis, np.array([[-reach, -reach, low], [reach, reach, reach]]), pad=0.0)
    for column, (title, i, j) in enumerate(VIEWS):
        _path_view(figure.add_axes((0.055 + 0.325 * column, 0.05, 0.27, 0.26)), picture, title, i, j)
    _save(figure, path, picture.hatted_names)


def views_svg(picture: PathPicture) -> str:
    """The three coordinate views as one SVG element for the report."""
    figure = new_figure(12, 4.2)
    for column, (title, i, j) in enumerate(VIEWS):
        _path_view(figure.add_axes((0.045 + 0.33 * column, 0.12, 0.275, 0.78)), picture, title, i, j)
    _letter(figure, picture.hatted_names)
    return svg_text(figure)


def svg_text(figure: Any) -> str:
    """A figure as one SVG element."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    buffer = io.StringIO()
    FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]


def mathematical(name: str) -> str:
    """A point's name in mathematical letters: ``Q1`` becomes Q with a hat and an index."""
    return f"$\\hat{{{name[0]}}}_{{{name[1:]}}}$" if name[:1] in "PQR" and name[1:].isdigit() else name


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
    _letter(figure, hatted_names)
    figure.savefig(path, dpi=120, pil_kwargs={"compress_level": 4})


def _letter(figure: Any, hatted_names: bool) -> None:
    """Take the hats off the names of points if they are not wanted."""
    from matplotlib.text import Text

    for item in [] if hatted_names else figure.findobj(Text):
        item.set_text(re.sub(r"\\hat\{(.)\}", r"\1", item.get_text()))


def _draw_region(axis: Any, region: RegionPicture, alpha: float, view: tuple[float, float] | None = None) -> None:
    """Shaded triangles and creases; with ``view`` only those triangles that face the viewer (the set is convex)."""
    from matplotlib.colors import to_rgb
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    mesh = region.mesh
    triangles = mesh.vertices[mesh.faces]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-30
    seen = np.ones(len(normals), dtype=bool) if view is None else normals @ direction(view) > -0.15
    triangles, normals = triangles[seen], normals[seen]
    light = np.array([-0.35, -0.65, 0.68])
    shade = 0.80 + 0.20 * (normals @ light)
    base = np.array([to_rgb(region.colour(k)) for k in range(len(region.labels))])[mesh.owner[seen]]
    colours = 1 - (1 - base) * 0.62
    faces = np.clip(colours * shade[:, None], 0, 1)
    rgba = np.concatenate([faces, np.full((len(faces), 1), alpha)], axis=1)
    lines = 0.2 if alpha == 1 else 0.0
    axis.add_collection3d(Poly3DCollection(triangles, facecolors=rgba, edgecolors=rgba, linewidths=lines))
    for edge in mesh.edges:
        axis.plot(*edge.T, color=INK, linewidth=1.2, alpha=min(1.0, alpha + 0.3))


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


def _frame(axis: Any, points: Array, pad: float, view: tuple[float, float] = (20.0, -62.0)) -> None:
    from matplotlib.ticker import MaxNLocator

    low, high = points.min(axis=0), points.max(axis=0)
    extra = (high - low) * pad
    widest = float((high - low).max()) or 1.0
    for name, a, b in zip(AXES, low - extra, high + extra, strict=True):
        getattr(axis, f"set_{name}lim")(a, b)
        getattr(axis, f"set_{name}label")(name)
        getattr(axis, f"{name}axis").set_major_locator(MaxNLocator(max(1, round(5 * (b - a) / widest))))
    axis.set_box_aspect((high - low) + 1e-12, zoom=1.06)
    axis.view_init(elev=view[0], azim=view[1])
    for pane in (axis.xaxis, axis.yaxis, axis.zaxis):
        pane.pane.set_facecolor("#f6f8fa")
        pane.pane.set_edgecolor("#dfe5ea")
        pane._axinfo["grid"]["color"] = "#e3e8ec"


def _legend(axis: Any, region: RegionPicture) -> None:
    from matplotlib.patches import Patch

    shown = sorted(set(region.mesh.owner.tolist()))
    handles = [Patch(color=region.colour(k), alpha=0.75, label=boundary_name(region.labels[k])) for k in shown]
    axis.legend(handles=handles, loc="upper left", frameon=False, fontsize=9, bbox_to_anchor=(-0.08, 1.05))


def boundary_name(label: str) -> str:
    """A boundary surface in mathematical letters."""
    if label.endswith(".z"):
        return f"{mathematical(label[:2])} on the table"
    return rf"$\|${mathematical(label)}$\| = r$" if label in CONTROL else label


def _region_view(axis: Any, region: RegionPicture, title: str, i: int, j: int) -> None:
    outline = hull(region.mesh.vertices[:, [i, j]])
    axis.fill(*outline.T, color="#e9edf1", zorder=0)
    axis.plot(*outline.T, color=INK, linewidth=1)
    for edge in region.mesh.edges:
        axis.plot(edge[:, i], edge[:, j], color=PALE, linewidth=0.8)
    if region.chosen is not None:
        axis.plot(region.chosen[i], region.chosen[j], "o", color=INK, markersize=5)
    _flat(axis, title, i, j)


def _path_view(axis: Any, picture: PathPicture, title: str, i: int, j: int) -> None:
    angle = np.linspace(0, np.pi if picture.has_floor and j == 2 else 2 * np.pi, 181)
    axis.plot(picture.radius * np.cos(angle), picture.radius * np.sin(angle), color=PALE, linewidth=1)
    if picture.has_floor and j == 2:
        axis.plot([-picture.radius, picture.radius], [0, 0], color=FLOOR, linewidth=1.5)
    if picture.region is not None:
        outline = hull(picture.region.mesh.vertices[:, [i, j]])
        axis.fill(*outline.T, color="#e9edf1", zorder=0)
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
    for text, point in _grouped(picture, i, j):
        label = axis.annotate(text, point, xytext=(3, 6), textcoords="offset points")
        label.set_fontsize(8)
    _flat(axis, title, i, j)


def _grouped(picture: PathPicture, i: int, j: int) -> list[tuple[str, tuple[float, float]]]:
    """One label per place: names of points that coincide in this view are put together."""
    groups: list[tuple[list[str], tuple[float, float]]] = []
    for name, point in picture.marks.items():
        here = (float(point[i]), float(point[j]))
        near = [g for g in groups if np.hypot(g[1][0] - here[0], g[1][1] - here[1]) < 0.07 * picture.radius]
        if near:
            near[0][0].append(name)
        else:
            groups.append(([name], here))
    return [(" ".join(map(mathematical, names)), place) for names, place in groups]


def _flat(axis: Any, title: str, i: int, j: int) -> None:
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_title(f"{title} ({AXES[i]}{AXES[j]})", fontsize=10, color=INK)
    axis.set_xlabel(AXES[i])
    axis.set_ylabel(AXES[j])
    axis.grid(color="#e3e8ec", linewidth=0.6)
    axis.set_axisbelow(True)


def _say(axis: Any, text: str) -> None:
    axis.set_axis_off()
    axis.text(0.5, 0.5, text, transform=axis.transAxes, ha="center", fontsize=12, color=INK)
