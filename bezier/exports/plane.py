"""The path in a coordinate plane, for what is flat: G-code for plotters, SVG."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from itertools import pairwise
from math import ceil, sqrt

import numpy as np

from bezier.curves.workspace import WorkspaceKind
from bezier.motion.track import Array, Track, casteljau
from bezier.pictures.obstacles import ObstaclePicture
from bezier.problem import Problem
from qe.arguments import wrong
from qe.errors import InputError

PLANES = ("xy", "xz", "yz")
MOST_LINES = 200_000


def axes(plane: object) -> tuple[int, int]:
    """The two axes of a plane by their names. Raises ``InputError``."""
    if not isinstance(plane, str) or plane not in PLANES:
        raise wrong("plane", f"one of {', '.join(PLANES)}", plane)
    i, j = ("xyz".index(axis) for axis in plane)
    return i, j


def polyline(control: Array, tolerance: float) -> Array:
    """Points of a planar Bézier curve whose chords are within ``tolerance`` of it.

    A chord over a parameter length h is off by at most h^2/8 max |P''|, and |P''| <= d (d-1) max |second differences|.
    """
    degree = len(control) - 1
    bend = 0.0 if degree < 2 else float(np.linalg.norm(np.diff(control, n=2, axis=0), axis=1).max())
    wanted = sqrt(degree * (degree - 1) * bend / 8 / tolerance)
    if not wanted < MOST_LINES:
        raise InputError(f"tolerance: one with at most {MOST_LINES} lines for a curve expected, {tolerance:g} found")
    return casteljau(control, np.linspace(0.0, 1.0, max(1, ceil(wanted)) + 1))


# --- G-code -------------------------------------------------------------------------------------------------
def gcode(
    track: Track,
    *,
    plane: str = "xy",
    tolerance: float = 0.05,
    feed: float = 1000.0,
) -> str:
    """Lines for a pen plotter (RS-274: mm, absolute): the path in a plane, in chords within ``tolerance`` (mm) of it;
    ``feed`` in mm/min."""
    i, j = axes(plane)
    parts = [polyline(control[:, [i, j]], tolerance) for control in track.control]
    points = np.concatenate([parts[0][:1], *(part[1:] for part in parts)])
    down, up = "G1 Z0 F1000", "G0 Z5"  # the pen
    places = [f"X{x:.4f} Y{y:.4f}" for x, y in points + 0.0]
    kept = [places[0], *(b for a, b in pairwise(places) if a != b)]
    head = [f"; planned path, plane {plane}, chords within {tolerance:g} mm", "G21", "G90", up]
    first = f"G1 {kept[1]} F{feed:g}" if len(kept) > 1 else ""
    body = [f"G0 {kept[0]}", down, *filter(None, [first]), *(f"G1 {place}" for place in kept[2:])]
    return "\n".join([*head, *body, up, "M2"]) + "\n"


# --- SVG ----------------------------------------------------------------------------------------------------
INK, FAINT, STRAIGHT = "#22303c", "#9aa7b1", "L"
COMMANDS = {1: "L", 2: "Q", 3: "C"}
FINE = 1e-4
"""Of the size of the picture: how far chords may be off where SVG has no curve of the degree."""


def svg(track: Track, problem: Problem, obstacles: Sequence[ObstaclePicture], plane: str = "xy") -> str:
    """The path in a plane as one SVG image in mm, with the workspace, the obstacles' outlines and the given points.

    Curves up to degree three are SVG's own, others chords.
    """
    i, j = axes(plane)
    radius = sqrt(float(problem.workspace.radius_squared))
    flat = track.control[:, :, [i, j]] * [1.0, -1.0]  # the vertical axis of SVG points down
    outlines = [(o, o.outline(i, j)) for o in obstacles]
    half = problem.workspace.kind is WorkspaceKind.HEMISPHERE and plane != "xy"
    edge = 1.05 * radius
    view = f"{_n(-edge)} {_n(-edge)} {_n(2 * edge)} {_n((edge + 0.05 * radius) if half else 2 * edge)}"
    r = _n(radius)
    border = f"M-{r} 0 A{r} {r} 0 0 1 {r} 0 Z" if half else f"M-{r} 0 A{r} {r} 0 0 1 {r} 0 A{r} {r} 0 0 1 -{r} 0 Z"
    marks = {"start": problem.start, "Q0": problem.via[0], "R0": problem.via[1], "goal": problem.goal}
    parts = [f'<path d="{border}" fill="none" stroke="{FAINT}" stroke-width="{_n(radius / 300)}"/>']
    for obstacle, outline in outlines:
        if outline is not None:
            corners = " ".join(f"{_n(x)},{_n(-y)}" for x, y in outline)
            named = f"<title>{escape(obstacle.name, quote=False)}</title>"
            parts.append(f'<polygon points="{corners}" fill="{obstacle.colour}" fill-opacity="0.5">{named}</polygon>')
    parts.append(
        f'<path d="{_drawn(flat, FINE * radius)}" fill="none" stroke="{INK}" stroke-width="{_n(radius / 150)}"/>'
    )
    for name, point in marks.items():
        x, y = float(point[i]), -float(point[j])
        dot = f'<circle cx="{_n(x)}" cy="{_n(y)}" r="{_n(radius / 80)}" fill="{INK}">'
        parts.append(f"{dot}<title>{name}</title></circle>")
    title = f"planned path, plane {plane}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{view}" role="img" aria-label="{title}">'
    return "\n".join([head, f"<title>{title}</title>", *parts, "</svg>"]) + "\n"


def _drawn(control: Array, tolerance: float) -> str:
    """The data of an SVG path."""
    degree = control.shape[1] - 1
    words = [f"M{_pair(control[0, 0])}"]
    for points in control:
        corners = points if degree in COMMANDS else polyline(points, tolerance)
        words.append(COMMANDS.get(degree, STRAIGHT) + " ".join(map(_pair, corners[1:])))
    return " ".join(words)


def _pair(point: Array) -> str:
    return f"{_n(point[0])},{_n(point[1])}"


def _n(value: float) -> str:
    return f"{value + 0.0:.9g}"
