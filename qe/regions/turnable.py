"""A region in space as a page with a picture that can be turned. For looking only."""

from __future__ import annotations

from typing import Any

from qe.errors import InputError
from qe.regions.sketch import Sketch

FILL, EDGE = "#5c87b8", "#1f3b5c"


def page(sketch: Sketch) -> str:
    """One HTML file that needs no network. Raises ``InputError`` for regions that are not in space."""
    if len(sketch.order) != 3:
        raise InputError(f"a turnable picture needs 3 variables, the region has {len(sketch.order)}")
    from plotly.graph_objects import Figure

    figure = Figure(data=_traces(sketch))
    axes = {f"{axis}axis": {"title": {"text": name}} for axis, name in zip("xyz", sketch.order, strict=True)}
    figure.update_layout(
        scene={**axes, "aspectmode": "data", "camera": {"projection": {"type": "orthographic"}}},
        title="empty region" if sketch.is_empty else None,
        margin={"l": 0, "r": 0, "t": 30, "b": 0},
    )
    return str(figure.to_html(include_plotlyjs=True, full_html=True))


def _traces(sketch: Sketch) -> list[Any]:
    from plotly.graph_objects import Mesh3d, Scatter3d

    traces: list[Any] = []
    for surface in sketch.solid.surfaces:
        (x, y, z), (i, j, k) = surface.vertices.T, surface.faces.T
        light = {"ambient": 0.6, "diffuse": 0.6, "specular": 0.1}
        traces.append(Mesh3d(x=x, y=y, z=z, i=i, j=j, k=k, color=FILL, flatshading=False, lighting=light))
    for line in sketch.solid.lines:
        x, y, z = line.T
        mode = "lines" if len(line) > 1 else "markers"
        traces.append(Scatter3d(x=x, y=y, z=z, mode=mode, line={"color": EDGE}, marker={"color": EDGE, "size": 4}))
    for trace in traces:
        trace.update(hoverinfo="x+y+z", showlegend=False)
    return traces
