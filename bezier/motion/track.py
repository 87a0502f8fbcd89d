"""A motion in floating point: arrays that numpy evaluates at many times at once. They decide nothing."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bezier.trajectories.piecewise import Trajectory
from qe.errors import InputError, Unable

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Track:
    """``breaks``: (n+1,) ascending times; ``control``: (n, d+1, 3), the control points of each piece (mm)."""

    breaks: Array
    control: Array

    @staticmethod
    def of(moved: Trajectory) -> Track:
        """Each number rounded once. Raises ``Unable`` where floating point cannot tell two times apart."""
        curves = [moved.curve(i) for i in range(len(moved.pieces))]
        degree = max(curve.degree for curve in curves)
        try:
            breaks = list(map(float, moved.breaks))
            control = [[[float(c) for c in p] for p in curve.elevate(degree).points] for curve in curves]
        except OverflowError:
            expected = "numbers within the range of floating point"
            raise InputError(f"the path: {expected} expected, larger ones found") from None
        if not all(a < b for a, b in pairwise(breaks)):
            raise Unable("a part of the motion is shorter than floating point can resolve, so it has no rounded form")
        return Track(np.array(breaks), np.array(control))

    @property
    def end(self) -> float:
        """The time at the end; it begins at 0."""
        return float(self.breaks[-1])

    @cached_property
    def derivative(self) -> Track:
        """The velocity as a track."""
        degree = self.control.shape[1] - 1
        if degree == 0:
            return Track(self.breaks, np.zeros_like(self.control))
        length = np.diff(self.breaks)[:, None, None]
        return Track(self.breaks, degree * np.diff(self.control, axis=1) / length)

    def halved(self) -> Track:
        """The same with a break in the middle of each piece (de Casteljau)."""
        left, right, rows = [self.control[:, :1]], [self.control[:, -1:]], self.control
        while rows.shape[1] > 1:
            rows = (rows[:, :-1] + rows[:, 1:]) / 2
            left.append(rows[:, :1])
            right.append(rows[:, -1:])
        halves = np.stack([np.concatenate(left, axis=1), np.concatenate(right[::-1], axis=1)], axis=1)
        middle = (self.breaks[:-1] + self.breaks[1:]) / 2
        breaks = np.append(np.stack([self.breaks[:-1], middle], axis=1).ravel(), self.breaks[-1])
        return Track(breaks, halves.reshape(-1, *self.control.shape[1:]))

    def at(self, times: ArrayLike) -> Array:
        """The points at these times, of shape (*times.shape, 3). Raises ``InputError`` for times outside."""
        given = _times(times)
        outside = ~((given >= 0) & (given <= self.end))  # true for what is not a number as well
        if outside.any():
            result = given[outside].flat[0]
            raise InputError(f"t: times from 0 to {self.end:.12g} expected, {result:.12g} found")
        at = np.clip(np.searchsorted(self.breaks, given, side="right") - 1, 0, len(self.control) - 1)
        low, high = self.breaks[at], self.breaks[at + 1]
        return casteljau(self.control[at], (given - low) / (high - low))


def casteljau(rows: Array, u: Array) -> Array:
    """The points at ``u`` of curves with these control points, of shape (*u.shape, d+1, axes) or (d+1, axes)."""
    share = u[..., None, None]
    while rows.shape[-2] > 1:
        rows = rows[..., :-1, :] * (1 - share) + rows[..., 1:, :] * share
    return np.asarray(np.broadcast_to(rows[..., 0, :], (*u.shape, rows.shape[-1])))


def _times(times: ArrayLike) -> Array:
    try:
        result = np.asarray(times)
        if result.dtype.kind in "iuf" or (result.dtype == object and result.size):
            return result.astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InputError(f"t: numbers expected, {type(times).__name__} found")
