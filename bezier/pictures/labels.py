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
