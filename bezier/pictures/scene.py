"""Turnable pictures for the report: figure descriptions for plotly.js, as plain dictionaries.

The library's script is shipped inside the plotly package and is put into the page once, so the page needs no
network. The Python side of plotly is not imported: a figure is only data.
"""

from __future__ import annotations

from importlib.resources import files
from typing import Any

import numpy as np

from bezier.pictures.mesh import Array, best_view, direction
from bezier.pictures.obstacles import ObstaclePicture
from bezier.pictures.picture import INK, PALE, PathPicture, RegionPicture

Trace = dict[str, Any]


def plotly_script() -> str:
    """The text of plotly.js."""
    return (files("plotly") / "package_data" / "plotly.min.js").read_text(encoding="utf-8")


def region_figure(picture: PathPicture) -> dict[str, Any] | None:
    """The region with its creases and the chosen point; None when there is nothing to draw."""
    if picture.region is None:
        return None
    traces = _region_traces(picture.region, opacity=1.0, legend=True)
    if picture.region.chosen is not None:
        traces.append(_marks({"Q1": picture.region.chosen}, size=6))
    mesh = picture.region.mesh
    return _figure(traces, mesh.vertices, best_view(mesh))


def compared_figure(picture: RegionPicture, other: RegionPicture) -> dict[str, Any]:
    """A region seen as one sees another one, for a picture beside it."""
    view = best_view(other.mesh)
    return _figure(_region_traces(picture, opacity=1.0, legend=True), other.mesh.vertices, view)


def path_figure(picture: PathPicture) -> dict[str, Any]:
    """The curves and control polygons in the workspace, with the region."""
    traces = _workspace_traces(picture)
    for curve in picture.curves:
        polygon = _line(curve.polygon, curve.colour, 3, dash="dash")
        polygon |= {"mode": "lines+markers", "marker": {"size": 4, "color": curve.colour}, "showlegend": False}
        traces.append(polygon)
        traces.append(_line(curve.points, curve.colour, 9) | {"name": f"{hatted(curve.name)}(t)", "showlegend": True})
    if picture.region is not None:
        traces += _region_traces(picture.region, opacity=0.35, legend=False)
    traces += [_obstacle_trace(obstacle) for obstacle in picture.obstacles]
    traces.append(_marks(picture.marks, size=3))
    reach = picture.radius
    return _figure(traces, np.array([[-reach, -reach, 0.0 if picture.has_floor else -reach], [reach] * 3]))


def hatted(name: str) -> str:
    """A name with a combining hat on its letter and its index lowered, for labels inside the canvas."""
    lowered = name[1:].translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
    return f"{name[0]}\u0302{lowered}" if name[:1] in "PQR" else name


def _region_traces(region: RegionPicture, opacity: float, legend: bool) -> list[Trace]:
    mesh = region.mesh
    traces: list[Trace] = []
    for index in sorted(set(mesh.owner.tolist())):
        used, flat = np.unique(mesh.faces[mesh.owner == index], return_inverse=True)
        i, j, k = flat.reshape(-1, 3).T.tolist()
        x, y, z = mesh.vertices[used].T
        trace: Trace = {"type": "mesh3d", "x": _short(x), "y": _short(y), "z": _short(z), "i": i, "j": j, "k": k}
        trace["color"] = region.colour(index)
        trace |= {"opacity": opacity, "name": _boundary(region.labels[index]), "showlegend": legend}
        trace["hoverinfo"] = "name"
        trace["lighting"] = {"ambient": 0.68, "diffuse": 0.5, "specular": 0.08, "roughness": 0.9}
        trace["flatshading"] = False
        traces.append(trace)
    for edge in mesh.edges:
        traces.append(_line(edge[::4] if len(edge) > 40 else edge, INK, 3))
    return traces


def _obstacle_trace(obstacle: ObstaclePicture) -> Trace:
    x, y, z = obstacle.vertices.T
    trace: Trace = {"x": _short(x), "y": _short(y), "z": _short(z), "name": obstacle.name, "showlegend": True}
    trace["hoverinfo"] = "name"
    if obstacle.faces is None:
        return trace | {"type": "scatter3d", "mode": "markers", "marker": {"size": 2, "color": obstacle.colour}}
    i, j, k = obstacle.faces.T.tolist()
    return trace | {"type": "mesh3d", "i": i, "j": j, "k": k, "color": obstacle.colour, "opacity": 0.45}


def _boundary(label: str) -> str:
    if label.endswith(".z"):
        return f"{hatted(label[:-2])} on the table"
    return f"‖{hatted(label)}‖ = r" if len(label) == 2 else label


def _workspace_traces(picture: PathPicture) -> list[Trace]:
    angle = np.linspace(0, 2 * np.pi, 73)
    low = 0.0 if picture.has_floor else -np.pi / 2
    rings: list[Array] = []
    for height in np.linspace(low, np.pi / 2, 4 if picture.has_floor else 7)[:-1]:
        ring = np.stack([np.cos(height) * np.cos(angle), np.cos(height) * np.sin(angle), 0 * angle + np.sin(height)])
        rings.append(ring.T)
    arc = np.linspace(low, np.pi / 2, 37)
    for turn in np.radians(np.arange(0, 360, 30)):
        rings.append(np.stack([np.cos(arc) * np.cos(turn), np.cos(arc) * np.sin(turn), np.sin(arc)]).T)
    gap = np.full((1, 3), np.nan)
    joined = np.concatenate([part for ring in rings for part in (ring * picture.radius, gap)])
    grid = _line(joined, PALE, 1) | {"opacity": 0.6, "name": "workspace", "showlegend": True}
    return [grid, _marks({"O": np.zeros(3)}, size=3)]


def _line(points: Array, colour: str, width: int, dash: str = "solid") -> Trace:
    x, y, z = points.T
    line = {"color": colour, "width": width, "dash": dash}
    return {
        "type": "scatter3d",
        "mode": "lines",
        "x": _short(x),
        "y": _short(y),
        "z": _short(z),
        "line": line,
        "hoverinfo": "skip",
        "showlegend": False,
    }


def _marks(marks: Any, size: int) -> Trace:
    points = np.array(list(marks.values()))
    x, y, z = points.T
    return {
        "type": "scatter3d",
        "mode": "markers+text",
        "x": _short(x),
        "y": _short(y),
        "z": _short(z),
        "text": [hatted(name) for name in marks],
        "textposition": "top center",
        "textfont": {"color": INK, "size": 14},
        "marker": {"size": size, "color": INK},
        "hovertemplate": "%{text}: (%{x:.4f}, %{y:.4f}, %{z:.4f})<extra></extra>",
        "showlegend": False,
    }


def _short(values: Array) -> list[float | None]:
    return [None if v != v else round(float(v), 6) for v in values]


def _figure(traces: list[Trace], frame: Array, view: tuple[float, float] = (22.0, -62.0)) -> dict[str, Any]:
    """``frame``: points that fill the axes; ``view``: elevation and azimuth of the first look, in degrees."""
    eye = 1.75 * direction(view)
    low, high = frame.min(axis=0), frame.max(axis=0)
    pad = 0.04 * (high - low).max()
    shape = high - low + 2 * pad
    axis = {"backgroundcolor": "#f6f8fa", "gridcolor": "#dde3e8", "showbackground": True, "zerolinecolor": "#c5ced6"}
    ranges = zip("xyz", _short(low - pad), _short(high + pad), strict=True)
    scene: dict[str, Any] = {f"{n}axis": axis | {"title": {"text": n}, "range": [a, b]} for n, a, b in ranges}
    scene["aspectmode"] = "manual"
    scene["aspectratio"] = dict(zip("xyz", _short(shape / shape.max()), strict=True))
    scene |= {"camera": {"eye": dict(zip("xyz", _short(eye), strict=True))}}
    layout = {
        "scene": scene,
        "margin": {"l": 0, "r": 0, "t": 0, "b": 0},
        "legend": {"x": 0.01, "y": 0.99, "bgcolor": "rgba(255,255,255,0.7)"},
        "font": {"family": "system-ui, sans-serif", "color": INK},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "uirevision": "keep",
    }
    return {"data": traces, "layout": layout, "config": {"responsive": True, "displaylogo": False}}
