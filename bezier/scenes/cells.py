"""The cells into which the coordinates of all corners divide a domain: which are free, and which hang together.

On an axis with the coordinates c_0 < ... < c_m place 2*i is the number c_i, place 2*i + 1 the open interval above it.
Obstacles are closed, so a free cell has only free cells around it within the domain: two free cells, one of which is in
the closure of the other, are joined by free cells that differ in one place by one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from bezier.scenes.scene import Point, Scene, Solid, SolidBox
from qe.errors import Unable
from qe.options import Budget

Place = tuple[int, ...]
Open = tuple[Point, Point]
"""The open box between two corners."""

MOST_CELLS = 20_000_000


@dataclass(frozen=True, slots=True)
class CellGrid:
    """``free``: for each place of each axis whether the cell is outside all obstacles."""

    axes: tuple[tuple[Fraction, ...], ...]
    free: NDArray[np.bool_]

    @staticmethod
    def of(scene: Scene, boxes: Sequence[SolidBox]) -> CellGrid:
        """The cells of a scene with these boxes for its obstacles, start and goal among the corners. Raises ``Unable``
        where there are too many."""
        axes = []
        for k, (low, high) in enumerate(zip(scene.domain.low, scene.domain.high, strict=True)):
            corners = {c[k] for box in boxes for c in (box.low, box.high)} | {scene.start[k], scene.goal[k]}
            axes.append(tuple(sorted({low, high} | {c for c in corners if low < c < high})))
        shape = [2 * len(axis) - 1 for axis in axes]
        if int(np.prod(shape, dtype=object)) > MOST_CELLS:
            raise Unable(f"more than {MOST_CELLS} cells")
        free = np.ones(shape, dtype=bool)
        cells = CellGrid(tuple(axes), free)
        for box in boxes:
            free[tuple(cells._range(k, box) for k in range(len(axes)))] = False
        return cells

    def _range(self, k: int, box: SolidBox) -> slice:
        """The places of an axis that lie in a box."""
        axis = self.axes[k]
        inside = [2 * i for i, c in enumerate(axis) if box.low[k] <= c <= box.high[k]]
        if inside:
            return slice(inside[0], inside[-1] + 1)
        return slice(0, 0)

    def place(self, point: Point) -> Place:
        """The cell of a point that is a corner on every axis."""
        return tuple(2 * axis.index(c) for axis, c in zip(self.axes, point, strict=True))

    def sample(self, place: Place) -> Point:
        """A point of a cell: the number, or the middle of the interval."""
        return tuple(
            axis[p // 2] if p % 2 == 0 else (axis[p // 2] + axis[p // 2 + 1]) / 2
            for axis, p in zip(self.axes, place, strict=True)
        )

    def reached(self, start: Place, budget: Budget) -> tuple[NDArray[np.bool_], dict[Place, Place]]:
        """The free cells that hang together with one of them, and for each the one before it on a shortest way."""
        seen, before = np.zeros_like(self.free), dict[Place, Place]()
        seen[start], waiting = True, deque([start])
        while waiting:
            place = waiting.popleft()
            budget.check("cells of the scene")
            for other in self._around(place):
                if self.free[other] and not seen[other]:
                    seen[other], before[other] = True, place
                    waiting.append(other)
        return seen, before

    def _around(self, place: Place) -> Iterator[Place]:
        for k, p in enumerate(place):
            for q in (p - 1, p + 1):
                if 0 <= q < self.free.shape[k]:
                    yield (*place[:k], q, *place[k + 1 :])

    def boxes(self, chosen: NDArray[np.bool_]) -> tuple[Open, ...]:
        """Open boxes that hold just these cells of the domain, where these are all free cells around each of them."""
        left_over, made = chosen.copy(), []
        while left_over.any():
            first = tuple(int(p) for p in np.unravel_index(int(np.argmax(left_over)), chosen.shape))
            ranges = [[p, p] for p in first]
            for k in range(len(ranges)):
                for end, step in ((0, -1), (1, 1)):
                    while 0 <= ranges[k][end] + step < chosen.shape[k]:
                        wider = [list(r) for r in ranges]
                        wider[k][end] += step
                        if not chosen[tuple(slice(a, b + 1) for a, b in wider)].all():
                            break
                        ranges = wider
            left_over[tuple(slice(a, b + 1) for a, b in ranges)] = False
            made.append(self._open(ranges))
        return tuple(made)

    def _open(self, ranges: Sequence[Sequence[int]]) -> Open:
        """Beyond the domain where a range ends with it."""
        low, high = [], []
        for axis, (a, b) in zip(self.axes, ranges, strict=True):
            low.append(axis[0] - 1 if a == 0 else axis[a // 2])
            high.append(axis[-1] + 1 if b == 2 * len(axis) - 2 else axis[b // 2 + 1])
        return tuple(low), tuple(high)


def shortened(points: Sequence[Point], obstacles: Sequence[Solid]) -> tuple[Point, ...]:
    """A polygonal path with as few of these corners as are met by looking from each as far ahead as the way is free."""
    kept, at = [points[0]], 0
    while at < len(points) - 1:
        ahead = len(points) - 1
        while ahead > at + 1 and any(box.meets(points[at], points[ahead]) for box in obstacles):
            ahead -= 1
        kept.append(points[ahead])
        at = ahead
    return tuple(kept)


def way(before: dict[Place, Place], start: Place, goal: Place) -> list[Place]:
    """The cells from start to goal."""
    places = [goal]
    while places[-1] != start:
        places.append(before[places[-1]])
    return places[::-1]


def segments(points: Sequence[Point]) -> Iterator[tuple[Point, Point]]:
    """The segments of a polygonal path."""
    return pairwise(points)
