"""Names beside points of a drawing, placed so that they cover neither each other nor what is drawn, and stay inside."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np

from bezier.pictures.mesh import Array

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
        centres = [at + _step(k, reach, half) for reach, k in product(REACHES, range(PLACES))]
        best = min(centres, key=lambda c: _cost(np.concatenate([c - half, c + half]), frame, taken, busy, at))
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


def _cost(box: Array, frame: Array, taken: Sequence[Array], busy: Array, at: Array) -> float:
    size = float((box[2] - box[0]) * (box[3] - box[1]))
    over = sum(_shared(box, other) for other in taken)
    inside = ((busy >= box[:2]) & (busy <= box[2:])).all(axis=1).sum() if len(busy) else 0
    away = float(np.linalg.norm((box[:2] + box[2:]) / 2 - at))
    return COVERING * over + OUTSIDE * (size - _shared(box, frame)) + CROSSING * float(inside) + FAR * away


def _shared(a: Array, b: Array) -> float:
    """The area that two rectangles (low, high) have in common."""
    sides = np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2])
    return float(max(sides[0], 0.0) * max(sides[1], 0.0))
