"""A region as a page: in space a picture that can be turned, drawn on a canvas without any library; else a drawing."""

from __future__ import annotations

import json
from base64 import b64encode
from html import escape
from importlib.resources import files
from itertools import pairwise

import numpy as np

from qe.regions.sketch import Sketch

STEPS = 65535
"""Into how many steps the width of a picture is divided: more than a screen shows."""


def page(sketch: Sketch, drawing: str = "") -> str:
    """One HTML file that needs no network; ``drawing``: the SVG of a region on a line or in the plane."""
    template = (files("qe.regions") / "turnable.html").read_text(encoding="utf-8")
    head, _, rest = template.partition("<!--picture-->")
    if len(sketch.order) != 3:
        return f"{head}{drawing[drawing.index('<svg') :]}</html>\n"
    words = f"The region in {escape(', '.join(sketch.order))}" + (" is empty" if sketch.is_empty else "")
    text = json.dumps(_scene(sketch)).replace("<", "\\u003c")
    body = f'<canvas role="img" aria-label="{words}" tabindex="0"></canvas><p>{words}. Drag or arrow keys turn it.</p>'
    return f'{head}{body}<script type="application/json" id="data">{text}</script>{rest}'


def _scene(sketch: Sketch) -> dict[str, object]:
    """Points as numbers of steps, faces and lines by the numbers of their points."""
    surfaces, lines = sketch.solid.surfaces, sketch.solid.lines
    listed = [*(s.vertices for s in surfaces), *lines] or [np.zeros((1, 3))]
    starts = np.cumsum([0, *map(len, listed)])
    faces = [s.faces[~s.inner] + start for s, start in zip(surfaces, starts, strict=False)] or [np.zeros((0, 3))]
    points = np.concatenate(listed)
    low, high = points.min(axis=0), points.max(axis=0)
    size = np.where(high > low, high - low, 1.0)
    steps = np.round((points - (low + high - size) / 2) / size * STEPS).clip(0, STEPS)
    ends = starts[len(surfaces) :]
    return {
        "names": sketch.order,
        "low": [f"{x:.3g}" for x in low],
        "high": [f"{x:.3g}" for x in high],
        "size": (size / size.max()).tolist(),
        "points": b64encode(steps.astype("<u2").tobytes()).decode(),
        "faces": b64encode(np.concatenate(faces).astype("<u4").tobytes()).decode(),
        "lines": [[int(a), int(b)] for a, b in pairwise(ends)],
    }
